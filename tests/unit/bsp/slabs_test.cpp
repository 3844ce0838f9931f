// One triangle against eight: what is said to be apart is, and what is clearly beyond one of the
// four slabs is said to be.
#include "engine/bsp/slabs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/whole_triangles.h"

namespace csgrun::slabs_test {
namespace {

using namespace test;  // NOLINT: a test

EightTriangles packed(const std::array<Triangle, 8>& triangles) {
  EightTriangles eight{};
  for (size_t lane = 0; lane < 8; ++lane) {
    for (size_t i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 3; ++k) {
        eight.at[i][k][lane] = static_cast<float>(triangles[lane][i][k]);
      }
    }
  }
  return eight;
}

TEST(Slabs, SeeWhatIsClearlyBeyondOneOfThemAndNothingElse) {
  size_t found = 0, touching = 0, coplanar = 0;
  for (int i = 0; i < 4000; ++i) {
    test::Random random(3100 + i);
    const int64_t size = random.integer(2, 9);
    const Triangle own = random_triangle(random, size);
    std::array<Triangle, 8> others;
    for (Triangle& t : others) t = random_neighbour(own, random, size);
    const auto reach = static_cast<double>(20 * size);
    const auto which = static_cast<uint32_t>(random.integer(0, 255));
    const uint32_t apart = Slabs(own, reach).apart_in_space(packed(others), which);
    EXPECT_EQ(apart & ~which, 0u);
    for (uint32_t lane = 0; lane < 8; ++lane) {
      if ((which >> lane & 1) == 0) continue;
      const bool is_apart = (apart >> lane & 1) != 0;
      const double room = most_room(own, others[lane]);
      const bool is_coplanar =
          std::all_of(others[lane].begin(), others[lane].end(),
                      [&](const Vec& p) { return dot(normal(own), minus(p, own[0])) == 0; });
      // The slack, and what rounding adds to it. (Others are clearly off the plane: coordinates
      // are small.)
      const bool is_clear = !is_coplanar && room > 0x1p-18 * reach;
      EXPECT_TRUE(is_apart || !is_clear) << i << ' ' << lane;
      EXPECT_TRUE(!is_apart || (are_apart(own, others[lane]) && !is_coplanar)) << i << ' ' << lane;
      coplanar += is_coplanar && room > 0x1p-18 * reach;
      found += is_apart;
      touching += !are_apart(own, others[lane]);
    }
  }
  EXPECT_GT(found, 3000u);
  EXPECT_GT(touching, 3000u);
  EXPECT_GT(coplanar, 100u);
}

// Far from the middle floats do not have all bits of the points: what touches is never apart.
TEST(Slabs, RoundedCornersNeverPartWhatTouches) {
  constexpr double kReach = 0x1p29;
  for (int i = 0; i < 3000; ++i) {
    test::Random random(9100 + i);
    const Triangle own = random_triangle(random, 400);
    std::array<Triangle, 8> others;
    Vec move{};
    for (double& m : move)
      m = static_cast<double>(random.integer(-(int64_t{1} << 28), int64_t{1} << 28));
    for (Triangle& t : others) t = random_touching(own, random, 400, move);
    EXPECT_EQ(Slabs(scaled(own, 3, move), kReach).apart_in_space(packed(others), 0xff), 0u) << i;
  }
}

// A side of one passes through the middle of another one.
TEST(Slabs, RoundedCornersNeverPartWhatPassesThrough) {
  constexpr double kReach = 0x1p29;
  for (int i = 0; i < 3000; ++i) {
    test::Random random(7700 + i);
    Vec move{}, middle{};
    for (double& m : move)
      m = static_cast<double>(random.integer(-(int64_t{1} << 28), int64_t{1} << 28));
    const Triangle small = random_triangle(random, 400);
    const Triangle own = scaled(small, 3, move);
    for (size_t k = 0; k < 3; ++k) middle[k] = small[0][k] + small[1][k] + small[2][k] + move[k];
    std::array<Triangle, 8> others;
    for (Triangle& t : others) {
      t = scaled(random_triangle(random, 400), 3, move);
      const auto at = static_cast<size_t>(random.integer(0, 2));
      for (size_t k = 0; k < 3; ++k) t[(at + 1) % 3][k] = 2 * middle[k] - t[at][k];
    }
    EXPECT_EQ(Slabs(own, kReach).apart_in_space(packed(others), 0xff), 0u) << i;
    std::array<Triangle, 8> same;
    same.fill(own);
    for (const Triangle& t : others) {
      EXPECT_EQ(Slabs(t, kReach).apart_in_space(packed(same), 0xff), 0u) << i;
    }
  }
}

/// The room between s and what t has in the plane of s, across a side of s, less what the slabs may
/// take for it: t is so much longer in them, the more level it is.
double most_room_in_plane(const Triangle& s, const Triangle& t, double slack) {
  const Vec up = normal(s);
  const auto height = [&](const Vec& p) {
    return dot(minus(p, s[0]), up) / std::sqrt(dot(up, up));
  };
  double most = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < 3; ++i) {
    const Vec way = cross(edge(s, i), up);
    const double length = std::sqrt(dot(way, way));
    const auto place = [&](const Vec& p) { return dot(p, way) / length; };
    const auto [s_lo, s_hi] = std::minmax({place(s[0]), place(s[1]), place(s[2])});
    double lo = std::numeric_limits<double>::infinity(), hi = -lo, steps = 0;
    for (size_t k = 0; k < 3; ++k) {
      const Vec &a = t[k], &b = t[(k + 1) % 3];
      const double from = height(a), to = height(b);
      if (from * to > 0 || from == to) continue;
      const double at = place(a) + (place(b) - place(a)) * from / (from - to);
      lo = std::min(lo, at), hi = std::max(hi, at);
      steps = std::max(steps, std::fabs((place(b) - place(a)) / (to - from)));
    }
    most = std::max(most, std::max(lo - s_hi, s_lo - hi) - slack * (2 + steps));
  }
  return most;
}

