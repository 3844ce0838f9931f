// Whether operands only add or only take away, against tables of truth; and, of all functions of
// three bodies that cross in general position, where what is kept touches itself.
#include "engine/bsp/unate.h"

#include <algorithm>
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/convex_operand.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"
#include "tests/support/touches_told.h"

namespace csgrun::unate_test {
namespace {

using namespace test;  // NOLINT: a test

constexpr uint32_t kOperands = 3;
/// A function of three operands: bit i is its value where operand k is bit k of i.
using Table = uint32_t;

uint32_t add_node(Expression& e, BooleanOp op, const std::vector<uint32_t>& children) {
  e.nodes.push_back({false, op, 0, static_cast<uint32_t>(e.children.size()),
                     static_cast<uint32_t>(children.size())});
  e.children.insert(e.children.end(), children.begin(), children.end());
  return static_cast<uint32_t>(e.nodes.size() - 1);
}

uint32_t add_operand(Expression& e, uint32_t operand) {
  e.nodes.push_back({true, BooleanOp::kUnion, operand, 0, 0});
  return static_cast<uint32_t>(e.nodes.size() - 1);
}

/// The operands of a set met, less others.
uint32_t add_product(Expression& e, uint32_t with, uint32_t without) {
  std::vector<uint32_t> met;
  for (uint32_t o = 0; o < kOperands; ++o) {
    if (with >> o & 1) met.push_back(add_operand(e, o));
  }
  std::vector<uint32_t> parts{add_node(e, BooleanOp::kIntersection, met)};
  for (uint32_t o = 0; o < kOperands; ++o) {
    if (without >> o & 1) parts.push_back(add_operand(e, o));
  }
  return add_node(e, BooleanOp::kDifference, parts);
}

/// A union of products, one for each combination that is inside. The table's bit 0 is 0.
Expression sum_of(Table table) {
  Expression e;
  std::vector<uint32_t> products;
  for (uint32_t i = 1; i < 8; ++i) {
    if (table >> i & 1) products.push_back(add_product(e, i, ~i));
  }
  add_node(e, BooleanOp::kUnion, products);
  return e;
}

/// The same as a symmetric difference of intersections.
Expression polynomial_of(Table table) {
  Expression e;
  std::vector<uint32_t> products;
  for (uint32_t i = 1; i < 8; ++i) {
    bool is_odd = false;  // Moebius transform: the sum over all subsets
    for (uint32_t j = 1; j < 8; ++j) is_odd ^= (j & ~i) == 0 && (table >> j & 1);
    if (is_odd) products.push_back(add_product(e, i, 0));
  }
  add_node(e, BooleanOp::kSymmetricDifference, products);
  return e;
}

Table table_of(const Expression& e) {
  Table table = 0;
  for (uint32_t i = 0; i < 8; ++i) {
    std::vector<bool> value;
    for (const Expression::Node& n : e.nodes) {
      if (n.is_operand) {
        value.push_back(i >> n.operand & 1);
        continue;
      }
      const auto child = [&](uint32_t c) { return value[e.children[n.first_child + c]]; };
      bool v = n.child_count > 0 && child(0);
      for (uint32_t c = 1; c < n.child_count; ++c) {
        switch (n.op) {
          case BooleanOp::kUnion:
            v = v || child(c);
            break;
          case BooleanOp::kIntersection:
            v = v && child(c);
            break;
          case BooleanOp::kDifference:
            v = v && !child(c);
            break;
          case BooleanOp::kSymmetricDifference:
            v = v != child(c);
            break;
        }
      }
      value.push_back(v);
    }
    table |= static_cast<Table>(value.back()) << i;
  }
  return table;
}

bool is_unate(Table table) {
  for (uint32_t o = 0; o < kOperands; ++o) {
    bool adds = false, takes = false;
    for (uint32_t i = 0; i < 8; ++i) {
      if (i >> o & 1) continue;
      const bool without = table >> i & 1, with = table >> (i | 1u << o) & 1;
      adds |= with && !without;
      takes |= without && !with;
    }
    if (adds && takes) return false;
  }
  return true;
}

TEST(Unate, IsNotClaimedOfOtherFunctions) {
  Random random(4401);
  int claimed = 0, others = 0;
  for (int i = 0; i < 4000; ++i) {
    Expression e;
    std::vector<uint32_t> open;
    for (int64_t n = random.integer(1, 5); n > 0; --n) {
      open.push_back(add_operand(e, static_cast<uint32_t>(random.integer(0, 2))));
    }
    do {
      std::vector<uint32_t> children;
      const int64_t wanted = random.integer(1, 3);
      while (!open.empty() && static_cast<int64_t>(children.size()) < wanted) {
        const auto at = open.begin() + random.integer(0, static_cast<int64_t>(open.size()) - 1);
        children.push_back(*at);
        open.erase(at);
      }
      open.push_back(add_node(e, static_cast<BooleanOp>(random.integer(0, 3)), children));
    } while (open.size() > 1);
    const bool says = is_unate(e);
    if (says) {
      ASSERT_TRUE(is_unate(table_of(e))) << i;
    }
    ++(says ? claimed : others);
  }
  EXPECT_GT(claimed, 1000);
  EXPECT_GT(others, 1000);
}

TEST(Unate, IsSeenWhereOperandsAreOnOneSideOnly) {
  Expression e;  // a less (b and c) less b
  const uint32_t a = add_operand(e, 0), b = add_operand(e, 1), c = add_operand(e, 2),
                 again = add_operand(e, 1);
  const uint32_t both = add_node(e, BooleanOp::kIntersection, {b, c});
  add_node(e, BooleanOp::kDifference, {a, both, again});
  EXPECT_TRUE(is_unate(e));
  Expression one;
  add_node(one, BooleanOp::kSymmetricDifference, {add_operand(one, 0), add_operand(one, 1)});
  EXPECT_FALSE(is_unate(one));
  Expression twice;  // a less (b less a)
  const uint32_t first = add_operand(twice, 0), second = add_operand(twice, 1),
                 third = add_operand(twice, 0);
  const uint32_t less = add_node(twice, BooleanOp::kDifference, {second, third});
  add_node(twice, BooleanOp::kDifference, {first, less});
  EXPECT_TRUE(is_unate(twice));  // taken away twice, it adds
  EXPECT_TRUE(is_unate(Expression{}));
}

/// Three pyramids whose bases cross in one point, in general position.
std::vector<Operand> pyramids() {
  const auto hull = [](const std::vector<IVec3>& points) {
    return convex_operand(hull_loops(points));
  };
  return {hull({{0, -50, -61}, {0, 50, -61}, {0, 50, 63}, {0, -50, 63}, {-100, 3, 7}}),
          hull({{-70, 0, -81}, {71, 0, -81}, {71, 0, 83}, {-70, 0, 83}, {5, -97, 4}}),
          hull({{-90, -41, 0}, {93, -41, 0}, {93, 44, 0}, {-90, 44, 0}, {6, 2, -99}})};
}

// Two wedges, say, may meet in an edge of both that ends in the middle of one of them.
TEST(Unate, CrossingsOfThreeBodies) {
  const std::vector<Operand> bodies = pyramids();
  const GridBox region = region_of(bodies);
  int touching = 0;
  for (Table table = 2; table < 256; table += 2) {
    std::shared_ptr<const BoundaryMesh> first;
    for (const bool whole_faces : {true, false}) {
      KernelOptions options;
      options.whole_faces = whole_faces;
      for (const Expression& e : {sum_of(table), polynomial_of(table)}) {
        ASSERT_EQ(table_of(e), table);
        EvaluateStats stats;
        const auto mesh = evaluate_boolean(bodies, e, region, options, stats);
        ASSERT_TRUE(mesh) << table;
        expect_touches_told(**mesh, std::to_string(table));
        if (!first) first = *mesh;
        EXPECT_EQ(difference_between(*first, **mesh, false), "") << table;
        touching += whole_faces && (*mesh)->may_touch;
        if (whole_faces && is_unate(e)) {
          EXPECT_FALSE((*mesh)->may_touch) << table;
        }
      }
    }
  }
  EXPECT_GT(touching, 50);
}

}  // namespace
}  // namespace csgrun::unate_test
