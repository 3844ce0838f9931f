#include "engine/mesh/improve_triangles.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/unit/mesh/planar_faces.h"

namespace csgrun::test::improve_triangles_test {
namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

/// Grid points in space, in the plane z = x / 2 + 3, stretched along x so that its metric is
/// theirs.
std::vector<std::array<double, 3>> in_space(const std::vector<FlatPoint>& points) {
  std::vector<std::array<double, 3>> out;
  for (const FlatPoint& p : points) {
    const auto x = static_cast<double>(p[0]) / std::sqrt(1.25);
    out.push_back({x, static_cast<double>(p[1]), x / 2 + 3});
  }
  return out;
}

void improve(const std::vector<FlatLoop>& loops, const std::vector<FlatPoint>& points,
             Triangles& triangles) {
  const auto positions = in_space(points);
  improve_triangles(
      loops, GridOracle(points),
      [&](uint32_t p) -> const std::array<double, 3>& { return positions[p]; }, triangles);
}

/// The angle at `apex` between `a` and `b`.
double angle(const FlatPoint& apex, const FlatPoint& a, const FlatPoint& b) {
  const int64_t dot = (a[0] - apex[0]) * (b[0] - apex[0]) + (a[1] - apex[1]) * (b[1] - apex[1]);
  return std::atan2(static_cast<double>(cross(apex, a, b)), static_cast<double>(dot));
}

/// How many diagonals have opposite angles of clearly more than 180 degrees in all: a point of the
/// other side is inside the circle around their triangle.
size_t not_delaunay(const std::vector<FlatLoop>& loops, const std::vector<FlatPoint>& points,
                    const Triangles& triangles) {
  std::set<std::pair<uint32_t, uint32_t>> fixed;
  for (const FlatLoop& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) fixed.insert({loop[i], loop[(i + 1) % loop.size()]});
  }
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> apex;
  for (const auto& t : triangles) {
    for (int i = 0; i < 3; ++i) apex[{t[i], t[(i + 1) % 3]}] = t[(i + 2) % 3];
  }
  size_t count = 0;
  for (const auto& [edge, c] : apex) {
    const auto [a, b] = edge;
    if (fixed.count(edge)) continue;
    const uint32_t d = apex.at({b, a});
    count += angle(points[c], points[a], points[b]) + angle(points[d], points[b], points[a]) >
             std::acos(-1.0) + 0.04;
  }
  return count;
}

/// Triangulates and improves; all checks that hold for every face.
Triangles check(const std::vector<FlatLoop>& loops, const std::vector<FlatPoint>& points,
                const char* what) {
  auto given = triangulate_face(loops, GridOracle(points));
  if (!given) {
    ADD_FAILURE() << what << ": " << given.error().message;
    return {};
  }
  Triangles improved = *given;
  improve(loops, points, improved);
  const char* found = fault(loops, points, improved);
  EXPECT_EQ(found, nullptr) << what << ": " << found;
  EXPECT_EQ(improved.size(), given->size()) << what;
  EXPECT_TRUE(std::is_sorted(improved.begin(), improved.end())) << what;
  for (const auto& t : improved) EXPECT_EQ(t[0], std::min({t[0], t[1], t[2]})) << what;
  Triangles again = improved;
  improve(loops, points, again);
  EXPECT_EQ(again, improved) << what << ": not idempotent";
  return improved;
}

FlatLoop circular(size_t count) {
  FlatLoop loop(count);
  std::iota(loop.begin(), loop.end(), 0u);
  return loop;
}

TEST(ImproveTriangles, RandomPatchesBecomeDelaunay) {
  std::mt19937 random(23);
  size_t before = 0;
  for (int round = 0; round < 1500 && !testing::Test::HasFailure(); ++round) {
    const int n = 3 + static_cast<int>(random() % 8);
    const auto points = grid_points(n);
    const auto loops = random_patch(random_triangulation(n, points, 40 * n * n, random),
                                    0.4 + 0.1 * static_cast<double>(random() % 6), random);
    const auto given = triangulate_face(loops, GridOracle(points));
    ASSERT_TRUE(given);
    before += not_delaunay(loops, points, *given);
    const Triangles improved = check(loops, points, "patch");
    EXPECT_EQ(not_delaunay(loops, points, improved), 0u) << "round " << round;
  }
  EXPECT_GT(before, 1000u);
}

