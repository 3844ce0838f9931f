// Points in order, few and so many that threads share them.
#include "engine/bsp/lexicographic.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun {
namespace {

TEST(LexicographicOrder, IsThatOfASort) {
  test::Random random(1231);
  for (const size_t count : {size_t{1}, size_t{7}, size_t{300}, size_t{40000}}) {
    for (const int64_t reach : {int64_t{2}, int64_t{50}, int64_t{1} << 40}) {
      std::vector<std::array<double, 3>> points(count);
      for (auto& p : points) {
        for (double& c : p) c = static_cast<double>(random.integer(-reach, reach)) / 4;
      }
      // Equal ones by descending numbers.
      const auto before = [](uint32_t i, uint32_t j) { return i > j; };
      std::vector<uint32_t> expected(count);
      std::iota(expected.begin(), expected.end(), 0u);
      std::sort(expected.begin(), expected.end(), [&](uint32_t i, uint32_t j) {
        return points[i] != points[j] ? points[i] < points[j] : i > j;
      });
      const auto order = lexicographic_order(
          count, [&](uint32_t i) -> const std::array<double, 3>& { return points[i]; }, before);
      ASSERT_EQ(std::vector<uint32_t>(order.begin(), order.end()), expected) << count;
    }
  }
}

}  // namespace
}  // namespace csgrun
