// Keys and placements: what is the same subtree, and where it stands.
#include "engine/csg/scene.h"

#include <random>

#include <gtest/gtest.h>

#include "engine/csg/scene_start.h"
#include "test_meshes.h"

namespace csgrun::scene_test {
namespace {

using namespace testing;

class SceneTest : public ::testing::Test {
 protected:
  Scene scene(const std::vector<NodePtr>& parts, GridStep step = {}) {
    std::vector<uint32_t> roots;
    for (const auto& root_node : parts) roots.push_back(*form.add(root_node));
    SceneRoom room;
    SceneContext context{form, store, appearances, warnings, room, [] { return false; }, {}};
    auto result = build_scene(context, roots, step);
    EXPECT_TRUE(result.has_value()) << result.error().message;
    return std::move(*result);
  }
  static const Subtree& root(const Scene& s, size_t i) { return s.nodes[s.roots[i]].subtree; }

  AppearanceTable appearances;
  NormalForm form{appearances};
  LeafStore store{appearances};
  Warnings warnings;
  NodePtr part =
      subtract({box({0, 0, 0}, {4, 3, 2}), box({1, 1, -1}, {2, 2, 3}), prism(5, 0.5, 9)});
};

TEST_F(SceneTest, MovedByWholeStepsTurnedMirroredAndPaintedCopiesHaveOneKey) {
  Appearance red;
  red.red = 1;
  std::vector<NodePtr> copies{part,
                              moved(0.3, 1.7, -2.001, part),
                              moved(0.1 + 0.2, 1.7, -2.001, part),
                              turned(90, {0, 0, 1}, part),
                              turned(31, {3, 2, 1}, moved(5, 0, 0, part)),
                              Node::transformed(scaling(1, -1, 1), part),
                              Node::painted(red, part),
                              Node::transformed(scaling(-1, 1, 1), turned(77, {1, 0, 1}, part))};
  const Scene s = scene(copies);
  for (size_t i = 1; i < copies.size(); ++i) {
    EXPECT_EQ(root(s, i).id.key, root(s, 0).id.key) << i;
  }
  EXPECT_EQ(root(s, 1).id.origin, root(s, 2).id.origin) << "0.1 + 0.2 is 0.3";
  EXPECT_NE(root(s, 6).id.paint, root(s, 0).id.paint);
  EXPECT_EQ(root(s, 3).id.frame, 0u) << "a 90-degree turn needs no frame";
  EXPECT_NE(root(s, 4).id.frame, 0u);
}

TEST_F(SceneTest, DifferentThingsHaveDifferentKeys) {
  const NodePtr a = cube(1), b = moved(0.5, 0.5, 0.5, cube(1));
  Appearance red;
  red.red = 1;
  const Scene s = scene({unite({a, b}), intersect({a, b}), subtract({a, b}), symmetric({a, b}),
                         subtract({b, a}), unite({a, moved(0.5, 0.5, 0.501, cube(1))}),
                         unite({a, Node::painted(red, b)}), unite({Node::painted(red, a), b}),
                         unite({a, turned(1, {0, 0, 1}, b)}), cube(1), cube(1.001), a});
  for (size_t i = 0; i < s.roots.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (i == 11 && j == 9) {
        EXPECT_EQ(root(s, i).id.key, root(s, j).id.key);
      } else {
        EXPECT_NE(root(s, i).id.key, root(s, j).id.key) << i << " " << j;
      }
    }
  }
}

TEST_F(SceneTest, CopiesMovedByPartOfAStepDiffer) {
  const GridStep step = *GridStep::parse("0.001");
  const NodePtr leaf = prism(11, 1, 1);
  const Scene s = scene({leaf, moved(0.0003, 0, 0, leaf), moved(0.001, 0, 0, leaf)}, step);
  EXPECT_NE(root(s, 0).id.key, root(s, 1).id.key);
  EXPECT_EQ(root(s, 0).id.key, root(s, 2).id.key);
}

TEST_F(SceneTest, PrefixKeysAreTheKeysOfShorterLists) {
  const NodePtr a = cube(3), b = moved(1, 1, 1, cube(1)), c = turned(20, {0, 0, 1}, cube(1)),
                d = moved(0, 0, 2, cube(1));
  const Scene s =
      scene({subtract({a, b, c, d}), subtract({a, b}), subtract({subtract({a, b}), c})});
  const auto list = s.operands(s.roots[0]);
  ASSERT_EQ(list.operands.size(), 4u);
  EXPECT_EQ(list.values[1]->id.key, root(s, 1).id.key);
  EXPECT_EQ(list.values[2]->id.key, root(s, 2).id.key);
  EXPECT_EQ(list.values[3]->id.key, root(s, 0).id.key);
}

TEST_F(SceneTest, MixedFramesAreKeyedInTheWorld) {
  const NodePtr mixed = unite({cube(2), turned(20, {0, 0, 1}, cube(2))});
  const Scene s =
      scene({mixed, moved(1, 0, 0, mixed), unite({cube(2), turned(20, {0, 0, 1}, cube(2))})});
  EXPECT_NE(root(s, 0).id.key, root(s, 1).id.key);
  EXPECT_EQ(root(s, 0).id.key, root(s, 2).id.key);
  EXPECT_EQ(root(s, 0).id.frame, 0u);
  EXPECT_EQ(root(s, 0).id.origin, (IVec3{0, 0, 0}));
}

TEST_F(SceneTest, BoxesEncloseTheResult) {
  const Scene s =
      scene({subtract({cube(1), moved(0.5, 0, 0, cube(1))}),
             intersect({cube(1), moved(0.5, 0, 0, cube(1))}), turned(45, {0, 0, 1}, cube(1))},
            *GridStep::parse("0.001"));
  EXPECT_EQ(root(s, 0).world.hi, (IVec3{1000, 1000, 1000}));
  EXPECT_EQ(root(s, 1).world.lo, (IVec3{500, 0, 0}));
  const GridBox& turned_box = root(s, 2).world;
  EXPECT_LE(turned_box.lo[0], -708);
  EXPECT_GE(turned_box.lo[0], -720);
  EXPECT_GE(turned_box.hi[1], 1415);
  EXPECT_LE(turned_box.hi[1], 1425);
}

TEST_F(SceneTest, WhatCannotReachTheResultDoesNotSetTheStep) {
  EXPECT_EQ(scene({cube(1)}).step.millimetres(), 1.5625e-08);
  EXPECT_EQ(scene({subtract({cube(1), moved(-100, -100, -1, cube(300))})}).step.millimetres(),
            1.5625e-08);
  EXPECT_EQ(scene({intersect({cube(1), moved(-100, -100, -1, cube(300))})}).step.millimetres(),
            1.5625e-08);
  EXPECT_EQ(scene({unite({cube(1), cube(300)})}).step.millimetres(), 8e-06);
  EXPECT_EQ(scene({cube(1), cube(300)}).step.millimetres(), 8e-06);
  EXPECT_EQ(scene({unite({cube(1), intersect({cube(300), cube(2)})})}).step.millimetres(),
            1.5625e-08);
  // In a frame of its own a leaf counts as a whole: its planes have no room for far coordinates.
  const NodePtr disc = prism(5, 200, 9);
  EXPECT_EQ(scene({subtract({cube(1), turned(20, {0, 0, 1}, disc)})}).step.millimetres(), 8e-06);
  // But for ends that can be drawn near.
  EXPECT_EQ(scene({subtract({cube(1), turned(20, {0, 0, 1}, moved(-100, -100, -1, cube(300)))})})
                .step.millimetres(),
            1.25e-07);
}

TEST_F(SceneTest, LeavesInFramesBeyondTheGridAreLeftOut) {
  // What both have in common is not near any of their leaves.
  const auto turned_at = [](double x, double y, double z) {
    return moved(x, y, z, turned(45, {0, 0, 1}, cube(1)));
  };
  const NodePtr a = unite({turned_at(40, 0, 0), moved(0, 40, 0, cube(1))}),
                b = unite({moved(50, 20, 0, cube(1)), turned_at(20, 50, 0)});
  const Scene s = scene({unite({cube(0.1), intersect({a, b})})});
  EXPECT_EQ(s.step.millimetres(), 1.953125e-09);  // of the small cube
  for (const SceneNode& node : s.nodes) {
    if (node.kind == SceneNode::Kind::kLeaf && node.subtree.id.frame != 0) {
      EXPECT_TRUE(fits_grid(node.subtree.box));
    }
  }
  // The boxes of the other two have nothing in common.
  EXPECT_EQ(root(s, 0).slots, 1u);
}

TEST_F(SceneTest, BoxesThatHoldAllBeforeThemAreNoOperands) {
  const NodePtr bounds = box({0, 0, 0}, {4, 4, 4});
  const auto kind = [&](const NodePtr& node) {
    const Scene s = scene({node});
    return s.nodes[s.roots[0]].kind;
  };
  EXPECT_EQ(kind(intersect({moved(1, 0, 0, cube(3)), bounds})), SceneNode::Kind::kLeaf);
  EXPECT_EQ(kind(intersect({turned(45, {0, 0, 1}, moved(2, -1, 1, cube(1))), bounds})),
            SceneNode::Kind::kLeaf);
  EXPECT_EQ(kind(intersect({moved(1.001, 0, 0, cube(3)), bounds})), SceneNode::Kind::kOperator);
  EXPECT_EQ(kind(intersect({bounds, cube(3)})), SceneNode::Kind::kOperator);
  EXPECT_EQ(kind(intersect({cube(1), prism(5, 9, 9)})), SceneNode::Kind::kOperator);
  EXPECT_EQ(kind(intersect({cube(1), turned(45, {0, 0, 1}, moved(-9, -9, -9, cube(20)))})),
            SceneNode::Kind::kOperator);
  const NodePtr two = unite({cube(1), moved(2, 2, 2, cube(1))});
  const Scene s = scene({two, intersect({two, bounds})});
  EXPECT_EQ(root(s, 0).id, root(s, 1).id);
}

TEST_F(SceneTest, DisjointIntersectionsAreEmpty) {
  const Scene s = scene({intersect({cube(1), moved(1, 0, 0, cube(1))}),
                         unite({cube(1), intersect({cube(1), moved(5, 0, 0, cube(1))})}),
                         subtract({intersect({cube(1), moved(0, 3, 0, cube(1))}), cube(1)})});
  EXPECT_EQ(s.nodes[s.roots[0]].kind, SceneNode::Kind::kEmpty);
  EXPECT_EQ(s.nodes[s.roots[1]].kind, SceneNode::Kind::kLeaf);
  EXPECT_EQ(s.nodes[s.roots[2]].kind, SceneNode::Kind::kEmpty);
}

TEST_F(SceneTest, SourcesAreLeavesInTreeOrder) {
  const NodePtr x = subtract({cube(3), moved(1, 1, -1, cube(1))});
  const Scene s = scene({unite({x, moved(10, 0, 0, x), cube(2)})});
  EXPECT_EQ(root(s, 0).slots, 5u);
  std::vector<uint32_t> in_order;  // all of them, by hand
  std::vector<uint32_t> stack{s.roots[0]};
  while (!stack.empty()) {
    const uint32_t top = stack.back();
    stack.pop_back();
    const SceneNode& node = s.nodes[top];
    if (node.kind == SceneNode::Kind::kLeaf) {
      in_order.push_back(top);
    } else {
      stack.insert(stack.end(), node.rest.rbegin(), node.rest.rend());
      stack.push_back(node.first);
    }
  }
  ASSERT_EQ(in_order.size(), 5u);
  for (uint32_t some = 0; some < 32; ++some) {
    std::vector<uint32_t> numbers, leaves;
    for (uint32_t i = 0; i < 5; ++i) {
      if ((some >> i & 1) == 0) continue;
      numbers.push_back(i);
      leaves.push_back(in_order[i]);
    }
    EXPECT_EQ(s.leaves(s.roots[0], numbers), leaves) << some;
  }
}

/// A tool that may be far away, large, in a frame of its own, in one that differs from others by
/// noise, wound the other way, or made of two.
NodePtr any_tool(std::mt19937& random) {
  const auto at = [&] { return static_cast<double>(random() % 31) / 3; };
  NodePtr body = random() % 4 == 0 ? unite({cube(1), moved(0.5, 0.5, 0.5, cube(2))}) : cube(2);
  if (random() % 8 == 0) body = leaf(inverted(box_mesh({0, 0, 0}, {1, 2, 3})), FillRule::kNonZero);
  switch (random() % 6) {
    case 0:
      body = turned(static_cast<double>(random() % 4), {3, 2, 1}, body);
      break;
    case 1:  // within the tolerance of its neighbours, not all within that of one another
      body = turned(31 + 4e-13 * static_cast<double>(random() % 6), {3, 2, 1}, body);
      break;
    case 2:
      body = Node::transformed(scaling(-1, 1, 1), body);
      break;
    default:
      break;
  }
  const double far = random() % 40 == 0 ? 3000 : 1;
  const double x = at(), y = at(), z = at();
  return moved(far * x, y, z, body);
}

// What a scene knows that goes on from one before is what one says that has all leaves.
TEST_F(SceneTest, GoesOnFromOneBefore) {
  std::mt19937 random(92);
  SceneRoom room;
  EvaluateStats stats;
  const Resolver resolve =
      [&](const Key&, const Operand& surface, std::span<const std::array<uint32_t, 2>> crossings,
          InsideRule rule) { return resolve_surface(surface, crossings, rule, {}, stats); };
  size_t partial = 0, whole = 0, met = 0;
  for (int round = 0; round < 60; ++round) {
    SceneStarts starts([](const Key&) { return true; });
    NodePtr body = moved(0, 0, 0, cube(10));
    std::vector<NodePtr> before{body}, tools;
    const auto start_op = random() % 2;
    for (int step = 0; step < 12; ++step) {
      const NodePtr from = random() % 6 != 0 ? before.back() : before[random() % before.size()];
      tools.push_back(tools.empty() || random() % 5 != 0 ? any_tool(random)
                                                         : tools[random() % tools.size()]);
      const uint32_t kind = random() % 12;
      NodePtr grown = kind == 0   ? intersect({from, moved(-9, -9, -9, cube(40))})
                      : kind == 1 ? symmetric({from, tools.back()})
                      : kind == 2 ? Node::transformed(scaling(1, 1, -1), from)
                      : (kind == 3) != (start_op == 0)
                          ? unite({from, tools.back(), any_tool(random)})
                          : subtract({from, tools.back()});
      before.push_back(grown);
      const std::vector<uint32_t> roots{*form.add(grown)};
      SceneContext context{form, store, appearances, warnings, room, [] { return false; }, resolve};
      const auto all = build_scene(context, roots, {});
      const auto some = build_scene(context, roots, {}, {}, &starts);
      ASSERT_EQ(all.has_value(), some.has_value());
      if (!all) continue;
      ++(some->is_partial ? partial : whole);
      ASSERT_EQ(some->step, all->step);
      const Subtree &a = root(*all, 0), &b = root(*some, 0);
      ASSERT_EQ(a.id.key, b.id.key) << "round " << round << ", step " << step;
      ASSERT_EQ(a.id.permutation, b.id.permutation);
      ASSERT_EQ(a.id.origin, b.id.origin);
      ASSERT_EQ(a.id.paint, b.id.paint);
      ASSERT_EQ(all->frames[a.id.frame], some->frames[b.id.frame]);
      for (const auto& [one, other] : {std::pair(a.box, b.box), std::pair(a.world, b.world)}) {
        ASSERT_EQ(one.lo, other.lo);
        ASSERT_EQ(one.hi, other.hi);
      }
      ASSERT_EQ(a.slots, b.slots);
      ASSERT_EQ(a.is_far, b.is_far);
      if (!some->met_before) continue;
      // The same operands were met before, where frames have the numbers that they have there.
      const OperandList list = all->operands(all->roots[0]), own = some->operands(some->roots[0]);
      const size_t added = own.operands.size() - 1, known = list.operands.size() - added;
      ASSERT_EQ(some->met_count, known);
      for (size_t i = 0; i < known; ++i) {
        const bool is_body = all->nodes[all->roots[0]].op == BooleanOp::kDifference && i == 0;
        const auto found = some->met_before->find(all->nodes[list.operands[i]].subtree.id);
        const bool is_met = found != some->met_before->end() && found->second < known;
        ASSERT_TRUE(is_met || is_body);
        met += is_met;
      }
    }
  }
  EXPECT_GT(partial, 300u);
  EXPECT_GT(whole, 100u);
  EXPECT_GT(met, 500u);
}

}  // namespace
}  // namespace csgrun::scene_test
