// What a job says besides its faces: where the result may touch itself, progress, and that it was
// stopped.
#include "engine/bsp/evaluate_job.h"

#include <atomic>

#include <gtest/gtest.h>

#include "engine/bsp/kernel.h"
#include "engine/bsp/piece_store.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_trees.h"

namespace csgrun::evaluate_job_test {
namespace {

bool holds(const GridBox& outer, const GridBox& inner) {
  for (size_t k = 0; k < 3; ++k) {
    if (outer.lo[k] > inner.lo[k] || outer.hi[k] < inner.hi[k]) return false;
  }
  return true;
}

TEST(EvaluateJob, OperandsThatTouchThemselvesSayWhere) {
  auto apart = std::make_shared<LeafGeometry>(*test::box_leaf({0, 0, 0}, {1, 1, 1}));
  auto leaf = std::make_shared<LeafGeometry>(*apart);
  apart->may_touch = false;
  auto result = std::make_shared<BoundaryMesh>();
  result->may_touch = false;
  auto touching = std::make_shared<BoundaryMesh>();
  touching->touches = {{{1, 2, 3}, {4, 5, 6}}};
  auto anywhere = std::make_shared<BoundaryMesh>();
  const auto of_leaf = [](const std::shared_ptr<LeafGeometry>& l) { return test::operand_of(l); };
  const auto of = [](const std::shared_ptr<BoundaryMesh>& mesh) {
    Operand o;
    o.boundary = mesh;
    return o;
  };
  const auto told = [](const std::vector<Operand>& operands) { return touching_before(operands); };
  Operand moved = of(touching), turned = of(touching), in_pieces;
  moved.translation = {10, 20, 30};
  turned.frame = test::frame_of(test::turn_about(2, 30));
  in_pieces.pieces = std::make_shared<PieceOperand>();

  EXPECT_FALSE(told({}).anywhere);
  EXPECT_FALSE(told({of_leaf(apart), of(result), in_pieces}).anywhere);
  EXPECT_TRUE(told({of_leaf(apart), of(result), in_pieces}).boxes.empty());
  EXPECT_TRUE(told({of_leaf(apart), of_leaf(leaf)}).anywhere);
  EXPECT_TRUE(told({of_leaf(leaf), of_leaf(apart)}).anywhere);
  EXPECT_TRUE(told({of(anywhere)}).anywhere);
  // The box from (1, 2, 3) to (4, 5, 6), turned back by 30 degrees: c + 2 s to 4 c + 5 s along x.
  const Touching of_turned = told({turned, of(result)});
  EXPECT_FALSE(of_turned.anywhere);
  ASSERT_EQ(of_turned.boxes.size(), 1u);
  const double low[3] = {1.866, -0.268, 3}, high[3] = {5.964, 3.830, 6};
  for (size_t k = 0; k < 3; ++k) {
    EXPECT_LE(static_cast<double>(of_turned.boxes[0].lo[k]), low[k]) << k;
    EXPECT_GE(static_cast<double>(of_turned.boxes[0].lo[k]), low[k] - 2) << k;
    EXPECT_GE(static_cast<double>(of_turned.boxes[0].hi[k]), high[k]) << k;
    EXPECT_LE(static_cast<double>(of_turned.boxes[0].hi[k]), high[k] + 2) << k;
  }
  const Touching places = told({of_leaf(apart), of(touching), in_pieces, moved});
  EXPECT_FALSE(places.anywhere);
  ASSERT_EQ(places.boxes.size(), 2u);
  EXPECT_EQ(places.boxes[0].lo, (IVec3{1, 2, 3}));
  EXPECT_EQ(places.boxes[1].lo, (IVec3{11, 22, 33}));
  EXPECT_EQ(places.boxes[1].hi, (IVec3{14, 25, 36}));
}

/// Two boxes that share an edge, or whose corners are apart.
Result<std::shared_ptr<const BoundaryMesh>> two_boxes(const IVec3& lo,
                                                      const KernelOptions& options) {
  std::vector<Operand> boxes;
  for (const auto& leaf : {test::box_leaf({0, 0, 0}, {4, 4, 4}),
                           test::box_leaf(lo, {lo[0] + 4, lo[1] + 4, lo[2] + 4})}) {
    auto known = std::make_shared<LeafGeometry>(*leaf);
    known->may_touch = false;
    boxes.push_back(test::operand_of(known));
    boxes.back().frame = test::frame_of(test::turn_about(2, 0));  // by no lattice of boxes
  }
  EvaluateStats stats;
  return evaluate_boolean(boxes, test::flat_expression(BooleanOp::kUnion, 2),
                          test::region_of(boxes), options, stats);
}

TEST(EvaluateJob, ResultsSayWhereTheyTouch) {
  for (const bool whole_faces : {true, false}) {
    KernelOptions options;
    options.whole_faces = whole_faces;
    const auto sharing = two_boxes({4, 4, 0}, options), apart = two_boxes({9, 9, 9}, options);
    ASSERT_TRUE(sharing && apart);
    EXPECT_TRUE((*sharing)->may_touch) << whole_faces;
    ASSERT_FALSE((*sharing)->touches.empty()) << whole_faces;
    const auto& touches = (*sharing)->touches;
    EXPECT_TRUE(std::any_of(touches.begin(), touches.end(), [](const GridBox& box) {
      return holds(box, {{4, 4, 0}, {4, 4, 4}});
    }));
    EXPECT_FALSE((*apart)->may_touch) << whole_faces;
    EXPECT_TRUE((*apart)->touches.empty()) << whole_faces;
  }
  // Literal cells do not look.
  KernelOptions literal;
  literal.literal_cells = true;
  const auto unknown = two_boxes({9, 9, 9}, literal);
  ASSERT_TRUE(unknown);
  EXPECT_TRUE((*unknown)->may_touch);
  EXPECT_TRUE((*unknown)->touches.empty());
}

/// Stops at the n-th report: the result is an error then, or complete.
void expect_stops(const test::RandomTree& tree, KernelOptions options) {
  EvaluateStats stats;
  const auto whole = evaluate_boolean(tree.operands, tree.expression, tree.region, options, stats);
  ASSERT_TRUE(whole);
  for (int stop = 0;; ++stop) {
    std::atomic<bool> cancel = stop == 0;
    int reports = 0;
    options.cancel = &cancel;
    options.progress = [&](uint64_t done, uint64_t total) {
      EXPECT_LE(done, total);
      if (++reports == stop) cancel = true;
    };
    const auto result =
        evaluate_boolean(tree.operands, tree.expression, tree.region, options, stats);
    if (result) {
      EXPECT_EQ(test::first_difference(**result, **whole), "");
    } else {
      EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
    }
    if (stop == 0) {
      EXPECT_FALSE(result);
    }
    if (reports < stop) {
      EXPECT_TRUE(result);
      break;
    }
  }
}

TEST(EvaluateJob, StopsAtAnyTime) {
  test::Random random(702);
  test::TreeMaker maker(random);
  for (int i = 0; i < 12; ++i) {
    const auto tree = maker.make(
        {.size = 6, .operands = 4, .depth = 2, .frames = i % 2 == 0, .known = i % 3 == 0});
    KernelOptions options;
    options.cell_limit = 2;
    ASSERT_NO_FATAL_FAILURE(expect_stops(tree, options));
    options.whole_faces = false;
    ASSERT_NO_FATAL_FAILURE(expect_stops(tree, options));
  }
  test::RandomTree boxes;
  for (int64_t i = 0; i < 20; ++i) {
    boxes.operands.push_back(test::operand_of(test::box_leaf({i, i, i}, {i + 3, i + 3, i + 3})));
  }
  boxes.expression = test::flat_expression(BooleanOp::kUnion, 20);
  boxes.region = test::region_of(boxes.operands);
  ASSERT_NO_FATAL_FAILURE(expect_stops(boxes, {}));
}

// Corners in line are dropped from faces that nothing touches, too.
TEST(EvaluateJob, StraightCornersOfUntouchedFacesAreDropped) {
  const std::vector<test::Loop> loops = test::box_loops({0, 0, 0}, {4, 4, 4});
  const Operand plain = test::operand_of(test::make_leaf(loops));
  const Operand operand = test::operand_of(test::make_leaf(test::with_middles(loops)));
  const Operand other = test::operand_of(test::box_leaf({10, 0, 0}, {14, 4, 4}));
  EvaluateStats stats;
  for (const bool whole_faces : {true, false}) {
    KernelOptions options;
    options.whole_faces = whole_faces;
    const auto evaluated = [&](const Operand& first) {
      std::vector<Operand> operands{first, other};
      operands[1].first_source = 1;
      return evaluate_boolean(operands, test::flat_expression(BooleanOp::kUnion, 2),
                              test::region_of(operands), options, stats);
    };
    const auto with = evaluated(operand), without = evaluated(plain);
    ASSERT_TRUE(with && without);
    EXPECT_EQ((*with)->point_rounded.size(), 16u);
    EXPECT_EQ(test::first_difference(**with, **without), "");
  }
}

// The region may lie within an operand whose face is at the lowest wall, just outside of it.
TEST(EvaluateJob, RegionsMayStartInsideAnOperand) {
  for (const int64_t lo : {-1, 0, 1}) {
    std::vector<Operand> operands{test::operand_of(test::box_leaf({lo, lo, lo}, {9, 9, 9})),
                                  test::operand_of(test::box_leaf({2, 2, 2}, {3, 3, 3}))};
    KernelOptions options;
    options.whole_faces = false;
    EvaluateStats stats;
    const auto result =
        evaluate_boolean(operands, test::flat_expression(BooleanOp::kIntersection, 2),
                         {{1, 1, 1}, {4, 4, 4}}, options, stats);
    ASSERT_TRUE(result);
    EXPECT_EQ((*result)->faces.size(), 6u) << lo;
  }
}

}  // namespace
}  // namespace csgrun::evaluate_job_test
