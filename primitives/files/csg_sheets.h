// Surfaces of .csg trees that enclose nothing, open or flat: a hull has their points, and a shadow
// their faces, all the same.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/shape2d.h>

namespace csgrun {

/// Faces that need not be closed, in millimetres; each is an outer loop and its holes.
struct CsgSheet {
  using Face = std::vector<std::vector<glm::dvec3>>;
  std::vector<Face> faces;

  [[nodiscard]] bool empty() const { return faces.empty(); }
  void append(CsgSheet more);
};

/// Whether a mesh that is refused as a solid is at least faces over finite points.
bool is_sheet(const PolygonMesh& mesh);

/// The faces of a mesh under a map.
CsgSheet sheet_of(const PolygonMesh& mesh, const Affine& map = {});
/// Those of a solid.
CsgSheet sheet_of(const Solid& solid, const Affine& map);
/// What the sheet becomes under a map.
CsgSheet mapped(CsgSheet sheet, const Affine& map);

/// The shadow on the plane z = 0: of all faces, whichever way they look. Errors: those of
/// Shape2D::from_outlines.
Result<Shape2D> shadow_of(const CsgSheet& sheet);

/// The convex hull of the points of a mesh that faces have, as a leaf.
NodePtr leaf_of_corners(const PolygonMesh& mesh, const SourceRef& where);

/// What a map that flattens leaves of a tree for a hull around it: the convex hull of its corners
/// there, in the one colour of the tree if it has one. Leaves under unions give theirs as they are,
/// all else is evaluated. Errors: those of the evaluation.
Result<NodePtr> flattened_corners(const NodePtr& tree, const Affine& map, Evaluator& evaluator,
                                  const SourceRef& where);

/// What it leaves of a tree for a Minkowski sum: the union of convex parts, hulls of points of one
/// plane. Leaves that are convex are one part, of all else there is one for each triangle of its
/// surface (whose image is that of the whole). The colour and the errors as above.
Result<NodePtr> flattened_parts(const NodePtr& tree, const Affine& map, Evaluator& evaluator,
                                const SourceRef& where);

}  // namespace csgrun
