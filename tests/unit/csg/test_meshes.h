// Small leaves and transforms for the tests of this folder.
#pragma once

#include <array>
#include <vector>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/evaluate.h>

namespace csgrun::testing {

/// An axis-aligned box.
PolygonMesh box_mesh(glm::dvec3 lo, glm::dvec3 hi);

/// The faces of both meshes in one, whatever they do to one another.
PolygonMesh in_one(PolygonMesh a, const PolygonMesh& b);

/// The mesh with its faces turned over.
PolygonMesh inverted(PolygonMesh mesh);

NodePtr leaf(PolygonMesh mesh, FillRule fill, SourceRef where = {});

NodePtr box(glm::dvec3 lo, glm::dvec3 hi, SourceRef where = {});
NodePtr cube(double size);

/// A right prism over a regular polygon, along +z from 0.
NodePtr prism(int sides, double radius, double height);

Affine translation(double x, double y, double z);
Affine scaling(double x, double y, double z);
/// Rotation about an axis by degrees.
Affine rotation(double degrees, std::array<double, 3> axis);

NodePtr moved(double x, double y, double z, NodePtr child);
NodePtr turned(double degrees, std::array<double, 3> axis, NodePtr child);
NodePtr hull(NodePtr child, OuterHull options = {});
NodePtr unite(std::vector<NodePtr> parts);
NodePtr intersect(std::vector<NodePtr> parts);
NodePtr subtract(std::vector<NodePtr> parts);
NodePtr symmetric(std::vector<NodePtr> parts);

/// Evaluated on one thread; an error fails the test.
SolidPtr solid_of(const NodePtr& root, EvaluateOptions options = {});
/// With contacts joined or kept apart.
SolidPtr solid_of(const NodePtr& root, bool join);

}  // namespace csgrun::testing