// Of two triangles the diagonal is flipped if it is clearly the worse one and the other one is
// inside, and never else.
TEST(ImproveTriangles, QuadrilateralsHaveTheBetterDiagonal) {
  std::mt19937 random(31);
  size_t flipped = 0, reflex = 0;
  for (int round = 0; round < 4000; ++round) {
    std::vector<FlatPoint> points(4);
    for (FlatPoint& p : points)
      p = {static_cast<int64_t>(random() % 40), static_cast<int64_t>(random() % 40)};
    FlatLoop loop = circular(4);
    std::shuffle(loop.begin(), loop.end(), random);
    const auto turn = [&](size_t i, size_t j, size_t k) {
      return cross(points[loop[i]], points[loop[j]], points[loop[k]]);
    };
    // The diagonal from the first corner is inside.
    if (turn(0, 1, 2) <= 0 || turn(0, 2, 3) <= 0) continue;
    Triangles given{{loop[0], loop[1], loop[2]}, {loop[0], loop[2], loop[3]}};
    if (random() % 2) std::swap(given[0], given[1]);
    for (auto& t : given) std::rotate(t.begin(), t.begin() + random() % 3, t.end());
    const bool is_convex = turn(3, 0, 1) > 0 && turn(1, 2, 3) > 0;
    const bool is_worse = not_delaunay({loop}, points, given) == 1 && is_convex;
    Triangles improved = given;
    improve({loop}, points, improved);
    EXPECT_EQ(fault({loop}, points, improved), nullptr) << round;
    EXPECT_TRUE(std::is_sorted(improved.begin(), improved.end())) << round;
    for (const auto& t : improved) EXPECT_EQ(t[0], std::min({t[0], t[1], t[2]})) << round;
    const auto has_corner = [&](const auto& t, uint32_t corner) {
      return std::find(t.begin(), t.end(), corner) != t.end();
    };
    const bool has_flipped = !has_corner(improved[0], loop[0]) ||
                             !has_corner(improved[1], loop[0]) ||
                             !has_corner(improved[0], loop[2]) || !has_corner(improved[1], loop[2]);
    EXPECT_TRUE(has_flipped || !is_worse) << round;
    EXPECT_TRUE(!has_flipped || not_delaunay({loop}, points, improved) == 0) << round;
    EXPECT_TRUE(is_convex || !has_flipped) << round;
    flipped += has_flipped;
    reflex += !is_convex;
  }
  EXPECT_GT(flipped, 100u);
  EXPECT_GT(reflex, 100u);
}

TEST(ImproveTriangles, DoesNotDependOnTheOrderOfTriangles) {
  std::mt19937 random(29);
  for (int round = 0; round < 300; ++round) {
    const auto points = grid_points(8);
    auto loops = random_patch(random_triangulation(8, points, 2000, random), 0.8, random);
    const auto given = triangulate_face(loops, GridOracle(points));
    ASSERT_TRUE(given);
    Triangles expected = *given, shuffled = *given;
    improve(loops, points, expected);
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    for (auto& t : shuffled) std::rotate(t.begin(), t.begin() + random() % 3, t.end());
    std::shuffle(loops.begin(), loops.end(), random);
    improve(loops, points, shuffled);
    ASSERT_EQ(expected, shuffled);
  }
}

TEST(ImproveTriangles, TakesTheBetterDiagonalOfAQuadrilateral) {
  const std::vector<FlatPoint> points{{0, 0}, {5, -1}, {10, 0}, {5, 1}};
  const Triangles better{{0, 1, 3}, {1, 2, 3}};
  for (Triangles given : {Triangles{{0, 1, 2}, {0, 2, 3}}, better}) {
    improve({{0, 1, 2, 3}}, points, given);
    EXPECT_EQ(given, better);
  }
}

TEST(ImproveTriangles, KeepsTheDiagonalOfARectangle) {
  const std::vector<FlatPoint> points{{0, 0}, {7, 0}, {7, 3}, {0, 3}};
  for (const Triangles& given :
       {Triangles{{0, 1, 2}, {0, 2, 3}}, Triangles{{0, 1, 3}, {1, 2, 3}}}) {
    Triangles improved = given;
    improve({{0, 1, 2, 3}}, points, improved);
    EXPECT_EQ(improved, given);
  }
}

TEST(ImproveTriangles, KeepsAQuadrilateralThatIsNotConvex) {
  // The other diagonal lies outside, or on the reflex corner's sides.
  for (const FlatPoint& corner : {FlatPoint{5, 1}, FlatPoint{5, 0}}) {
    const std::vector<FlatPoint> points{{0, 0}, corner, {10, 0}, {5, 9}};
    Triangles triangles{{0, 1, 3}, {1, 2, 3}};
    const Triangles given = triangles;
    improve({{0, 1, 2, 3}}, points, triangles);
    EXPECT_EQ(triangles, given);
  }
}

