// Results in pieces, changed by one operation after another, against one operation over everything.
#include "engine/bsp/result_pieces.h"

#include <gtest/gtest.h>

#include "engine/bsp/untouched.h"
#include "engine/bsp/vertex_signs.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_trees.h"

namespace csgrun {
namespace {

/// A version in pieces, and the operation that gives it at once.
struct Version {
  PiecesPtr pieces;
  std::vector<Operand> operands;
  Expression expression;
};

/// The expression with one more node: the root before, and operands that are new.
Expression continued(Expression e, BooleanOp op, uint32_t first, uint32_t count) {
  Expression::Node root;
  root.is_operand = false;
  root.op = op;
  root.first_child = static_cast<uint32_t>(e.children.size());
  root.child_count = count + 1;
  e.children.push_back(static_cast<uint32_t>(e.nodes.size()) - 1);
  for (uint32_t o = first; o < first + count; ++o) {
    e.children.push_back(static_cast<uint32_t>(e.nodes.size()));
    e.nodes.emplace_back().operand = o;
  }
  e.nodes.push_back(root);
  return e;
}

class Chains {
 public:
  explicit Chains(uint64_t seed) : random_(seed), maker_(random_) {}

  /// Starts from two operands and goes on for some steps; each version is looked at.
  void run(const test::TreeShape& shape, int steps) {
    std::vector<Version> versions;
    const test::RandomTree leaves = maker_.make(shape);
    for (const Operand& o : leaves.operands) unused_.push_back(o);
    Version start;
    take(start.operands, 2);
    const auto op = static_cast<BooleanOp>(random_.integer(0, 3));
    start.expression = test::flat_expression(op, 2);
    auto made = evaluate_pieces(start.operands, start.expression, leaves.region, {}, stats_);
    ASSERT_TRUE(made) << made.error().message;
    if (!*made) return;
    start.pieces = *made;
    ASSERT_NO_FATAL_FAILURE(check(start, leaves.region));
    versions.push_back(start);
    for (int i = 0; i < steps && !unused_.empty(); ++i) {
      // Now and then from a version that others went on from already.
      const size_t from =
          random_.integer(0, 3)
              ? versions.size() - 1
              : static_cast<size_t>(random_.integer(0, static_cast<int64_t>(versions.size()) - 1));
      Version next = versions[from];
      const auto first = static_cast<uint32_t>(next.operands.size());
      std::vector<Operand> others;
      take(others, static_cast<size_t>(random_.integer(1, 2)));
      next.operands.insert(next.operands.end(), others.begin(), others.end());
      const auto count = static_cast<uint32_t>(others.size());
      const auto step = static_cast<BooleanOp>(random_.integer(0, 3));
      next.expression = continued(next.expression, step, first, count);
      auto changed =
          change_pieces(*versions[from].pieces, others, test::flat_expression(step, count + 1),
                        leaves.region, {}, stats_);
      ASSERT_TRUE(changed) << changed.error().message;
      if (!*changed) continue;
      next.pieces = *changed;
      EXPECT_GT(next.pieces->bytes, 0u);
      ASSERT_NO_FATAL_FAILURE(check(next, leaves.region)) << "step " << i;
      versions.push_back(next);
      ++steps_;
    }
    // What came later did not change any of them.
    for (const Version& v : versions) ASSERT_NO_FATAL_FAILURE(check(v, leaves.region));
    unused_.clear();
  }

  [[nodiscard]] int steps() const { return steps_; }

 private:
  void take(std::vector<Operand>& to, size_t count) {
    for (; count > 0 && !unused_.empty(); --count) {
      to.push_back(unused_.front());
      unused_.erase(unused_.begin());
    }
  }

  void check(const Version& v, const GridBox& region) {
    const auto once = evaluate_boolean(v.operands, v.expression, region, {}, stats_);
    ASSERT_TRUE(once) << once.error().message;
    const auto assembled = assemble_pieces(*v.pieces, false);
    ASSERT_TRUE(assembled) << assembled.error().message;
    ASSERT_EQ(test::first_difference(**assembled, **once), "");
    const auto named = assemble_pieces(*v.pieces, true);
    ASSERT_TRUE(named) << named.error().message;
    ASSERT_EQ(test::first_difference(*expanded(*named), **once), "");
  }

  test::Random random_;
  test::TreeMaker maker_;
  std::vector<Operand> unused_;
  EvaluateStats stats_;
  int steps_ = 0;
};

TEST(ResultPieces, OfTouchingLeaves) {
  Chains chains(521);
  for (int i = 0; i < 25; ++i) {
    ASSERT_NO_FATAL_FAILURE(chains.run({.size = 4, .operands = 7, .known = i % 2 == 0}, 4))
        << "chain " << i;
  }
  EXPECT_GT(chains.steps(), 40);
}

TEST(ResultPieces, OfTurnedLeaves) {
  Chains chains(522);
  for (int i = 0; i < 15; ++i) {
    ASSERT_NO_FATAL_FAILURE(
        chains.run({.size = 6, .operands = 6, .frames = true, .known = i % 2 == 0}, 3))
        << "chain " << i;
  }
  EXPECT_GT(chains.steps(), 20);
}

TEST(ResultPieces, OfCrossingLeaves) {
  Chains chains(523);
  for (int i = 0; i < 25; ++i) {
    ASSERT_NO_FATAL_FAILURE(chains.run({.size = 1000, .operands = 7, .known = i % 2 == 0}, 4))
        << "chain " << i;
  }
  EXPECT_GT(chains.steps(), 40);
}

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
    EXPECT_EQ(VertexSigns(job).error(1), 51 * 0x1p-53);
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
}  // namespace csgrun
