// What touches an operand mostly leaves a surface; where it does not, a box says so.
#include "engine/bsp/touch_finder.h"

#include <gtest/gtest.h>

#include "engine/bsp/kernel.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/convex_operand.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun::touch_finder_test {
namespace {

using test::convex_operand;
using test::octahedron;

/// The top of it is a polygon of its own that is no square.
Operand block(int64_t reach, int64_t top) {
  std::vector<IVec3> points;
  for (const int64_t x : {-reach, reach}) {
    for (const int64_t y : {-reach, reach}) {
      points.push_back({x, y, top - reach});
      points.push_back({x, y + x, top});
    }
  }
  return convex_operand(test::hull_loops(points));
}

test::Boundary evaluate(BooleanOp op, const std::vector<Operand>& operands) {
  EvaluateStats stats;
  const auto result =
      evaluate_boolean(operands, test::flat_expression(op, static_cast<uint32_t>(operands.size())),
                       test::region_of(operands), {}, stats);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *result : std::make_shared<BoundaryMesh>();
}

bool holds(const BoundaryMesh& mesh, const IVec3& p) {
  return std::any_of(mesh.touches.begin(), mesh.touches.end(), [&](const GridBox& box) {
    bool all = true;
    for (size_t k = 0; k < 3; ++k) all &= box.lo[k] <= p[k] && p[k] <= box.hi[k];
    return all;
  });
}

// Equators in the top of a block are common edges of what is left.
TEST(TouchFinder, HasNothingToSayOfCommonEdges) {
  std::vector<Operand> operands{block(100, 0), octahedron({-50, -50, 0}, 20),
                                octahedron({40, 30, 0}, 20), octahedron({50, 45, 0}, 20)};
  EXPECT_FALSE(evaluate(BooleanOp::kDifference, operands)->may_touch);
  EXPECT_FALSE(evaluate(BooleanOp::kUnion, operands)->may_touch);
  EXPECT_FALSE(evaluate(BooleanOp::kIntersection, {operands[0], operands[2]})->may_touch);
}

TEST(TouchFinder, FindsCornersThatMeet) {
  const auto two =
      evaluate(BooleanOp::kUnion, {octahedron({0, 0, 0}, 10), octahedron({20, 0, 0}, 10)});
  EXPECT_TRUE(two->may_touch);
  EXPECT_TRUE(holds(*two, {10, 0, 0}));
  // Two voids that meet in a corner.
  const auto voids = evaluate(BooleanOp::kDifference, {block(100, 0), octahedron({0, 0, -50}, 10),
                                                       octahedron({20, 0, -50}, 10)});
  EXPECT_TRUE(holds(*voids, {10, 0, -50}));
  EXPECT_FALSE(holds(*voids, {-10, 0, -50}));
  // In the top of the block the corners around that point are one round.
  EXPECT_FALSE(evaluate(BooleanOp::kDifference,
                        {block(100, 0), octahedron({0, 0, 0}, 10), octahedron({20, 0, 0}, 10)})
                   ->may_touch);
}

TEST(TouchFinder, FindsACornerOnAFace) {
  const auto on = evaluate(BooleanOp::kUnion, {block(100, 0), octahedron({-7, 9, 15}, 15)});
  EXPECT_TRUE(holds(*on, {-7, 9, 0}));
  const auto below =
      evaluate(BooleanOp::kDifference, {block(100, 0), octahedron({-7, 9, -15}, 15)});
  EXPECT_TRUE(holds(*below, {-7, 9, 0}));
}

TEST(TouchFinder, FindsAnEdgeOnAFace) {
  const std::vector<IVec3> roof{{-30, -10, 20}, {-30, 10, 20}, {30, -10, 20},
                                {30, 10, 20},   {-30, 3, 0},   {30, 3, 0}};
  const auto on =
      evaluate(BooleanOp::kUnion, {block(100, 0), convex_operand(test::hull_loops(roof))});
  EXPECT_TRUE(holds(*on, {-30, 3, 0}));
  EXPECT_TRUE(holds(*on, {30, 3, 0}));
  EXPECT_TRUE(holds(*on, {5, 3, 0}));
}

Operand known(const std::vector<test::Loop>& loops) {
  auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(loops));
  leaf->opposite = pair_edges(*leaf).opposite;
  leaf->may_touch = false;
  return test::operand_of(std::move(leaf));
}

// Two wedges with an edge in common, or a part of one: all of that is told.
TEST(TouchFinder, FindsEdgesThatMeet) {
  const auto wedge = [](int64_t sign, int64_t from, int64_t to) {
    std::vector<IVec3> points;
    for (const int64_t z : {from, to}) {
      for (const int64_t y : {1, 5}) points.push_back({sign * 10, sign * y, z});
      points.push_back({0, 0, z});
    }
    return known(test::hull_loops(points));
  };
  const Operand around = known(test::box_loops({-90, -90, -90}, {90, 90, 90}));
  for (const auto& [from, to] :
       {std::pair<int64_t, int64_t>{0, 30}, {0, 20}, {10, 20}, {10, 40}, {-10, 40}, {30, 50}}) {
    const Operand one = wedge(1, 0, 30), other = wedge(-1, from, to);
    const auto both = evaluate(BooleanOp::kUnion, {one, other}),
               voids = evaluate(BooleanOp::kDifference, {around, one, other});
    for (int64_t z = std::max<int64_t>(from, 0); z <= std::min<int64_t>(to, 30); z += 5) {
      EXPECT_TRUE(holds(*both, {0, 0, z})) << from << ' ' << to;
      EXPECT_TRUE(holds(*voids, {0, 0, z})) << from << ' ' << to;
    }
    EXPECT_FALSE(evaluate(BooleanOp::kUnion, {one, wedge(-1, 31, 40)})->may_touch);
  }
}

// Whether very many corners are one round nobody asks.
TEST(TouchFinder, LooksAtSixtyFourCornersAtMost) {
  for (const int64_t sides : {63, 64, 65, 70}) {
    std::vector<test::Point2> base;
    for (int64_t i = 0; i < sides; ++i) base.push_back({i, i * i});
    const IVec3 apex{sides / 2, 3 * sides * sides / 8, 40};
    const Operand cone = known(test::cone_loops(base, 0, apex, std::nullopt)),
                  box = known(test::box_loops({-10, -10, -20}, {100, 5000, 40}));
    const auto inside = evaluate(BooleanOp::kIntersection, {cone, box});
    EXPECT_EQ(inside->faces.size(), static_cast<size_t>(sides) + 1);
    EXPECT_EQ(inside->may_touch, sides > 64) << sides;
    EXPECT_EQ(holds(*inside, apex), sides > 64) << sides;
  }
}

}  // namespace
}  // namespace csgrun::touch_finder_test
