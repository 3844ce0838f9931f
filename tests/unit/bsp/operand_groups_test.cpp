// Operands that are evaluated in groups against one job over all of them.
#include "engine/bsp/operand_groups.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/bsp/kernel.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/convex_operand.h"
#include "tests/support/random_trees.h"

namespace csgrun {
namespace {

using test::convex_operand;

/// A bar through the origin.
Operand spoke(double angle, int64_t length, int64_t width, int64_t low, int64_t high) {
  const double x = std::cos(angle), y = std::sin(angle);
  std::vector<IVec3> points;
  for (const int64_t along : {-length, length}) {
    for (const int64_t across : {-width, width}) {
      for (const int64_t z : {low, high}) {
        const auto u = static_cast<double>(along), v = static_cast<double>(across);
        points.push_back({std::llround(u * x - v * y), std::llround(u * y + v * x), z});
      }
    }
  }
  return convex_operand(test::hull_loops(points));
}

std::vector<Operand> wheel(int spokes) {
  std::vector<Operand> operands;
  for (int i = 0; i < spokes; ++i) {
    operands.push_back(spoke(3.14159 * i / spokes, 4000, 150, i % 5 == 0 ? -100 : 0, 300));
    operands.back().first_source = static_cast<uint32_t>(i);
  }
  return operands;
}

uint64_t signs_of(const EvaluateStats& stats) {
  uint64_t total = stats.sign_filter + stats.sign_symbolic;
  for (const uint64_t n : stats.sign_exact) total += n;
  return total;
}

Result<std::shared_ptr<const BoundaryMesh>> evaluate(const std::vector<Operand>& operands,
                                                     const Expression& expression, bool may_group,
                                                     uint64_t& signs) {
  KernelOptions options;
  options.may_group = may_group;
  EvaluateStats stats;
  auto result = evaluate_boolean(operands, expression, test::region_of(operands), options, stats);
  signs = signs_of(stats);
  return result;
}

TEST(OperandGroups, SpokesAreEvaluatedInGroups) {
  for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kDifference, BooleanOp::kIntersection}) {
    std::vector<Operand> operands = wheel(24);
    // What is taken from, or the first of what is common: a plate with the spokes' top.
    const bool is_plate_first = op != BooleanOp::kUnion;
    if (is_plate_first) operands[0] = spoke(0.3, 3000, 3000, -200, 300);
    const Expression expression = test::flat_expression(op, static_cast<uint32_t>(operands.size()));
    uint64_t grouped_signs = 0, whole_signs = 0;
    const auto grouped = evaluate(operands, expression, true, grouped_signs);
    const auto whole = evaluate(operands, expression, false, whole_signs);
    ASSERT_TRUE(grouped && whole);
    EXPECT_EQ(test::first_difference(**grouped, **whole), "");
    EXPECT_GT((*whole)->faces.size(), 8u);
    if (op == BooleanOp::kUnion) {
      EXPECT_LT(8 * grouped_signs, whole_signs);
    }
  }
}

TEST(OperandGroups, FewOperandsAreNot) {
  EXPECT_FALSE(can_be_grouped(Expression()));
  EXPECT_FALSE(can_be_grouped(test::flat_expression(BooleanOp::kUnion, 2)));
  EXPECT_FALSE(can_be_grouped(test::flat_expression(BooleanOp::kDifference, 3)));
  EXPECT_FALSE(can_be_grouped(test::flat_expression(BooleanOp::kSymmetricDifference, 9)));
  EXPECT_TRUE(can_be_grouped(test::flat_expression(BooleanOp::kUnion, 3)));
  EXPECT_TRUE(can_be_grouped(test::flat_expression(BooleanOp::kDifference, 4)));
}

// The groups of any expression, down to operators of two operands.
TEST(OperandGroups, OfRandomTreesAreEvaluatedAsOneJob) {
  test::Random random(77120);
  test::TreeMaker maker(random);
  int grouped = 0;
  for (int round = 0; round < 60; ++round) {
    test::TreeShape shape;
    shape.operands = 7;
    shape.depth = 1 + round % 2;
    shape.frames = round % 3 == 0;
    const test::RandomTree tree = maker.make(shape);
    uint64_t signs = 0;
    const auto whole = evaluate(tree.operands, tree.expression, false, signs);
    ASSERT_TRUE(whole) << whole.error().message;
    GroupedJob job{tree.operands, tree.expression};
    for (; can_be_grouped(job.expression); ++grouped) {
      const std::vector<GridBox> boxes(job.operands.size(), tree.region);
      auto next = evaluate_groups(
          job.operands, job.expression, boxes,
          [&](const std::vector<Operand>& operands, const Expression& part, const GridBox& around) {
            EXPECT_LT(part.nodes.size(), job.expression.nodes.size());
            EvaluateStats stats;
            return evaluate_boolean(operands, part, around, {}, stats);
          });
      ASSERT_TRUE(next) << next.error().message;
      ASSERT_LT(next->expression.nodes.size(), job.expression.nodes.size());
      job = *std::move(next);
    }
    EvaluateStats stats;
    const auto last = evaluate_boolean(job.operands, job.expression, tree.region, {}, stats);
    ASSERT_TRUE(last) << last.error().message;
    ASSERT_EQ(test::first_difference(**last, **whole), "") << "round " << round;
  }
  EXPECT_GT(grouped, 20);
}

}  // namespace
}  // namespace csgrun
