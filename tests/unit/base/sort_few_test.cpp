// Sorting of a few, and of more, is what the standard's stable sort does.
#include "engine/base/sort_few.h"

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace csgrun::sort_few_test {
namespace {

struct Thing {
  uint32_t key, name;
  bool operator==(const Thing&) const = default;
};

TEST(SortFew, SortsStably) {
  std::mt19937 random(7);
  const auto is_less = [](const Thing& a, const Thing& b) { return a.key < b.key; };
  for (uint32_t count = 0; count < 70; ++count) {
    for (const uint32_t keys : {1u, 3u, 1000u}) {
      std::vector<Thing> things;
      for (uint32_t i = 0; i < count; ++i)
        things.push_back({static_cast<uint32_t>(random() % keys), i});
      std::vector<Thing> expected = things;
      std::stable_sort(expected.begin(), expected.end(), is_less);
      sort_few(things.begin(), things.end(), is_less);
      EXPECT_EQ(things, expected) << count;
    }
  }
}

}  // namespace
}  // namespace csgrun::sort_few_test
