// The working memory of a cell: signs, cuts and orders against rationals, and which tier gave them.
#include "engine/bsp/cell_geometry.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/support/exact_solid.h"
#include "tests/support/gmp_bridge.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun::cell_geometry_test {
namespace {

using test::Rational3;

mpq_class value_at(const Plane& s, const Rational3& p) {
  return test::to_gmp(s.a) * p[0] + test::to_gmp(s.b) * p[1] + test::to_gmp(s.c) * p[2] +
         test::to_gmp(s.d);
}

/// A number of up to so many bits.
Int128 random_bits(test::Random& random, int bits) {
  const UInt128 v = (static_cast<UInt128>(random.bits()) << 64 | random.bits()) >> (128 - bits);
  return random.bits() & 1 ? -static_cast<Int128>(v) : static_cast<Int128>(v);
}

Plane random_plane(test::Random& random, int bits) {
  Plane p;
  while (p.a == 0 && p.b == 0 && p.c == 0) {
    p = {random_bits(random, bits), random_bits(random, bits), random_bits(random, bits),
         random_bits(random, bits + 4)};
  }
  return p;
}

Plane sum(const Plane& p, const Plane& q) { return {p.a + q.a, p.b + q.b, p.c + q.c, p.d + q.d}; }

/// Random planes and the points where three of them meet, each with its rational twin.
class Arrangement {
 public:
  Arrangement(test::Random& random, int count, int bits) : geometry(planes, nullptr) {
    while (planes.size() < static_cast<size_t>(count)) planes.intern(random_plane(random, bits));
    for (int i = 0; i < 4 * count; ++i) {
      std::array<uint32_t, 3> t{};
      for (auto& p : t) p = static_cast<uint32_t>(random.integer(0, count - 1));
      const Plane &p = planes.plane(t[0]), &q = planes.plane(t[1]), &r = planes.plane(t[2]);
      const Rational3 n[3] = {normal(p), normal(q), normal(r)};
      if (test::dot(n[0], test::cross(n[1], n[2])) == 0) continue;
      geometry.add_point(t);
      points.push_back(test::meeting_point(p, q, r));
      // A plane through the point that is none of the three.
      if (i % 4 == 0) planes.intern(sum(p, q));
    }
  }

  static Rational3 normal(const Plane& p) {
    return {test::to_gmp(p.a), test::to_gmp(p.b), test::to_gmp(p.c)};
  }

