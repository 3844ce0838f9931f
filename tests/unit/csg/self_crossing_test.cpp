// Leaves that cross themselves: what they enclose by each fill rule, compared with Booleans of the
// parts that they were put together from.
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>

#include "test_meshes.h"

namespace csgrun::self_crossing_test {
namespace {

using namespace testing;

struct Outcome {
  SolidPtr solid = std::make_shared<Solid>();
  std::vector<std::string> warnings;
};

Outcome run(const NodePtr& root, EvaluateOptions options = {}) {
  options.threads = 2;
  Evaluator evaluator(options);
  auto result = evaluator.evaluate(root);
  EXPECT_TRUE(result.has_value()) << result.error().message;
  Outcome outcome;
  if (result) outcome.solid = *result;
  outcome.warnings = evaluator.warnings();
  return outcome;
}

void expect_same(const NodePtr& given, const NodePtr& truth, const std::string& what = {}) {
  EvaluateOptions options;
  options.grid = *GridStep::parse("2^-16mm");
  const SolidPtr a = run(given, options).solid, b = run(truth, options).solid;
  EXPECT_EQ(a->measures.volume, b->measures.volume) << what;
  EXPECT_EQ(a->measures.genus, b->measures.genus) << what;
  EXPECT_EQ(a->canonical_hash, b->canonical_hash) << what;
}

constexpr FillRule kRules[] = {FillRule::kNonZero, FillRule::kPositive, FillRule::kEvenOdd};

const PolygonMesh kA = box_mesh({0, 0, 0}, {4, 4, 4}), kB = box_mesh({2, 1, 1}, {6, 3, 9}),
                  kC = box_mesh({1, -2, 2}, {5, 6, 3});
NodePtr node(const PolygonMesh& mesh) { return Node::leaf(std::make_shared<PolygonMesh>(mesh)); }

/// What a rule makes of boxes that overlap in one mesh, as Booleans.
NodePtr meaning(FillRule rule, std::vector<NodePtr> parts) {
  return rule == FillRule::kEvenOdd ? symmetric(std::move(parts)) : unite(std::move(parts));
}

TEST(SelfCrossing, OverlapsInOneMesh) {
  for (const FillRule rule : kRules) {
    const std::string what = std::to_string(static_cast<int>(rule));
    expect_same(leaf(in_one(kA, kB), rule), meaning(rule, {node(kA), node(kB)}), what);
    expect_same(leaf(in_one(in_one(kA, kB), kC), rule),
                meaning(rule, {node(kA), node(kB), node(kC)}), "three, " + what);
    // A face in common, in part; a corner inside; one inside the other; the same twice.
    for (const auto& other : {box_mesh({4, 1, 1}, {6, 5, 5}), box_mesh({3, 3, 3}, {5, 5, 5}),
                              box_mesh({1, 1, 0}, {2, 2, 4}), box_mesh({1, 1, 1}, {2, 2, 2}), kA}) {
      expect_same(leaf(in_one(kA, other), rule), meaning(rule, {node(kA), node(other)}), what);
    }
  }
}

TEST(SelfCrossing, InvertedParts) {
  const NodePtr a = node(kA), b = node(kB);
  const PolygonMesh tangle = in_one(kA, inverted(kB));
  expect_same(leaf(tangle, FillRule::kNonZero), symmetric({a, b}));
  expect_same(leaf(tangle, FillRule::kEvenOdd), symmetric({a, b}));
  expect_same(leaf(tangle, FillRule::kPositive), subtract({a, b}));
  expect_same(leaf(in_one(inverted(kA), inverted(kB)), FillRule::kNonZero), unite({a, b}));
  const auto nothing = run(leaf(in_one(inverted(kA), inverted(kB)), FillRule::kPositive));
  EXPECT_TRUE(nothing.solid->empty());
  ASSERT_EQ(nothing.warnings.size(), 2u);
  EXPECT_NE(nothing.warnings[1].find("encloses nothing by the fill rule positive"),
            std::string::npos);
}

TEST(SelfCrossing, ShellsWithoutCrossings) {
  const PolygonMesh inner = box_mesh({1, 1, 1}, {2, 3, 3});
  const NodePtr a = node(kA), b = node(inner);
  // Where shells fit together no rule matters, and nothing is said.
  for (const FillRule rule : kRules) {
    expect_same(leaf(in_one(kA, inverted(inner)), rule), subtract({a, b}));
    EXPECT_TRUE(run(leaf(in_one(kA, inverted(inner)), rule)).warnings.empty());
  }
  expect_same(leaf(in_one(kA, inner), FillRule::kNonZero), a);
  expect_same(leaf(in_one(kA, inner), FillRule::kEvenOdd), subtract({a, b}));
  expect_same(leaf(inverted(kA), FillRule::kNonZero), a);
  EXPECT_TRUE(run(leaf(inverted(kA), FillRule::kPositive)).solid->empty());
  const PolygonMesh away = box_mesh({7, 0, 0}, {8, 1, 1});
  expect_same(leaf(in_one(kA, inverted(away)), FillRule::kNonZero), unite({a, node(away)}));
  expect_same(leaf(in_one(kA, inverted(away)), FillRule::kPositive), a);
  const auto said = run(leaf(in_one(kA, inner), FillRule::kNonZero)).warnings;
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("shells"), std::string::npos);
}

TEST(SelfCrossing, AnOperandLikeAnyOther) {
  const NodePtr bite = box({3, 2, 2}, {5, 8, 8}), plus = box({0, 0, 3}, {1, 1, 12});
  for (const FillRule rule : kRules) {
    const NodePtr tangle = leaf(in_one(kA, kB), rule), truth = meaning(rule, {node(kA), node(kB)});
    const auto use = [&](const NodePtr& x) {
      return std::vector<NodePtr>{
          subtract({x, bite}),
          subtract({bite, x}),
          unite({plus, x, bite}),
          symmetric({x, bite, plus}),
          intersect({x, unite({plus, bite})}),
          subtract({unite({x, moved(1, 1, 1, x)}), moved(0.5, 0, 0, x)}),
          symmetric({x, turned(90, {0, 0, 1}, x), Node::transformed(scaling(-1, 1, 1), x)})};
    };
    const auto given = use(tangle), expected = use(truth);
    for (size_t i = 0; i < given.size(); ++i) {
      expect_same(given[i], expected[i], "use " + std::to_string(i));
    }
  }
}

TEST(SelfCrossing, FramesAndMirrors) {
  // The rule `positive` tells which parts are inverted, so a mirror must not turn them over.
  const NodePtr tangle = leaf(in_one(kA, inverted(kB)), FillRule::kPositive);
  const NodePtr truth = subtract({node(kA), node(kB)});
  const NodePtr other = box({1, 1, 1}, {7, 2, 2});
  Affine swap;
  swap.m = {{{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}}};
  Affine flat;  // nearly singular: rounded in the world
  flat.m = {{{1, 1, 0, 0}, {1, 1.0 + 0x1p-20, 0, 0}, {0, 0, 1, 0}}};
  Affine flat_mirror = flat;
  std::swap(flat_mirror.m[0], flat_mirror.m[1]);
  std::vector<Affine> maps{swap,
                           flat,
                           flat_mirror,
                           scaling(-1, 1, 1),
                           scaling(-2, -2, -2),
                           rotation(30, {1, 2, 3}),
                           Affine::compose(rotation(30, {1, 2, 3}), swap),
                           Affine::compose(rotation(77, {0, 0, 1}), scaling(1, 1, -1.5)),
                           Affine::compose(translation(1.25, -3, 0.5), scaling(1, -1, 1))};
  for (size_t i = 0; i < maps.size(); ++i) {
    const std::string what = "map " + std::to_string(i);
    expect_same(Node::transformed(maps[i], tangle), Node::transformed(maps[i], truth), what);
    expect_same(subtract({other, Node::transformed(maps[i], tangle)}),
                subtract({other, Node::transformed(maps[i], truth)}), what);
  }
}

TEST(SelfCrossing, TheSameInEveryWayOfEvaluation) {
  const NodePtr tangle = leaf(in_one(in_one(kA, kB), kC), FillRule::kEvenOdd);
  const NodePtr root = subtract({unite({tangle, turned(25, {1, 1, 0}, tangle)}),
                                 moved(2, 0, 0, tangle), moved(0, 2, 0, tangle)});
  const auto reference = run(root).solid->canonical_hash;
  for (const bool flatten : {true, false}) {
    for (const uint32_t limit : {5u, 17u, 60u}) {
      EvaluateOptions options;
      options.flatten = flatten;
      options.cell_limit = limit;
      options.octree_shift = {limit, 3, 7};
      EXPECT_EQ(run(root, options).solid->canonical_hash, reference);
    }
  }
  // A chain that grows, from cached prefixes; and copies by whole steps.
  Evaluator evaluator(EvaluateOptions{});
  NodePtr chain = tangle, truth = symmetric({node(kA), node(kB), node(kC)});
  for (int i = 1; i < 5; ++i) {
    chain = subtract({chain, moved(i, i, 0, tangle)});
    truth = subtract({truth, moved(i, i, 0, symmetric({node(kA), node(kB), node(kC)}))});
    EXPECT_EQ((*evaluator.evaluate(chain))->canonical_hash,
              (*evaluator.evaluate(truth))->canonical_hash);
  }
}

TEST(SelfCrossing, FacesThatCrossThemselves) {
  // Prisms over a bow-tie, whose caps have no signed area, and over a five-pointed star, whose caps
  // have; both tilted, and compared with the same prisms with fans of triangles as caps.
  const std::vector<glm::dvec2> bow{{0, 0}, {10, 10}, {10, 0}, {0, 10}};
  const std::vector<glm::dvec2> star{{0, 0}, {12, 9}, {-3, 9}, {10, 0}, {5, 15}};
  const auto prism = [](const std::vector<glm::dvec2>& outline, bool fans) {
    const auto n = static_cast<uint32_t>(outline.size());
    PolygonMesh mesh;
    for (const double z : {0.0, 5.0}) {
      for (const glm::dvec2& p : outline) mesh.points.push_back({p.x, p.y, z + p.x / 2 + p.y / 4});
    }
    std::vector<uint32_t> bottom, top;
    for (uint32_t i = 0; i < n; ++i) {
      bottom.push_back(n - 1 - i);
      top.push_back(n + i);
      const uint32_t next = (i + 1) % n;
      mesh.add_face(std::array<uint32_t, 4>{i, next, n + next, n + i});
    }
    for (const auto& cap : {bottom, top}) {
      if (!fans) mesh.add_face(cap);
      for (uint32_t i = 1; fans && i + 1 < n; ++i)
        mesh.add_face(std::array<uint32_t, 3>{cap[0], cap[i], cap[i + 1]});
    }
    return mesh;
  };
  for (const FillRule rule : kRules) {
    for (const auto& outline : {bow, star})
      expect_same(leaf(prism(outline, false), rule), leaf(prism(outline, true), rule));
    EXPECT_EQ(run(leaf(prism(bow, false), rule)).solid->measures.volume,
              rule == FillRule::kPositive ? 125 : 250);
  }
}

TEST(SelfCrossing, WhatIsSaid) {
  SourceRef where{std::make_shared<const std::string>("model.lua"), 7};
  const NodePtr tangle =
      leaf(in_one(kA, box_mesh({3, 3, 3}, {5, 5, 5})), FillRule::kEvenOdd, where);
  const auto said = run(unite({tangle, moved(20, 0, 0, tangle), turned(30, {0, 0, 1}, tangle)}));
  ASSERT_EQ(said.warnings.size(), 1u);
  const std::string& text = said.warnings[0];
  EXPECT_EQ(
      text.rfind("model.lua:7: 'tangle' crosses itself: 6 pairs of faces, the first near (", 0), 0u)
      << text;
  EXPECT_NE(text.find("; what is inside follows the fill rule evenodd"), std::string::npos) << text;
  EXPECT_EQ(text.find("00000"), std::string::npos) << text;
  // Faces 1 (z = 4) of the one and 2 to 5 of the other meet there.
  double x = 0, y = 0, z = 0;
  ASSERT_EQ(std::sscanf(text.c_str() + text.find("near ("), "near (%lf, %lf, %lf)", &x, &y, &z), 3);
  for (const double c : {x, y, z}) {
    EXPECT_GE(c, 3 - 1e-6);
    EXPECT_LE(c, 4 + 1e-6);
  }
}

TEST(SelfCrossing, TheRuleIsPartOfTheKeyOnlyWhereItMatters) {
  Evaluator evaluator(EvaluateOptions{});
  const auto solid = [&](const NodePtr& root) { return *evaluator.evaluate(root); };
  EXPECT_EQ(solid(leaf(kA, FillRule::kNonZero)), solid(leaf(kA, FillRule::kEvenOdd)));
  EXPECT_EQ(solid(leaf(in_one(kA, kB), FillRule::kEvenOdd)),
            solid(leaf(in_one(kA, kB), FillRule::kEvenOdd)));
  EXPECT_NE(solid(leaf(in_one(kA, kB), FillRule::kNonZero))->measures.volume,
            solid(leaf(in_one(kA, kB), FillRule::kEvenOdd))->measures.volume);
}

TEST(SelfCrossing, FarOnes) {
  // What crosses itself is needed as a whole: the step follows it, though little of it is seen.
  const PolygonMesh a = box_mesh({-1e5, -1, -1}, {0.5, 1, 1}),
                    b = box_mesh({-1, -1e5, -1}, {1, 0.5, 1});
  const NodePtr window = box({-2, -2, -2}, {2, 2, 2});
  const Outcome outcome = run(intersect({window, leaf(in_one(a, b), FillRule::kNonZero)}));
  // [-2, 0.5] x [-1, 1] and [-1, 1] x [-2, 0.5], 2 high, less the overlap.
  EXPECT_NEAR(outcome.solid->measures.volume, 2 * (5 + 5 - 1.5 * 1.5), 0.05);
  EvaluateOptions fine;
  fine.grid = *GridStep::parse("0.0005");
  Evaluator evaluator(fine);
  const auto refused =
      evaluator.evaluate(intersect({window, leaf(in_one(a, b), FillRule::kNonZero)}));
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::kOutOfRange);
}

TEST(SelfCrossing, ColoursStay) {
  PolygonMesh tangle = in_one(kA, kB);
  tangle.appearances = {Appearance{1, 0, 0, 1, 0, 0.5f, "red", false},
                        Appearance{0, 1, 0, 1, 0, 0.5f, "green", false}};
  tangle.appearance_of = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  const auto paint = [&](int i, const PolygonMesh& mesh) {
    return Node::painted(tangle.appearances[static_cast<size_t>(i)], node(mesh));
  };
  expect_same(leaf(tangle, FillRule::kNonZero), unite({paint(0, kA), paint(1, kB)}));
  expect_same(subtract({leaf(tangle, FillRule::kEvenOdd), box({1, 1, 1}, {9, 2, 9})}),
              subtract({symmetric({paint(0, kA), paint(1, kB)}), box({1, 1, 1}, {9, 2, 9})}));
  const Appearance blue{0, 0, 1, 1, 0, 0.5f, "blue", false};
  expect_same(Node::painted(blue, leaf(tangle, FillRule::kNonZero)),
              Node::painted(blue, unite({node(kA), node(kB)})));
}

}  // namespace
}  // namespace csgrun::self_crossing_test
