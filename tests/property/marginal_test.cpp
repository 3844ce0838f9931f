// Solids that touch: faces on faces, edges on edges, corners on corners.
#include <gtest/gtest.h>

#include "tests/support/exact_measures.h"
#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/kernel_checks.h"
#include "tests/support/oracle.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::marginal_test {
namespace {

using namespace test;  // NOLINT: a test

SolidPtr presented(const Tree& tree, const std::vector<Operand>& leaves,
                   const Materialise& nest = {}) {
  const auto r = evaluate(tree, leaves, {}, nest);
  EXPECT_TRUE(r) << text(r.error());
  if (!r) return nullptr;
  EXPECT_EQ(fault_in(**r), "");
  const auto solid = present(**r, test_context());
  EXPECT_TRUE(solid) << text(solid.error());
  if (!solid) return nullptr;
  EXPECT_EQ(fault_in(**solid, **r), "");
  return *solid;
}

Tree join_of(size_t n) {
  Tree t = join({});
  for (size_t i = 0; i < n; ++i) t.children.push_back(leaf(static_cast<int>(i)));
  return t;
}

TEST(Marginal, TouchingCubesAreOneBoxOfTwelveTriangles) {
  for (int64_t n = 1; n <= 4; ++n) {
    std::vector<Operand> cubes;
    for (int64_t i = 0; i < n * n * n; ++i) {
      const IVec3 lo{i % n * 3, i / n % n * 3, i / (n * n) * 3};
      cubes.push_back(operand_of(box_leaf(lo, {lo[0] + 3, lo[1] + 3, lo[2] + 3})));
    }
    const auto solid = presented(join_of(cubes.size()), cubes);
    ASSERT_TRUE(solid);
    EXPECT_EQ(solid->triangles.size(), 12u);
    EXPECT_EQ(solid->measures.components, 1);
    EXPECT_EQ(solid->measures.genus, 0);
    EXPECT_EQ(solid->measures.volume, static_cast<double>(27 * n * n * n));
    // One after another, each result materialised.
    Tree chain = leaf(0);
    for (size_t i = 1; i < cubes.size(); ++i) chain = join({chain, leaf(static_cast<int>(i))});
    const auto chained = presented(chain, cubes, [](const Tree&) { return true; });
    ASSERT_TRUE(chained);
    EXPECT_EQ(difference_between(*solid, *chained), "");
  }
}

TEST(Marginal, CubesInARowAndTheirFacets) {
  std::vector<Operand> cubes;
  for (int64_t i = 0; i < 10; ++i) {
    cubes.push_back(operand_of(make_leaf(box_loops({i, 0, 0}, {i + 1, 1, 1}), true)));
  }
  const auto solid = presented(join_of(10), cubes);
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->triangles.size(), 12u);
}

TEST(Marginal, CubesThatShareAnEdgeOrAVertexOnlyAreTwoComponents) {
  for (const IVec3& at :
       {IVec3{2, 2, 0}, {2, 0, 2}, {0, -2, 2}, {2, 2, 1}, {2, 2, 2}, {-2, 2, -2}}) {
    const std::vector<Operand> cubes{operand_of(box_leaf({0, 0, 0}, {2, 2, 2})),
                                     operand_of(box_leaf(at, {at[0] + 2, at[1] + 2, at[2] + 2}))};
    for (const Tree& tree : {join({leaf(0), leaf(1)}), differ({leaf(1), leaf(0)})}) {
      const auto solid = presented(tree, cubes);
      ASSERT_TRUE(solid);
      EXPECT_EQ(solid->measures.components, 2);
      EXPECT_EQ(solid->measures.genus, 0);
      EXPECT_EQ(solid->measures.volume, 16);
    }
    EXPECT_TRUE(presented(meet({leaf(0), leaf(1)}), cubes)->empty());
  }
}

TEST(Marginal, NothingIsLeftOfASolidLessItself) {
  Random random(31);
  const int n = cases(20);
  for (int i = 0; i < n; ++i) {
    std::vector<Operand> leaves{operand_of(random_leaf(random))};
    if (random.bits() & 1) leaves[0].frame = random_frame(random);
    EXPECT_TRUE(presented(less({leaf(0), leaf(0)}), leaves)->empty());
    EXPECT_TRUE(presented(differ({leaf(0), leaf(0)}), leaves)->empty());
  }
}