  PlaneTable planes;
  CellGeometry geometry;
  std::vector<Rational3> points;
};

TEST(CellGeometry, SidesAreExactAndCountedByTheTierThatGaveThem) {
  test::Random random(51);
  SignCounters seen;
  for (const int bits : {2, 6, 13, 14, 15, 25, 40, 55, 80, 100}) {
    Arrangement a(random, 14, bits);
    for (uint32_t p = 0; p < a.points.size(); ++p) {
      const auto named = a.geometry.point(p).planes;
      const Point exact = a.geometry.exact(p);
      for (uint32_t s = 0; s < a.planes.size(); ++s) {
        const Plane& plane = a.planes.plane(s);
        const SignCounters before = a.geometry.counters;
        ASSERT_EQ(a.geometry.side(s, p), sgn(value_at(plane, a.points[p])));
        // One more in one place: by name, by doubles where they are sure, else in the lowest tier
        // that holds the value for certain.
        SignCounters expected = before;
        if (std::count(named.begin(), named.end(), s)) {
          ++expected.symbolic;
        } else if (filter_side(a.planes.approximate(s), a.geometry.point(p).rounded)) {
          ++expected.filter;
        } else {
          ++expected.exact[static_cast<size_t>(exact_tier(plane, exact))];
        }
        const SignCounters& after = a.geometry.counters;
        ASSERT_EQ(after.symbolic, expected.symbolic);
        ASSERT_EQ(after.filter, expected.filter);
        ASSERT_EQ(after.exact, expected.exact);
      }
    }
    seen.add(a.geometry.counters);
  }
  EXPECT_GT(seen.symbolic, 300u);
  EXPECT_GT(seen.filter, 1000u);
  for (const uint64_t n : seen.exact) EXPECT_GT(n, 5u);
  SignCounters none = seen;
  none.subtract(seen);
  EXPECT_EQ(none.symbolic + none.filter, 0u);
  EXPECT_EQ(none.exact, (std::array<uint64_t, 6>{}));
}

TEST(CellGeometry, OrdersPointsAlongAxes) {
  test::Random random(52);
  size_t equal = 0;
  for (const int bits : {1, 2, 40}) {
    Arrangement a(random, 9, bits);
    for (uint32_t p = 0; p < a.points.size(); ++p) {
      for (uint32_t q = 0; q < a.points.size(); ++q) {
        for (int axis = 0; axis < 3; ++axis) {
          const int expected = cmp(a.points[p][axis], a.points[q][axis]);
          ASSERT_EQ(a.geometry.compare_along(p, q, axis), (expected > 0) - (expected < 0));
          equal += p != q && expected == 0;
        }
      }
    }
  }
  EXPECT_GT(equal, 20u);
}

// Apart by less than doubles can say, on every axis.
TEST(CellGeometry, OrdersPointsThatDoublesCannotTellApart) {
  PlaneTable planes;
  constexpr Int128 kScale = Int128{1} << 61;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<uint32_t, 2> wall{};
    for (int upper = 0; upper < 2; ++upper) {
      Plane p{0, 0, 0, -(kScale + upper)};
      (axis == 0 ? p.a : axis == 1 ? p.b : p.c) = 3 * kScale;
      wall[upper] = planes.intern(p).index();
    }
    const uint32_t u = planes.intern({axis != 0, axis == 0, 0, -1}).index();
    const uint32_t v = planes.intern({0, axis == 2, axis != 2, -1}).index();
    CellGeometry geometry(planes, nullptr);
    const uint32_t low = geometry.add_point({wall[0], u, v});
    const uint32_t high = geometry.add_point({wall[1], u, v});
    ASSERT_EQ(geometry.point(low).rounded, geometry.point(high).rounded);
    EXPECT_EQ(geometry.compare_along(low, high, axis), -1);
    EXPECT_EQ(geometry.compare_along(high, low, axis), 1);
    EXPECT_EQ(geometry.compare_along(high, high, axis), 0);
    EXPECT_EQ(geometry.compare_along(high, low, (axis + 1) % 3), 0);
    for (const auto& [from, to] : {std::pair{low, high}, std::pair{high, low}}) {
      const LineAxis way = geometry.axis_between(from, to);
      EXPECT_EQ(way.axis, axis);
      EXPECT_EQ(way.sign, from == low ? 1 : -1);
    }
  }
}

TEST(CellGeometry, AxisBetweenIsTheOneOnWhichDoublesDifferMost) {
  test::Random random(56);
  size_t equal = 0;
  std::array<size_t, 3> chosen{};
  for (const int bits : {1, 2, 40}) {
    Arrangement a(random, 9, bits);
    for (uint32_t p = 0; p < a.points.size(); ++p) {
      for (uint32_t q = 0; q < a.points.size(); ++q) {
        const LineAxis way = a.geometry.axis_between(p, q);
        const auto &from = a.geometry.point(p).rounded, &to = a.geometry.point(q).rounded;
        for (int k = 0; k < 3; ++k) {
          ASSERT_LE(std::fabs(to[k] - from[k]), std::fabs(to[way.axis] - from[way.axis]));
        }
        ASSERT_EQ(way.sign, sgn(mpq_class(a.points[q][way.axis] - a.points[p][way.axis])));
        if (way.sign == 0) {
          ASSERT_EQ(a.points[p], a.points[q]);
          ++equal;
        }
        chosen[static_cast<size_t>(way.axis)] += way.sign != 0;
      }
    }
  }
  EXPECT_GT(equal, 20u);
  for (const size_t n : chosen) EXPECT_GT(n, 50u);
}

TEST(CellGeometry, LineAxisIsTheLongestOfTheCrossProduct) {
  test::Random random(53);
  for (const int bits : {1, 2, 30, 110}) {
    for (int i = 0; i < 200; ++i) {
      const Plane p = random_plane(random, bits), q = random_plane(random, bits);
      const Rational3 d = test::cross(Arrangement::normal(p), Arrangement::normal(q));
      if (d == Rational3{0, 0, 0}) continue;
      const LineAxis line = line_axis(p, q);
      ASSERT_EQ(line.sign, sgn(d[line.axis]));
      for (int k = 0; k < 3; ++k) {
        // By doubles, so nearly.
        ASSERT_LE(std::fabs(d[k].get_d()), std::fabs(d[line.axis].get_d()) * (1 + 0x1p-40));
        // The first of equal ones.
        if (abs(d[k]) == abs(d[line.axis])) {
          ASSERT_GE(k, line.axis);
        }
      }
    }
  }
}

