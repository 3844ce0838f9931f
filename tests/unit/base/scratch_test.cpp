// Memory for the length of a function: arrays do not overlap, and what ends is used again.
#include "engine/base/scratch.h"

#include <array>
#include <thread>

#include <gtest/gtest.h>

namespace csgrun::scratch_test {
namespace {

/// Takes arrays, here and `depth` functions further down, and sees that each keeps what it holds.
void nest(unsigned depth, unsigned seed) {
  Scratch scratch;
  const auto bytes = scratch.array<uint8_t>(seed % 77 + 1, static_cast<uint8_t>(seed));
  const auto numbers = scratch.array<uint64_t>(seed % 5000, seed);
  if (depth > 0) nest(depth - 1, seed * 31 + 7);
  const auto points = scratch.array<std::array<double, 3>>(3, {1.0, 2.0, double(seed)});
  if (depth > 0) nest(depth - 1, seed * 17 + 3);
  for (const uint8_t b : bytes) ASSERT_EQ(b, static_cast<uint8_t>(seed));
  for (const uint64_t n : numbers) ASSERT_EQ(n, seed);
  for (const auto& p : points) ASSERT_EQ(p[2], double(seed));
  ASSERT_EQ(reinterpret_cast<uintptr_t>(numbers.data()) % alignof(uint64_t), 0u);
  ASSERT_EQ(reinterpret_cast<uintptr_t>(points.data()) % alignof(double), 0u);
}

TEST(Scratch, ArraysAreApart) {
  for (unsigned seed = 0; seed < 40; ++seed) nest(6, seed);
}

TEST(Scratch, MemoryIsUsedAgain) {
  const auto place = [] {
    Scratch scratch;
    return scratch.array<int>(100).data();
  };
  const int* const first = place();
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(place(), first);
}

TEST(Scratch, HasRoomForAnything) {
  constexpr size_t kLarge = size_t{3} << 20;
  Scratch scratch;
  const auto few = scratch.array<uint32_t>(10, 1);
  const auto none = scratch.array<uint32_t>(0);
  const auto large = scratch.array<uint32_t>(kLarge, 2);
  const auto more = scratch.array<uint32_t>(10, 3);
  EXPECT_EQ(none.size(), 0u);
  EXPECT_EQ(large.size(), kLarge);
  EXPECT_EQ(few.back(), 1u);
  EXPECT_EQ(large.front(), 2u);
  EXPECT_EQ(large.back(), 2u);
  EXPECT_EQ(more.front(), 3u);
}

TEST(Scratch, EachThreadHasItsOwn) {
  Scratch scratch;
  const auto mine = scratch.array<int>(1000, 1);
  std::thread([] {
    Scratch other;
    other.array<int>(1000, 2);
  }).join();
  for (const int n : mine) EXPECT_EQ(n, 1);
}

}  // namespace
}  // namespace csgrun::scratch_test