TEST(ImproveTriangles, NearlyStraightChainsGetNoSlivers) {
  // A big box whose sides bulge outwards by a hair: n corners on each, on a parabola.
  const int64_t size = 1'000'000;
  for (const int n : {2, 3, 10, 40}) {
    std::vector<FlatPoint> points;
    const auto side = [&](FlatPoint from, FlatPoint to, FlatPoint out) {
      for (int i = 0; i < n; ++i) {
        const int64_t bulge = i * (n - i);
        points.push_back({from[0] + (to[0] - from[0]) / n * i + out[0] * bulge,
                          from[1] + (to[1] - from[1]) / n * i + out[1] * bulge});
      }
    };
    side({0, 0}, {size, 0}, {0, -1});
    side({size, 0}, {size, size}, {1, 0});
    side({size, size}, {0, size}, {0, 1});
    side({0, size}, {0, 0}, {-1, 0});
    const std::vector<FlatLoop> loops{circular(points.size())};
    const auto height = [&](const std::array<uint32_t, 3>& t) {
      double longest = 0;
      for (int i = 0; i < 3; ++i) {
        const FlatPoint &a = points[t[i]], &b = points[t[(i + 1) % 3]];
        longest = std::max(longest, std::hypot(b[0] - a[0], b[1] - a[1]));
      }
      return static_cast<double>(cross(points[t[0]], points[t[1]], points[t[2]])) / longest;
    };
    // The worst triangulation to start from: ears of three successive corners wherever possible.
    Triangles ears;
    FlatLoop rest = loops[0];
    while (rest.size() > 3) {
      FlatLoop kept;
      for (size_t i = 0; i < rest.size(); ++i) {
        kept.push_back(rest[i]);
        if (i + 2 < rest.size() && rest.size() - i > 2) {
          ears.push_back({rest[i], rest[i + 1], rest[i + 2]}), ++i;
        }
      }
      if (kept.size() == rest.size()) break;
      rest = kept;
    }
    ears.push_back({rest[0], rest[1], rest[2]});
    ASSERT_EQ(fault(loops, points, ears), nullptr);
    ASSERT_LT(height(ears[0]), 100);
    for (Triangles triangles : {check(loops, points, "box"), ears}) {
      improve(loops, points, triangles);
      ASSERT_EQ(fault(loops, points, triangles), nullptr);
      for (const auto& t : triangles) EXPECT_GT(height(t), 0.1 * size / n) << n;
    }
  }
}

TEST(ImproveTriangles, NoiseOnACircleCausesNoFlips) {
  std::vector<FlatPoint> points;
  const size_t count = 200;
  for (size_t i = 0; i < count; ++i) {
    const double at = 2 * std::acos(-1.0) * static_cast<double>(i) / count;
    points.push_back({std::llround(1e8 * std::cos(at)), std::llround(1e8 * std::sin(at))});
  }
  Triangles fan;
  for (uint32_t i = 1; i + 1 < count; ++i) fan.push_back({0, i, i + 1});
  Triangles improved = fan;
  improve({circular(count)}, points, improved);
  EXPECT_EQ(improved, fan);
}

TEST(ImproveTriangles, BothSidesOfASlitStay) {
  // A flat rhombus, slit along its long diagonal, which would be flipped.
  const std::vector<FlatPoint> rhombus{{0, 0}, {5, -1}, {10, 0}, {5, 1}};
  const Triangles halves{{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(check({{0, 1, 2, 3}, {0, 2}}, rhombus, "slit across"), halves);
  EXPECT_EQ(check({{0, 1, 2, 0, 2, 3}}, rhombus, "slit across, one loop"), halves);

  const std::vector<FlatPoint> points{{0, 0},   {5, -1},  {10, 0}, {5, 1},
                                      {-9, -9}, {19, -9}, {19, 9}, {-9, 9}};
  check({{4, 5, 6, 7}, {0, 2}}, points, "free slit");
  check({{4, 0, 4, 5, 6, 7}}, points, "hanging slit");
  check({{4, 0, 2, 0, 4, 5, 6, 7}}, points, "slit of two edges");
  check({{4, 5, 6, 7}, {0, 1, 2, 1}}, points, "bent slit");
}

TEST(ImproveTriangles, ManyHolesStayCheap) {
  // A perforated sheet: the sweep leaves long triangles. Flips end well before the limit, so that
  // all diagonals are good.
  std::mt19937 random(31);
  const auto points = grid_points(60);
  const auto loops = random_patch(random_triangulation(60, points, 0, random), 0.85, random);
  EXPECT_EQ(not_delaunay(loops, points, check(loops, points, "sheet")), 0u);
}

}  // namespace
}  // namespace csgrun::test::improve_triangles_test
