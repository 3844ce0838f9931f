// A mesh that is several solids at once, resolved, is a Boolean of these solids.
#include "engine/bsp/self_resolution.h"

#include <atomic>

#include <gtest/gtest.h>

#include "engine/mesh/leaf_check.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::test::self_resolution_test {
namespace {

/// Five of a hundred random cases: quick.
class RandomSurfaces : public ::testing::TestWithParam<int> {
 protected:
  static constexpr int kCases = 5;
  static int first() { return GetParam() * kCases; }
};
INSTANTIATE_TEST_SUITE_P(Parts, RandomSurfaces, ::testing::Range(0, 20));

BoundaryResult resolved(const Operand& operand, InsideRule rule,
                        const KernelOptions& options = {}) {
  EvaluateStats stats;
  std::vector<std::array<uint32_t, 2>> crossings;
  if (operand.leaf) crossings = find_self_intersections(*operand.leaf);
  return resolve_surface(operand, crossings, rule, options, stats);
}

/// The solids' Boolean, all faces labelled as from one source, as in one mesh.
BoundaryResult combined(const std::vector<Operand>& solids, BooleanOp op) {
  const Expression expression = flat_expression(op, static_cast<uint32_t>(solids.size()));
  EvaluateStats stats;
  return evaluate_boolean(solids, expression, region_of(solids), {}, stats);
}

std::string difference_of(const BoundaryResult& a, const BoundaryResult& b) {
  if (!a) return "no result: " + a.error().message;
  if (!b) return "no other result: " + b.error().message;
  return difference_between(**a, **b, false);
}

struct Merged {
  std::vector<Operand> solids;
  Operand all;  ///< one leaf with the faces of all solids
};

Merged random_case(Random& random, bool turn_second) {
  Merged m;
  std::vector<Loop> loops;
  const int64_t count = turn_second ? 2 : random.integer(2, 4);
  const Frame frame = random.integer(0, 2) ? Frame{} : random_frame(random);
  for (int64_t i = 0; i < count; ++i) {
    auto own = random_loops(random, 4);
    m.solids.push_back(operand_of(make_leaf(own)));
    m.solids.back().frame = frame;
    if (turn_second && i == 1) turn_over(own);
    loops.insert(loops.end(), own.begin(), own.end());
  }
  auto all = std::make_shared<LeafGeometry>(*make_leaf(loops));
  all->opposite = pair_edges(*all).opposite;
  m.all = operand_of(all);
  m.all.frame = frame;
  return m;
}

KernelOptions random_options(Random& random) {
  KernelOptions options;
  options.cell_limit = static_cast<uint32_t>(random.integer(1, 40));
  for (auto& s : options.octree_shift) s = static_cast<uint32_t>(random.integer(0, 5));
  options.whole_faces = random.integer(0, 3) > 0;
  return options;
}

TEST_P(RandomSurfaces, SeveralSolidsInOneMeshAreTheirUnion) {
  for (int i = first(); i < first() + kCases; ++i) {
    Random random(1000 + i);
    const Merged m = random_case(random, false);
    const auto expected = combined(m.solids, BooleanOp::kUnion);
    EXPECT_EQ(
        difference_of(resolved(m.all, InsideRule::kNonZero, random_options(random)), expected), "")
        << "case " << i;
    EXPECT_EQ(difference_of(resolved(m.all, InsideRule::kPositive), expected), "") << "case " << i;
  }
}

TEST_P(RandomSurfaces, EvenOddIsTheSymmetricDifference) {
  for (int i = first(); i < first() + kCases; ++i) {
    Random random(2000 + i);
    const Merged m = random_case(random, false);
    EXPECT_EQ(difference_of(resolved(m.all, InsideRule::kEvenOdd, random_options(random)),
                            combined(m.solids, BooleanOp::kSymmetricDifference)),
              "")
        << "case " << i;
  }
}

TEST_P(RandomSurfaces, AnInvertedSolidIsTakenAway) {
  for (int i = first(); i < first() + kCases; ++i) {
    Random random(3000 + i);
    const Merged m = random_case(random, true);
    EXPECT_EQ(difference_of(resolved(m.all, InsideRule::kPositive, random_options(random)),
                            combined(m.solids, BooleanOp::kDifference)),
              "")
        << "case " << i;
    EXPECT_EQ(difference_of(resolved(m.all, InsideRule::kNonZero),
                            combined(m.solids, BooleanOp::kSymmetricDifference)),
              "")
        << "case " << i;
  }
}

// The hull of several solids in one mesh is that of their union, which has no more than voids to
// fill.
TEST_P(RandomSurfaces, OuterHullFillsTheVoidsOfTheUnion) {
  for (int i = first(); i < first() + kCases; ++i) {
    Random random(4000 + i);
    const Merged m = random_case(random, false);
    auto united = combined(m.solids, BooleanOp::kUnion);
    ASSERT_TRUE(united);
    Operand simple;
    simple.boundary = *united;
    const auto expected = resolved(simple, InsideRule::kOuterHull, random_options(random));
    EXPECT_EQ(
        difference_of(resolved(m.all, InsideRule::kOuterHull, random_options(random)), expected),
        "")
        << "case " << i;
    EXPECT_EQ(
        difference_of(resolved(m.all, InsideRule::kOrientedHull, random_options(random)), expected),
        "")
        << "case " << i;
  }
}

std::vector<Loop> boxes(const std::vector<std::array<IVec3, 2>>& list, std::vector<bool> turned) {
  std::vector<Loop> loops;
  for (size_t i = 0; i < list.size(); ++i) {
    auto own = box_loops(list[i][0], list[i][1]);
    if (turned[i]) turn_over(own);
    loops.insert(loops.end(), own.begin(), own.end());
  }
  return loops;
}

TEST(SelfResolution, HullsOfNestedAndInvertedBoxes) {
  const std::array<IVec3, 2> outer{IVec3{0, 0, 0}, {12, 12, 12}},
      room{IVec3{2, 2, 2}, {10, 10, 10}}, ball{IVec3{4, 4, 4}, {6, 6, 6}},
      corner{IVec3{8, 8, 8}, {16, 16, 16}};
  const auto one = [](const std::array<IVec3, 2>& b) { return operand_of(box_leaf(b[0], b[1])); };
  const auto mesh = [](const std::vector<std::array<IVec3, 2>>& list, std::vector<bool> turned) {
    return operand_of(make_leaf(boxes(list, std::move(turned))));
  };
  const auto is = [](const Operand& surface, InsideRule rule, BooleanOp op,
                     const std::vector<Operand>& solids) {
    return difference_of(resolved(surface, rule), combined(solids, op));
  };
  const Operand o = one(outer), r = one(room), c = one(corner);
  constexpr auto kUnion = BooleanOp::kUnion, kDifference = BooleanOp::kDifference;
  // A room with a ball in it: filled, or kept by winding number.
  const Operand house = mesh({outer, room, ball}, {false, true, false});
  EXPECT_EQ(is(house, InsideRule::kOuterHull, kUnion, {o}), "");
  EXPECT_EQ(is(house, InsideRule::kOrientedHull, kUnion, {o}), "");
  EXPECT_EQ(is(house, InsideRule::kNonZero, BooleanOp::kSymmetricDifference, {o, r, one(ball)}),
            "");
  // A box inside out that reaches out of another: the plain hull has both. What sticks out is free
  // to enter from behind, but what both cover can be entered from neither side: it is a void.
  const Operand notched = mesh({outer, corner}, {false, true});
  EXPECT_EQ(is(notched, InsideRule::kOuterHull, kUnion, {o, c}), "");
  EXPECT_EQ(is(notched, InsideRule::kOrientedHull, kUnion, {o}), "");
  EXPECT_EQ(is(notched, InsideRule::kPositive, kDifference, {o, c}), "");
  // Alone and inside out: nothing is left but for the plain hull.
  const Operand turned = mesh({corner}, {true});
  EXPECT_EQ(is(turned, InsideRule::kOuterHull, kUnion, {c}), "");
  EXPECT_TRUE((*resolved(turned, InsideRule::kOrientedHull))->faces.empty());
  EXPECT_TRUE((*resolved(turned, InsideRule::kPositive))->faces.empty());
  EXPECT_EQ(is(turned, InsideRule::kNonZero, kUnion, {c}), "");
  // Twice the same box: once, or nothing.
  const Operand twice = mesh({outer, outer}, {false, false});
  EXPECT_EQ(is(twice, InsideRule::kNonZero, kUnion, {o}), "");
  EXPECT_EQ(is(twice, InsideRule::kOuterHull, kUnion, {o}), "");
  EXPECT_TRUE((*resolved(twice, InsideRule::kEvenOdd))->faces.empty());
}

/// The faces of a pyramid over a square, seen from outside, and then its base.
std::vector<Loop> pyramid(const IVec3& apex) {
  const IVec3 a{2, 2, 4}, b{10, 2, 4}, c{10, 10, 4}, d{2, 10, 4};
  return {{a, b, apex}, {b, c, apex}, {c, d, apex}, {d, a, apex}, {a, d, c, b}};
}

TEST(SelfResolution, HullOfAResultFillsWhatTouchingPartsEnclose) {
  // A tent stands on a plate, and touches it along its sharp rim alone: no face ends there.
  auto tent = pyramid({6, 6, 10}), space = pyramid({6, 6, 8});
  tent.pop_back();
  space.pop_back();
  turn_over(space);
  tent.insert(tent.end(), space.begin(), space.end());
  const Operand plate = operand_of(box_leaf({0, 0, 0}, {12, 12, 4}));
  const Operand full = operand_of(make_leaf(pyramid({6, 6, 10})));
  Operand both;
  both.boundary = *combined({plate, operand_of(make_leaf(tent))}, BooleanOp::kUnion);
  const auto filled = combined({plate, full}, BooleanOp::kUnion);
  for (const InsideRule rule : {InsideRule::kOuterHull, InsideRule::kOrientedHull}) {
    EXPECT_EQ(difference_of(resolved(both, rule), filled), "");
  }
}

constexpr InsideRule kRules[] = {InsideRule::kNonZero, InsideRule::kPositive, InsideRule::kEvenOdd,
                                 InsideRule::kOuterHull, InsideRule::kOrientedHull};

TEST(SelfResolution, OpenSurfacesAreRefused) {
  // Two boxes across each other, or apart; one of them without its last face.
  for (const int64_t move : {3, 20}) {
    auto loops = box_loops({0, 0, 0}, {6, 6, 6});
    const auto other = box_loops({move, 3, 3}, {move + 6, 9, 9});
    loops.insert(loops.end(), other.begin(), other.end() - 1);
    const Operand open = operand_of(make_leaf(loops));
    for (const InsideRule rule : kRules) {
      const auto result = resolved(open, rule);
      ASSERT_FALSE(result);
      EXPECT_EQ(result.error().code, ErrorCode::kInternal);
    }
  }
}

TEST(SelfResolution, StopsWhenCancelled) {
  auto loops = box_loops({0, 0, 0}, {6, 6, 6});
  for (const int64_t move : {3, 20}) {
    const auto other = box_loops({move, 3, 3}, {move + 6, 9, 9});
    loops.insert(loops.end(), other.begin(), other.end());
  }
  const Operand leaf = operand_of(make_leaf(loops));
  Operand result;
  result.boundary = *resolved(leaf, InsideRule::kNonZero);
  std::atomic<bool> cancel = false;
  KernelOptions options;
  options.cancel = &cancel;
  for (const Operand* operand : std::array<const Operand*, 2>{&leaf, &result}) {
    for (const InsideRule rule : kRules) {
      cancel = false;
      EXPECT_EQ(difference_of(resolved(*operand, rule, options), resolved(*operand, rule)), "");
      cancel = true;
      const auto stopped = resolved(*operand, rule, options);
      ASSERT_FALSE(stopped);
      EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
    }
  }
}

/// A leaf that knows its opposite edges.
Operand paired(const std::vector<Loop>& loops) {
  auto leaf = std::make_shared<LeafGeometry>(*make_leaf(loops));
  leaf->opposite = pair_edges(*leaf).opposite;
  return operand_of(leaf);
}

// Nothing crosses: one ray tells.
TEST(SelfResolution, StopsWhenCancelledBeforeARay) {
  std::atomic<bool> cancel = true;
  KernelOptions options;
  options.cancel = &cancel;
  const auto stopped =
      resolved(paired(box_loops({0, 0, 0}, {6, 6, 6})), InsideRule::kNonZero, options);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
}

const std::vector<Loop>& pierced_box() {
  static const std::vector<Loop> loops =
      boxes({{IVec3{0, 0, 0}, {60, 60, 60}}, {IVec3{30, 20, 10}, {90, 50, 40}}}, {false, false});
  return loops;
}

// A ray tells all that hangs together, where faces may be cut whole.
TEST(SelfResolution, CutsFacesWholeWhereItMay) {
  const auto cells = [](const Operand& operand, InsideRule rule, bool whole_faces) {
    KernelOptions options;
    options.cell_limit = 4;
    options.whole_faces = whole_faces;
    EvaluateStats stats;
    const auto crossings = find_self_intersections(*operand.leaf);
    EXPECT_TRUE(resolve_surface(operand, crossings, rule, options, stats));
    return stats.solved_cells;
  };
  const Operand plain = paired(pierced_box()), unpaired = operand_of(make_leaf(pierced_box()));
  std::vector<Loop> with_others = pierced_box();
  for (int64_t x = 100; x < 180; x += 10) {
    const auto other = box_loops({x, 0, 0}, {x + 5, 5, 5});
    with_others.insert(with_others.end(), other.begin(), other.end());
  }
  const Operand many = paired(with_others);
  Operand turned = plain;
  turned.frame.is_identity = false;
  for (size_t k = 0; k < 3; ++k) {
    turned.frame.matrix[k][k] = (k < 2 ? -1 : 1) * (int64_t{1} << Frame::kShift);
  }
  for (const InsideRule rule :
       {InsideRule::kNonZero, InsideRule::kPositive, InsideRule::kEvenOdd}) {
    EXPECT_EQ(cells(plain, rule, true), 0u);
    EXPECT_GT(cells(plain, rule, false), 4u);
    EXPECT_EQ(cells(unpaired, rule, true), 0u);
    EXPECT_EQ(cells(many, rule, true), 0u);
    EXPECT_EQ(cells(turned, rule, true), cells(turned, rule, false));
  }
  EXPECT_EQ(cells(plain, InsideRule::kOuterHull, true),
            cells(plain, InsideRule::kOuterHull, false));
}

// No ray finds a start in a piece that is thinner than its steps: cells tell of it.
TEST(SelfResolution, PiecesTooThinForRays) {
  // Two walls across the top of a box, the second one aslant by a step in 2^26.
  const int64_t far = int64_t{1} << 26;
  const std::vector<Loop> base = box_loops({0, 0, -3}, {10, 10, 0});
  const std::vector<std::vector<Loop>> solids{
      base, box_loops({5, -5, -1}, {20, 15, 3}),
      hull_loops({{5, 0, -2}, {6, far, -2}, {40, 0, -2}, {5, 0, 2}, {6, far, 2}, {40, 0, 2}})};
  std::vector<Loop> all;
  std::vector<Operand> operands;
  for (const auto& loops : solids) {
    operands.push_back(operand_of(make_leaf(loops)));
    // As triangles the walls do not tell what is between them either.
    for (const Loop& loop : loops) {
      for (size_t i = 2; i < loop.size(); ++i) all.push_back({loop[0], loop[i - 1], loop[i]});
    }
  }
  const Operand surface = paired(all);
  KernelOptions options;
  EvaluateStats stats;
  const auto result = resolve_surface(surface, find_self_intersections(*surface.leaf),
                                      InsideRule::kNonZero, options, stats);
  ASSERT_TRUE(result);
  EXPECT_GT(stats.solved_cells, 0u);
  EXPECT_EQ(difference_of(result, combined(operands, BooleanOp::kUnion)), "");
}

// What is kept touches where faces cross, and nowhere else.
TEST(SelfResolution, TouchesWhereFacesCross) {
  const auto result = resolved(paired(pierced_box()), InsideRule::kNonZero);
  ASSERT_TRUE(result);
  ASSERT_FALSE((*result)->touches.empty());
  GridBox all = (*result)->touches[0];
  for (const GridBox& box : (*result)->touches) {
    for (size_t k = 0; k < 3; ++k) {
      all.lo[k] = std::min(all.lo[k], box.lo[k]);
      all.hi[k] = std::max(all.hi[k], box.hi[k]);
    }
  }
  // One face of the first box and four of the second.
  EXPECT_EQ(all.lo, (IVec3{60, 20, 10}));
  EXPECT_EQ(all.hi, (IVec3{60, 50, 40}));
}

// Work is added to what was counted before.
TEST(SelfResolution, CountsItsWork) {
  auto loops = box_loops({0, 0, 0}, {60, 60, 60});
  const auto other = box_loops({30, 30, 30}, {90, 90, 91});
  loops.insert(loops.end(), other.begin(), other.end());
  const Operand operand = operand_of(make_leaf(loops));
  const auto crossings = find_self_intersections(*operand.leaf);
  KernelOptions options;
  options.cell_limit = 1;
  options.whole_faces = false;
  const auto numbers = [&](EvaluateStats& s) {
    EXPECT_TRUE(resolve_surface(operand, crossings, InsideRule::kNonZero, options, s));
    std::vector<uint64_t> n{s.cells, s.surface_cells, s.solved_cells, s.sign_filter,
                            s.sign_symbolic};
    n.insert(n.end(), s.sign_exact.begin(), s.sign_exact.end());
    return n;
  };
  EvaluateStats stats;
  const auto once = numbers(stats), twice = numbers(stats);
  for (size_t k = 0; k < once.size(); ++k) {
    EXPECT_LT(once[k], 100000u) << k;
    EXPECT_EQ(twice[k], 2 * once[k]) << k;
  }
  for (size_t k = 0; k < 5; ++k) EXPECT_GT(once[k], 0u) << k;
  EXPECT_EQ(stats.cells / 2 % 2, 1u);  // each division makes two of one
  EXPECT_LT(stats.solved_cells, stats.cells);

  options.whole_faces = true;
  stats = {};
  const auto whole = numbers(stats), again = numbers(stats);
  EXPECT_EQ(stats.cells, 0u);
  EXPECT_GT(stats.sign_filter, 0u);
  for (size_t k = 0; k < whole.size(); ++k) EXPECT_EQ(again[k], 2 * whole[k]) << k;
}

}  // namespace
}  // namespace csgrun::test::self_resolution_test
