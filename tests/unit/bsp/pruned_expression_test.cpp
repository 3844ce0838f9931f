// Boolean expressions and their folded forms, against truth tables.
#include "engine/bsp/pruned_expression.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun::pruned_expression_test {
namespace {

constexpr uint32_t kOperands = 5;
using Form = PrunedExpression::Form;

/// Adds a random subtree; returns its node.
uint32_t add(test::Random& random, Expression& e, int depth) {
  Expression::Node node;
  if (depth == 0 || random.integer(0, 3) == 0) {
    node.operand = static_cast<uint32_t>(random.integer(0, kOperands - 1));
  } else {
    std::vector<uint32_t> children;
    for (int64_t n = random.integer(1, 4); n > 0; --n)
      children.push_back(add(random, e, depth - 1));
    node.is_operand = false;
    node.op = static_cast<BooleanOp>(random.integer(0, 3));
    node.first_child = static_cast<uint32_t>(e.children.size());
    node.child_count = static_cast<uint32_t>(children.size());
    e.children.insert(e.children.end(), children.begin(), children.end());
  }
  e.nodes.push_back(node);
  return static_cast<uint32_t>(e.nodes.size() - 1);
}

bool truth(const Expression& e, uint32_t at, uint32_t inside) {
  const Expression::Node& n = e.nodes[at];
  if (n.is_operand) return inside >> n.operand & 1;
  const auto child = [&](uint32_t c) { return truth(e, e.children[n.first_child + c], inside); };
  bool r = child(0);
  for (uint32_t c = 1; c < n.child_count; ++c) {
    switch (n.op) {
      case BooleanOp::kUnion:
        r = r | child(c);
        break;
      case BooleanOp::kIntersection:
        r = r & child(c);
        break;
      case BooleanOp::kDifference:
        r = r & !child(c);
        break;
      case BooleanOp::kSymmetricDifference:
        r = r ^ child(c);
        break;
    }
  }
  return r;
}

/// The lowest child with boundary, a symmetric difference taken as binary ones from the left.
uint32_t boundary_operand(const Expression& e, uint32_t at, uint32_t front, uint32_t back) {
  if (truth(e, at, front) == truth(e, at, back)) return PrunedExpression::kNoOperand;
  const Expression::Node& n = e.nodes[at];
  if (n.is_operand) return n.operand;
  uint32_t from = 0;
  if (n.op == BooleanOp::kSymmetricDifference) {
    // Behind the last prefix that has no boundary.
    bool f = false, b = false;
    for (uint32_t c = 0; c < n.child_count; ++c) {
      f ^= truth(e, e.children[n.first_child + c], front);
      b ^= truth(e, e.children[n.first_child + c], back);
      if (f == b) from = c + 1;
    }
  }
  for (uint32_t c = from; c < n.child_count; ++c) {
    const uint32_t o = boundary_operand(e, e.children[n.first_child + c], front, back);
    if (o != PrunedExpression::kNoOperand) return o;
  }
  ADD_FAILURE() << "boundary of no child";
  return PrunedExpression::kNoOperand;
}

TEST(PrunedExpression, IsItsTruthTableHoweverItIsFolded) {
  test::Random random(91);
  std::array<int, 5> forms{};
  std::vector<Inside> scratch;
  std::vector<PrunedExpression::Boundary> boundaries;
  for (int i = 0; i < 3000; ++i) {
    Expression e;
    const uint32_t root = add(random, e, static_cast<int>(random.integer(0, 4)));
    PrunedExpression folded(e);
    // Some operands become constants, in one step or two.
    const auto known = static_cast<uint32_t>(random.integer(0, (1 << kOperands) - 1));
    const auto values = static_cast<uint32_t>(random.integer(0, (1 << kOperands) - 1)) & known;
    const auto now = static_cast<uint32_t>(random.integer(0, (1 << kOperands) - 1)) & known;
    for (const uint32_t step : {now, known}) {
      folded = folded.fold([&](uint32_t o) {
        return !(step >> o & 1) ? Inside::kUnknown : values >> o & 1 ? Inside::kYes : Inside::kNo;
      });
    }
    std::set<uint32_t> mentioned;
    folded.each_operand([&](uint32_t o) { mentioned.insert(o); });
    for (const uint32_t o : mentioned) ASSERT_FALSE(known >> o & 1);
    bool can_be[2] = {false, false};
    for (uint32_t free = 0; free < 1u << kOperands; ++free) {
      if (free & known) continue;
      const bool expected = truth(e, root, free | values);
      can_be[expected] = true;
      const auto value = [&](uint32_t o) { return free >> o & 1 ? Inside::kYes : Inside::kNo; };
      ASSERT_EQ(folded.evaluate(value, scratch), expected ? Inside::kYes : Inside::kNo) << i;
      switch (folded.form()) {
        case Form::kEmpty:
          ASSERT_FALSE(expected);
          break;
        case Form::kFull:
          ASSERT_TRUE(expected);
          break;
        case Form::kOperand:
          ASSERT_EQ(expected, free >> folded.single() & 1);
          break;
        case Form::kComplement:
          ASSERT_NE(expected, free >> folded.single() & 1);
          break;
        case Form::kGeneral:
          break;
      }
      // What is said of a point of which less is known holds for all that it may be.
      const auto hidden = static_cast<uint32_t>(random.integer(0, (1 << kOperands) - 1));
      const Inside guess = folded.evaluate(
          [&](uint32_t o) { return hidden >> o & 1 ? Inside::kUnknown : value(o); }, scratch);
      if (guess != Inside::kUnknown) {
        ASSERT_EQ(guess, expected ? Inside::kYes : Inside::kNo);
      }
      // The operand that gives the boundary between two points.
      const uint32_t other =
          static_cast<uint32_t>(random.integer(0, (1 << kOperands) - 1)) & ~known;
      const auto b = folded.boundary([&](uint32_t o) { return (free >> o & 1) != 0; },
                                     [&](uint32_t o) { return (other >> o & 1) != 0; }, boundaries);
      const uint32_t operand = boundary_operand(e, root, free | values, other | values);
      ASSERT_EQ(b.operand, operand) << i;
      if (operand != PrunedExpression::kNoOperand) {
        ASSERT_EQ(b.front, expected);
        ASSERT_EQ(b.back, truth(e, root, other | values));
      }
    }
    // Operands that occur once: a constant is seen to be one.
    if (mentioned.empty()) {
      ASSERT_TRUE(folded.form() == (can_be[1] ? Form::kFull : Form::kEmpty));
    }
    ++forms[static_cast<size_t>(folded.form())];
  }
  for (const int n : forms) EXPECT_GT(n, 50);
}

// Kleene's tables: nothing known that does not follow, nothing unknown that does, node by node.
TEST(PrunedExpression, EvaluatesWhatIsKnownOfOneNode) {
  test::Random random(92);
  std::vector<Inside> scratch;
  for (int i = 0; i < 600; ++i) {
    Expression e;
    const auto n = static_cast<uint32_t>(random.integer(2, kOperands));
    Expression::Node root;
    root.is_operand = false;
    root.op = static_cast<BooleanOp>(i % 4);
    root.child_count = n;
    for (uint32_t o = 0; o < n; ++o) {
      Expression::Node leaf;
      leaf.operand = o;
      e.nodes.push_back(leaf);
      e.children.push_back(o);
    }
    e.nodes.push_back(root);
    const PrunedExpression whole(e);
    ASSERT_EQ(whole.form(), Form::kGeneral);
    const auto hidden = static_cast<uint32_t>(random.integer(0, (1 << n) - 1));
    const auto values = static_cast<uint32_t>(random.integer(0, (1 << n) - 1)) & ~hidden;
    bool can_be[2] = {false, false};
    for (uint32_t all = 0; all < 1u << n; ++all) {
      if ((all & ~hidden) == values) can_be[truth(e, n, all)] = true;
    }
    const auto value = [&](uint32_t o) {
      return hidden >> o & 1 ? Inside::kUnknown : values >> o & 1 ? Inside::kYes : Inside::kNo;
    };
    const Inside expected = can_be[0] && can_be[1] ? Inside::kUnknown
                            : can_be[1]            ? Inside::kYes
                                                   : Inside::kNo;
    ASSERT_EQ(whole.evaluate(value, scratch), expected);
    // Folded away, it is the constant, or what is left of it decides nothing yet.
    const PrunedExpression folded = whole.fold(value);
    ASSERT_EQ(folded.form() == Form::kEmpty, expected == Inside::kNo);
    ASSERT_EQ(folded.form() == Form::kFull, expected == Inside::kYes);
    // With one operand left that counts, it is that operand or its complement.
    if (expected == Inside::kUnknown && (hidden & (hidden - 1)) == 0) {
      ASSERT_EQ(folded.form(),
                can_be[1] && truth(e, n, values | hidden) ? Form::kOperand : Form::kComplement);
      ASSERT_EQ(1u << folded.single(), hidden);
    }
  }
}

// One node may be a child twice.
TEST(PrunedExpression, OfOneOperandTwice) {
  for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kIntersection, BooleanOp::kDifference,
                             BooleanOp::kSymmetricDifference}) {
    Expression e;
    e.nodes.emplace_back().operand = 3;
    Expression::Node both;
    both.is_operand = false;
    both.op = op;
    both.child_count = 2;
    e.nodes.push_back(both);
    e.children = {0, 0};
    const PrunedExpression pruned(e);
    std::vector<Inside> scratch;
    for (const Inside value : {Inside::kNo, Inside::kYes}) {
      const bool is_itself = op == BooleanOp::kUnion || op == BooleanOp::kIntersection;
      EXPECT_EQ(pruned.evaluate([&](uint32_t) { return value; }, scratch),
                is_itself ? value : Inside::kNo);
    }
  }
}

TEST(PrunedExpression, OfNothingIsEmpty) {
  EXPECT_EQ(PrunedExpression().form(), Form::kEmpty);
  EXPECT_EQ(PrunedExpression(Expression()).form(), Form::kEmpty);
}

}  // namespace
}  // namespace csgrun::pruned_expression_test
