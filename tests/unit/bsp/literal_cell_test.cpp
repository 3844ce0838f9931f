// Two ways to solve a critical cell must agree: pushing polygons down the other operands' BSPs, and
// the paper's merge of labelled BSPs with extraction from its nodes. Whatever the limit m, so that
// cells with few and with many operands, and walls anywhere, are among them.
#include <gtest/gtest.h>

#include "engine/bsp/kernel.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/random_trees.h"

namespace csgrun::literal_cell_test {
namespace {

using Boundary = std::shared_ptr<const BoundaryMesh>;

struct Way {
  bool literal;
  uint32_t cell_limit;
  std::array<uint32_t, 3> shift;
};
constexpr Way kWays[] = {{false, 3, {0, 0, 0}},
                         {false, 9, {1, 2, 0}},
                         {true, 3, {0, 0, 0}},
                         {true, 9, {0, 0, 0}},
                         {true, 17, {1, 2, 3}}};

Result<Boundary> evaluate(const test::RandomTree& tree, const Way& way, uint64_t& critical_cells) {
  KernelOptions options;
  options.literal_cells = way.literal;
  options.cell_limit = way.cell_limit;
  options.octree_shift = way.shift;
  EvaluateStats stats;
  auto result = evaluate_boolean(tree.operands, tree.expression, tree.region, options, stats);
  critical_cells += stats.critical_cells;
  return result;
}

class Comparison {
 public:
  /// Evaluates a tree in all ways; returns the value, or null after a failure.
  Boundary run(const test::RandomTree& tree, const std::string& what) {
    SCOPED_TRACE(what);
    const auto expected = evaluate(tree, {false, 17, {0, 0, 0}}, critical_cells);
    if (!expected) {
      ADD_FAILURE() << expected.error().message;
      return nullptr;
    }
    faces += (*expected)->faces.size();
    bool same = true;
    for (const Way& way : kWays) {
      const auto got = evaluate(tree, way, critical_cells);
      const std::string difference =
          got ? test::first_difference(**expected, **got) : got.error().message;
      EXPECT_EQ(difference, "") << (way.literal ? "literal" : "default")
                                << ", m = " << way.cell_limit;
      same &= difference.empty();
    }
    return same ? *expected : nullptr;
  }

  uint64_t faces = 0, critical_cells = 0;
};

void compare_random_trees(uint64_t seed, int count, const test::TreeShape& shape) {
  test::Random random(seed);
  test::TreeMaker maker(random);
  Comparison comparison;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    test::TreeShape s = shape;
    s.operands = static_cast<int>(random.integer(2, shape.operands));
    s.depth = static_cast<int>(random.integer(1, shape.depth));
    comparison.run(maker.make(s), "tree " + std::to_string(i));
  }
  // The comparison is worth nothing if hardly anything met.
  EXPECT_GT(comparison.critical_cells, static_cast<uint64_t>(count));
  EXPECT_GT(comparison.faces, static_cast<uint64_t>(count));
}

TEST(LiteralCell, AgreesOnDenseLeaves) {
  compare_random_trees(1, 150, {.size = 5, .operands = 5, .depth = 3});
}

TEST(LiteralCell, AgreesOnTinyLeaves) {
  compare_random_trees(2, 80, {.size = 3, .operands = 5, .depth = 3});
}

TEST(LiteralCell, AgreesOnLargeCoordinates) {
  compare_random_trees(3, 40, {.size = 5, .unit = 26843543, .operands = 4, .depth = 3});
}

TEST(LiteralCell, AgreesOnSpreadCoordinates) {
  compare_random_trees(4, 40, {.size = 100000, .operands = 4, .depth = 2});
}

TEST(LiteralCell, AgreesInFrames) {
  compare_random_trees(5, 40, {.size = 5, .unit = 7, .operands = 4, .depth = 2, .frames = true});
}

// A materialised result as an operand: its polygons have constructed corners. Evaluated flat or in
// two steps, on either path, the value is one and the same.
TEST(LiteralCell, AgreesOnMaterialisedOperands) {
  test::Random random(6);
  test::TreeMaker maker(random);
  Comparison comparison;
  for (int i = 0; i < 40 && !testing::Test::HasFailure(); ++i) {
    const test::TreeShape shape{.size = 4, .operands = 4, .depth = 2, .frames = i % 3 == 0};
    test::RandomTree flat = maker.make(shape);
    // The last operand is kept for the outer step, the inner one is the expression over the others.
    test::RandomTree inner = flat;
    const auto last = static_cast<uint32_t>(flat.operands.size());
    flat.operands.push_back(maker.make(shape).operands.front());
    flat.operands.back().first_source = last;
    const auto op = static_cast<BooleanOp>(random.integer(0, 3));
    Expression& e = flat.expression;
    const auto root = static_cast<uint32_t>(e.nodes.size() - 1);
    e.nodes.push_back({true, BooleanOp::kUnion, last, 0, 0});
    e.nodes.push_back({false, op, 0, static_cast<uint32_t>(e.children.size()), 2});
    e.children.insert(e.children.end(), {root, root + 1});
    flat.region = test::TreeMaker::region_of(flat.operands);
    const Boundary whole = comparison.run(flat, "flat tree " + std::to_string(i));
    const Boundary part = comparison.run(inner, "inner tree " + std::to_string(i));
    if (!whole || !part) return;
    test::RandomTree outer;
    outer.region = flat.region;
    outer.operands.resize(2);
    outer.operands[0].boundary = part;
    outer.operands[1] = flat.operands[last];
    outer.expression.nodes = {{true, op, 0, 0, 0}, {true, op, 1, 0, 0}, {false, op, 0, 0, 2}};
    outer.expression.children = {0, 1};
    const Boundary nested = comparison.run(outer, "outer tree " + std::to_string(i));
    if (!nested) return;
    EXPECT_EQ(test::first_difference(*whole, *nested), "") << "nested, tree " << i;
  }
  EXPECT_GT(comparison.critical_cells, 60u);
}

}  // namespace
}  // namespace csgrun::literal_cell_test