// Of triangles that are apart, and pass through each other's plane.
TEST(Slabs, SeeWhatIsClearlyBesideInThePlane) {
  size_t clear = 0, left = 0, only_here = 0;
  for (int i = 0; i < 4000; ++i) {
    test::Random random(5200 + i);
    const int64_t size = random.integer(2, 9);
    const Triangle own = random_triangle(random, size);
    std::array<Triangle, 8> others;
    for (Triangle& t : others) t = random_neighbour(own, random, size);
    const auto reach = static_cast<double>(20 * size);
    const uint32_t apart = Slabs(own, reach).apart_in_space(packed(others), 0xff);
    for (uint32_t lane = 0; lane < 8; ++lane) {
      const Triangle& t = others[lane];
      if (gap(own, t, normal(own)) >= 0 || gap(own, t, normal(t)) >= 0) continue;
      const bool is_clear = most_room_in_plane(own, t, 0x1p-18 * reach) > 0;
      const bool is_apart = (apart >> lane & 1) != 0;
      EXPECT_TRUE(is_apart || !is_clear) << i << ' ' << lane;
      EXPECT_TRUE(!is_apart || are_apart(own, t)) << i << ' ' << lane;
      clear += is_clear;
      only_here += is_clear && most_room(own, t) <= 0;
      left += are_apart(own, t) && !is_clear;
    }
  }
  EXPECT_GT(clear, 1500u);
  EXPECT_GT(only_here, 1000u);
  EXPECT_LT(20 * left, clear);
}

EightBoxes boxes_of(const std::array<Triangle, 8>& triangles) {
  EightBoxes boxes{};
  for (size_t lane = 0; lane < 8; ++lane) {
    for (size_t k = 0; k < 3; ++k) {
      const auto [lo, hi] =
          std::minmax({triangles[lane][0][k], triangles[lane][1][k], triangles[lane][2][k]});
      boxes.lo[k][lane] = static_cast<float>(lo);
      boxes.hi[k][lane] = static_cast<float>(hi);
    }
  }
  return boxes;
}

/// The most room that the slabs of s leave to a box.
double most_room(const Triangle& s, const Vec& lo, const Vec& hi) {
  double most = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < 4; ++i) {
    const Vec way = i == 3 ? normal(s) : cross(edge(s, i), normal(s));
    double room = std::numeric_limits<double>::infinity();  // to one side and to the other
    for (const double sense : {1.0, -1.0}) {
      const auto along = [&](const Vec& p) { return sense * dot(p, way); };
      Vec least{};
      for (size_t k = 0; k < 3; ++k) least[k] = sense * way[k] > 0 ? lo[k] : hi[k];
      const double gap = along(least) - std::max({along(s[0]), along(s[1]), along(s[2])});
      room = sense > 0 ? gap : std::max(room, gap);
    }
    most = std::max(most, room / std::sqrt(dot(way, way)));
  }
  return most;
}

TEST(Slabs, SeeWhichBoxesAreBeyondOneOfThemAndNoOther) {
  size_t found = 0, left = 0;
  for (int i = 0; i < 3000; ++i) {
    test::Random random(4700 + i);
    const int64_t size = random.integer(2, 9);
    const Triangle own = random_triangle(random, size);
    std::array<Triangle, 8> inside;  // of the boxes
    for (Triangle& t : inside) {
      t = scaled(random_triangle(random, size), 0.5,
                 own[static_cast<size_t>(random.integer(0, 2))]);
    }
    const EightBoxes boxes = boxes_of(inside);
    const auto reach = static_cast<double>(20 * size);
    const auto which = static_cast<uint32_t>(random.integer(0, 255));
    const uint32_t apart = Slabs(own, reach).apart(boxes, which);
    EXPECT_EQ(apart & ~which, 0u);
    for (uint32_t lane = 0; lane < 8; ++lane) {
      if ((which >> lane & 1) == 0) continue;
      const auto corner = [&](const auto& bounds) {
        return Vec{bounds[0][lane], bounds[1][lane], bounds[2][lane]};
      };
      const double room = most_room(own, corner(boxes.lo), corner(boxes.hi));
      const bool is_apart = (apart >> lane & 1) != 0;
      // Where there is room at all it is more than the slack: coordinates are small.
      EXPECT_EQ(is_apart, room > 0x1p-18 * reach) << i << ' ' << lane;
      ++(is_apart ? found : left);
    }
  }
  EXPECT_GT(found, 1000u);
  EXPECT_GT(left, 1000u);
}

TEST(Slabs, ATriangleWithoutAreaIsApartFromNothing) {
  std::array<Triangle, 8> others;
  others.fill({{{90, 90, 90}, {91, 90, 90}, {90, 91, 90}}});
  const Triangle line{{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}}, good{{{0, 0, 0}, {1, 1, 1}, {2, 3, 2}}};
  EXPECT_EQ(Slabs(line, 100).apart_in_space(packed(others), 0xff), 0u);
  EXPECT_EQ(Slabs(good, 100).apart_in_space(packed(others), 0xff), 0xffu);
  EXPECT_EQ(Slabs(line, 100).apart(boxes_of(others), 0xff), 0u);
  EXPECT_EQ(Slabs(good, 100).apart(boxes_of(others), 0xff), 0xffu);
  // A reach beyond all measure leaves no room.
  EXPECT_EQ(Slabs(good, 0x1p40).apart_in_space(packed(others), 0xff), 0u);
}

}  // namespace
}  // namespace csgrun::slabs_test
