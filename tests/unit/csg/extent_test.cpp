// Volume, box, area and centroid of results that go on from one another, against evaluations that
// start anew.
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>

#include "test_meshes.h"

namespace csgrun::extent_test {
namespace {

using namespace testing;

void expect_extent_of(const Extent& extent, const NodePtr& node) {
  const SolidPtr solid = solid_of(node);  // by an evaluator of its own
  ASSERT_EQ(extent.empty, solid->empty());
  if (extent.empty) return;
  EXPECT_EQ(extent.volume, solid->measures.volume);
  for (size_t side = 0; side < 2; ++side) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(extent.bbox[side][k], solid->measures.bbox[side][k]) << side << ' ' << k;
    }
  }
}

void expect_fresh_extent(Evaluator& evaluator, const NodePtr& part) {
  const auto extent = evaluator.extent(part);
  ASSERT_TRUE(extent) << extent.error().message;
  expect_extent_of(*extent, part);
  const auto area = evaluator.area(part);
  const auto centroid = evaluator.centroid(part);
  ASSERT_TRUE(area && centroid);
  const SolidPtr solid = solid_of(part);
  EXPECT_EQ(*area, solid->measures.area);
  EXPECT_EQ(centroid->has_value(), !solid->empty());
  if (!solid->empty()) {
    EXPECT_EQ(**centroid, solid->measures.centroid);
  }
}

void expect_fresh_solid(Evaluator& evaluator, const NodePtr& part) {
  const auto solid = evaluator.evaluate(part);
  ASSERT_TRUE(solid) << solid.error().message;
  const SolidPtr fresh = solid_of(part);
  EXPECT_EQ((*solid)->positions, fresh->positions);
  EXPECT_EQ((*solid)->triangles, fresh->triangles);
  ASSERT_EQ((*solid)->faces.size(), fresh->faces.size());
  for (size_t f = 0; f < fresh->faces.size(); ++f) {
    EXPECT_EQ((*solid)->faces[f].source, fresh->faces[f].source) << f;
  }
}

/// A tool of its own at a place of thirds, so that coordinates are rounded.
NodePtr tool(std::mt19937& random) {
  const auto at = [&] { return static_cast<double>(random() % 31) / 3; };
  const NodePtr body = cube(1 + static_cast<double>(random() % 3));
  const double x = at(), y = at(), z = at();
  if (random() % 3 != 0) return moved(x, y, z, body);
  Affine turn;  // 3-4-5
  turn.m = {{{0.6, -0.8, 0, x}, {0.8, 0.6, 0, y}, {0, 0, 1, z}}};
  return Node::transformed(turn, body);
}

uint64_t signs_of(const Evaluator& evaluator) {
  uint64_t total = evaluator.stats().sign_filter + evaluator.stats().sign_symbolic;
  for (const uint64_t n : evaluator.stats().sign_exact) total += n;
  return total;
}

TEST(Extent, OfChainsIsThatOfAFreshEvaluation) {
  std::mt19937 random(91);
  for (int round = 0; round < 12; ++round) {
    EvaluateOptions options;
    options.threads = 1;
    Evaluator evaluator(options);
    NodePtr part = moved(0, 0, 0, cube(10));
    std::vector<NodePtr> before;
    for (int step = 0; step < 14; ++step) {
      before.push_back(part);
      // Mostly from the last one, sometimes from one that others went on from already.
      const NodePtr& from = random() % 5 != 0 ? part : before[random() % before.size()];
      const std::vector<NodePtr> operands = random() % 4 != 0
                                                ? std::vector{from, tool(random)}
                                                : std::vector{from, tool(random), tool(random)};
      switch (random() % 6) {
        case 0:
          part = unite(operands);
          break;
        case 1:
          part = symmetric(operands);
          break;
        case 2:
          part = intersect({from, moved(-1, -1, 0.5, cube(11))});
          break;
        default:
          part = subtract(operands);
          break;
      }
      expect_fresh_extent(evaluator, part);
      if (HasFailure()) FAIL() << "round " << round << ", step " << step;
    }
    expect_fresh_solid(evaluator, part);
  }
}

TEST(Extent, WorkDependsOnTheTool) {
  // Pins over a plate, far from each other: the last one costs no more signs than an early one.
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options);
  NodePtr part = moved(-1, -1, 0, cube(100));
  std::vector<uint64_t> signs;
  const auto count = [&] { return signs_of(evaluator); };
  for (int i = 0; i < 81; ++i) {
    part = subtract({part, moved(i % 9 * 10 + 1, i / 9 * 10 + 1, 99, cube(3))});
    const uint64_t was = count();
    ASSERT_TRUE(evaluator.extent(part));
    signs.push_back(count() - was);
  }
  uint64_t early = 0, late = 0;
  for (size_t i = 0; i < 10; ++i) {
    early += signs[5 + i];
    late += signs[71 + i];
  }
  EXPECT_LE(late, 2 * early);
  // What was taken away before is no work at all.
  part = subtract({part, moved(41, 31, 99, cube(3))});
  const uint64_t was = count();
  const auto extent = evaluator.extent(part);
  ASSERT_TRUE(extent);
  EXPECT_EQ(count(), was);
  expect_extent_of(*extent, part);
}

