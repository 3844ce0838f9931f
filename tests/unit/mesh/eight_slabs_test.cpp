// Eight triangles against one of another eight: what is said to be apart is, and what is clearly
// beyond a slab of either is said to be.
#include "engine/mesh/eight_slabs.h"

#include <gtest/gtest.h>

#include "tests/support/whole_triangles.h"

namespace csgrun::eight_slabs_test {
namespace {

using namespace test;  // NOLINT: a test

EightSlabs packed(const std::array<Triangle, 8>& triangles, uint32_t lanes, double reach) {
  EightSlabs::Corners corners{};
  for (size_t lane = 0; lane < 8; ++lane) {
    for (size_t i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 3; ++k) {
        corners[i][k][lane] = static_cast<float>(triangles[lane][i][k]);
      }
    }
  }
  return {corners, lanes, reach};
}

/// With one triangle at a lane, and something else at all others.
EightSlabs single(const Triangle& own, uint32_t lane, Random& random, double reach) {
  std::array<Triangle, 8> triangles;
  for (Triangle& t : triangles) t = random_triangle(random, 5);
  triangles[lane] = own;
  return packed(triangles, 0xff, reach);
}

TEST(EightSlabs, SeeWhatIsClearlyBeyondOneOfEitherAndNothingElse) {
  size_t found = 0, touching = 0, by_other = 0;
  for (int i = 0; i < 3000; ++i) {
    Random random(5200 + i);
    const int64_t size = random.integer(2, 9);
    const auto reach = static_cast<double>(20 * size);
    const Triangle own = random_triangle(random, size);
    std::array<Triangle, 8> others;
    for (Triangle& t : others) t = random_neighbour(own, random, size);
    const auto which = static_cast<uint32_t>(random.integer(0, 255)),
               lanes = random.integer(0, 3) == 0 ? static_cast<uint32_t>(random.integer(0, 255))
                                                 : 0xffu,
               lane = static_cast<uint32_t>(random.integer(0, 7));
    const EightSlabs own_slabs = single(own, lane, random, reach);
    const uint32_t apart = packed(others, lanes, reach).apart(own_slabs, lane, which);
    EXPECT_EQ(apart & ~(which & lanes), 0u);
    for (uint32_t other = 0; other < 8; ++other) {
      if ((which & lanes) >> other & 1) {
        const Triangle& t = others[other];
        const bool is_apart = (apart >> other & 1) != 0;
        const double room = most_room(own, t), room_of_other = most_room(t, own);
        // The slack, and what rounding adds to it.
        const double clear = 0x1p-18 * reach;
        EXPECT_TRUE(is_apart || std::max(room, room_of_other) <= clear) << i << ' ' << other;
        EXPECT_TRUE(!is_apart || are_apart(own, t)) << i << ' ' << other;
        found += is_apart;
        touching += !are_apart(own, t);
        by_other += room <= 0 && room_of_other > clear;
      }
    }
  }
  EXPECT_GT(found, 3000u);
  EXPECT_GT(touching, 3000u);
  EXPECT_GT(by_other, 300u);
}

// Far from the middle floats do not have all bits of the points: what touches is never apart.
TEST(EightSlabs, RoundedCornersNeverPartWhatTouches) {
  constexpr double kReach = 0x1p29;
  for (int i = 0; i < 3000; ++i) {
    Random random(7700 + i);
    const int64_t size = int64_t{1} << random.integer(4, 26);
    const Triangle own = random_triangle(random, size);
    Vec move{};
    for (double& m : move) {
      m = static_cast<double>(random.integer(-(int64_t{1} << 28), int64_t{1} << 28));
    }
    std::array<Triangle, 8> others;
    for (Triangle& t : others) t = random_touching(own, random, size, move);
    const EightSlabs own_slabs = single(scaled(own, 3, move), 3, random, kReach);
    EXPECT_EQ(packed(others, 0xff, kReach).apart(own_slabs, 3, 0xff), 0u) << i;
  }
}

// One that is no triangle, and one without area, which has no slab of its own.
TEST(EightSlabs, WhatIsNoTriangleIsApartFromNothing) {
  const Triangle good{{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}}}, far{{{0, 0, 50}, {9, 0, 50}, {0, 9, 50}}},
      line{{{0, 0, 50}, {9, 9, 50}, {18, 18, 50}}};
  std::array<Triangle, 8> others;
  others.fill(far);
  others[2] = line;
  const EightSlabs eight = packed(others, 0xf7, 100);
  std::array<Triangle, 8> own;
  own.fill(line);
  own[1] = good;
  EXPECT_EQ(eight.apart(packed(own, 0xff, 100), 1, 0xff), 0xf7u);
  EXPECT_EQ(eight.apart(packed(own, 0xfd, 100), 1, 0xff), 0u);
  EXPECT_EQ(eight.apart(packed(own, 0xff, 100), 1, 0x0f), 0x07u);
  // By the slabs of the others only: these are in one plane with the line.
  EXPECT_EQ(eight.apart(packed(own, 0xff, 100), 0, 0xff), 0u);
  others.fill({{{20, 0, 50}, {29, 0, 50}, {20, 9, 50}}});
  EXPECT_EQ(packed(others, 0xff, 100).apart(packed(own, 0xff, 100), 0, 0xff), 0xffu);
}

}  // namespace
}  // namespace csgrun::eight_slabs_test
