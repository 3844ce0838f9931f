// Exact questions about triangles over doubles, against rationals: sums, signs, and crossings by
// clipping one triangle with the other.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <csgrun/engine/exact_triangles.h>

#include "engine/base/parallel.h"
#include "engine/mesh/crossing_test.h"
#include "engine/mesh/exact_sum.h"
#include "tests/support/rationals.h"

namespace csgrun::testing::exact_triangles_test {
namespace {

using boost::multiprecision::cpp_rational;

double random_double(std::mt19937_64& random, int spread) {
  const auto mantissa = static_cast<double>(static_cast<int64_t>(random() >> (random() % 60))) *
                        (random() % 2 ? 1 : -1);
  return std::ldexp(mantissa,
                    static_cast<int>(random() % static_cast<uint64_t>(2 * spread + 1)) - spread);
}

TEST(ExactSum, AgreesWithRationals) {
  std::mt19937_64 random(1);
  int zeros = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    ExactSum sum;
    cpp_rational expected = 0;
    const int spread = trial % 3 == 0 ? 0 : trial % 3 == 1 ? 30 : 250;
    std::vector<std::array<double, 3>> terms;
    for (int i = 0; i < 1 + trial % 7; ++i) {
      terms.push_back({random_double(random, spread), random_double(random, spread),
                       random_double(random, spread)});
    }
    for (const auto& [x, y, z] : terms) {
      sum.add(x, y, z);
      expected += rational(x) * rational(y) * rational(z);
    }
    if (trial % 5 == 0) {  // takes everything back, in another order
      for (const auto& [x, y, z] : terms) sum.add(z, x, y, true);
      expected = 0;
      ++zeros;
    }
    EXPECT_EQ(sum.sign(), expected.sign());
    EXPECT_TRUE(is_nearest(expected / 6, sum.divided(6)));
  }
  EXPECT_EQ(zeros, 600);
}

TEST(ExactSum, TiesGoToEven) {
  for (const double above : {1.0, 1.0 + 0x1p-52}) {
    ExactSum sum;
    sum.add(above, 1, 1);
    sum.add(0x1p-53, 1, 1);
    const cpp_rational exact = rational(above) + rational(0x1p-53);
    EXPECT_TRUE(is_nearest(exact, sum.divided(1)));
    sum.add(0x1p-300, 1, 1);
    EXPECT_EQ(sum.divided(1), above + 0x1p-52);
  }
}

TEST(Orient, AgreesWithRationalsAlsoNearAndAtZero) {
  std::mt19937_64 random(2);
  int zeros = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const auto coordinate = [&] {
      return trial % 2 == 0 ? static_cast<double>(random() % 4)
                            : 12.0 + std::ldexp(static_cast<double>(random() % 5), -50);
    };
    std::array<glm::dvec3, 4> p;
    for (auto& point : p) point = {coordinate(), coordinate(), coordinate()};
    std::array<std::array<cpp_rational, 3>, 3> m;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) m[i][k] = rational(p[i + 1][k]) - rational(p[0][k]);
    }
    const cpp_rational determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                                     m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                                     m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    zeros += determinant.sign() == 0 ? 1 : 0;
    EXPECT_EQ(orient(p[0], p[1], p[2], p[3]), determinant.sign());
    const cpp_rational area = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    EXPECT_EQ(orient_along(2, p[0], p[1], p[2]), area.sign());
  }
  EXPECT_GT(zeros, 400);
}

using Rational3 = std::array<cpp_rational, 3>;
using Triangle = std::array<uint32_t, 3>;