TEST(Marginal, BoxesInBoxes) {
  std::vector<Operand> boxes;
  for (int64_t i = 0; i < 6; ++i)
    boxes.push_back(operand_of(box_leaf({i, i, i}, {20 - i, 20 - i, 20 - i})));
  Tree nested = leaf(5);
  for (int i = 4; i >= 0; --i) nested = less({leaf(i), nested});
  for (const bool materialise : {false, true}) {
    const auto solid = presented(nested, boxes, [&](const Tree&) { return materialise; });
    ASSERT_TRUE(solid);
    EXPECT_EQ(solid->measures.components, 6);
    double expected = 0;
    for (int i = 0; i < 6; ++i) expected += (i % 2 ? -1 : 1) * std::pow(20 - 2 * i, 3);
    EXPECT_EQ(solid->measures.volume, expected);
  }
  EXPECT_EQ(presented(join_of(6), boxes)->triangles.size(), 12u);
}

TEST(Marginal, HolesThatTouchEachOtherAndTheRim) {
  // A plate with square holes that meet in corners, one of them in the middle of the plate's edge.
  std::vector<Operand> parts{operand_of(box_leaf({0, 0, 0}, {12, 12, 2}))};
  for (const IVec3& at : {IVec3{2, 2, -1}, {4, 4, -1}, {2, 6, -1}, {6, 2, -1}}) {
    parts.push_back(operand_of(box_leaf(at, {at[0] + 2, at[1] + 2, 3})));
  }
  parts.push_back(operand_of(make_leaf(prism_loops({{9, 9}, {12, 6}, {12, 12}}, -1, 3))));
  parts.push_back(operand_of(make_leaf(prism_loops({{6, 12}, {4, 10}, {8, 10}}, -1, 3))));
  Tree tree = less({});
  for (int i = 0; i < static_cast<int>(parts.size()); ++i) tree.children.push_back(leaf(i));
  const auto solid = presented(tree, parts);
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->measures.volume, 2 * (144 - 16 - 9 - 4));
}

// A face in a plane x = m + 1/3 is an ordinary thing in a sheared frame, and an ordinary face of a
// result that was materialised in the world; walls of cells must not lie in it.
TEST(Marginal, FacesWhereCellWallsWouldStand) {
  Frame frame;
  frame.is_identity = false;
  for (int k = 0; k < 3; ++k)
    frame.matrix[k][k] = int64_t{3} << (Frame::kShift - 2);  // x = 4 q / 3
  std::vector<Operand> leaves;
  for (int64_t i = 0; i < 4; ++i) {
    leaves.push_back(operand_of(box_leaf({i, 0, 0}, {4 * i + 4, 4 + i, 7})));
    leaves.back().frame = frame;
  }
  leaves.push_back(operand_of(box_leaf({-2, 1, 1}, {30, 3, 3})));
  leaves.push_back(operand_of(box_leaf({1, 1, -1}, {3, 3, 30})));
  const Tree tree = less(
      {differ({differ({leaf(0), leaf(1)}), differ({leaf(2), leaf(3)})}), join({leaf(4), leaf(5)})});
  const auto flat = evaluate(tree, leaves);
  ASSERT_TRUE(flat) << text(flat.error());
  for (uint32_t limit : {1u, 2u, 5u, 17u}) {
    for (uint32_t shift = 0; shift < 5; ++shift) {
      KernelOptions options;
      options.cell_limit = limit;
      options.octree_shift = {shift, shift, shift};
      const auto nested = evaluate(tree, leaves, options, [](const Tree&) { return true; });
      ASSERT_TRUE(nested) << text(nested.error());
      EXPECT_EQ(difference_between(**flat, **nested), "");
    }
  }
}

// One operand may be mentioned several times in an expression.
TEST(Marginal, AnOperandMentionedTwice) {
  Random random(32);
  const int n = cases(60);
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const std::vector<Operand> leaves{operand_of(make_leaf(random_loops(random))),
                                      operand_of(make_leaf(random_loops(random)))};
    const Tree tree{-1,
                    static_cast<BooleanOp>(random.integer(0, 3)),
                    {{-1, static_cast<BooleanOp>(random.integer(0, 3)), {leaf(0), leaf(1)}},
                     {-1, static_cast<BooleanOp>(random.integer(0, 3)), {leaf(1), leaf(0)}}}};
    Expression e;
    e.nodes = {{true, {}, 0, 0, 0},
               {true, {}, 1, 0, 0},
               {false, tree.children[0].op, 0, 0, 2},
               {false, tree.children[1].op, 0, 2, 2},
               {false, tree.op, 0, 4, 2}};
    e.children = {0, 1, 1, 0, 2, 3};
    EvaluateStats stats;
    const auto shared =
        evaluate_boolean(leaves, e, region_of(leaves), random_options(random), stats);
    ASSERT_TRUE(shared) << text(shared.error());
    ASSERT_EQ(fault_in(**shared), "");
    const auto a = present(**shared, test_context());
    ASSERT_TRUE(a) << text(a.error());
    ASSERT_EQ(fault_in(**a, **shared), "");
    const auto b = presented(tree, leaves);
    ASSERT_EQ((*a)->positions, b->positions);
    ASSERT_EQ((*a)->triangles, b->triangles);
  }
}

