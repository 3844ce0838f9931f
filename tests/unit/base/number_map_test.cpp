// Numbers that stand for numbers, held against a map of the standard library.
#include "engine/base/number_map.h"

#include <map>
#include <random>

#include <gtest/gtest.h>

namespace csgrun::number_map_test {
namespace {

TEST(NumberMap, KeepsTheFirstValueOfANumber) {
  std::mt19937 random(41);
  for (const uint32_t range : {1u, 7u, 100u, 5000u, ~0u}) {
    for (const uint32_t stride : {1u, 64u, 1u << 20}) {
      NumberMap map;
      std::map<uint32_t, uint32_t> same;
      for (uint32_t i = 0; i < 3000; ++i) {
        const uint32_t number = (random() % range) * stride;
        const auto [value, is_new] = map.find_or_add(number, i);
        const auto [expected, was_new] = same.try_emplace(number, i);
        ASSERT_EQ(value, expected->second);
        ASSERT_EQ(is_new, was_new);
        ASSERT_EQ(map.size(), same.size());
      }
    }
  }
}

}  // namespace
}  // namespace csgrun::number_map_test
