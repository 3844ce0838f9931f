#include "tests/unit/csg/test_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <memory>

#include <gtest/gtest.h>

namespace csgrun::testing {

PolygonMesh box_mesh(glm::dvec3 lo, glm::dvec3 hi) {
  PolygonMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.points.push_back({i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z});
  }
  for (const auto& face : std::initializer_list<std::array<uint32_t, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.add_face(face);
  }
  mesh.convex = true;
  mesh.kind = "cube";
  return mesh;
}

PolygonMesh in_one(PolygonMesh a, const PolygonMesh& b) {
  const auto first = static_cast<uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (size_t loop = 0; loop < b.loop_count(); ++loop) {
    std::vector<uint32_t> corners(b.corners.begin() + b.loop_starts[loop],
                                  b.corners.begin() + b.loop_starts[loop + 1]);
    for (uint32_t& corner : corners) corner += first;
    a.add_face(corners);
  }
  a.convex = false;
  a.kind = "tangle";
  return a;
}

PolygonMesh inverted(PolygonMesh mesh) {
  for (size_t loop = 0; loop < mesh.loop_count(); ++loop) {
    std::reverse(mesh.corners.begin() + mesh.loop_starts[loop],
                 mesh.corners.begin() + mesh.loop_starts[loop + 1]);
  }
  mesh.convex = false;
  return mesh;
}

NodePtr leaf(PolygonMesh mesh, FillRule fill, SourceRef where) {
  mesh.fill = fill;
  return Node::leaf(std::make_shared<PolygonMesh>(std::move(mesh)), std::move(where));
}

NodePtr box(glm::dvec3 lo, glm::dvec3 hi, SourceRef where) {
  return Node::leaf(std::make_shared<PolygonMesh>(box_mesh(lo, hi)), std::move(where));
}

NodePtr cube(double size) { return box({0, 0, 0}, {size, size, size}); }

NodePtr prism(int sides, double radius, double height) {
  auto mesh = std::make_shared<PolygonMesh>();
  std::vector<uint32_t> bottom, top;
  for (int i = 0; i < sides; ++i) {
    const double t = 2 * 3.14159265358979323846 * i / sides;
    mesh->points.push_back({radius * std::cos(t), radius * std::sin(t), 0});
    mesh->points.push_back({radius * std::cos(t), radius * std::sin(t), height});
    bottom.insert(bottom.begin(), 2 * i);
    top.push_back(2 * i + 1);
  }
  mesh->add_face(bottom);
  mesh->add_face(top);
  for (uint32_t i = 0; i < static_cast<uint32_t>(sides); ++i) {
    const uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
    mesh->add_face(std::array<uint32_t, 4>{a, b, b + 1, a + 1}, 1);
  }
  mesh->convex = true;
  mesh->kind = "cylinder";
  return Node::leaf(mesh);
}

Affine translation(double x, double y, double z) {
  Affine a;
  a.m[0][3] = x;
  a.m[1][3] = y;
  a.m[2][3] = z;
  return a;
}

Affine scaling(double x, double y, double z) {
  Affine a;
  a.m[0][0] = x;
  a.m[1][1] = y;
  a.m[2][2] = z;
  return a;
}

Affine rotation(double degrees, std::array<double, 3> axis) {
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  for (double& a : axis) a /= length;
  const double t = degrees * 3.14159265358979323846 / 180, c = std::cos(t), s = std::sin(t);
  Affine r;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r.m[i][j] = axis[i] * axis[j] * (1 - c) + (i == j ? c : 0);
  }
  r.m[0][1] -= axis[2] * s;
  r.m[1][0] += axis[2] * s;
  r.m[0][2] += axis[1] * s;
  r.m[2][0] -= axis[1] * s;
  r.m[1][2] -= axis[0] * s;
  r.m[2][1] += axis[0] * s;
  return r;
}

NodePtr moved(double x, double y, double z, NodePtr child) {
  return Node::transformed(translation(x, y, z), std::move(child));
}

NodePtr turned(double degrees, std::array<double, 3> axis, NodePtr child) {
  return Node::transformed(rotation(degrees, axis), std::move(child));
}

NodePtr hull(NodePtr child, OuterHull options) {
  return Node::outer_hull(options, std::move(child));
}

NodePtr unite(std::vector<NodePtr> parts) {
  return Node::boolean(BooleanOp::kUnion, std::move(parts));
}

NodePtr intersect(std::vector<NodePtr> parts) {
  return Node::boolean(BooleanOp::kIntersection, std::move(parts));
}

NodePtr subtract(std::vector<NodePtr> parts) {
  return Node::boolean(BooleanOp::kDifference, std::move(parts));
}

NodePtr symmetric(std::vector<NodePtr> parts) {
  return Node::boolean(BooleanOp::kSymmetricDifference, std::move(parts));
}

SolidPtr solid_of(const NodePtr& root, EvaluateOptions options) {
  options.threads = 1;
  Evaluator evaluator(options);
  auto result = evaluator.evaluate(root);
  EXPECT_TRUE(result.has_value()) << result.error().message;
  return result ? *result : std::make_shared<Solid>();
}

SolidPtr solid_of(const NodePtr& root, bool join) {
  EvaluateOptions options;
  options.join_contacts = join;
  return solid_of(root, options);
}

}  // namespace csgrun::testing