// The region needs to hold the result only.
TEST(Marginal, OperandsThatReachBeyondTheRegion) {
  Random random(33);
  const int n = cases(80);
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    GridMap map;
    const int64_t scale = random.integer(1, 1 << 23);
    for (int k = 0; k < 3; ++k) map.rows[k][k] = scale, map.move[k] = -scale * random.integer(0, 5);
    std::vector<Operand> operands{
        operand_of(random_leaf(random)),
        operand_of(make_leaf(mapped(random_loops(random), map), random.bits() & 1))};
    if (random.bits() & 1) operands[1].frame = random_frame(random);
    operands[1].first_source = 1;
    for (const BooleanOp op : {BooleanOp::kIntersection, BooleanOp::kDifference}) {
      Expression e;
      e.nodes = {{true, op, 0, 0, 0}, {true, op, 1, 0, 0}, {false, op, 0, 0, 2}};
      e.children = {0, 1};
      EvaluateStats stats;
      const auto tight =
          evaluate_boolean(operands, e, {{0, 0, 0}, {5, 5, 5}}, random_options(random), stats);
      const auto wide =
          evaluate_boolean(operands, e, region_of(operands), random_options(random), stats);
      ASSERT_TRUE(tight && wide);
      ASSERT_EQ(fault_in(**tight), "");
      ASSERT_EQ(difference_between(**tight, **wide), "");
    }
  }
}

// A huge tool keeps the planes of its own vertices, with coordinates of up to 40 bits.
TEST(Marginal, ToolsThatReachVeryFar) {
  Random random(34);
  const int n = cases(80);
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    GridMap map = random_map(random, static_cast<int>(random.integer(20, 36)));
    if (random.bits() & 1) {
      const int64_t scale = int64_t{1} << random.integer(20, 36);
      for (int k = 0; k < 3; ++k) {
        map.rows[k] = {0, 0, 0};
        map.rows[k][k] = scale;
      }
    }
    // Some lattice point of the tool lies within the other solid.
    const IVec3 at{random.integer(0, 5), random.integer(0, 5), random.integer(0, 5)};
    for (int k = 0; k < 3; ++k) map.move[k] = random.integer(0, 5) - dot_of(map.rows[k], at);
    std::vector<Loop> far = mapped(random_loops(random), map);
    bool fits = true;
    for (const Loop& l : far) {
      for (const IVec3& p : l) {
        for (const int64_t v : p) fits = fits && std::abs(v) < (int64_t{1} << 40);
      }
    }
    if (!fits) continue;
    std::vector<Operand> operands{operand_of(random_leaf(random)), operand_of(make_leaf(far))};
    operands[1].first_source = 1;
    const std::vector<Oracle> oracles{Oracle(exact_solid(operands[0])),
                                      Oracle(exact_solid(operands[1]))};
    mpq_class v[2];
    for (const BooleanOp op : {BooleanOp::kIntersection, BooleanOp::kDifference}) {
      Expression e;
      e.nodes = {{true, op, 0, 0, 0}, {true, op, 1, 0, 0}, {false, op, 0, 0, 2}};
      e.children = {0, 1};
      EvaluateStats stats;
      const auto r =
          evaluate_boolean(operands, e, {{0, 0, 0}, {5, 5, 5}}, random_options(random), stats);
      ASSERT_TRUE(r) << text(r.error());
      ASSERT_EQ(fault_in(**r), "");
      const Oracle result(exact_solid(**r));
      for (int k = 0; k < 40; ++k) {
        const Query q = random_query(random, oracles[0].solid());
        const auto a = oracles[0].winding(q), b = oracles[1].winding(q), c = result.winding(q);
        if (!a || !b || !c) continue;
        ASSERT_EQ(*c, *a && (*b != 0) == (op == BooleanOp::kIntersection) ? 1 : 0);
      }
      v[op == BooleanOp::kIntersection ? 0 : 1] = volume(result.solid());
      const auto solid = present(**r, test_context());
      ASSERT_TRUE(solid) << text(solid.error());
      ASSERT_EQ(fault_in(**solid, **r), "");
    }
    ASSERT_EQ(v[0] + v[1], volume(oracles[0].solid()));
  }
}

}  // namespace
}  // namespace csgrun::marginal_test
