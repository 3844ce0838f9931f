// The quick way gives what the sweep gives, to the order of triangles, or nothing.
#include "engine/mesh/triangulate_monotone.h"

#include <gtest/gtest.h>

#include "tests/unit/mesh/planar_faces.h"

namespace csgrun::test::triangulate_monotone_test {
namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

const FlatPoint kSweeps[][2] = {{{1, 0}, {0, 1}}, {{0, 1}, {1, 0}}, {{-2, 5}, {1, 1}}};

/// Whether the quick way did it; it must agree with the sweep then.
bool agrees(const FlatLoop& loop, const PlanarOracle& oracle) {
  const std::vector<FlatLoop> loops{loop};
  const auto expected = triangulate_by_sweep(loops, oracle);
  const std::array<uint32_t, 3> before{7, 8, 9};
  Triangles got{before};
  const bool done = triangulate_monotone(loop, oracle, got);
  EXPECT_EQ(got[0], before);
  got.erase(got.begin());
  if (!done) {
    EXPECT_TRUE(got.empty());
    return false;
  }
  EXPECT_TRUE(expected) << expected.error().message;
  if (expected) {
    EXPECT_EQ(got, *expected);
  }
  return true;
}

TEST(TriangulateMonotone, IsWhatTheSweepDoes) {
  std::mt19937 random(31);
  size_t done = 0, left = 0;
  for (int round = 0; round < 4000; ++round) {
    const int n = 2 + static_cast<int>(random() % 5);
    const auto points = grid_points(n);
    const auto loops = random_patch(random_triangulation(n, points, 40 * n * n, random),
                                    0.1 + 0.1 * static_cast<double>(random() % 8), random);
    if (loops.size() != 1) continue;
    for (const auto& sweep : kSweeps) {
      (agrees(loops[0], GridOracle(points, sweep[0], sweep[1])) ? done : left) += 1;
      if (HasFailure()) FAIL() << "round " << round;
    }
  }
  EXPECT_GT(done, 500u);
  EXPECT_GT(left, 500u);
}

/// A convex polygon of many corners, some of 180 degrees, from any of them on.
TEST(TriangulateMonotone, ConvexLoops) {
  for (int n = 3; n < 30; ++n) {
    std::vector<FlatPoint> points;
    for (int i = 0; i < n; ++i) points.push_back({i, i * i});
    FlatLoop loop(points.size());
    for (uint32_t i = 0; i < loop.size(); ++i) loop[i] = i;
    for (int start = 0; start < n; ++start) {
      for (const auto& sweep : kSweeps) {
        EXPECT_EQ(agrees(loop, GridOracle(points, sweep[0], sweep[1])), n <= 24);
      }
      std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    }
    std::reverse(loop.begin(), loop.end());  // seen from behind: no face
    EXPECT_FALSE(agrees(loop, GridOracle(points, kSweeps[0][0], kSweeps[0][1])));
  }
  const std::vector<FlatPoint> runs{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  EXPECT_TRUE(agrees({0, 1, 2, 3, 4, 5, 6, 7}, GridOracle(runs)));
}

TEST(TriangulateMonotone, GivesUpWhatIsNoFace) {
  const std::vector<FlatPoint> points{{0, 0}, {2, 0}, {4, 0}, {1, 3}, {0, 0}};
  EXPECT_FALSE(agrees({0, 1}, GridOracle(points)));
  EXPECT_FALSE(agrees({0, 1, 2}, GridOracle(points)));     // flat
  EXPECT_FALSE(agrees({0, 3, 2}, GridOracle(points)));     // turned over
  EXPECT_FALSE(agrees({0, 2, 3, 4}, GridOracle(points)));  // one point twice
  EXPECT_TRUE(agrees({0, 1, 2, 3}, GridOracle(points)));
}

}  // namespace
}  // namespace csgrun::test::triangulate_monotone_test
