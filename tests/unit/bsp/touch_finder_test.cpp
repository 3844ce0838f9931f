// What touches an operand mostly leaves a surface; where it does not, a box says so.
#include "engine/bsp/touch_finder.h"

#include <gtest/gtest.h>

#include "engine/bsp/kernel.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun {
namespace {

Operand convex(const std::vector<IVec3>& points) {
  auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(test::hull_loops(points)));
  leaf->opposite = pair_edges(*leaf).opposite;
  leaf->convex = true;
  leaf->may_touch = false;
  return test::operand_of(std::move(leaf));
}

Operand octahedron(const IVec3& middle, int64_t radius) {
  std::vector<IVec3> points;
  for (size_t k = 0; k < 3; ++k) {
    for (const int64_t r : {-radius, radius}) {
      points.push_back(middle);
      points.back()[k] += r;
    }
  }
  return convex(points);
}

/// The top of it is a polygon of its own that is no square.
Operand block(int64_t reach, int64_t top) {
  std::vector<IVec3> points;
  for (const int64_t x : {-reach, reach}) {
    for (const int64_t y : {-reach, reach}) {
      points.push_back({x, y, top - reach});
      points.push_back({x, y + x, top});
    }
  }
  return convex(points);
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
  const auto on = evaluate(BooleanOp::kUnion, {block(100, 0), convex(roof)});
  EXPECT_TRUE(holds(*on, {-30, 3, 0}));
  EXPECT_TRUE(holds(*on, {30, 3, 0}));
  EXPECT_TRUE(holds(*on, {5, 3, 0}));
}

}  // namespace
}  // namespace csgrun