/// Convex polygons of a leaf, cut by random planes, against the signs of their corners.
TEST(CellGeometry, SplitsAlongPlanes) {
  test::Random random(54);
  size_t fronts = 0, backs = 0, ons = 0, splits = 0, touched = 0;
  for (int i = 0; i < 300; ++i) {
    const std::vector<Operand> operands{test::operand_of(test::random_leaf(random))};
    Job job(operands);
    for (uint32_t p = 0; p < job.polygons().size(); ++p) job.ensure_planes(p);
    PlaneTable& planes = job.planes();
    CellGeometry geometry(planes, &job);
    for (uint32_t polygon = 0; polygon < job.polygons().size(); ++polygon) {
      const Fragment f = geometry.load(polygon);
      ASSERT_EQ(f.count, job.corners(job.polygons()[polygon]).size());
      const size_t points = geometry.point_count();
      geometry.load(polygon);
      ASSERT_EQ(geometry.point_count(), points);  // a vertex is one point
      const uint32_t plane =
          random.integer(0, 9) ? planes.intern(random_plane(random, 2)).index() : f.support.index();
      const auto sign = [&](const Fragment& of, uint32_t corner) {
        const Point x = geometry.exact(geometry.corners(of)[corner]);
        return test::gmp_side(planes.plane(plane), test::to_gmp(x));
      };
      size_t positive = 0, negative = 0;
      for (uint32_t c = 0; c < f.count; ++c) {
        positive += sign(f, c) > 0;
        negative += sign(f, c) < 0;
      }
      Fragment front, back;
      geometry.met_plane = false;
      const Side side = geometry.split(f, plane, front, back);
      ASSERT_EQ(geometry.met_plane, positive + negative < f.count);
      if (side != Side::kSplit) {  // once met, it stays so
        geometry.met_plane = true;
        geometry.split(f, plane, front, back);
        ASSERT_TRUE(geometry.met_plane);
      }
      ASSERT_EQ(side, geometry.classify(f, plane));
      if (plane == f.support.index()) {
        ASSERT_EQ(side, Side::kOn);
        ++ons;
        continue;
      }
      if (positive == 0 && negative == 0) continue;  // the support under another name cannot be
      if (positive == 0 || negative == 0) {
        ASSERT_EQ(side, positive ? Side::kFront : Side::kBack);
        ++(positive ? fronts : backs);
        continue;
      }
      ASSERT_EQ(side, Side::kSplit);
      ++splits;
      const size_t on = f.count - positive - negative;
      touched += on > 0;
      // Two corners on the plane are shared: old ones, or new ones in crossed edges.
      ASSERT_EQ(front.count, positive + 2);
      ASSERT_EQ(back.count, negative + 2);
      for (const auto* piece : {&front, &back}) {
        ASSERT_EQ(piece->support, f.support);
        ASSERT_EQ(piece->polygon, f.polygon);
        size_t cut = 0;
        for (uint32_t c = 0; c < piece->count; ++c) {
          const int s = sign(*piece, c);
          ASSERT_NE(s, piece == &front ? -1 : 1);
          // Each edge lies in its plane, and not in the support alone.
          const uint32_t edge = geometry.edges(*piece)[c];
          ASSERT_NE(edge, f.support.index());
          const uint32_t from = geometry.corners(*piece)[c];
          const uint32_t to = geometry.corners(*piece)[c + 1 < piece->count ? c + 1 : 0];
          ASSERT_NE(from, to);
          for (const uint32_t end : {from, to}) {
            const auto x = test::to_gmp(geometry.exact(end));
            ASSERT_EQ(test::gmp_side(planes.plane(edge), x), 0);
            ASSERT_EQ(test::gmp_side(planes.plane(f.support.index()), x), 0);
          }
          cut += edge == plane;
        }
        ASSERT_EQ(cut, 1u);
      }
      // No corner was made twice for the two pieces.
      ASSERT_EQ(geometry.point_count(), points + 2 - on);
    }
  }
  EXPECT_GT(fronts, 100u);
  EXPECT_GT(backs, 100u);
  EXPECT_GT(ons, 50u);
  EXPECT_GT(splits, 200u);
  EXPECT_GT(touched, 20u);
}