Rational3 minus(const Rational3& a, const Rational3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Rational3 cross(const Rational3& a, const Rational3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
cpp_rational dot(const Rational3& a, const Rational3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// What of a convex polygon (or segment, or point) lies where normal . (p - origin) >= 0.
std::vector<Rational3> clipped(const std::vector<Rational3>& polygon, const Rational3& origin,
                               const Rational3& normal) {
  std::vector<Rational3> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Rational3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const cpp_rational at_p = dot(normal, minus(p, origin)), at_q = dot(normal, minus(q, origin));
    if (at_p >= 0) kept.push_back(p);
    if (at_p.sign() * at_q.sign() < 0) {
      const cpp_rational part = at_p / (at_p - at_q);
      Rational3 cut;
      for (int k = 0; k < 3; ++k) cut[k] = p[k] + part * (q[k] - p[k]);
      kept.push_back(cut);
    }
  }
  return kept;
}

/// The corners of the intersection of two triangles with area.
std::vector<Rational3> intersection(const std::array<Rational3, 3>& s,
                                    const std::array<Rational3, 3>& t) {
  std::vector<Rational3> polygon(t.begin(), t.end());
  const Rational3 normal = cross(minus(s[1], s[0]), minus(s[2], s[0]));
  const Rational3 reverse = minus({0, 0, 0}, normal);
  polygon = clipped(clipped(polygon, s[0], normal), s[0], reverse);
  for (int i = 0; i < 3; ++i)
    polygon = clipped(polygon, s[i], cross(normal, minus(s[(i + 1) % 3], s[i])));
  return polygon;
}

/// The crossings as the definition has them: every pair, and points beyond what both have by
/// number.
std::vector<std::array<uint32_t, 2>> all_crossings(const std::vector<glm::dvec3>& points,
                                                   const std::vector<Triangle>& triangles) {
  std::vector<std::array<Rational3, 3>> exact;
  for (const Triangle& t : triangles) {
    exact.emplace_back();
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) exact.back()[i][k] = rational(points[t[i]][k]);
    }
  }
  const auto has_area = [&](uint32_t i) {
    return cross(minus(exact[i][1], exact[i][0]), minus(exact[i][2], exact[i][0])) !=
           Rational3{0, 0, 0};
  };
  std::vector<std::array<uint32_t, 2>> found;
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    for (uint32_t j = i + 1; j < triangles.size(); ++j) {
      if (!has_area(i) || !has_area(j)) continue;
      std::vector<Rational3> shared;
      for (int k = 0; k < 3; ++k) {
        for (const uint32_t other : triangles[j]) {
          if (triangles[i][k] == other) shared.push_back(exact[i][k]);
        }
      }
      bool crosses = shared.size() == 3;
      for (const Rational3& p : intersection(exact[i], exact[j])) {
        if (shared.size() == 1) {
          crosses = crosses || p != shared[0];
        } else if (shared.size() == 2) {
          crosses = crosses ||
                    cross(minus(p, shared[0]), minus(shared[1], shared[0])) != Rational3{0, 0, 0};
        } else {
          crosses = true;
        }
      }
      if (crosses) found.push_back({i, j});
    }
  }
  return found;
}

