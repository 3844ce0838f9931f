// Labels of volumes from what cells say of them, by hand: what contradicts itself is noticed.
#include "engine/bsp/surface_volumes.h"

#include <gtest/gtest.h>

#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun {
namespace {

/// Volumes of winding 0, 1, 2, -1 in one cell, and what is seen of patch 0 there.
std::vector<SurfaceCells> runs_with(const std::vector<std::array<uint32_t, 2>>& sides) {
  std::vector<SurfaceCells> runs(1);
  runs[0].windings = {0, 1, 2, -1};
  for (const auto& [front, back] : sides) runs[0].patches.push_back({0, front, back});
  return runs;
}

TEST(SurfaceVolumes, WindingsAreInsideByTheRule) {
  const auto inside = [](InsideRule rule) {
    return label_by_winding(runs_with({}), 0, rule)->volumes;
  };
  EXPECT_EQ(inside(InsideRule::kNonZero), (std::vector<std::vector<uint8_t>>{{0, 1, 1, 1}}));
  EXPECT_EQ(inside(InsideRule::kPositive), (std::vector<std::vector<uint8_t>>{{0, 1, 1, 0}}));
  EXPECT_EQ(inside(InsideRule::kEvenOdd), (std::vector<std::vector<uint8_t>>{{0, 1, 0, 1}}));
}

TEST(SurfaceVolumes, APatchHasOneLabelOnEachSide) {
  const auto labels = [](const std::vector<std::array<uint32_t, 2>>& sides) {
    return label_by_winding(runs_with(sides), 2, InsideRule::kNonZero);
  };
  const auto same = labels({{0, 1}, {0, 2}});
  ASSERT_TRUE(same);
  EXPECT_TRUE(same->patches[0].known);
  EXPECT_FALSE(same->patches[0].front);
  EXPECT_TRUE(same->patches[0].back);
  EXPECT_FALSE(same->patches[1].known);
  EXPECT_FALSE(labels({{0, 1}, {1, 1}}));
  EXPECT_FALSE(labels({{0, 1}, {0, 0}}));
  EXPECT_FALSE(labels({{0, 1}, {1, 0}}));
}

TEST(SurfaceVolumes, AReachThatStartsNowhereIsNone) {
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {4, 4, 4}))};
  const Job job(operands);
  std::vector<SurfaceCells> runs = runs_with({{0, 1}});
  EXPECT_FALSE(label_by_reach(job, runs, 1, 5, InsideRule::kOuterHull));
  runs[0].vertex_volumes.push_back({4, 0});  // another vertex
  EXPECT_FALSE(label_by_reach(job, runs, 1, 5, InsideRule::kOuterHull));
  runs[0].vertex_volumes.push_back({5, 0});
  const auto labels = label_by_reach(job, runs, 1, 5, InsideRule::kOuterHull);
  ASSERT_TRUE(labels);
  EXPECT_EQ(labels->volumes, (std::vector<std::vector<uint8_t>>{{0, 1, 1, 1}}));
  EXPECT_FALSE(labels->patches[0].front);
  EXPECT_TRUE(labels->patches[0].back);
}

// From the outside, through what faces away from one who comes.
TEST(SurfaceVolumes, AnOrientedHullIsEnteredFromBehind) {
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {4, 4, 4}))};
  const Job job(operands);
  std::vector<SurfaceCells> runs = runs_with({});
  runs[0].vertex_volumes.push_back({5, 0});
  // 0 | 1 faces 0; 2 | 0 faces 2, so that 0 is behind it; 3 | 2 faces both ways.
  runs[0].sides = {{0, 1, true, false}, {2, 0, true, false}, {3, 2, true, true}};
  const auto inside = [&](InsideRule rule) {
    return label_by_reach(job, runs, 0, 5, rule)->volumes[0];
  };
  EXPECT_EQ(inside(InsideRule::kOuterHull), (std::vector<uint8_t>{0, 1, 1, 1}));
  EXPECT_EQ(inside(InsideRule::kOrientedHull), (std::vector<uint8_t>{0, 1, 0, 1}));
  runs[0].sides.push_back({2, 3, false, true});  // faces 3: entered from 2
  EXPECT_EQ(inside(InsideRule::kOrientedHull), (std::vector<uint8_t>{0, 1, 0, 0}));
}

}  // namespace
}  // namespace csgrun
