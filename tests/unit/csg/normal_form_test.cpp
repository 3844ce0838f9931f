// The normal form: what is folded, flattened, dropped and shared, and trees of any depth.
#include "engine/csg/normal_form.h"

#include <cmath>

#include <gtest/gtest.h>

#include "test_meshes.h"

namespace csgrun::normal_form_test {
namespace {

using namespace testing;

class NormalFormTest : public ::testing::Test {
 protected:
  uint32_t add(const NodePtr& root) {
    auto index = form.add(root);
    EXPECT_TRUE(index.has_value());
    return *index;
  }
  const NormalNode& node(const NodePtr& root) { return form.nodes()[add(root)]; }
  size_t operand_count(const NodePtr& root) { return form.operands(add(root)).size(); }
  /// "u(a,b)" with the x translation of leaves as names.
  std::string text(uint32_t index) {
    const NormalNode& n = form.nodes()[index];
    if (n.kind == NormalNode::Kind::kEmpty) return "0";
    if (n.kind == NormalNode::Kind::kLeaf) {
      return std::string(1, static_cast<char>('a' + static_cast<int>(n.map.m[0][3])));
    }
    std::string s(1, "uidx"[static_cast<int>(n.op)]);
    s += '(';
    for (uint32_t operand : form.operands(index)) s += text(operand) + ',';
    s.back() = ')';
    return s;
  }
  std::string text(const NodePtr& root) { return text(add(root)); }