TEST(CellGeometry, ForgetsWhatItHeld) {
  test::Random random(55);
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {2, 3, 4}))};
  Job job(operands);
  for (uint32_t p = 0; p < job.polygons().size(); ++p) job.ensure_planes(p);
  CellGeometry geometry(job.planes(), &job);
  for (int round = 0; round < 3; ++round) {
    for (uint32_t p = 0; p < job.polygons().size(); ++p) {
      const Fragment f = geometry.load(p);
      for (uint32_t c = 0; c < f.count; ++c) {
        const uint32_t vertex = job.corners(job.polygons()[p])[c];
        const auto& point = geometry.point(geometry.corners(f)[c]);
        ASSERT_EQ(point.vertex, vertex);
        ASSERT_EQ(point.rounded, job.rounded(vertex));
      }
    }
    EXPECT_EQ(geometry.point_count(), 8u);
    geometry.clear();
    EXPECT_EQ(geometry.point_count(), 0u);
  }
}

// Normals that are nearly parallel: the direction of the line is what is left of large products.
TEST(CellGeometry, LineAxisOfNearlyParallelPlanes) {
  test::Random random(1221);
  int narrow = 0;
  for (int i = 0; i < 4000; ++i) {
    const int bits = static_cast<int>(random.integer(3, 90));
    const auto wide = [&] {
      return (static_cast<Int128>(random.integer(-1000000, 1000000)) << bits) +
             random.integer(-1000000, 1000000);
    };
    const Plane a{wide(), wide(), wide(), 0};
    const int off = static_cast<int>(random.integer(0, bits));
    const auto near = [&] { return static_cast<Int128>(random.integer(-9, 9)) << off; };
    const Plane b{a.a + near(), a.b + near(), a.c + near(), 5};
    const mpz_class n[3] = {test::to_gmp(a.a), test::to_gmp(a.b), test::to_gmp(a.c)},
                    m[3] = {test::to_gmp(b.a), test::to_gmp(b.b), test::to_gmp(b.c)};
    mpz_class d[3], largest = 0;
    for (int k = 0; k < 3; ++k) {
      const int u = (k + 1) % 3, v = (k + 2) % 3;
      d[k] = n[u] * m[v] - n[v] * m[u];
      if (abs(d[k]) > largest) largest = abs(d[k]);
    }
    if (largest == 0) continue;
    const LineAxis way = line_axis(a, b);
    ASSERT_EQ(way.sign, sgn(d[way.axis])) << i;
    ASSERT_NE(way.sign, 0) << i;
    ASSERT_GE(abs(d[way.axis]) * 4, largest) << i;  // or one that is sure
    narrow += off < bits - 40;
  }
  EXPECT_GT(narrow, 300);
}

// As near each other as whole numbers allow: the cross product is that of two short vectors.
TEST(CellGeometry, LineAxisOfPlanesWhoseCrossProductIsShort) {
  test::Random random(1222);
  std::array<int, 3> chosen{};
  for (int i = 0; i < 2000; ++i) {
    Int128 u[3], v[3];
    for (int k = 0; k < 3; ++k) u[k] = random.integer(-1, 1), v[k] = random.integer(-1, 1);
    std::array<Int128, 3> cross{};
    size_t first = 0;
    const auto size = [&](size_t k) { return cross[k] < 0 ? -cross[k] : cross[k]; };
    for (size_t k = 0; k < 3; ++k) {
      cross[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    }
    for (size_t k = 1; k < 3; ++k) {
      if (size(k) > size(first)) first = k;
    }
    if (cross[first] == 0) continue;
    // p u + q v and r u + s v, of the determinant 1 or -1: doubles say nothing of their product.
    Int128 p = 1, q = 0, r = 0, s = 1;
    int determinant = 1;
    while (p < Int128{1} << 40) {
      const Int128 times = random.integer(1, 9);
      std::tie(p, q, r, s) = std::tuple(times * p + r, times * q + s, p, q);
      determinant = -determinant;
    }
    const Plane a{p * u[0] + q * v[0], p * u[1] + q * v[1], p * u[2] + q * v[2], 7},
        b{r * u[0] + s * v[0], r * u[1] + s * v[1], r * u[2] + s * v[2], 5};
    const LineAxis way = line_axis(a, b);
    ASSERT_EQ(way.axis, static_cast<int>(first)) << i;
    ASSERT_EQ(way.sign, (cross[first] > 0) == (determinant > 0) ? 1 : -1) << i;
    ++chosen[first];
  }
  for (const int n : chosen) EXPECT_GT(n, 100);
}

}  // namespace
}  // namespace csgrun::cell_geometry_test