// What a step moves as a whole stays where it was evaluated; tools come there.
TEST(Extent, OfMovedChains) {
  std::mt19937 random(92);
  for (int round = 0; round < 12; ++round) {
    EvaluateOptions options;
    options.threads = 1;
    Evaluator evaluator(options);
    NodePtr part = moved(0, 0, 0, cube(10));
    // A result of its own, which stands somewhere else each time.
    const NodePtr stamp = subtract({cube(3), moved(1, 1, 1, cube(4))});
    ASSERT_TRUE(evaluator.extent(stamp));
    for (int step = 0; step < 12; ++step) {
      const NodePtr other =
          random() % 3 == 0 ? moved(random() % 8, random() % 8, random() % 8, stamp) : tool(random);
      part = random() % 4 == 0 ? unite({part, other}) : subtract({part, other});
      const auto by = [&] { return static_cast<double>(random() % 9) / 4 - 1; };
      const double x = by(), y = by(), z = random() % 3 == 0 ? by() / 3 : by();
      if (random() % 3 != 0) part = moved(x, y, z, part);
      if (random() % 6 == 0) part = Node::transformed(scaling(-1, 1, 1), part);
      if (random() % 6 == 0) {
        Appearance colour;
        colour.red = static_cast<double>(random() % 2);
        colour.is_default = false;
        part = Node::painted(colour, part);
      }
      expect_fresh_extent(evaluator, part);
      if (HasFailure()) FAIL() << "round " << round << ", step " << step;
    }
    expect_fresh_solid(evaluator, part);
  }
}

TEST(Extent, OfAMovedPartCostsWhatTheToolTouches) {
  // A rack under a cutter that stands still.
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options);
  NodePtr part = box({-1, 0, 0}, {101, 4, 4});
  std::vector<uint64_t> signs;
  for (int i = 0; i < 80; ++i) {
    const uint64_t was = signs_of(evaluator);
    part = moved(-1, 0, 0, subtract({part, box({0.25, -1, 3}, {0.75, 5, 5})}));
    const auto extent = evaluator.extent(part);
    ASSERT_TRUE(extent);
    EXPECT_EQ(extent->volume, 102 * 16 - 2.0 * (i + 1));
    EXPECT_EQ(extent->bbox[0].x, -2 - i);
    EXPECT_EQ(extent->bbox[1].x, 100 - i);
    signs.push_back(signs_of(evaluator) - was);
  }
  const auto sum = [&](size_t first) {
    return std::accumulate(signs.begin() + static_cast<long>(first),
                           signs.begin() + static_cast<long>(first) + 10, uint64_t{0});
  };
  EXPECT_GT(sum(5), 0u);
  EXPECT_LE(sum(70), 2 * sum(5));
}

// What stands before a part that was looked at does not make it another one.
TEST(Extent, OfPartsThatOthersStandBefore) {
  std::mt19937 random(93);
  for (int round = 0; round < 12; ++round) {
    EvaluateOptions options;
    options.threads = 1;
    Evaluator evaluator(options);
    NodePtr part = unite({cube(4), moved(3, 1, 0.5, cube(5))});
    for (int step = 0; step < 12; ++step) {
      const NodePtr other = tool(random);
      switch (random() % 6) {
        case 0:
          part = unite({other, tool(random), part});
          break;
        case 1:
          part = intersect({moved(-1, -1, 0.5, cube(12)), part});
          break;
        case 2:
          part = subtract({part, other});
          break;
        case 3:
          part = unite({subtract({other, moved(0.5, 0.5, 0.5, other)}), part});
          break;
        default:
          part = unite({other, part});
          break;
      }
      expect_fresh_extent(evaluator, part);
      if (HasFailure()) FAIL() << "round " << round << ", step " << step;
    }
    expect_fresh_solid(evaluator, part);
    if (HasFailure()) FAIL() << "round " << round;
  }
}

// Lists that end alike, but elsewhere or by another operator.
TEST(Extent, OfListsThatEndAlike) {
  Evaluator evaluator{EvaluateOptions()};
  const NodePtr a = cube(4), b = moved(3, 1, 0.5, cube(5)), c = moved(1, 2, 2, cube(6));
  expect_fresh_extent(evaluator, unite({a, b}));
  expect_fresh_extent(evaluator, unite({c, moved(0.5, 0, 0, a), b}));
  expect_fresh_extent(evaluator, unite({c, a, moved(0, 0.5, 0, b)}));
  expect_fresh_extent(evaluator, unite({moved(0, 0, 1, unite({a, b})), c}));
  expect_fresh_extent(evaluator, unite({c, moved(0, 0, 1, unite({a, b}))}));
  expect_fresh_extent(evaluator, intersect({c, a, b}));
  expect_fresh_extent(evaluator, intersect({a, b}));
  expect_fresh_extent(evaluator, intersect({c, a, b}));
  expect_fresh_extent(evaluator, unite({c, a, b}));
  expect_fresh_extent(evaluator, subtract({c, a, b}));
}