  AppearanceTable appearances;
  NormalForm form{appearances};
  NodePtr unit = cube(1);
  NodePtr a = unit, b = moved(1, 0, 0, unit), c = moved(2, 0, 0, unit), d = moved(3, 0, 0, unit);
  NodePtr none = Node::empty();
};

TEST_F(NormalFormTest, FoldsTransforms) {
  const NodePtr tree = moved(1, 2, 3, turned(90, {0, 0, 1}, moved(5, 0, 0, unit)));
  const NormalNode& n = node(tree);
  ASSERT_EQ(n.kind, NormalNode::Kind::kLeaf);
  EXPECT_NEAR(n.map.m[0][3], 1, 1e-12);
  EXPECT_NEAR(n.map.m[1][3], 7, 1e-12);
  EXPECT_NEAR(n.map.m[2][3], 3, 1e-12);
  EXPECT_NEAR(n.map.m[1][0], 1, 1e-12);
}

TEST_F(NormalFormTest, TheOutermostAppearanceWins) {
  Appearance red, blue;
  red.red = 1;
  blue.blue = 1;
  const NormalNode& n = node(Node::painted(red, moved(1, 0, 0, Node::painted(blue, unit))));
  EXPECT_EQ(appearances.values()[n.paint], red);
  const NodePtr mixed = unite({Node::painted(blue, a), b});
  const auto operands = form.operands(add(Node::painted(red, mixed)));
  for (uint32_t operand : operands) {
    EXPECT_EQ(appearances.values()[form.nodes()[operand].paint], red);
  }
  EXPECT_EQ(form.nodes()[form.operands(add(mixed))[1]].paint, kUnpainted);
}

TEST_F(NormalFormTest, Flattens) {
  EXPECT_EQ(text(unite({unite({a, b}), unite({c, d})})), "u(a,b,c,d)");
  EXPECT_EQ(text(intersect({a, intersect({b, intersect({c, d})})})), "i(a,b,c,d)");
  EXPECT_EQ(text(subtract({subtract({a, b}), c, d})), "d(a,b,c,d)");
  EXPECT_EQ(text(subtract({a, subtract({b, c})})), "d(a,d(b,c))");
  EXPECT_EQ(text(symmetric({a, symmetric({b, c})})), "x(a,x(b,c))");
  EXPECT_EQ(text(unite({a, moved(1, 0, 0, unite({a, b}))})), "u(a,b,c)");
  EXPECT_EQ(text(unite({subtract({unite({a, b}), c}), d})), "u(d(u(a,b),c),d)");
}

TEST_F(NormalFormTest, DropsWhatDoesNothing) {
  EXPECT_EQ(text(unite({a})), "a");
  EXPECT_EQ(text(subtract({a})), "a");
  EXPECT_EQ(text(unite({none, a, none})), "a");
  EXPECT_EQ(text(unite({none, none})), "0");
  EXPECT_EQ(text(Node::boolean(BooleanOp::kUnion, {})), "0");
  EXPECT_EQ(text(subtract({none, a})), "0");
  EXPECT_EQ(text(subtract({a, none})), "a");
  EXPECT_EQ(text(subtract({a, none, b})), "d(a,b)");
  EXPECT_EQ(text(intersect({a, none, b})), "0");
  EXPECT_EQ(text(symmetric({none, a, none, b})), "x(a,b)");
  EXPECT_EQ(text(unite({a, b, a})), "u(a,b)");
  EXPECT_EQ(text(intersect({a, a})), "a");
  EXPECT_EQ(text(subtract({a, b, b})), "d(a,b)");
  EXPECT_EQ(text(subtract({subtract({none, a}), b})), "0");
  EXPECT_EQ(text(subtract({unite({none, subtract({a, b})}), c})), "d(a,b,c)");
}

TEST_F(NormalFormTest, WhatIsTakenAwayFromItselfIsNothing) {
  EXPECT_EQ(text(subtract({a, a})), "0");
  EXPECT_EQ(text(subtract({a, b, a, c})), "0");
  EXPECT_EQ(text(subtract({a, unite({b, a})})), "0");
  EXPECT_EQ(text(subtract({subtract({a, b}), subtract({a, b})})), "0");
  EXPECT_EQ(text(unite({subtract({a, a}), b})), "b");
  EXPECT_EQ(text(subtract({b, subtract({a, a})})), "b");
  // Another place is another solid, and the rest is left to the kernel.
  EXPECT_NE(text(subtract({a, moved(1, 0, 0, a)})), "0");
  EXPECT_EQ(text(subtract({unite({a, b}), a})), "d(u(a,b),a)");
  EXPECT_EQ(text(symmetric({a, a})), "x(a,a)");
}

TEST_F(NormalFormTest, EqualSubtreesAreShared) {
  const NodePtr part = subtract({a, b});
  const auto operands =
      form.operands(add(unite({moved(7, 0, 0, part), symmetric({moved(7, 0, 0, part), d})})));
  EXPECT_EQ(operands[0], form.nodes()[operands[1]].first);
}

TEST_F(NormalFormTest, AGrowingChainKeepsItsPrefix) {
  NodePtr chain = a;
  size_t before = 0;
  for (int i = 0; i < 100; ++i) {
    chain = subtract({chain, moved(i + 1, 0, 0, unit)});
    add(chain);
    if (i > 0) {
      EXPECT_EQ(form.nodes().size(), before + 2);
    }
    before = form.nodes().size();
  }
  EXPECT_EQ(operand_count(chain), 101u);
}

TEST_F(NormalFormTest, SharedUnionsDoNotExplode) {
  NodePtr tree = unite({a, b});
  for (int i = 0; i < 60; ++i) tree = unite({tree, tree});
  EXPECT_EQ(text(tree), "u(a,b)");
  NodePtr both = intersect({a, b});
  for (int i = 0; i < 60; ++i) both = intersect({both, both});
  EXPECT_EQ(text(both), "i(a,b)");
  // Each union is used twice, but only by what moves it.
  NodePtr moving = a;
  for (int i = 0; i < 60; ++i) moving = moved(0, 1, 0, unite({moving, moving}));
  EXPECT_EQ(text(moving), "a");
}

TEST_F(NormalFormTest, TreeOrder) {
  const NodePtr tree = unite({subtract({b, a}), c, intersect({d, a})});
  std::string order;
  const std::vector<uint32_t> roots{add(tree)};
  for (uint32_t index : form.reachable(roots)) {
    if (form.nodes()[index].kind == NormalNode::Kind::kLeaf) order += text(index);
  }
  EXPECT_EQ(order, "bacd");
}

TEST_F(NormalFormTest, RejectsTransformsThatAreNotFinite) {
  Affine bad;
  bad.m[1][2] = NAN;
  const auto file = std::make_shared<const std::string>("x.lua");
  auto result = form.add(unite({a, Node::transformed(bad, b, {file, 3})}));
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(result.error().where.text(), "x.lua:3");
}

constexpr int kDeep = 100000;

TEST_F(NormalFormTest, DeepChainsOfAnyKind) {
  {
    NodePtr chain = a;
    for (int i = 0; i < kDeep; ++i) chain = unite({chain, moved(i, 1, 0, unit)});
    EXPECT_EQ(operand_count(chain), size_t{kDeep} + 1);
  }
  {
    NodePtr chain = a;
    for (int i = 0; i < kDeep; ++i) chain = unite({moved(i, 1, 0, unit), chain});
    EXPECT_EQ(operand_count(chain), size_t{kDeep} + 1);
  }
  {
    NodePtr chain = a;
    for (int i = 0; i < kDeep; ++i) chain = moved(0.001, 0, 0, chain);
    EXPECT_NEAR(node(chain).map.m[0][3], 100, 1e-6);
  }
  {
    NodePtr chain = a;
    for (int i = 0; i < kDeep; ++i) chain = Node::painted(Appearance{}, chain);
    EXPECT_EQ(node(chain).kind, NormalNode::Kind::kLeaf);
  }
  {
    NodePtr left = a, right = a, zigzag = a, cross = a;
    for (int i = 0; i < kDeep; ++i) {
      const NodePtr x = moved(i, 1, 0, unit);
      left = subtract({left, x});
      right = subtract({x, right});
      zigzag = i % 2 ? unite({zigzag, x}) : subtract({zigzag, x});
      cross = symmetric({x, cross});
    }
    EXPECT_EQ(operand_count(left), size_t{kDeep} + 1);
    EXPECT_EQ(operand_count(right), 2u);
    EXPECT_EQ(operand_count(zigzag), 2u);
    EXPECT_EQ(operand_count(cross), 2u);
    const std::vector<uint32_t> roots{add(right), add(zigzag), add(cross)};
    EXPECT_GT(form.reachable(roots).size(), 3u * kDeep);
  }
}

}  // namespace
}  // namespace csgrun::normal_form_test
