// Sets that are joined, against renaming all members.
#include "engine/bsp/union_find.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun::union_find_test {
namespace {

TEST(UnionFind, SetsAreKnownByTheirLeastMember) {
  test::Random random(801);
  for (int i = 0; i < 50; ++i) {
    const auto count = static_cast<uint32_t>(random.integer(1, 30));
    UnionFind sets(count);
    std::vector<uint32_t> of(count);
    std::iota(of.begin(), of.end(), 0u);
    for (int64_t k = random.integer(0, 40); k > 0; --k) {
      const auto a = static_cast<uint32_t>(random.integer(0, count - 1)),
                 b = static_cast<uint32_t>(random.integer(0, count - 1));
      const uint32_t least = std::min(of[a], of[b]), other = std::max(of[a], of[b]);
      if (random.integer(0, 1)) {
        sets.join(a, b);
      } else {
        EXPECT_EQ(sets.join_with(sets.find(a), b), least);
      }
      std::replace(of.begin(), of.end(), other, least);
      for (uint32_t n = 0; n < count; ++n) ASSERT_EQ(sets.find(n), of[n]) << n;
    }
    EXPECT_EQ(sets.size(), count);
    const uint32_t half = count / 2;
    sets.flatten(0, half);
    sets.flatten(half, count);
    for (uint32_t n = 0; n < count; ++n) ASSERT_EQ(sets.root(n), of[n]) << n;
    sets.reset(count + 1);
    for (uint32_t n = 0; n <= count; ++n) EXPECT_EQ(sets.find(n), n);
  }
}

}  // namespace
}  // namespace csgrun::union_find_test
