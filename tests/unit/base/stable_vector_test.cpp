#include "engine/base/stable_vector.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace csgrun {
namespace {

TEST(StableVector, LeavesWhatItHoldsWhereItIs) {
  StableVector<std::string> words;
  std::vector<const std::string*> places;
  for (size_t i = 0; i < 1000; ++i) {
    words.push_back(std::to_string(i));
    places.push_back(&words[i]);
  }
  ASSERT_EQ(words.size(), 1000u);
  for (size_t i = 0; i < 1000; ++i) {
    EXPECT_EQ(&words[i], places[i]);
    EXPECT_EQ(words[i], std::to_string(i));
  }
}

TEST(StableVector, StartsAnewInTheSamePlace) {
  StableVector<int> numbers;
  for (int i = 0; i < 40; ++i) numbers.push_back(i);
  const int* const first = &numbers[0];
  numbers.clear();
  EXPECT_EQ(numbers.size(), 0u);
  for (int i = 0; i < 60; ++i) numbers.push_back(2 * i);
  EXPECT_EQ(&numbers[0], first);
  for (size_t i = 0; i < 60; ++i) EXPECT_EQ(numbers[i], static_cast<int>(2 * i));
}

}  // namespace
}  // namespace csgrun
