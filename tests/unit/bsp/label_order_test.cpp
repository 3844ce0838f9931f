// Which of two operands gives way where both have surface, against the evaluation of expressions.
#include "engine/bsp/label_order.h"

#include <gtest/gtest.h>

#include "engine/bsp/pruned_expression.h"
#include "tests/support/kernel_case.h"
#include "tests/support/seeded.h"

namespace csgrun::label_order_test {
namespace {

/// A random tree; an operand may stand in several places, a node below several others.
uint32_t add_node(test::Random& random, Expression& e, uint32_t operands, int depth, bool shares) {
  Expression::Node node;
  if (depth == 0 || random.integer(0, 3) == 0) {
    node.operand = static_cast<uint32_t>(random.integer(0, operands - 1));
  } else {
    node.is_operand = false;
    node.op = static_cast<BooleanOp>(random.integer(0, 3));
    std::vector<uint32_t> children;
    for (int64_t c = random.integer(1, 4); c > 0; --c) {
      const bool known = shares && !e.nodes.empty() && random.integer(0, 4) == 0;
      const auto last = static_cast<int64_t>(e.nodes.size()) - 1;
      children.push_back(known ? static_cast<uint32_t>(random.integer(0, last))
                               : add_node(random, e, operands, depth - 1, shares));
    }
    node.first_child = static_cast<uint32_t>(e.children.size());
    node.child_count = static_cast<uint32_t>(children.size());
    e.children.insert(e.children.end(), children.begin(), children.end());
  }
  e.nodes.push_back(node);
  return static_cast<uint32_t>(e.nodes.size() - 1);
}

TEST(LabelOrder, WhatYieldsIsNeverNamed) {
  test::Random random(977);
  size_t yielding = 0, both = 0, named = 0;
  std::vector<PrunedExpression::Boundary> scratch;
  for (int round = 0; round < 10'000; ++round) {
    Expression e;
    const auto operands = static_cast<uint32_t>(random.integer(2, 9));
    add_node(random, e, operands, static_cast<int>(random.integer(1, 4)), round % 3 == 0);
    const PrunedExpression whole(e);
    const LabelOrder order(e, operands);
    std::vector<uint8_t> front(operands), back(operands);
    for (int point = 0; point < 8; ++point) {
      for (uint32_t o = 0; o < operands; ++o) {
        front[o] = random.integer(0, 1) == 0;
        back[o] = random.integer(0, 1) == 0;
      }
      const auto boundary = whole.boundary([&](uint32_t o) { return front[o] != 0; },
                                           [&](uint32_t o) { return back[o] != 0; }, scratch);
      for (uint32_t o = 0; o < operands; ++o) {
        for (uint32_t p = 0; p < operands; ++p) {
          const bool yields = order.yields(o, p);
          yielding += yields;
          if (front[o] == back[o] || front[p] == back[p]) continue;
          both += yields;
          named += boundary.operand == p && yields;
          ASSERT_FALSE(yields && boundary.operand == o) << round << ": " << o << " and " << p;
        }
      }
    }
  }
  EXPECT_GT(yielding, 10'000u);
  EXPECT_GT(both, 3000u);
  EXPECT_GT(named, 500u);
}

Expression expression_of(std::vector<Expression::Node> nodes, std::vector<uint32_t> children) {
  return {std::move(nodes), std::move(children)};
}
Expression::Node operand(uint32_t o) { return {true, BooleanOp::kUnion, o, 0, 0}; }
Expression::Node operation(BooleanOp op, uint32_t first, uint32_t count) {
  return {false, op, 0, first, count};
}

TEST(LabelOrder, OfOneOperatorTheFirstIsNamed) {
  for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kIntersection, BooleanOp::kDifference,
                             BooleanOp::kSymmetricDifference}) {
    const LabelOrder order(test::flat_expression(op, 3), 4);
    for (uint32_t o = 0; o < 4; ++o) {
      for (uint32_t p = 0; p < 4; ++p) {
        const bool expected = op != BooleanOp::kSymmetricDifference && p < o && o < 3;
        EXPECT_EQ(order.yields(o, p), expected) << o << ' ' << p;
      }
    }
  }
}

// 0 - (1 - (2 - 3)) and ((0 - 1) - 2) - 3: only in the first all yield to what is before them.
TEST(LabelOrder, OfNestedDifferences) {
  const auto less = [](uint32_t first) { return operation(BooleanOp::kDifference, first, 2); };
  const LabelOrder right(
      expression_of({operand(0), operand(1), operand(2), operand(3), less(0), less(2), less(4)},
                    {2, 3, 1, 4, 0, 5}),
      4);
  const LabelOrder left(
      expression_of({operand(0), operand(1), less(0), operand(2), less(2), operand(3), less(4)},
                    {0, 1, 2, 3, 4, 5}),
      4);
  for (uint32_t o = 0; o < 4; ++o) {
    for (uint32_t p = 0; p < 4; ++p) {
      EXPECT_EQ(right.yields(o, p), p < o) << o << ' ' << p;
      EXPECT_EQ(left.yields(o, p), p == 0 && o == 1) << o << ' ' << p;
    }
  }
}

TEST(LabelOrder, OfNothingAndOfOneOperand) {
  EXPECT_FALSE(LabelOrder(Expression(), 2).yields(1, 0));
  EXPECT_FALSE(LabelOrder(expression_of({operand(1)}, {}), 2).yields(1, 0));
}

// What stands in two places is asked twice.
TEST(LabelOrder, OfAnOperandInTwoPlaces) {
  const LabelOrder order(expression_of({operand(1), operand(0), operand(1), operand(2),
                                        operation(BooleanOp::kUnion, 0, 4)},
                                       {0, 1, 2, 3}),
                         3);
  EXPECT_FALSE(order.yields(1, 0));
  EXPECT_FALSE(order.yields(0, 1));
  EXPECT_FALSE(order.yields(2, 1));
  EXPECT_TRUE(order.yields(2, 0));
}

}  // namespace
}  // namespace csgrun::label_order_test