TEST(Extent, OfWhatStandsBeforeAPartCostsWhatThatTouches) {
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options);
  NodePtr part = prism(16, 1, 2);
  std::vector<uint64_t> signs;
  for (int i = 1; i <= 60; ++i) {
    const uint64_t was = signs_of(evaluator);
    // No row of them is like another one.
    part = unite({moved(1.3 * i + i * i % 29 * 0.01, i * i % 31 * 0.05, 0, prism(16, 1, 2)), part});
    ASSERT_TRUE(evaluator.extent(part));
    signs.push_back(signs_of(evaluator) - was);
  }
  const auto sum = [&](size_t first) {
    return std::accumulate(signs.begin() + static_cast<long>(first),
                           signs.begin() + static_cast<long>(first) + 10, uint64_t{0});
  };
  EXPECT_GT(sum(5), 0u);
  EXPECT_LE(sum(50), 2 * sum(5));
  expect_fresh_solid(evaluator, part);
}

// A part that would be off the grid where the one before stands.
TEST(Extent, OfAPartThatMovedFar) {
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options);
  // Always about as far from the origin, so that the grid stays.
  NodePtr part = subtract({box({800, 0, 0}, {900, 50, 50}), box({810, 10, 10}, {890, 40, 60})});
  expect_extent_of(*evaluator.extent(part), part);
  part = unite({moved(-1700, 0, 0, part), box({850, 0, 0}, {900, 10, 10})});
  expect_extent_of(*evaluator.extent(part), part);
  part = subtract({part, box({-900, 0, 40}, {900, 5, 60})});
  expect_extent_of(*evaluator.extent(part), part);
}

TEST(Extent, DependsOnTheStep) {
  // Where the grid grows with the part, whole numbers are the same and pieces shared; their
  // millimetres are not.
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options);
  const auto evaluated = [&](double scale) {
    const uint64_t before = evaluator.stats().nodes_evaluated;
    NodePtr part = cube(100 * scale);
    for (int i = 1; i <= 4; ++i) {
      part = subtract({part, moved(10 * i * scale, 5 * scale, 90 * scale, cube(20 * scale))});
      expect_extent_of(*evaluator.extent(part), part);
    }
    return evaluator.stats().nodes_evaluated - before;
  };
  EXPECT_EQ(evaluated(1), 4u);
  uint64_t rest = 0;
  for (const double scale : {8, 10, 64, 100, 1000}) rest += evaluated(scale);
  EXPECT_LT(rest, 5 * 4u) << "nothing is shared";
}

TEST(Extent, OfNothing) {
  Evaluator evaluator{EvaluateOptions()};
  const NodePtr a = cube(2);
  EXPECT_TRUE(evaluator.extent(subtract({a, a}))->empty);
  EXPECT_EQ(*evaluator.area(subtract({a, a})), 0);
  EXPECT_FALSE(evaluator.centroid(subtract({a, a}))->has_value());
  const NodePtr first = subtract({cube(4), moved(0, 0, 2, cube(4))});
  EXPECT_EQ(evaluator.extent(first)->volume, 32);
  const NodePtr second = subtract({first, moved(0, 0, -1, cube(4))});
  EXPECT_TRUE(evaluator.extent(second)->empty);
  EXPECT_EQ(evaluator.extent(unite({second, cube(1)}))->volume, 1);
}

// Solids that are not measured are the same but for that.
TEST(Extent, IsKnownOfSolidsThatWereNotMeasured) {
  Evaluator first{EvaluateOptions()}, second{EvaluateOptions()};
  const NodePtr part = subtract({cube(4), moved(1, 1, 2, cube(4))});
  const auto bare = first.evaluate(part, Measuring::kNothing), measured = second.evaluate(part);
  ASSERT_TRUE(bare && measured);
  EXPECT_EQ((*bare)->triangles, (*measured)->triangles);
  EXPECT_EQ((*bare)->positions, (*measured)->positions);
  EXPECT_EQ((*bare)->measures.volume, 0);
  EXPECT_EQ((*measured)->measures.volume, 46);
  EXPECT_EQ(first.extent(part)->volume, 46);
  const auto topology = Evaluator(EvaluateOptions()).evaluate(part, Measuring::kTopology);
  ASSERT_TRUE(topology);
  EXPECT_EQ((*topology)->measures.components, 1);
  EXPECT_EQ((*topology)->measures.area, 0);
  // They do not stand in for measured ones, but measured ones do for them.
  const auto later = first.evaluate(part);
  ASSERT_TRUE(later);
  EXPECT_EQ((*later)->measures.area, (*measured)->measures.area);
  EXPECT_EQ((*later)->measures.centroid, (*measured)->measures.centroid);
  EXPECT_EQ((*later)->canonical_hash, (*measured)->canonical_hash);
  const auto again = second.evaluate(part, Measuring::kNothing);
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, *measured);
}

}  // namespace
}  // namespace csgrun::extent_test
