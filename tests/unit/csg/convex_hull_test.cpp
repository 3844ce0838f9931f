// Hulls of grid points against what makes a hull a hull: all points behind all faces, exactly.
#include "engine/csg/convex_hull.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "engine/exact/fixed_int.h"

namespace csgrun::convex_hull_test {
namespace {

using Vec = std::array<Int128, 3>;

Vec minus(const IVec3& a, const IVec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Int128 dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
/// The sign of the part of `v` along `normal`, to which it is parallel (the product might not fit).
int sense(const Vec& normal, const Vec& v) {
  for (int i = 0; i < 3; ++i) {
    if (normal[i] != 0) return v[i] == 0 ? 0 : (v[i] > 0) == (normal[i] > 0) ? 1 : -1;
  }
  return 0;
}
bool is_zero(const Vec& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

/// Whether points do not lie in one plane.
bool spans_space(const std::vector<IVec3>& points) {
  for (const IVec3& b : points) {
    for (const IVec3& c : points) {
      const Vec n = cross(minus(b, points[0]), minus(c, points[0]));
      if (is_zero(n)) continue;
      for (const IVec3& d : points) {
        if (dot(n, minus(d, points[0])) != 0) return true;
      }
      return false;  // all are in the plane of three that are not on a line
    }
  }
  return false;
}

/// Every face has all points behind it or in it, is strictly convex, and holds all points of its
/// plane; every edge has two faces; vertices are points.
void expect_hull(const LeafGeometry& hull, const std::vector<IVec3>& points) {
  const std::set<IVec3> given(points.begin(), points.end());
  for (const IVec3& v : hull.vertices) EXPECT_TRUE(given.contains(v));
  EXPECT_EQ(std::set<IVec3>(hull.vertices.begin(), hull.vertices.end()).size(),
            hull.vertices.size());
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (size_t f = 0; f < hull.face_count(); ++f) {
    const uint32_t* loop = &hull.corners[hull.face_starts[f]];
    const uint32_t n = hull.face_starts[f + 1] - hull.face_starts[f];
    ASSERT_GE(n, 3u);
    const auto at = [&](uint32_t i) { return hull.vertices[loop[i % n]]; };
    const Vec normal = cross(minus(at(1), at(0)), minus(at(2), at(0)));
    ASSERT_FALSE(is_zero(normal));
    for (const IVec3& p : points) ASSERT_LE(dot(normal, minus(p, at(0))), 0);
    for (uint32_t i = 0; i < n; ++i) {
      EXPECT_EQ(dot(normal, minus(at(i), at(0))), 0);
      const Vec edge = minus(at(i + 1), at(i));
      EXPECT_GT(sense(normal, cross(edge, minus(at(i + 2), at(i)))), 0);  // turns left
      for (const IVec3& p : points) {
        if (dot(normal, minus(p, at(0))) == 0) {
          EXPECT_GE(sense(normal, cross(edge, minus(p, at(i)))), 0);
        }
      }
      ++edges[{loop[i], loop[(i + 1) % n]}];
    }
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
  const auto faces = static_cast<int64_t>(hull.face_count());
  EXPECT_EQ(
      static_cast<int64_t>(hull.vertices.size()) - static_cast<int64_t>(edges.size() / 2) + faces,
      2);
  EXPECT_EQ(hull.opposite.size(), hull.corners.size());
}

TEST(ConvexHull, OfAFullGridIsACube) {
  std::vector<IVec3> points;
  for (int i = 0; i < 125; ++i) points.push_back({i % 5, i / 5 % 5, i / 25});
  const LeafGeometry hull = convex_hull(points);
  EXPECT_EQ(hull.vertices.size(), 8u);
  EXPECT_EQ(hull.face_count(), 6u);
  expect_hull(hull, points);
}

TEST(ConvexHull, SmallGridsFullOfCoincidences) {
  std::mt19937 random(1);
  int solid = 0;
  for (int round = 0; round < 3000; ++round) {
    const int side = 2 + static_cast<int>(random() % 4),
              count = 1 + static_cast<int>(random() % 40);
    std::vector<IVec3> points;
    for (int i = 0; i < count; ++i) {
      const auto one = [&] { return static_cast<int64_t>(random() % static_cast<uint64_t>(side)); };
      points.push_back({one(), one(), one()});
    }
    const LeafGeometry hull = convex_hull(points);
    ASSERT_EQ(hull.face_count() > 0, spans_space(points)) << round;
    if (hull.face_count() == 0) continue;
    ++solid;
    expect_hull(hull, points);
    std::shuffle(points.begin(), points.end(), random);
    points.push_back(points[0]);
    const LeafGeometry again = convex_hull(points);
    EXPECT_EQ(again.vertices, hull.vertices);
    EXPECT_EQ(again.corners, hull.corners);
    EXPECT_EQ(again.face_starts, hull.face_starts);
  }
  EXPECT_GT(solid, 2000);
}

TEST(ConvexHull, BallsOfAllSizes) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (const double radius : {10.0, 1e4, 1e8, 0x1p39}) {
    std::vector<IVec3> points;
    for (int i = 0; i < 300; ++i) {
      const double x = normal(random), y = normal(random), z = normal(random);
      const double scale = radius / std::sqrt(x * x + y * y + z * z);
      points.push_back({std::llround(x * scale), std::llround(y * scale), std::llround(z * scale)});
    }
    expect_hull(convex_hull(points), points);
  }
}

TEST(ConvexHull, WhatIsFlatIsNone) {
  EXPECT_EQ(convex_hull({}).face_count(), 0u);
  std::vector<IVec3> points{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {-5, -10, -15}};
  EXPECT_EQ(convex_hull(points).face_count(), 0u);  // on a line
  points.push_back({1, 0, 0});
  EXPECT_EQ(convex_hull(points).face_count(), 0u);  // in a plane
  points.push_back({0, 0, 1});
  EXPECT_GT(convex_hull(points).face_count(), 0u);
}

}  // namespace
}  // namespace csgrun::convex_hull_test