TEST(Crossings, OfRandomSoupsAgreeWithRationalClipping) {
  std::mt19937_64 random(3);
  size_t crossings = 0, pairs = 0;
  for (int trial = 0; trial < 300; ++trial) {
    // On a tiny lattice nearly everything touches; far out, floats are coarse and differences
    // inexact.
    const double step = trial % 3 == 0 ? 1 : trial % 3 == 1 ? 0x1p-14 : 0.1;
    const double base = trial % 3 == 0 ? 0 : 1000.0 / 3;
    const uint64_t extent = 2 + random() % 4;
    std::vector<glm::dvec3> points;
    while (points.size() < 9) {
      glm::dvec3 p;
      for (int k = 0; k < 3; ++k) p[k] = base + step * static_cast<double>(random() % extent);
      if (std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
      if (extent == 2 && points.size() == 8) break;
    }
    std::vector<Triangle> triangles;
    while (triangles.size() < 8) {
      Triangle t;
      for (uint32_t& corner : t) corner = static_cast<uint32_t>(random() % points.size());
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
    }
    // Near the ends of double's range everything is as it is in the middle.
    if (trial % 12 == 0)
      for (glm::dvec3& p : points) p *= 0x1p-1074;
    if (trial % 12 == 3)
      for (glm::dvec3& p : points) p *= 0x1p1021;
    std::vector<std::array<uint32_t, 2>> found;
    const TriangleView mesh{points, triangles};
    for (const TriangleCrossing& crossing : find_crossings(mesh, 1000)) {
      found.push_back(crossing.triangles);
      // The place lies on both, but for roundings and overflow.
      if (trial % 12 == 3) continue;
      for (const uint32_t t : crossing.triangles) {
        for (int k = 0; k < 3; ++k) {
          double low = 1e308, high = -1e308;
          for (const uint32_t corner : triangles[t]) {
            low = std::min(low, points[corner][k]);
            high = std::max(high, points[corner][k]);
          }
          EXPECT_GE(crossing.place[k], low - 1e-9);
          EXPECT_LE(crossing.place[k], high + 1e-9);
        }
      }
    }
    EXPECT_EQ(found, all_crossings(points, triangles)) << "trial " << trial;
    EXPECT_EQ(find_crossings(mesh, 3).size(), std::min<size_t>(3, found.size()));
    crossings += found.size();
    pairs += 28;
  }
  EXPECT_GT(crossings, pairs / 5);
  EXPECT_LT(crossings, pairs * 4 / 5);
}

/// Many triangles, searched in parts: the pairs are those of any two by themselves, in order, on
/// any number of threads, and what is left out beyond a limit comes last.
using Pairs = std::vector<std::array<uint32_t, 2>>;

Pairs pairs_of(std::span<const TriangleCrossing> crossings) {
  Pairs result;
  for (const TriangleCrossing& c : crossings) result.push_back(c.triangles);
  return result;
}

/// By looking at all pairs.
Pairs crossing_pairs(const TriangleView& mesh) {
  const CrossingTest test(mesh);
  Pairs result;
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    for (uint32_t j = i + 1; j < mesh.triangles.size(); ++j) {
      if (!test.has_area(i) || !test.has_area(j)) continue;
      if (test.crossing(i, j)) result.push_back({i, j});
    }
  }
  return result;
}

TEST(Crossings, OfManyAreThoseOfTwoByTwo) {
  std::mt19937_64 random(9);
  constexpr uint32_t kCount = 900;
  std::vector<glm::dvec3> points;
  std::vector<Triangle> triangles;
  const auto coordinate = [&](int range) { return 0.25 * static_cast<double>(random() % range); };
  for (uint32_t t = 0; t < kCount; ++t) {
    const glm::dvec3 at(coordinate(40), coordinate(40), coordinate(40));
    for (int k = 0; k < 3; ++k) {
      points.push_back(at + glm::dvec3(coordinate(9), coordinate(9), coordinate(9)));
    }
    // Some have a corner of the one before.
    const uint32_t first = t > 0 && random() % 3 == 0 ? 3 * t - 1 : 3 * t;
    triangles.push_back({first, 3 * t + 1, 3 * t + 2});
  }
  const Pairs expected = crossing_pairs({points, triangles});
  EXPECT_GT(expected.size(), 500u);
  const auto pairs = [&](uint64_t most, unsigned threads) {
    return pairs_of(with_threads(threads, [&] {
      return find_crossings({points, triangles}, most);
    }));
  };
  for (const unsigned threads : {1u, 2u, 5u}) {
    EXPECT_EQ(pairs(1000000, threads), expected);
    for (const size_t most : {size_t{0}, size_t{1}, size_t{17}, expected.size() / 2,
                              expected.size() - 1, expected.size()}) {
      const Pairs wanted(expected.begin(), expected.begin() + static_cast<long>(most));
      EXPECT_EQ(pairs(most, threads), wanted);
    }
  }
}

