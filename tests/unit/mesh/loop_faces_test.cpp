// Loops that lie on a line are dropped, and the surface around them stays closed.
#include "engine/mesh/loop_faces.h"

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace csgrun::test::loop_faces_test {
namespace {

using Point = std::array<int64_t, 3>;
using Loop = std::vector<uint32_t>;

struct Surface {
  std::vector<Point> points;
  std::vector<LoopFace> faces;

  void add(Loop loop) { faces.push_back({{std::move(loop)}}); }
};

/// All lines of the tests lie along X; other faces have points off it.
bool drop(Surface& s) {
  return drop_collinear_loops(s.points, s.faces, [&](const Loop& loop) {
    for (const uint32_t v : loop) {
      if (s.points[v][1] != 0 || s.points[v][2] != 0) return false;
    }
    return true;
  });
}

/// Whether each directed edge is there as often as its reverse.
bool is_closed(const Surface& s) {
  std::map<std::pair<uint32_t, uint32_t>, int> balance;
  for (const LoopFace& face : s.faces) {
    for (const Loop& loop : face.loops) {
      for (size_t i = 0; i < loop.size(); ++i) {
        const uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
        balance[std::minmax(a, b)] += a < b ? 1 : -1;
      }
    }
  }
  for (const auto& [edge, count] : balance) {
    if (count != 0) return false;
  }
  return true;
}

/// Six times the volume.
int64_t volume6(const Surface& s) {
  int64_t sum = 0;
  for (const LoopFace& face : s.faces) {
    for (const Loop& loop : face.loops) {
      for (size_t i = 1; i + 1 < loop.size(); ++i) {
        const Point &a = s.points[loop[0]], &b = s.points[loop[i]], &c = s.points[loop[i + 1]];
        sum += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
      }
    }
  }
  return sum;
}

/// A tetrahedron; on one side its edge along X has n - 1 points, between which and the other side
/// there is a fan of slivers from the edge's begin.
Surface with_fan(uint32_t n) {
  Surface s;
  s.points = {{0, 0, 0}, {n, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (uint32_t i = 1; i < n; ++i) s.points.push_back({i, 0, 0});
  const auto on_edge = [&](uint32_t i) { return i == 0 ? 0u : i == n ? 1u : 3 + i; };
  for (uint32_t i = 0; i < n; ++i) s.add({2, on_edge(i + 1), on_edge(i)});
  s.add({0, 1, 3});
  s.add({1, 2, 3});
  s.add({2, 0, 3});
  for (uint32_t i = 1; i < n; ++i) s.add({0, on_edge(i), on_edge(i + 1)});
  return s;
}

TEST(LoopFaces, FansOfSliversOfAnySize) {
  for (const uint32_t n : {2u, 3u, 10u, 30u, 40u, 100u, 5000u}) {
    Surface s = with_fan(n);
    ASSERT_TRUE(is_closed(s)) << n;
    ASSERT_TRUE(drop(s)) << n;
    EXPECT_TRUE(is_closed(s)) << n;
    EXPECT_EQ(s.faces.size(), n + 3) << n;
    EXPECT_EQ(volume6(s), n) << n;
    for (const LoopFace& face : s.faces) {
      const Loop& loop = face.loops[0];
      const bool has_edge = std::set<uint32_t>(loop.begin(), loop.end()).count(0) != 0 &&
                            std::set<uint32_t>(loop.begin(), loop.end()).count(1) != 0;
      EXPECT_EQ(loop.size(), has_edge ? n + 2 : 3) << n;
    }
  }
}

TEST(LoopFaces, OneLongLoopThatRunsToAndFro) {
  // Its edges are those of as many thin tetrahedra: each is split at all that lies inside.
  constexpr uint32_t kCorners = 200;
  Surface s;
  Loop line;
  for (uint32_t i = 0; i < kCorners; ++i) {
    line.push_back(i);
    s.points.push_back({i % 2 == 0 ? i : int64_t{2} * kCorners - i, 0, 0});
  }
  s.points.push_back({0, 1, 0});
  s.points.push_back({0, 0, 1});
  for (uint32_t i = 0; i < kCorners; ++i) {
    const uint32_t a = i, b = (i + 1) % kCorners;
    s.add({b, a, kCorners});
  }
  s.add(line);
  ASSERT_TRUE(is_closed(s));
  ASSERT_TRUE(drop(s));
  EXPECT_TRUE(is_closed(s));
  EXPECT_EQ(s.faces.size(), kCorners);
  EXPECT_FALSE(drop(s));
}

TEST(LoopFaces, SplitsGoWhereTheyMustAndNotFurther) {
  // Two slivers beside each other: the corner 3 of the second splits no edge of the first but the
  // one that both have.
  Surface s;
  s.points = {{0, 0, 0}, {5, 0, 0}, {10, 0, 0}, {7, 0, 0}, {0, 9, 0}};
  s.add({0, 1, 2});
  s.add({1, 0, 3});
  s.add({2, 1, 4});
  s.add({0, 2, 4});
  s.add({1, 3, 4});
  s.add({3, 0, 4});
  s.add({4, 1, 0});  // leaves the edges of 4 open: only those on the line are looked at
  ASSERT_TRUE(drop(s));
  ASSERT_EQ(s.faces.size(), 5u);
  EXPECT_EQ(s.faces[0].loops[0], (Loop{2, 1, 4}));
  EXPECT_EQ(s.faces[1].loops[0], (Loop{0, 1, 2, 4}));
  EXPECT_EQ(s.faces[2].loops[0], (Loop{1, 3, 4}));
  EXPECT_EQ(s.faces[3].loops[0], (Loop{3, 1, 0, 4}));
}

}  // namespace
}  // namespace csgrun::test::loop_faces_test
