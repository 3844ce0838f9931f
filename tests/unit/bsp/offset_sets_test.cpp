// Sets that are joined with differences, against numbers that are known.
#include "engine/bsp/offset_sets.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun::offset_sets_test {
namespace {

TEST(OffsetSets, TellsDifferencesAndContradictions) {
  test::Random random(811);
  for (int i = 0; i < 50; ++i) {
    const auto count = static_cast<uint32_t>(random.integer(1, 30));
    OffsetSets sets(count);
    std::vector<uint32_t> of(count);
    std::iota(of.begin(), of.end(), 0u);
    std::vector<int32_t> number(count);
    for (int32_t& n : number) n = static_cast<int32_t>(random.integer(-9, 9));
    for (int64_t k = random.integer(0, 60); k > 0; --k) {
      const auto a = static_cast<uint32_t>(random.integer(0, count - 1)),
                 b = static_cast<uint32_t>(random.integer(0, count - 1));
      const int32_t step = number[b] - number[a];
      EXPECT_TRUE(sets.join(a, b, step));
      EXPECT_FALSE(sets.join(a, b, step + (random.integer(0, 1) ? 1 : -1)));
      const uint32_t least = std::min(of[a], of[b]), other = std::max(of[a], of[b]);
      std::replace(of.begin(), of.end(), other, least);
      for (uint32_t n = 0; n < count; ++n) {
        const OffsetSets::Place place = sets.find(n);
        ASSERT_EQ(place.root, of[n]) << n;
        ASSERT_EQ(place.offset, number[n] - number[of[n]]) << n;
      }
    }
  }
}

// A long way to the least member.
TEST(OffsetSets, ChainsAreShortened) {
  constexpr uint32_t kCount = 1000;
  OffsetSets sets(kCount);
  for (uint32_t n = kCount - 1; n > 0; --n) EXPECT_TRUE(sets.join(n, n - 1, 2));
  for (int round = 0; round < 2; ++round) {
    for (uint32_t n = kCount; n-- > 0;) {
      EXPECT_EQ(sets.find(n).root, 0u);
      EXPECT_EQ(sets.find(n).offset, -2 * static_cast<int32_t>(n));
    }
  }
}

}  // namespace
}  // namespace csgrun::offset_sets_test
