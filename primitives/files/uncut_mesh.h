// Meshes of .csg trees whose bent faces are cut only when it is known where they come to lie.
#pragma once

#include <memory>
#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// A mesh before its bent faces of four corners are cut, and where its points lie under the nodes
/// around it. They are moved node by node, as OpenSCAD moves them: which diagonal it takes may hang
/// on the last bit. Immutable, since what a node came to may be copied.
struct UncutMesh {
  std::shared_ptr<const PolygonMesh> mesh;
  std::vector<glm::dvec3> seen;
  bool is_mirrored = false;
};
using UncutPtr = std::shared_ptr<const UncutMesh>;

/// Null for a mesh without faces.
UncutPtr uncut_of(PolygonMesh mesh);
/// Under a map, and whether that mirrors; null stays null.
UncutPtr moved(const UncutPtr& uncut, const Affine& map, bool mirrors);
UncutPtr resized(const UncutPtr& uncut, const Resize& resize);

/// The solid, a leaf of the mesh under transforms, colours and resizes, with the faces cut as they
/// lie.
NodePtr cut_as_it_lies(const NodePtr& solid, const UncutMesh& uncut);

}  // namespace csgrun
