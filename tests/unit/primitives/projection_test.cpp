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

namespace csgrun {
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
    const Shape2D shadow = good(project_solid(**solid));
    const Shape2D expected = good(Shape2D::boolean(BooleanOp::kUnion, shapes));
    EXPECT_EQ(shadow.loops().size(), expected.loops().size()) << "case " << i;
    EXPECT_NEAR(shadow.area(), expected.area(), 1e-5) << "case " << i;
    EXPECT_NEAR(length_of(shadow), length_of(expected), 1e-5) << "case " << i;
  }
}

}  // namespace
}  // namespace csgrun
