// Parts of a turn as trees: their ends are flush with one another, and with what is turned.
#include <cmath>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/trig.h>

#include "tests/unit/primitives/outlines.h"

namespace csgrun::turned_ends_test {
namespace {

using testing::box;

constexpr double kPi = 3.14159265358979323846;

NodePtr turned(const Shape2D& shape, double angle, double start, double fn) {
  const auto tree = rotate_extrude_solid(shape, {angle, start, Facets{fn, 12, 2}}, {});
  EXPECT_TRUE(tree);
  return *tree;
}

NodePtr rotated(double angle, const NodePtr& node) {
  Affine map;
  map.m[0] = {cos_deg(angle), -sin_deg(angle), 0, 0};
  map.m[1] = {sin_deg(angle), cos_deg(angle), 0, 0};
  return Node::transformed(map, node);
}

SolidPtr evaluated(const NodePtr& node) {
  EvaluateOptions options;
  options.grid = *GridStep::parse("1e-6mm");
  const auto solid = Evaluator(options).evaluate(node);
  EXPECT_TRUE(solid) << solid.error().message;
  return *solid;
}

/// Of the turned box from x0 to x1, of that height: chords, no arcs.
double volume_of(double x0, double x1, double height, double angle, int steps) {
  const double sector = std::sin(std::fabs(angle) / steps * kPi / 180) / 2 * steps;
  return sector * (x1 * x1 - x0 * x0) * height;
}

TEST(TurnedEnds, AreWhereTheTurnEnds) {
  for (const double angle : {1.0, 40.0, 90.0, 200.0, 359.0, 359.95, -77.0, -350.0, 300.0, 500.0}) {
    for (const double start : {0.0, 13.7, -90.0, 400.0}) {
      for (const auto& [x0, x1] :
           {std::pair{0.0, 3.0}, std::pair{1.0, 3.0}, std::pair{-3.0, -1.0}}) {
        const Shape2D shape = box(x0, -1, x1, 2);
        const Facets facets{7, 12, 2};
        const double turn = std::fabs(angle) > 360 ? 360 : angle;
        const SolidPtr solid = evaluated(turned(shape, angle, start, 7));
        const double near = std::fmin(std::fabs(x0), std::fabs(x1));
        EXPECT_NEAR(solid->measures.volume, volume_of(near, 3, 3, turn, facets.fragments(3, turn)),
                    1e-4)
            << angle << ' ' << start << ' ' << x0;
        EXPECT_EQ(solid->measures.components, 1);
        EXPECT_EQ(solid->measures.genus, turn == 360 && near > 0 ? 1 : 0);
      }
    }
  }
}

// What stands on an end has no thickness, whatever the profiles are.
TEST(TurnedEnds, OfDifferentProfilesAreFlush) {
  Affine up;
  up.m[2][3] = 3;
  for (int angle = 5; angle < 360; angle += 5) {
    for (const double start : {0.0, 13.7}) {
      const NodePtr ring = turned(box(8, 0, 10, 5), angle, start, 36);
      const NodePtr cutter = Node::transformed(up, turned(box(0, 0, 20, 7), angle, start, 36));
      const SolidPtr left = evaluated(Node::boolean(BooleanOp::kDifference, {ring, cutter}));
      const SolidPtr low = evaluated(turned(box(8, 0, 10, 3), angle, start, 36));
      EXPECT_EQ(left->measures.bbox[1].z, 3);
      EXPECT_EQ(left->measures.volume, low->measures.volume) << angle << ' ' << start;
      EXPECT_EQ(left->measures.area, low->measures.area) << angle << ' ' << start;
    }
  }
}

TEST(TurnedEnds, AreFlushWithWhatIsTurned) {
  for (const double angle : {10.0, 33.0, 100.0, 170.0}) {
    const NodePtr part = turned(box(2, 0, 5, 3), angle, 0, 24);
    // Another one from its end on, and a bar along the end.
    const SolidPtr both = evaluated(Node::boolean(BooleanOp::kUnion, {part, rotated(angle, part)}));
    EXPECT_EQ(both->measures.components, 1) << angle;
    EXPECT_EQ(both->measures.genus, 0) << angle;
    const SolidPtr one = evaluated(part);
    EXPECT_NEAR(both->measures.volume, 2 * one->measures.volume, 1e-4);
    EXPECT_NEAR(both->measures.area, 2 * one->measures.area - 2 * 9, 1e-4);
  }
}

TEST(TurnedEnds, OfNextToNothing) {
  for (const double angle : {5e-324, 1e-300, -1e-12, 359.99999999, -359.99999999}) {
    EXPECT_TRUE(rotate_extrude_solid(box(1, 0, 2, 1), {angle, 3, Facets{3, 12, 2}}, {})) << angle;
  }
}

TEST(TurnedEnds, BadInputIsAnErrorAsOfTheMesh) {
  const RotateExtrudeOptions none{0, 0, {}};
  const auto tree = rotate_extrude_solid(box(1, 0, 2, 1), none, {});
  const auto mesh = rotate_extrude(box(1, 0, 2, 1), none);
  ASSERT_FALSE(tree);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(tree.error().message, mesh.error().message);
  EXPECT_FALSE(rotate_extrude_solid(box(-1, 0, 2, 1), {40, 0, {}}, {}));
}

}  // namespace
}  // namespace csgrun::turned_ends_test
