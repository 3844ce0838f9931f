// Results in pieces, changed by one operation after another: cases. Random chains are in
// piece_chains_test.cpp.
#include "engine/bsp/result_pieces.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "engine/bsp/untouched.h"
#include "engine/bsp/vertex_signs.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/convex_operand.h"
#include "tests/support/kernel_case.h"
#include "tests/support/piece_steps.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"
#include "tests/support/random_trees.h"

namespace csgrun::result_pieces_test {
namespace {

using test::continued;
using test::octahedron;
using test::step_of;

// Faces that nothing meets stay what they are when they are turned over, once and again: the
// boundary names them by their leaf.
TEST(ResultPieces, AreWholeWhenTheyAreTurnedOver) {
  std::vector<Operand> operands{octahedron({-20, 0, 0}, 10), octahedron({20, 1, 2}, 10),
                                test::operand_of(test::box_leaf({-50, -50, -50}, {50, 50, 50})),
                                test::operand_of(test::box_leaf({-60, -60, -60}, {60, 60, 60})),
                                octahedron({32, 1, 2}, 9)};
  for (uint32_t o = 0; o < operands.size(); ++o) operands[o].first_source = o;
  const GridBox region = test::region_of(operands);
  EvaluateStats stats;
  Expression all = test::flat_expression(BooleanOp::kUnion, 2);
  auto version = evaluate_pieces({operands[0], operands[1]}, all, region, {}, stats);
  for (uint32_t o = 2; o < operands.size(); ++o) {
    ASSERT_TRUE(version && *version);
    const auto named = assemble_pieces(**version, true);
    ASSERT_TRUE(named);
    size_t untouched = 0;
    for (const UntouchedPart& part : (*named)->parts) {
      EXPECT_EQ(part.flipped, o == 3);
      untouched += part.faces.size();
    }
    EXPECT_EQ(untouched, 16u);
    ASSERT_EQ((*named)->parts.size(), 2u);
    EXPECT_LT((*named)->parts[0].source, (*named)->parts[1].source);
    const auto once = evaluate_boolean(std::vector<Operand>(operands.begin(), operands.begin() + o),
                                       all, region, {}, stats);
    ASSERT_TRUE(once);
    EXPECT_EQ(test::first_difference(*expanded(*named), **once), "");
    all = continued(all, BooleanOp::kDifference, o, 1, o < 4);
    version = change_pieces(**version, {operands[o]}, step_of(BooleanOp::kDifference, 1, o < 4),
                            region, {}, stats);
  }
  // Into a corner of the second one another is cut.
  ASSERT_TRUE(version && *version);
  const auto assembled = assemble_pieces(**version, false);
  const auto once = evaluate_boolean(operands, all, region, {}, stats);
  ASSERT_TRUE(assembled && once);
  EXPECT_EQ(test::first_difference(**assembled, **once), "");
}

// A leaf that was turned over by the first operation of all, where nothing met it, is cut by the
// next one.
TEST(ResultPieces, OfVoidsThatAreCutLater) {
  std::vector<Operand> operands{test::operand_of(test::box_leaf({-50, -50, -50}, {50, 50, 50})),
                                octahedron({3, 4, 5}, 20), octahedron({20, 11, 12}, 17),
                                octahedron({-10, -15, 2}, 13)};
  for (uint32_t o = 0; o < operands.size(); ++o) operands[o].first_source = o;
  const GridBox region = test::region_of(operands);
  EvaluateStats stats;
  Expression all = test::flat_expression(BooleanOp::kDifference, 2);
  auto version = evaluate_pieces({operands[0], operands[1]}, all, region, {}, stats);
  for (uint32_t o = 2; o < operands.size(); ++o) {
    ASSERT_TRUE(version && *version);
    const auto op = o == 2 ? BooleanOp::kDifference : BooleanOp::kSymmetricDifference;
    all = continued(all, op, o, 1);
    version = change_pieces(**version, {operands[o]}, step_of(op, 1, false), region, {}, stats);
    ASSERT_TRUE(version && *version);
    const auto assembled = assemble_pieces(**version, false);
    const auto once =
        evaluate_boolean({operands.begin(), operands.begin() + o + 1}, all, region, {}, stats);
    ASSERT_TRUE(assembled && once);
    EXPECT_EQ(test::first_difference(**assembled, **once), "");
  }
}

// What a later operation touches, without cutting it, is not named as untouched, not even if one
// operation would see that it is as good as that; and a leaf that may touch itself makes the result
// one that may.
class WhatTouchedThem : public testing::TestWithParam<int> {};

TEST_P(WhatTouchedThem, IsRemembered) {
  std::vector<Operand> operands{octahedron({0, 0, 0}, 12), octahedron({50, 0, 0}, 12),
                                octahedron({17, 4, 4}, 13), octahedron({0, 40, 0}, 3)};
  for (uint32_t o = 0; o < operands.size(); ++o) {
    operands[o].first_source = o;
    if (GetParam() != 0) operands[o].frame = test::frame_of(test::turn_about(1, GetParam()));
  }
  // A corner of the third one, (4, 4, 4), is in a face of the first one.
  const GridBox region = test::region_of(operands);
  const Expression join = test::flat_expression(BooleanOp::kUnion, 2);
  EvaluateStats stats;
  auto version = evaluate_pieces({operands[0], operands[1]}, join, region, {}, stats);
  ASSERT_TRUE(version && *version);
  EXPECT_FALSE((*version)->touches_anywhere);
  version = change_pieces(**version, {operands[2]}, join, region, {}, stats);
  ASSERT_TRUE(version && *version);
  EXPECT_FALSE((*version)->touches_anywhere);
  test::check_names(**version);
  // Once more, with something that meets nothing.
  auto last = change_pieces(**version, {operands[3]}, join, region, {}, stats);
  ASSERT_TRUE(last && *last);
  EXPECT_FALSE((*last)->touches_anywhere);
  KernelOptions options;
  options.name_untouched = true;
  const auto faces_of = [](const BoundaryMesh& mesh) {
    std::vector<std::pair<uint32_t, uint32_t>> faces;
    for (const UntouchedPart& part : mesh.parts) {
      for (const uint32_t f : part.faces) faces.emplace_back(part.source, f);
    }
    return faces;
  };
  const auto once = evaluate_boolean(operands, test::flat_expression(BooleanOp::kUnion, 4), region,
                                     options, stats);
  const auto named = assemble_pieces(**last, true);
  ASSERT_TRUE(once && named);
  const auto few = faces_of(**named), most = faces_of(**once);
  EXPECT_TRUE(std::includes(most.begin(), most.end(), few.begin(), few.end()));
  EXPECT_LT(few.size(), most.size());
  EXPECT_LT(most.size(), 31u);
  EXPECT_GT(few.size(), 20u);
  EXPECT_EQ(test::first_difference(*expanded(*named), *expanded(*once)), "");

  auto unknown = std::make_shared<LeafGeometry>(*operands[3].leaf);
  unknown->may_touch = true;
  operands[3].leaf = unknown;
  last = change_pieces(**version, {operands[3]}, join, region, {}, stats);
  ASSERT_TRUE(last && *last);
  EXPECT_TRUE((*last)->touches_anywhere);
}
INSTANTIATE_TEST_SUITE_P(ResultPieces, WhatTouchedThem, testing::Values(0, 30));

TEST(ResultPieces, OfResults) {
  test::Random random(524);
  test::TreeMaker maker(random);
  EvaluateStats stats;
  for (int i = 0; i < 20; ++i) {
    const test::RandomTree inner = maker.make({.size = 5, .operands = 3, .known = true});
    const test::RandomTree outer = maker.make({.size = 5, .operands = 3, .known = true});
    const auto result = evaluate_boolean(inner.operands, inner.expression, inner.region, {}, stats);
    ASSERT_TRUE(result);
    std::vector<Operand> operands = outer.operands;
    for (uint32_t o = 0; o < 3; ++o) operands[o].first_source = 10 + o;
    operands[1] = {};
    operands[1].boundary = *result;
    if (i % 2) operands[1].first_source = 20;  // after the leaves
    const GridBox region =
        test::TreeMaker::region_of({outer.operands[0], outer.operands[2], inner.operands[0],
                                    inner.operands[1], inner.operands[2]});
    const auto op = static_cast<BooleanOp>(i % 4), then = static_cast<BooleanOp>(i / 4 % 3);
    const std::vector<Operand> first(operands.begin(), operands.begin() + 2);
    auto version = evaluate_pieces(first, test::flat_expression(op, 2), region, {}, stats);
    ASSERT_TRUE(version);
    if (!*version) continue;
    version =
        change_pieces(**version, {operands[2]}, test::flat_expression(then, 2), region, {}, stats);
    ASSERT_TRUE(version);
    if (!*version) continue;
    const auto assembled = assemble_pieces(**version, false);
    const auto once = evaluate_boolean(
        operands, continued(test::flat_expression(op, 2), then, 2, 1), region, {}, stats);
    ASSERT_TRUE(assembled && once);
    ASSERT_EQ(test::first_difference(**assembled, **once), "") << "case " << i;
  }
}

/// A staircase seen from above, in quarters of a step, all of one source.
Operand staircase(test::Random& random) {
  std::vector<Operand> steps;
  int64_t x = 1, y = 200;
  for (int i = 0; i < 9; ++i) {
    steps.push_back(test::operand_of(test::box_leaf({0, 0, 0}, {x, y, 40})));
    x += random.integer(1, 12), y -= random.integer(1, 20);
  }
  EvaluateStats stats;
  Operand operand;
  operand.boundary = *evaluate_boolean(steps, test::flat_expression(BooleanOp::kUnion, 9),
                                       test::region_of(steps), {}, stats);
  operand.frame.is_identity = false;
  for (size_t k = 0; k < 3; ++k) operand.frame.matrix[k][k] = int64_t{1} << 42;
  return operand;
}

// Where the walls stand that make a face of a result convex depends on who else is there: on one
// that has gone by the time the pieces are put together. Thirds of a step are no walls beside it.
TEST(ResultPieces, OfResultsThatAreMadeConvexAnew) {
  test::Random random(526);
  EvaluateStats stats;
  for (int i = 0; i < 30; ++i) {
    std::vector<Operand> operands{
        staircase(random), test::operand_of(test::box_leaf({800, 800, 800}, {900, 900, 900})),
        octahedron({random.integer(0, 9), random.integer(0, 30), 10}, 90)};
    operands[1].frame.is_identity = false;
    operands[1].frame.matrix = {
        {{int64_t{1} << 40, 0, 0}, {0, int64_t{3} << 38, 0}, {0, 0, int64_t{1} << 40}}};
    operands[1].first_source = 100, operands[2].first_source = 101;
    const GridBox region{{-200, -200, -200}, {2000, 2000, 2000}};
    auto version = evaluate_pieces({operands[0], operands[1]},
                                   test::flat_expression(BooleanOp::kUnion, 2), region, {}, stats);
    ASSERT_TRUE(version && *version);
    version = change_pieces(**version, {operands[2]},
                            test::flat_expression(BooleanOp::kIntersection, 2), region, {}, stats);
    ASSERT_TRUE(version && *version);
    const auto assembled = assemble_pieces(**version, false);
    ASSERT_TRUE(assembled) << i;
    const auto once = evaluate_boolean(
        operands,
        continued(test::flat_expression(BooleanOp::kUnion, 2), BooleanOp::kIntersection, 2, 1),
        region, {}, stats);
    ASSERT_TRUE(once);
    ASSERT_EQ(test::first_difference(**assembled, **once), "") << i;
  }
}

// A job has the pieces near the others only, but the box of all; and what is in the midst of a
// result is told from all pieces around.
TEST(ResultPieces, AreOfOneBox) {
  std::vector<Operand> boxes{test::operand_of(test::box_leaf({0, 0, 0}, {40, 40, 40})),
                             test::operand_of(test::box_leaf({30, 30, 30}, {50, 50, 51})),
                             test::operand_of(test::box_leaf({10, 11, 12}, {14, 15, 16})),
                             test::operand_of(test::box_leaf({70, 70, 70}, {80, 80, 80}))};
  for (uint32_t o = 0; o < 4; ++o) {
    boxes[o].first_source = o;
    boxes[o].frame.is_identity = false;  // no lattice
    boxes[o].frame.matrix = {
        {{int64_t{1} << 40, 0, 0}, {0, int64_t{1} << 40, 0}, {0, 0, int64_t{1} << 40}}};
  }
  const GridBox region{{-1, -1, -1}, {99, 99, 99}};
  EvaluateStats stats;
  const auto version = evaluate_pieces(
      {boxes[0], boxes[1]}, test::flat_expression(BooleanOp::kUnion, 2), region, {}, stats);
  ASSERT_TRUE(version && *version);
  for (const uint32_t tool : {2u, 3u}) {
    Operand pieces;
    pieces.pieces =
        std::make_shared<PieceOperand>(PieceOperand{(*version)->store, (*version)->tree});
    const std::vector<Operand> operands{boxes[tool], pieces};
    const Job job(operands, &(*version)->store->planes);
    for (int k = 0; k < 3; ++k) {
      EXPECT_LE(job.operand_box(1).lo[k], 0);
      EXPECT_GE(job.operand_box(1).lo[k], -1);
      EXPECT_GE(job.operand_box(1).hi[k], k == 2 ? 51 : 50);
      EXPECT_LE(job.operand_box(1).hi[k], k == 2 ? 52 : 51);
    }
    EXPECT_LT(job.polygons().size(), 18u);
    // Rays meet all of them: the largest coordinate counts, and rounding.
    EXPECT_EQ(VertexSigns(job, true).error(1), 51 * 0x1p-53);
    for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kDifference, BooleanOp::kIntersection,
                               BooleanOp::kSymmetricDifference}) {
      const auto next =
          change_pieces(**version, {boxes[tool]}, test::flat_expression(op, 2), region, {}, stats);
      ASSERT_TRUE(next && *next);
      const auto assembled = assemble_pieces(**next, false);
      const auto once = evaluate_boolean(
          {boxes[0], boxes[1], boxes[tool]},
          continued(test::flat_expression(BooleanOp::kUnion, 2), op, 2, 1), region, {}, stats);
      ASSERT_TRUE(assembled && once);
      EXPECT_EQ(test::first_difference(**assembled, **once), "") << tool << static_cast<int>(op);
    }
  }
  // Of nothing at all.
  Operand none;
  none.pieces = std::make_shared<PieceOperand>(PieceOperand{(*version)->store, {}});
  const std::vector<Operand> operands{boxes[3], none};
  const Job job(operands, &(*version)->store->planes);
  EXPECT_TRUE(job.operand_box(1).is_empty());
  EXPECT_FALSE(job.operand_box(0).is_empty());
}

TEST(ResultPieces, StopWhenCancelled) {
  const std::vector<Operand> boxes{test::operand_of(test::box_leaf({0, 0, 0}, {4, 4, 4})),
                                   test::operand_of(test::box_leaf({1, 1, 1}, {5, 6, 7}))};
  const GridBox region = test::region_of(boxes);
  const Expression join = test::flat_expression(BooleanOp::kUnion, 2);
  EvaluateStats stats;
  const auto version = evaluate_pieces(boxes, join, region, {}, stats);
  ASSERT_TRUE(version && *version);
  std::atomic<bool> cancel = true;
  KernelOptions options;
  options.cancel = &cancel;
  const auto stopped = evaluate_pieces(boxes, join, region, options, stats);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
  const auto changed = change_pieces(**version, {boxes[0]}, join, region, options, stats);
  ASSERT_FALSE(changed);
  EXPECT_EQ(changed.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace csgrun::result_pieces_test
