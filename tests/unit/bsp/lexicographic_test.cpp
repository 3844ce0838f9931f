// Points in order, few and so many that threads share them.
#include "engine/bsp/lexicographic.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun::lexicographic_test {
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

// As many buckets as there are whole x: threads share them out, and each sorts all of its own.
TEST(LexicographicOrder, OfManyColumns) {
  constexpr uint32_t kColumns = 3 * kFewForThreads, kEach = 3;
  std::vector<std::array<double, 3>> points;
  for (uint32_t x = 0; x < kColumns; ++x) {
    for (uint32_t y = 0; y < kEach; ++y) points.push_back({1.0 * x, -1.0 * y, 0});
  }
  const auto order = lexicographic_order(
      points.size(), [&](uint32_t i) -> const std::array<double, 3>& { return points[i]; },
      [](uint32_t i, uint32_t j) { return i < j; });
  ASSERT_EQ(order.size(), points.size());
  for (uint32_t i = 0; i < points.size(); ++i) {
    ASSERT_EQ(order[i], i / kEach * kEach + kEach - 1 - i % kEach) << i;
  }
}

}  // namespace
}  // namespace csgrun::lexicographic_test