/// Long triangles side by side, and the same turned: by whole numbers, so that nothing is rounded.
TEST(Crossings, OfLongTrianglesAreTheSameAslant) {
  std::mt19937_64 random(2);
  const auto whole = [&](int range) { return static_cast<double>(random() % range); };
  std::vector<glm::dvec3> upright, aslant;
  std::vector<Triangle> triangles;
  for (uint32_t t = 0; t < 700; ++t) {
    const double y = whole(60), z = whole(60);
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 p(whole(4000), y + whole(3), z + whole(3));
      upright.push_back(p);
      aslant.emplace_back(2 * p.x + 10 * p.y + 11 * p.z, 14 * p.x - 5 * p.y + 2 * p.z,
                          5 * p.x + 10 * p.y - 10 * p.z);
    }
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const auto pairs = [&](std::span<const glm::dvec3> points) {
    return pairs_of(find_crossings({points, triangles}, 1000000));
  };
  EXPECT_GT(pairs(upright).size(), 100u);
  EXPECT_EQ(pairs(aslant), pairs(upright));
}

/// Needles in fans and by themselves, in three directions, far from the origin or not, of any size.
TEST(Crossings, OfLongTrianglesAreThoseOfAllPairs) {
  size_t found = 0, near = 0;
  for (unsigned round = 0; round < 24; ++round) {
    std::mt19937_64 random(70 + round);
    const auto number = [&](double size) {
      return size * (static_cast<double>(random() % 2001) / 1000 - 1);
    };
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 5) * 150 - 300);
    const glm::dvec3 move =
        round % 2 == 0 ? glm::dvec3(0) : glm::dvec3(number(1e5), number(1e5), number(1e5));
    const std::array<glm::dvec3, 3> directions{{{1, 2, 3}, {-3, 1, 0.5}, {0, -1, 2}}};
    std::vector<glm::dvec3> points;
    std::vector<Triangle> triangles;
    for (int fan = 0; fan < 60; ++fan) {
      const glm::dvec3 way = directions[static_cast<size_t>(fan % 3)];
      const glm::dvec3 hub(number(20), number(20), number(20));
      const auto first = static_cast<uint32_t>(points.size());
      points.push_back(hub * scale + move * scale);
      for (int i = 0; i < 7; ++i) {
        const glm::dvec3 p = hub + way * 90.0 + glm::dvec3(number(1), number(1), number(1));
        points.push_back(p * scale + move * scale);
        if (i > 0)
          triangles.push_back(
              {first, first + static_cast<uint32_t>(i), first + static_cast<uint32_t>(i) + 1});
      }
    }
    const TriangleView mesh{points, triangles};
    const Pairs expected = crossing_pairs(mesh);
    EXPECT_EQ(pairs_of(find_crossings(mesh, 1000000)), expected) << round;
    found += expected.size();
    near += triangles.size() * (triangles.size() - 1) / 2;
  }
  EXPECT_GT(found, 2000u);
  EXPECT_GT(near, 50 * found);
}

TEST(Crossings, OfSomeAreAllThatThereAreIfTheyAreInAll) {
  std::mt19937_64 random(31);
  size_t asked = 0, all = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<glm::dvec3> points;
    std::vector<Triangle> triangles;
    const auto coordinate = [&](int range) { return 0.25 * static_cast<double>(random() % range); };
    for (uint32_t t = 0; t < 400; ++t) {
      const glm::dvec3 at(coordinate(60), coordinate(60), coordinate(60));
      for (int k = 0; k < 3; ++k) {
        points.push_back(at + glm::dvec3(coordinate(7), coordinate(7), coordinate(7)));
      }
      triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    const TriangleView mesh{points, triangles};
    const std::vector<TriangleCrossing> expected = find_crossings(mesh, 1000000);
    // Of each pair one, or both, and a few that are in none.
    std::vector<uint32_t> some;
    for (const TriangleCrossing& c : expected) some.push_back(c.triangles[random() % 2]);
    for (int i = 0; i < 20; ++i) some.push_back(static_cast<uint32_t>(random() % 400));
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
    const auto same = [](const TriangleCrossing& a, const TriangleCrossing& b) {
      return a.triangles == b.triangles && a.place == b.place;
    };
    for (const size_t most :
         {expected.size() + 1, expected.size(), expected.size() / 2, size_t{0}}) {
      const std::vector<TriangleCrossing> got = find_crossings(mesh, most, some);
      ASSERT_EQ(got.size(), std::min(most, expected.size()));
      EXPECT_TRUE(std::equal(got.begin(), got.end(), expected.begin(), same)) << round;
    }
    asked += some.size();
    all += triangles.size();
  }
  EXPECT_LT(asked, all / 2);
}

