#include "engine/mesh/triangulate.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/mesh/planar_faces.h"

namespace csgrun::test::triangulate_test {
namespace {

const FlatPoint kSweeps[][2] = {{{1, 0}, {0, 1}},  {{1, 0}, {0, -1}}, {{0, 1}, {1, 0}},
                                {{-1, 0}, {0, 1}}, {{3, 1}, {0, 1}},  {{-2, 5}, {1, 1}}};

void check(const std::vector<FlatLoop>& loops, const std::vector<FlatPoint>& points,
           const char* what) {
  for (const auto& sweep : kSweeps) {
    const auto result = triangulate_face(loops, GridOracle(points, sweep[0], sweep[1]));
    ASSERT_TRUE(result) << what << ": " << result.error().message;
    const char* found = fault(loops, points, *result);
    ASSERT_EQ(found, nullptr) << what << ": " << found;
  }
}

/// A loop of distinct points, as points and face.
void check_polygon(const std::vector<FlatPoint>& points, const char* what) {
  FlatLoop loop(points.size());
  for (uint32_t i = 0; i < loop.size(); ++i) loop[i] = i;
  check({loop}, points, what);
}

TEST(Triangulate, Triangle) { check_polygon({{0, 0}, {1, 0}, {0, 1}}, "triangle"); }

TEST(Triangulate, CollinearRuns) {
  for (int n = 1; n < 12; ++n) {
    std::vector<FlatPoint> points;
    for (int i = 0; i < n; ++i) points.push_back({i, 0});
    points.push_back({n, 0});
    points.push_back({n + 3, 5});
    check_polygon(points, "triangle with one long run");
    points.clear();
    for (int i = 0; i < n; ++i) points.push_back({i, 0});
    for (int i = 0; i < n; ++i) points.push_back({n, i});
    for (int i = 0; i < n; ++i) points.push_back({n - i, n});
    for (int i = 0; i < n; ++i) points.push_back({0, n - i});
    check_polygon(points, "square with runs");
    points.clear();
    for (int i = 0; i < n; ++i) points.push_back({2 * i, i});
    for (int i = 0; i < n; ++i) points.push_back({2 * n - i, n + i});
    for (int i = 0; i < n; ++i) points.push_back({n - i, 2 * n - 2 * i});
    check_polygon(points, "triangle with runs");
  }
}

TEST(Triangulate, RandomPatches) {
  std::mt19937 random(7);
  size_t with_holes = 0, touching = 0;
  for (int round = 0; round < 3000; ++round) {
    const int n = 3 + static_cast<int>(random() % 8);
    const auto points = grid_points(n);
    const auto triangles = random_triangulation(n, points, 40 * n * n, random);
    const auto loops =
        random_patch(triangles, 0.4 + 0.1 * static_cast<double>(random() % 6), random);
    with_holes += loops.size() > 1;
    std::set<uint32_t> seen;
    size_t corners = 0;
    for (const FlatLoop& loop : loops)
      seen.insert(loop.begin(), loop.end()), corners += loop.size();
    touching += corners > seen.size();
    check(loops, points, "patch");
    if (HasFatalFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(with_holes, 500u);
  EXPECT_GT(touching, 500u);
}

TEST(Triangulate, UnionsOfSquares) {
  std::mt19937 random(11);
  for (int round = 0; round < 60; ++round) {
    const int n = 30;
    const auto points = grid_points(n);
    const auto loops = random_patch(random_triangulation(n, points, 0, random),
                                    0.62 + 0.05 * static_cast<double>(random() % 7), random);
    check(loops, points, "squares");
  }
}

TEST(Triangulate, DoesNotDependOnHowTheLoopsAreGiven) {
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    const auto points = grid_points(8);
    auto loops = random_patch(random_triangulation(8, points, 2000, random), 0.8, random);
    const GridOracle oracle(points, {5, 3}, {0, 1});
    const auto expected = triangulate_face(loops, oracle);
    ASSERT_TRUE(expected);
    std::shuffle(loops.begin(), loops.end(), random);
    for (FlatLoop& loop : loops) {
      std::rotate(loop.begin(), loop.begin() + static_cast<long>(random() % loop.size()),
                  loop.end());
    }
    const auto got = triangulate_face(loops, oracle);
    ASSERT_TRUE(got);
    ASSERT_EQ(*expected, *got);

    // Nor on the numbers of the points.
    std::vector<uint32_t> rename(points.size());
    for (uint32_t i = 0; i < rename.size(); ++i) rename[i] = i;
    std::shuffle(rename.begin(), rename.end(), random);
    std::vector<FlatPoint> moved(points.size());
    for (uint32_t i = 0; i < rename.size(); ++i) moved[rename[i]] = points[i];
    for (FlatLoop& loop : loops) {
      for (uint32_t& v : loop) v = rename[v];
    }
    auto renamed = *expected;
    for (auto& t : renamed) {
      for (uint32_t& v : t) v = rename[v];
    }
    const auto again = triangulate_face(loops, GridOracle(moved, {5, 3}, {0, 1}));
    ASSERT_TRUE(again);
    ASSERT_EQ(renamed, *again);
  }
}

TEST(Triangulate, HolesChainedByTouchingCorners) {
  // A row of diamond holes, each touching the next, the first and last touching the outer loop.
  const int holes = 9;
  std::vector<FlatPoint> points{{0, -5},        {4 * holes, -5}, {4 * holes, 0},
                                {4 * holes, 5}, {0, 5},          {0, 0}};
  std::vector<FlatLoop> loops{{0, 1, 2, 3, 4, 5}};
  uint32_t left = 5;
  for (int i = 0; i < holes; ++i) {
    const auto base = static_cast<uint32_t>(points.size());
    points.push_back({4 * i + 2, 2});
    points.push_back({4 * i + 2, -2});
    uint32_t right = 2;
    if (i + 1 < holes) {
      right = base + 2;
      points.push_back({4 * i + 4, 0});
    }
    loops.push_back({left, base, right, base + 1});
    left = right;
  }
  check(loops, points, "chained holes");
}

TEST(Triangulate, Slits) {
  // An edge that the face has on both sides: hanging from the outer loop, and free inside.
  const std::vector<FlatPoint> points{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {4, 4}, {5, 5}, {6, 5}};
  check({{0, 1, 2, 3}, {4, 5}}, points, "free slit");
  check({{0, 4, 0, 1, 2, 3}}, points, "hanging slit");
  check({{0, 4, 5, 4, 0, 1, 2, 3}}, points, "slit of two edges");
  check({{0, 1, 2, 3}, {4, 5, 6, 5}}, points, "bent slit");
}

TEST(Triangulate, CombsSpiralsStars) {
  std::vector<FlatPoint> comb;
  for (int i = 0; i < 200; ++i) comb.push_back({10 * i, 0}), comb.push_back({10 * i + 5, i % 7});
  comb.push_back({2000, 0});
  comb.push_back({2000, 100});
  for (int i = 199; i >= 0; --i)
    comb.push_back({10 * i + 5, 20 + i % 11}), comb.push_back({10 * i, 100});
  check_polygon(comb, "comb");

  std::vector<FlatPoint> in, out;
  for (int i = 0; i < 40; ++i) {
    const int64_t r = 4 * i + 4;
    const FlatPoint corner[4] = {{-r, -r}, {r, -r}, {r, r}, {-r - 4, r}};
    for (const FlatPoint& p : corner) out.push_back(p);
    const FlatPoint inner[4] = {{-r + 2, -r + 2}, {r - 2, -r + 2}, {r - 2, r - 2}, {-r - 2, r - 2}};
    for (const FlatPoint& p : inner) in.push_back(p);
  }
  std::vector<FlatPoint> spiral = out;
  spiral.insert(spiral.end(), in.rbegin(), in.rend());
  FlatLoop loop(spiral.size());
  for (uint32_t i = 0; i < loop.size(); ++i) loop[i] = i;
  ASSERT_GT(twice_area({loop}, spiral), 0);
  check({loop}, spiral, "spiral");

  std::vector<FlatPoint> star;
  for (int i = 0; i < 500; ++i) {
    const double angle = 2 * M_PI * i / 500, r = i % 2 ? 1e6 : 1e5 + 3e3 * (i % 13);
    star.push_back({std::llround(r * std::cos(angle)), std::llround(r * std::sin(angle))});
  }
  check_polygon(star, "star");
}

TEST(Triangulate, Large) {
  std::vector<FlatPoint> points;
  for (int i = 0; i < 25000; ++i) points.push_back({2 * i, i % 2 ? 900 - i % 50 : 0});
  for (int i = 24999; i >= 0; --i) points.push_back({2 * i + 1, i % 2 ? 1000 : 901 + (i * 7) % 90});
  FlatLoop loop(points.size());
  for (uint32_t i = 0; i < loop.size(); ++i) loop[i] = i;
  check({loop}, points, "long comb");
}

TEST(Triangulate, RefusesWhatIsNoFace) {
  const std::vector<FlatPoint> points{{0, 0}, {4, 0}, {4, 4}, {0, 4},
                                      {2, 0}, {1, 1}, {0, 0}, {9, 1}};
  const GridOracle oracle(points);
  const std::vector<std::vector<FlatLoop>> bad{
      {},                         // nothing
      {{0, 1}},                   // two corners
      {{0, 1, 4}},                // flat
      {{3, 2, 1, 0}},             // clockwise
      {{0, 1, 1, 2, 3}},          // a corner twice in a row
      {{0, 1, 3, 2}},             // crosses itself
      {{0, 1, 2, 3}, {4, 5, 3}},  // a hole whose corner lies on an edge
      {{0, 1, 2, 3, 6, 5}},       // two numbers for one point
      {{0, 1, 2, 3}, {5, 7, 4}},  // a hole that reaches out
  };
  for (size_t i = 0; i < bad.size(); ++i) {
    const auto result = triangulate_face(bad[i], oracle);
    ASSERT_FALSE(result) << "case " << i;
    EXPECT_EQ(result.error().code, ErrorCode::kInternal);
  }
}

// What one face leaves behind, also one that was refused half way, is nothing to the next.
TEST(Triangulate, OneAfterAnotherAsEachByItself) {
  std::mt19937 random(11);
  const auto points = grid_points(8);
  const GridOracle oracle(points, {5, 3}, {0, 1});
  Triangulator triangulator;
  std::vector<std::array<uint32_t, 3>> got;
  size_t refused = 0, larger = 0;
  for (int round = 0; round < 400; ++round) {
    auto loops = random_patch(random_triangulation(8, points, 2000, random),
                              0.3 + 0.1 * static_cast<double>(random() % 7), random);
    if (round % 5 == 4) std::swap(loops[0][0], loops[0][loops[0].size() / 2]);
    const auto expected = triangulate_face(loops, oracle);
    const auto status = triangulator.face(loops, oracle, got);
    ASSERT_EQ(status.has_value(), expected.has_value()) << "round " << round;
    if (expected) {
      ASSERT_EQ(got, *expected) << "round " << round;
      larger += loops.size() > 1;
    } else {
      ++refused;
      EXPECT_EQ(status.error().message, expected.error().message);
    }
  }
  EXPECT_GT(refused, 20u);
  EXPECT_GT(larger, 50u);
}

}  // namespace
}  // namespace csgrun::test::triangulate_test
