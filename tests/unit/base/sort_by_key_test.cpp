// Sorting by key gives what sorting by key and order gives, however many keys and items there are.
#include "engine/base/sort_by_key.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace csgrun::sort_by_key_test {
namespace {

struct Thing {
  uint32_t key, order, name;
  bool operator==(const Thing&) const = default;
};

TEST(SortByKey, SortsByKeyAndOrder) {
  std::mt19937 random(11);
  SortByKey<Thing> sorter;  // one for all: nothing is left of the time before
  for (const uint32_t count : {0u, 1u, 2u, 255u, 256u, 257u, 1000u, 5000u}) {
    for (const uint32_t keys : {1u, 2u, 40u, 1000u, 4999u, 1000000u}) {
      std::vector<Thing> things;
      for (uint32_t i = 0; i < count; ++i) {
        things.push_back({static_cast<uint32_t>(random() % keys), 0, i});
      }
      std::vector<uint32_t> orders(count);  // each once: which comes first is told
      for (uint32_t i = 0; i < count; ++i) orders[i] = i;
      std::shuffle(orders.begin(), orders.end(), random);
      for (uint32_t i = 0; i < count; ++i) things[i].order = orders[i];
      std::vector<Thing> expected = things;
      std::sort(expected.begin(), expected.end(), [](const Thing& a, const Thing& b) {
        return std::tie(a.key, a.order) < std::tie(b.key, b.order);
      });
      sorter.sort(
          things, keys, [](const Thing& t) { return t.key; },
          [](const Thing& a, const Thing& b) {
            return together(a.key, a.order) < together(b.key, b.order);
          });
      EXPECT_EQ(things, expected) << count << " things, " << keys << " keys";
    }
  }
}

}  // namespace
}  // namespace csgrun::sort_by_key_test
