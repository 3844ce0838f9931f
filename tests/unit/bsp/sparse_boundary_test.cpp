// Boundaries of points inside few operands, against the evaluation of the whole expression.
#include "engine/bsp/sparse_boundary.h"

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun::sparse_boundary_test {
namespace {

/// A random tree over operands, some of which occur several times and some not at all.
uint32_t add_node(test::Random& random, Expression& e, uint32_t operands, int depth) {
  Expression::Node node;
  if (depth == 0 || random.integer(0, 5) == 0) {
    node.operand = static_cast<uint32_t>(random.integer(0, operands - 1));
    node.op = static_cast<BooleanOp>(random.integer(0, 3));  // means nothing here
  } else {
    node.is_operand = false;
    node.op = static_cast<BooleanOp>(random.integer(0, 3));
    std::vector<uint32_t> children;
    // Now and then a node of nothing: all of space, if it is an intersection.
    const int64_t count = random.integer(0, 20) == 0 ? 0 : random.integer(1, 5);
    for (int64_t c = 0; c < count; ++c) {
      // A node may be the child of several, and several times.
      const bool known = !e.nodes.empty() && random.integer(0, 5) == 0;
      children.push_back(
          known ? static_cast<uint32_t>(random.integer(0, static_cast<int64_t>(e.nodes.size()) - 1))
                : add_node(random, e, operands, depth - 1));
    }
    node.first_child = static_cast<uint32_t>(e.children.size());
    node.child_count = static_cast<uint32_t>(children.size());
    e.children.insert(e.children.end(), children.begin(), children.end());
  }
  e.nodes.push_back(node);
  return static_cast<uint32_t>(e.nodes.size() - 1);
}

TEST(SparseBoundary, IsThatOfTheWholeExpression) {
  test::Random random(521);
  int with_boundary = 0, full = 0;
  std::vector<PrunedExpression::Boundary> scratch;
  for (int i = 0; i < 2000; ++i) {
    Expression e;
    const auto operands = static_cast<uint32_t>(random.integer(1, 9));
    add_node(random, e, operands, static_cast<int>(random.integer(0, 4)));
    const PrunedExpression whole(e);
    SparseBoundary sparse(e);
    for (int k = 0; k < 8; ++k) {
      // One more than there are: what the expression does not mention does not matter.
      std::vector<uint8_t> front(operands + 1, 0), back(operands + 1, 0);
      std::vector<SparseBoundary::Sides> given;
      for (uint32_t o = 0; o <= operands; ++o) {
        if (random.integer(0, 1) == 0) continue;
        front[o] = random.integer(0, 1) == 0;
        back[o] = random.integer(0, 1) == 0;
        given.push_back({o, front[o] != 0, back[o] != 0});
      }
      PrunedExpression::Boundary expected =
          whole.boundary([&](uint32_t o) { return front[o] != 0; },
                         [&](uint32_t o) { return back[o] != 0; }, scratch);
      if (whole.form() == PrunedExpression::Form::kFull) expected.front = expected.back = true;
      const PrunedExpression::Boundary got = sparse.evaluate(given);
      ASSERT_EQ(got.front, expected.front) << "expression " << i;
      ASSERT_EQ(got.back, expected.back) << "expression " << i;
      ASSERT_EQ(got.operand, expected.operand) << "expression " << i;
      with_boundary += got.operand != PrunedExpression::kNoOperand;
      full += got.front && got.back;
    }
  }
  EXPECT_GT(with_boundary, 1000);
  EXPECT_GT(full, 1000);
}

TEST(SparseBoundary, OfNothingIsNone) {
  SparseBoundary nothing{Expression()};
  const std::vector<SparseBoundary::Sides> given{{0, false, true}};
  EXPECT_EQ(nothing.evaluate(given).operand, PrunedExpression::kNoOperand);
  EXPECT_FALSE(nothing.evaluate(given).back);
}

}  // namespace
}  // namespace csgrun::sparse_boundary_test
