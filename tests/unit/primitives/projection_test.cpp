// Shadows of solids, against unions of the shapes that they stand on.
#include <cmath>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/projection.h>
#include <csgrun/primitives/shape2d.h>

#include "tests/unit/primitives/outlines.h"

namespace csgrun::projection_test {
namespace {

using testing::good;
using testing::length_of;

/// The prism over a shape, from one height to another.
NodePtr prism(const Shape2D& shape, double low, double high) {
  LinearExtrudeOptions options;
  options.height = high - low;
  const auto mesh = linear_extrude(shape, options);
  EXPECT_TRUE(mesh);
  Affine up;
  up.m[2][3] = low;
  return Node::transformed(up, Node::leaf(std::make_shared<PolygonMesh>(*mesh)));
}

// A wall has corners at heights of its own: seen from above they are on edges of what is higher or
// lower. Nothing of that may be a crack.
TEST(Projection, OfPrismsIsTheUnionOfTheirShapes) {
  std::mt19937 random(31);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 60; ++i) {
    std::vector<Shape2D> shapes;
    std::vector<NodePtr> prisms;
    for (int k = 0; k < 4; ++k) {
      Shape2D::Loop loop;
      const int corners = 3 + (i + k) % 5;
      const double turn = between(0, 6), radius = between(2, 6), x = between(-4, 4),
                   y = between(-4, 4);
      for (int c = 0; c < corners; ++c) {
        const double angle = turn + 6.283185307179586 * c / corners;
        // On the grid of solids, too.
        loop.emplace_back(std::nearbyint((x + radius * std::cos(angle)) * 1e5) / 1e5,
                          std::nearbyint((y + radius * std::sin(angle)) * 1e5) / 1e5);
      }
      shapes.push_back(testing::outlines({loop}));
      const double low = between(0, 4);
      prisms.push_back(prism(shapes.back(), low, low + between(1, 5)));
    }
    Evaluator evaluator{EvaluateOptions{}};
    const auto solid = evaluator.evaluate(Node::boolean(BooleanOp::kUnion, prisms));
    ASSERT_TRUE(solid);
    const Shape2D shadow = good(project_solid(**solid, 0));
    const Shape2D expected = good(Shape2D::boolean(BooleanOp::kUnion, shapes));
    EXPECT_EQ(shadow.loops().size(), expected.loops().size()) << "case " << i;
    EXPECT_NEAR(shadow.area(), expected.area(), 1e-5) << "case " << i;
    EXPECT_NEAR(length_of(shadow), length_of(expected), 1e-5) << "case " << i;
  }
}

size_t corners_of(const Shape2D& shape) {
  size_t count = 0;
  for (const Shape2D::Loop& loop : shape.loops()) count += loop.size();
  return count;
}

NodePtr leaf_of(const MeshResult& mesh) {
  EXPECT_TRUE(mesh);
  return Node::leaf(std::make_shared<PolygonMesh>(*mesh));
}

// The grid makes triangles of the sides of cones: the section has no corners where these meet.
TEST(Slice, HasTheCornersOfTheSolid) {
  Evaluator evaluator{EvaluateOptions{}};
  for (const double fn : {5.0, 8.0, 20.0, 24.0, 50.0, 127.0}) {
    const NodePtr cone = leaf_of(make_cylinder(5, 3.5, 4, false, Facets{fn, 12, 2}));
    const NodePtr flat = leaf_of(make_cylinder(0.5, 30, 2, false, Facets{fn, 12, 2}));
    const NodePtr ball = leaf_of(make_sphere(10, Facets{fn, 12, 2}));
    EXPECT_EQ(corners_of(good(slice_solid(evaluator, cone, 2.5))), fn);
    EXPECT_EQ(corners_of(good(slice_solid(evaluator, flat, 0.3))), fn);
    EXPECT_EQ(corners_of(good(slice_solid(evaluator, ball, 3))), fn);
  }
  // Nothing that is seen is lost: a side of a circle of a thousand is 3e-5 mm off.
  const NodePtr fine = leaf_of(make_cylinder(5, 10, 10, false, Facets{1000, 12, 2}));
  EXPECT_EQ(corners_of(good(slice_solid(evaluator, fine, 1))), 1000u);
}

// A cone's section is its base, made smaller.
TEST(Slice, OfAConeIsItsBaseMadeSmaller) {
  Evaluator evaluator{EvaluateOptions{}};
  const NodePtr cone = leaf_of(make_cylinder(5, 4, 6, false, Facets{8, 12, 2}));
  LinearExtrudeOptions bent;
  bent.height = 7;
  bent.twist = 30;
  bent.slices = 6;
  bent.facets = {20, 12, 2};
  const Shape2D section = good(slice_solid(evaluator, cone, 3.5));
  const Shape2D octagon = good(make_circle(5.4, Facets{8, 12, 2}));
  const auto of_section = linear_extrude(section, bent), of_octagon = linear_extrude(octagon, bent);
  ASSERT_TRUE(of_section && of_octagon);
  EXPECT_EQ(of_section->points.size(), of_octagon->points.size());
  EXPECT_NEAR(section.area(), octagon.area(), 1e-5);
}

}  // namespace
}  // namespace csgrun::projection_test
