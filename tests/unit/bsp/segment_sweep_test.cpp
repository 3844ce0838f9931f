// The sweep visits each pair of boxes that meet, once, against all pairs; along whichever axis.
#include "engine/bsp/segment_sweep.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun::segment_sweep_test {
namespace {

using Position = std::array<double, 3>;

TEST(SegmentSweep, VisitsEachPairThatMeetsOnce) {
  test::Random random(41);
  size_t pairs = 0;
  SegmentSweep sweep;
  for (int i = 0; i < 120; ++i) {
    // Long along some axes, short along others, none on some; few values, so that boxes touch.
    Position reach, length;
    for (int k = 0; k < 3; ++k) {
      reach[k] = i % 5 == k ? 0 : static_cast<double>(random.integer(1, 40));
      length[k] = static_cast<double>(random.integer(0, i % 4 == k ? 30 : 4));
    }
    std::vector<std::array<Position, 2>> segments;
    sweep.clear();
    // Many are divided into strips.
    for (int64_t n = random.integer(0, i % 4 == 0 ? 500 : 30); n > 0; --n) {
      Position a, b;
      for (int k = 0; k < 3; ++k) {
        a[k] = std::floor((random.unit() - 0.3) * reach[k]);
        b[k] = a[k] + std::floor((random.unit() - 0.5) * length[k]);
      }
      segments.push_back({a, b});
      sweep.add(a, b);
    }
    std::set<std::array<uint32_t, 2>> expected, visited;
    for (uint32_t s = 0; s < segments.size(); ++s) {
      for (uint32_t t = 0; t < s; ++t) {
        bool meet = true;
        for (int k = 0; k < 3; ++k) {
          const auto [a, b] = std::minmax(segments[s][0][k], segments[s][1][k]);
          const auto [c, d] = std::minmax(segments[t][0][k], segments[t][1][k]);
          meet = meet && a <= d && c <= b;
        }
        if (meet) expected.insert({t, s});
      }
    }
    sweep.for_each_pair([&](uint32_t s, uint32_t t) {
      ASSERT_NE(s, t);
      ASSERT_TRUE(visited.insert({std::min(s, t), std::max(s, t)}).second);
    });
    ASSERT_EQ(visited, expected);
    pairs += expected.size();
  }
  EXPECT_GT(pairs, 500u);
}

}  // namespace
}  // namespace csgrun::segment_sweep_test