TEST(Crossings, OfSingleTrianglesWhileSomeChange) {
  std::mt19937_64 random(37);
  std::vector<glm::dvec3> points;
  std::vector<Triangle> triangles;
  const auto coordinate = [&](int range) { return 0.25 * static_cast<double>(random() % range); };
  for (uint32_t t = 0; t < 1000; ++t) {
    const glm::dvec3 at(coordinate(60), coordinate(60), coordinate(60));
    for (int k = 0; k < 3; ++k) {
      points.push_back(at + glm::dvec3(coordinate(7), coordinate(7), coordinate(7)));
    }
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const std::vector<Triangle> first = triangles;
  LocalCrossings local({points, triangles});
  size_t found = 0;
  for (int round = 0; round < 15; ++round) {
    for (int i = 0; round > 0 && i < 100; ++i) {
      const auto t = static_cast<uint32_t>(random() % triangles.size());
      // Some come back, and some lose their area.
      triangles[t] = i % 3 == 0 ? first[t] : first[random() % triangles.size()];
      if (i % 10 == 1) triangles[t][1] = triangles[t][0];
      local.changed(t);
    }
    const Pairs expected = crossing_pairs({points, triangles});
    Pairs got;
    for (uint32_t t = 0; t < triangles.size(); ++t) {
      const std::vector<uint32_t> crossed = local.of(t);
      EXPECT_TRUE(std::is_sorted(crossed.begin(), crossed.end()));
      for (const uint32_t other : crossed) {
        const std::vector<uint32_t> back = local.of(other);
        EXPECT_TRUE(std::binary_search(back.begin(), back.end(), t));
        if (t < other) got.push_back({t, other});
      }
    }
    EXPECT_EQ(got, expected) << round;
    found += got.size();
  }
  EXPECT_GT(found, 2000u);
}

TEST(Facing, AgreesWithRationals) {
  std::mt19937_64 random(4);
  int zeros = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const auto coordinate = [&] {
      return trial % 2 == 0 ? static_cast<double>(random() % 4)
                            : 12.0 + std::ldexp(static_cast<double>(random() % 5), -50);
    };
    std::vector<glm::dvec3> p(3);
    std::array<Rational3, 3> exact;
    for (int i = 0; i < 3; ++i) {
      p[i] = {coordinate(), coordinate(), coordinate()};
      for (int k = 0; k < 3; ++k) exact[i][k] = rational(p[i][k]);
    }
    const glm::dvec3 direction(random_double(random, 0), random() % 3 == 0 ? 0 : 1, trial % 3 - 1);
    const Rational3 normal = cross(minus(exact[1], exact[0]), minus(exact[2], exact[0]));
    const cpp_rational expected =
        dot(normal, {rational(direction.x), rational(direction.y), rational(direction.z)});
    const std::vector<Triangle> triangle{{0, 1, 2}};
    EXPECT_EQ(facing({p, triangle}, 0, direction), expected.sign());
    EXPECT_EQ(is_degenerate({p, triangle}, 0), normal == (Rational3{0, 0, 0}));
    zeros += expected.sign() == 0 ? 1 : 0;
  }
  EXPECT_GT(zeros, 100);
}

}  // namespace
}  // namespace csgrun::testing::exact_triangles_test
