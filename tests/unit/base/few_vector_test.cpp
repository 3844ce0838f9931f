// A vector of few elements, and of more: it is what std::vector is, however it is moved about.
#include "engine/base/few_vector.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun::few_vector_test {
namespace {

using Few = FewVector<uint32_t, 4>;

bool same(const Few& few, const std::vector<uint32_t>& other) {
  return few.size() == other.size() && few.empty() == other.empty() &&
         std::equal(few.begin(), few.end(), other.begin());
}

TEST(FewVector, IsWhatAVectorIs) {
  test::Random random(16);
  constexpr size_t kLists = 6;
  std::vector<Few> lists(kLists);
  std::vector<std::vector<uint32_t>> expected(kLists);
  for (int step = 0; step < 5000; ++step) {
    const auto to = static_cast<size_t>(random.integer(0, kLists - 1));
    const auto from = static_cast<size_t>(random.integer(0, kLists - 1));
    switch (random.integer(0, 5)) {
      case 0: {
        std::vector<uint32_t> elements(static_cast<size_t>(random.integer(0, 9)));
        for (uint32_t& e : elements) e = static_cast<uint32_t>(random.bits());
        lists[to] = elements;
        expected[to] = elements;
        break;
      }
      case 1:
        lists[to] = lists[from];
        expected[to] = expected[from];
        break;
      case 2:
        if (to == from) break;
        lists[to] = std::move(lists[from]);
        expected[to] = std::exchange(expected[from], {});
        break;
      case 3:
        std::swap(lists[to], lists[from]);
        std::swap(expected[to], expected[from]);
        break;
      case 4: {  // a part of itself
        if (expected[to].empty()) break;
        lists[to] = std::span<const uint32_t>(lists[to].begin() + 1, lists[to].end());
        expected[to].erase(expected[to].begin());
        break;
      }
      default: {
        const Few copy(lists[to]);
        ASSERT_TRUE(same(copy, expected[to]));
        if (expected[to].empty()) break;
        std::rotate(lists[to].begin(), lists[to].begin() + 1, lists[to].end());
        std::rotate(expected[to].begin(), expected[to].begin() + 1, expected[to].end());
      }
    }
    for (size_t l = 0; l < kLists; ++l) ASSERT_TRUE(same(lists[l], expected[l])) << step;
  }
}

TEST(FewVector, TakesMemoryForManyAlone) {
  const std::vector<uint32_t> four{1, 2, 3, 4}, five{1, 2, 3, 4, 5};
  const auto is_within = [](const Few& few) {
    const auto* const bytes = reinterpret_cast<const char*>(few.data());
    const auto* const own = reinterpret_cast<const char*>(&few);
    return bytes >= own && bytes < own + sizeof few;
  };
  EXPECT_TRUE(is_within(Few(four)));
  EXPECT_FALSE(is_within(Few(five)));
  EXPECT_EQ(sizeof(Few), sizeof(size_t) + 16);
}

}  // namespace
}  // namespace csgrun::few_vector_test
