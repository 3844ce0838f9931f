// Where a resolved surface says that it may touch itself: it is presented as if it could anywhere.
#include <gtest/gtest.h>

#include "engine/bsp/self_resolution.h"
#include "engine/mesh/leaf_check.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"
#include "tests/support/touches_told.h"

namespace csgrun::resolved_touches_test {
namespace {

using namespace test;  // NOLINT: a test

/// A leaf that knows its opposite edges, if each edge has two faces.
Operand surface_of(const std::vector<Loop>& loops, bool keep_facets = false) {
  auto leaf = std::make_shared<LeafGeometry>(*make_leaf(loops, keep_facets));
  leaf->opposite = pair_edges(*leaf).opposite;
  return operand_of(std::move(leaf));
}

BoundaryMesh resolved(const Operand& surface, InsideRule rule) {
  EvaluateStats stats;
  auto result = resolve_surface(surface, find_self_intersections(*surface.leaf), rule, {}, stats);
  EXPECT_TRUE(result);
  return **result;
}

/// Whether the mesh says where.
bool expect_same_as_anywhere(const BoundaryMesh& mesh, const std::string& what) {
  expect_touches_told(mesh, what);
  return !mesh.may_touch || !mesh.touches.empty();
}

TEST(ResolvedTouches, AreAllThereAre) {
  int known = 0, paired = 0;
  for (int round = 0; round < 60; ++round) {
    Random random(7100 + round);
    std::vector<Loop> loops;
    for (int64_t i = random.integer(2, 4); i > 0; --i) {
      const auto own = random_loops(random, 4);
      loops.insert(loops.end(), own.begin(), own.end());
    }
    Operand surface = surface_of(loops, random.integer(0, 1) == 0);
    if (random.integer(0, 2) == 0) surface.frame = random_frame(random);
    surface.translation = {random.integer(-5, 5), random.integer(-5, 5), random.integer(-5, 5)};
    for (const InsideRule rule : {InsideRule::kNonZero, InsideRule::kEvenOdd,
                                  InsideRule::kOuterHull, InsideRule::kOrientedHull}) {
      const std::string what =
          std::to_string(round) + " by rule " + std::to_string(static_cast<int>(rule));
      const bool is_known = expect_same_as_anywhere(resolved(surface, rule), what);
      known += is_known ? 1 : 0;
      paired += surface.leaf->opposite.empty() ? 0 : 1;
      const bool is_hull = rule == InsideRule::kOuterHull || rule == InsideRule::kOrientedHull;
      EXPECT_TRUE(is_hull || is_known) << what;
    }
  }
  EXPECT_GT(known, 160);
  EXPECT_GT(paired, 80);
  EXPECT_LT(paired, 160);
}

// Two boxes that cross, and a third that is far away: contacts are near the crossing.
TEST(ResolvedTouches, AreWhereTheSurfaceCrossesItself) {
  auto loops = box_loops({0, 0, 0}, {6, 6, 6});
  for (const auto& other : {box_loops({4, 4, 4}, {9, 9, 9}), box_loops({50, 0, 0}, {56, 6, 6})}) {
    loops.insert(loops.end(), other.begin(), other.end());
  }
  Operand surface = surface_of(loops);
  surface.translation = {100, 0, 0};
  const BoundaryMesh mesh = resolved(surface, InsideRule::kNonZero);
  ASSERT_FALSE(mesh.touches.empty());
  for (const GridBox& box : mesh.touches) {
    EXPECT_GE(box.lo[0], 104);
    EXPECT_LE(box.hi[0], 106);
    EXPECT_LE(box.lo[0], box.hi[0]);
  }
}

// Two boxes with an edge in common, which four faces have, and two tetrahedra with a corner.
TEST(ResolvedTouches, AreWhereTheSurfaceIsNoManifold) {
  auto loops = box_loops({0, 0, 0}, {6, 6, 6});
  for (const auto& other : {box_loops({6, 6, 0}, {9, 9, 6}),
                            hull_loops({{30, 0, 0}, {33, 0, 0}, {30, 3, 0}, {30, 0, 3}}),
                            hull_loops({{30, 0, 0}, {27, 0, 0}, {30, -3, 0}, {30, 0, -3}})}) {
    loops.insert(loops.end(), other.begin(), other.end());
  }
  Operand surface = surface_of(loops);
  ASSERT_TRUE(surface.leaf->opposite.empty());
  surface.translation = {100, 0, 0};
  const BoundaryMesh mesh = resolved(surface, InsideRule::kNonZero);
  ASSERT_EQ(mesh.touches.size(), 2u);
  EXPECT_EQ(mesh.touches[0].lo, (IVec3{106, 6, 0}));
  EXPECT_EQ(mesh.touches[0].hi, (IVec3{106, 6, 6}));
  EXPECT_EQ(mesh.touches[1].lo, (IVec3{130, 0, 0}));
  EXPECT_EQ(mesh.touches[1].hi, (IVec3{130, 0, 0}));
}

// Cubes in every other cell of a small grid are a leaf that touches itself in edges and corners
// only: so does what is left of it.
TEST(ResolvedTouches, OfALeafAreWhereItIsNoManifold) {
  size_t touching = 0;
  for (int round = 0; round < 60; ++round) {
    Random random(7300 + round);
    std::vector<Loop> loops;
    for (int64_t cell = 0; cell < 27; ++cell) {
      const IVec3 lo{cell % 3 * 2, cell / 3 % 3 * 2, cell / 9 * 2};
      if (cell % 2 != 0 || random.integer(0, 1) == 0) continue;
      const auto cube = box_loops(lo, {lo[0] + 2, lo[1] + 2, lo[2] + 2});
      loops.insert(loops.end(), cube.begin(), cube.end());
    }
    if (loops.empty()) continue;
    std::vector<Operand> operands{surface_of(loops), surface_of(random_loops(random, 6))};
    operands[0].translation = operands[1].translation = {random.integer(-5, 5), 0, 7};
    auto tool = std::make_shared<LeafGeometry>(*operands[1].leaf);
    tool->may_touch = !find_self_intersections(*tool).empty();
    ASSERT_FALSE(tool->may_touch) << round;
    operands[1].leaf = tool;
    EvaluateStats stats;
    const auto result = evaluate_boolean(operands, flat_expression(BooleanOp::kDifference, 2),
                                         region_of(operands), {}, stats);
    ASSERT_TRUE(result) << round;
    expect_same_as_anywhere(**result, std::to_string(round));
    touching += (*result)->touches.empty() ? 0 : 1;
  }
  EXPECT_GT(touching, 40u);
}

// A tetrahedron stands on its tip in the middle of a box's top, where four triangles of that meet.
// They become one face, which has no corner there.
TEST(ResolvedTouches, AreWhereACornerGoes) {
  for (const bool has_edge : {false, true}) {
    const IVec3 tip{3, 3, 6};
    std::vector<Loop> loops;
    for (const Loop& face : box_loops({0, 0, 0}, {6, 6, 6})) {
      const bool is_top =
          std::all_of(face.begin(), face.end(), [](const IVec3& p) { return p[2] == 6; });
      if (!is_top) loops.push_back(face);
      for (size_t i = 0; is_top && i < face.size(); ++i) {
        loops.push_back({face[i], face[(i + 1) % face.size()], tip});
      }
    }
    std::vector<std::vector<Loop>> others{hull_loops({tip, {2, 2, 9}, {4, 2, 9}, {3, 5, 9}})};
    if (has_edge) {
      others.push_back(box_loops({20, 0, 0}, {23, 3, 3}));
      others.push_back(box_loops({23, 3, 0}, {26, 6, 3}));
    }
    for (const auto& other : others) loops.insert(loops.end(), other.begin(), other.end());
    const Operand surface = surface_of(loops);
    ASSERT_EQ(surface.leaf->opposite.empty(), has_edge);
    EXPECT_TRUE(expect_same_as_anywhere(resolved(surface, InsideRule::kNonZero), "resolved"));
    auto tool = std::make_shared<LeafGeometry>(*make_leaf(box_loops({-1, -1, -1}, {1, 1, 1})));
    tool->may_touch = false;
    const std::vector<Operand> operands{surface, operand_of(tool)};
    EvaluateStats stats;
    const auto result = evaluate_boolean(operands, flat_expression(BooleanOp::kDifference, 2),
                                         region_of(operands), {}, stats);
    ASSERT_TRUE(result);
    EXPECT_FALSE((*result)->touches.empty());
    expect_same_as_anywhere(**result, "cut");
  }
}

}  // namespace
}  // namespace csgrun::resolved_touches_test
