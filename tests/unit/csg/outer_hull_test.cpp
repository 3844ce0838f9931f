// Outer hulls in trees: of meshes as they are, of results, in Booleans and under transforms.
#include <random>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>

#include "test_meshes.h"

namespace csgrun::outer_hull_test {
namespace {

using namespace testing;

constexpr OuterHull kPlain{false, false}, kOriented{true, false}, kPlainVoids{false, true},
    kOrientedVoids{true, true};

SolidPtr solid_of(const NodePtr& root, bool flatten = true) {
  EvaluateOptions options;
  options.threads = 2;
  options.flatten = flatten;
  options.grid = *GridStep::parse("2^-16mm");
  Evaluator evaluator(options);
  auto result = evaluator.evaluate(root);
  EXPECT_TRUE(result.has_value()) << result.error().message;
  return result ? *result : std::make_shared<Solid>();
}

void expect_same(const NodePtr& given, const NodePtr& truth, const std::string& what = {}) {
  const SolidPtr b = solid_of(truth);
  for (const bool flatten : {true, false}) {
    const SolidPtr a = solid_of(given, flatten);
    EXPECT_EQ(a->measures.volume, b->measures.volume) << what;
    EXPECT_EQ(a->canonical_hash, b->canonical_hash) << what;
  }
}

const PolygonMesh kOuter = box_mesh({0, 0, 0}, {9, 9, 9}), kInner = box_mesh({2, 2, 2}, {7, 7, 7}),
                  kCore = box_mesh({3, 3, 3}, {4, 4, 4}), kBar = box_mesh({8, 1, 1}, {12, 2, 2});
NodePtr node(const PolygonMesh& mesh) { return Node::leaf(std::make_shared<PolygonMesh>(mesh)); }
const NodePtr kShell = subtract({node(kOuter), node(kInner)});
const NodePtr kFull = unite({kShell, node(kCore)});  // a body in the void of another

TEST(OuterHull, OfResults) {
  for (const OuterHull& options : {kPlain, kOriented}) {
    expect_same(hull(kShell, options), node(kOuter));
    expect_same(hull(kFull, options), node(kOuter));
    expect_same(hull(hull(kFull, options), options), node(kOuter));
  }
  for (const OuterHull& options : {kPlainVoids, kOrientedVoids}) {
    expect_same(hull(kFull, options), kFull);
    expect_same(hull(hull(kShell, options), kPlain), node(kOuter));
  }
  EXPECT_TRUE(solid_of(hull(Node::empty()))->empty());
  EXPECT_TRUE(solid_of(hull(subtract({node(kCore), node(kOuter)})))->empty());
  // A hole is no void.
  const NodePtr holed = subtract({node(kOuter), box({2, 2, -1}, {7, 7, 7})});
  expect_same(hull(holed), holed);
}

TEST(OuterHull, OfMeshesAsTheyAre) {
  const NodePtr outer = node(kOuter), inner = node(kInner);
  // A shell in a shell that faces the same way: enclosed, and no void.
  expect_same(hull(leaf(in_one(kOuter, kInner), FillRule::kEvenOdd)), outer);
  expect_same(hull(leaf(in_one(kOuter, kInner), FillRule::kEvenOdd), kPlainVoids), outer);
  // A void.
  const NodePtr shell = leaf(in_one(kOuter, inverted(kInner)), FillRule::kNonZero);
  for (const OuterHull& options : {kPlain, kOriented}) expect_same(hull(shell, options), outer);
  for (const OuterHull& options : {kPlainVoids, kOrientedVoids}) {
    expect_same(hull(shell, options), kShell);
  }
  // Overlaps, by the rule that would cancel them.
  const NodePtr overlap = leaf(in_one(kOuter, kBar), FillRule::kEvenOdd);
  expect_same(hull(overlap), unite({outer, node(kBar)}));
  expect_same(hull(unite({overlap, overlap})), unite({outer, node(kBar)}));
  // An inverted bar that sticks out: outside of the box one may pass through it from back to front,
  // and what it takes from the box is enclosed by the box.
  const NodePtr inverted_bar = leaf(in_one(kOuter, inverted(kBar)), FillRule::kNonZero);
  expect_same(hull(inverted_bar, kPlain), unite({outer, node(kBar)}));
  expect_same(hull(inverted_bar, kOriented), outer);
  expect_same(hull(inverted_bar, kPlainVoids), symmetric({outer, node(kBar)}));
  expect_same(hull(inverted_bar, kOrientedVoids), subtract({outer, node(kBar)}));
  // One shell is its own hull.
  for (const OuterHull& options : {kPlain, kOriented, kPlainVoids, kOrientedVoids}) {
    expect_same(hull(outer, options), outer);
  }
  EXPECT_TRUE(solid_of(hull(leaf(inverted(kOuter), FillRule::kNonZero), kOriented))->empty());
  expect_same(hull(leaf(inverted(kOuter), FillRule::kNonZero), kPlain), outer);
}

TEST(OuterHull, InBooleans) {
  const NodePtr cut = box({1, 1, 1}, {5, 5, 12});
  const NodePtr raw = leaf(in_one(in_one(kOuter, inverted(kInner)), kBar), FillRule::kNonZero);
  for (const NodePtr& shell : {kShell, kFull, raw}) {
    const NodePtr body = shell == raw ? unite({node(kOuter), node(kBar)}) : node(kOuter);
    expect_same(subtract({hull(shell), cut}), subtract({body, cut}));
    expect_same(subtract({cut, hull(shell)}), subtract({cut, body}));
    expect_same(unite({hull(shell), cut, shell}), unite({body, cut}));
    expect_same(hull(unite({subtract({hull(shell), cut}), box({0, 0, 8}, {9, 9, 9})})),
                hull(unite({subtract({body, cut}), box({0, 0, 8}, {9, 9, 9})})));
    expect_same(symmetric({hull(shell), moved(3, 0, 0, hull(shell))}),
                symmetric({body, moved(3, 0, 0, body)}));
  }
}

TEST(OuterHull, UnderTransforms) {
  const NodePtr cut = box({1, 1, 1}, {5, 5, 12});
  Affine swap;
  swap.m = {{{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}}};
  for (const Affine& map : {scaling(-1, 1, 1), swap, rotation(30, {1, 2, 3}),
                            Affine::compose(rotation(45, {0, 1, 0}), swap)}) {
    for (const NodePtr& child :
         {kFull, leaf(in_one(in_one(kOuter, inverted(kInner)), kCore), FillRule::kNonZero)}) {
      expect_same(Node::transformed(map, hull(child)), Node::transformed(map, node(kOuter)));
      expect_same(hull(Node::transformed(map, child)), Node::transformed(map, node(kOuter)));
      expect_same(unite({Node::transformed(map, hull(child)), hull(child), cut}),
                  unite({Node::transformed(map, node(kOuter)), node(kOuter), cut}));
    }
    // A void of another frame.
    const NodePtr big = box({-20, -20, -20}, {20, 20, 20});
    expect_same(hull(subtract({big, Node::transformed(map, node(kInner))})), big);
    expect_same(Node::transformed(map, hull(subtract({big, turned(20, {1, 0, 0}, node(kInner))}))),
                Node::transformed(map, big));
  }
  const Appearance blue{0, 0, 1, 1, 0, 0.5f, "blue", false};
  expect_same(hull(Node::painted(blue, kFull)), Node::painted(blue, node(kOuter)));
  expect_same(Node::painted(blue, hull(kFull)), Node::painted(blue, node(kOuter)));
}

TEST(OuterHull, FarCuttersBelow) {
  const NodePtr far = box({4, -1e5, -1e5}, {1e5, 1e5, 1e5});
  const NodePtr window = box({-1, -1, -1}, {1, 1, 1});
  for (const NodePtr& shell :
       {kShell, leaf(in_one(kOuter, inverted(kInner)), FillRule::kNonZero)}) {
    Evaluator evaluator(EvaluateOptions{});
    const auto result = evaluator.evaluate(hull(subtract({shell, far})));
    ASSERT_TRUE(result.has_value()) << result.error().message;
    // On a step of about a thousandth.
    EXPECT_NEAR((*result)->measures.volume, 9 * 9 * 4 - 5 * 5 * 2, 0.1);
    // The far body is seen in a small window only; whether its void is one is told far away.
    const NodePtr hollow = subtract({box({-1e5, -1e5, -1e5}, {1e5, 1e5, 1e5}), node(kInner)});
    const auto seen = evaluator.evaluate(intersect({moved(3, 3, 3, window), hull(hollow)}));
    ASSERT_TRUE(seen.has_value()) << seen.error().message;
    EXPECT_NEAR((*seen)->measures.volume, 8, 0.1);
  }
}

// Of results with voids, with something in some of these, and of those that touch themselves.
TEST(OuterHull, OfRandomResults) {
  int with_voids = 0, without = 0;
  for (unsigned seed = 0; seed < 120; ++seed) {
    std::mt19937 random(seed);
    const auto upto = [&](double most) { return static_cast<double>(random() % 64) / 64 * most; };
    std::vector<NodePtr> solids;
    for (int i = 0; i < 5; ++i) {
      const NodePtr full = random() % 2 == 0 ? cube(2) : prism(5, 1, 2);
      // Some are hollow, and something is in the middle of some of these.
      const NodePtr hollow = subtract({cube(3), moved(0.5, 0.5, 0.5, cube(2))});
      NodePtr solid = random() % 8 == 0 ? hollow : full;
      if (random() % 12 == 0) solid = unite({hollow, moved(1, 1, 1, cube(0.5))});
      solids.push_back(moved(upto(9), upto(9), upto(3), solid));
    }
    const NodePtr model = seed % 3 == 0 ? symmetric(solids) : unite(solids);
    EvaluateOptions by_cells;
    by_cells.whole_faces = false;
    const SolidPtr truth = testing::solid_of(hull(model), by_cells),
                   fast = testing::solid_of(hull(model));
    EXPECT_EQ(fast->canonical_hash, truth->canonical_hash) << seed;
    EXPECT_EQ(fast->triangles, truth->triangles) << seed;
    ++(testing::solid_of(model)->measures.volume < truth->measures.volume ? with_voids : without);
  }
  EXPECT_GT(with_voids, 20);
  EXPECT_GT(without, 20);
}

TEST(OuterHull, PointsAndCaches) {
  Evaluator evaluator(EvaluateOptions{});
  EXPECT_EQ(*evaluator.contains(hull(kShell), {4, 4, 4}), 1);
  EXPECT_EQ(*evaluator.contains(kShell, {4, 4, 4}), -1);
  EXPECT_EQ(*evaluator.contains(hull(kShell), {9, 4, 4}), 0);
  EXPECT_EQ(*evaluator.contains(hull(kShell), {10, 4, 4}), -1);
  const auto first = evaluator.evaluate(hull(kFull));
  const uint64_t evaluated = evaluator.stats().nodes_evaluated;
  const auto again = evaluator.evaluate(hull(kFull));
  EXPECT_EQ(*first, *again);
  const auto moved_one = evaluator.evaluate(unite({moved(5, 0, 0, hull(kFull)), hull(kFull)}));
  EXPECT_EQ((*moved_one)->measures.volume, 14 * 81);
  EXPECT_EQ(evaluator.stats().nodes_evaluated, evaluated + 1);
}

}  // namespace
}  // namespace csgrun::outer_hull_test
