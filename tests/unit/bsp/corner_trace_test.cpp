// What stands between two corners of cells, against rational geometry in which the infinitely small
// move (e, e^2, e^3) of a corner is made with e = 2^-150.
#include "engine/bsp/corner_trace.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/exact_solid.h"
#include "tests/support/gmp_bridge.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::corner_trace_test {
namespace {

using test::Rational3;

Rational3 moved(const IVec3& corner, int64_t prime) {
  Rational3 p;
  for (int k = 0; k < 3; ++k) {
    const mpq_class e(mpz_class(1), mpz_class(1) << (150 * (k + 1)));
    p[k] = mpz_class(corner[k]) + mpq_class(1, static_cast<unsigned long>(prime)) + e;
  }
  return p;
}

mpq_class value_at(const Plane& s, const Rational3& p) {
  return test::to_gmp(s.a) * p[0] + test::to_gmp(s.b) * p[1] + test::to_gmp(s.c) * p[2] +
         test::to_gmp(s.d);
}

struct Truth {
  bool line = false;  ///< the line along the axis passes through the polygon
  mpq_class at;       ///< and there
  int direction = 0;  ///< sign of the outward normal along the axis
};

/// Where the line through `p` along `axis` meets a convex polygon, seen counter-clockwise from
/// outside.
Truth meet(const std::vector<Rational3>& polygon, const Rational3& p, int axis) {
  Rational3 n{0, 0, 0};
  for (size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Rational3 c =
        test::cross(test::minus(polygon[i], polygon[0]), test::minus(polygon[i + 1], polygon[0]));
    for (int k = 0; k < 3; ++k) n[k] += c[k];
  }
  Truth t;
  if (n[axis] == 0) return t;
  t.direction = sgn(n[axis]);
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  t.line = true;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const Rational3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const mpq_class turn = (b[i] - a[i]) * (p[j] - a[j]) - (b[j] - a[j]) * (p[i] - a[i]);
    if (sgn(turn) * t.direction <= 0) t.line = false;
  }
  const Rational3 from = test::minus(polygon[0], p);
  t.at = p[axis] + test::dot(n, from) / n[axis];
  return t;
}

void compare(test::Random& random, const std::vector<Operand>& operands, int64_t reach,
             std::array<int, 3>& hits) {
  Job job(operands);
  for (uint32_t o = 0; o < operands.size(); ++o) {
    const test::ExactSolid exact = test::exact_solid(operands[o]);
    for (uint32_t polygon = job.polygon_start(o); polygon < job.polygon_start(o + 1); ++polygon) {
      std::vector<Rational3> corners;
      for (const uint32_t c : exact.faces[polygon - job.polygon_start(o)].loops[0]) {
        corners.push_back(exact.points[c]);
      }
      for (int query = 0; query < 6; ++query) {
        IVec3 corner;
        // Below or beside a point of the polygon, mostly.
        const double u = random.unit(), v = random.unit() * (1 - u);
        for (int k = 0; k < 3; ++k) {
          const double a = corners[0][k].get_d(), b = corners[1][k].get_d(),
                       c = corners[2][k].get_d();
          corner[k] = static_cast<int64_t>(std::floor(a + u * (b - a) + v * (c - a))) -
                      random.integer(0, 2) / 2;
        }
        const int axis = static_cast<int>(random.integer(0, 2));
        corner[axis] += random.integer(-reach, 2);
        const Rational3 start = moved(corner, job.prime());
        const int64_t to = corner[axis] + random.integer(1, reach);
        IVec3 end = corner;
        end[axis] = to;
        const Truth t = meet(corners, start, axis), along_x = meet(corners, start, 0);
        const bool between = t.line && t.at > start[axis] && t.at < moved(end, job.prime())[axis];
        // Upwards through a face that looks up: out of the solid.
        ASSERT_EQ(winding_step(job, polygon, corner, axis, to), between ? -t.direction : 0);
        ASSERT_EQ(segment_crosses(job, polygon, corner, axis, to), between);
        ASSERT_EQ(ray_crosses(job, polygon, corner), along_x.line && along_x.at < start[0]);
        job.ensure_planes(polygon);
        ASSERT_EQ(line_hits(job, job.polygons()[polygon], corner, axis), t.line);
        const Plane& support = job.planes().plane(job.polygons()[polygon].support.index());
        ASSERT_EQ(side_of_corner(support, corner, job.prime()), sgn(value_at(support, start)));
        hits[0] += t.line, hits[1] += between, hits[2] += along_x.line && along_x.at < start[0];
      }
    }
  }
}

TEST(CornerTrace, AgreesWithRationals) {
  test::Random random(21);
  std::array<int, 3> hits{};
  for (int i = 0; i < 60 && !HasFatalFailure(); ++i) {
    std::vector<Operand> operands(2);
    for (Operand& o : operands) o.leaf = test::random_leaf(random);
    compare(random, operands, 6, hits);
  }
  for (const int n : hits) EXPECT_GT(n, 300);
}

TEST(CornerTrace, AgreesWithRationalsInFrames) {
  test::Random random(22);
  std::array<int, 3> hits{};
  for (int i = 0; i < 30 && !HasFatalFailure(); ++i) {
    std::vector<Operand> operands(2);
    for (Operand& o : operands) {
      o.leaf = test::random_leaf(random);
      if (random.integer(0, 2)) o.frame = test::random_frame(random);
    }
    compare(random, operands, 6, hits);
  }
  for (const int n : hits) EXPECT_GT(n, 50);
}

// Planes that pass through corners: with the prime 3 all planes x + y + z = k do, of any k.
TEST(CornerTrace, CornersInPlanesAreMoved) {
  test::Random random(23);
  std::array<int, 3> hits{};
  int through = 0;
  for (int i = 0; i < 150 && !HasFatalFailure(); ++i) {
    std::vector<test::Loop> loops;
    // Convex polygons in x + y + z = k, and others with a normal of one, two or three sums of 1.
    for (int f = 0; f < 4; ++f) {
      const IVec3 a{random.integer(0, 5), random.integer(0, 5), random.integer(0, 5)};
      const int64_t u = random.integer(1, 4), v = random.integer(1, 4);
      test::Loop l{a, {a[0] + u, a[1] - u, a[2]}, {a[0], a[1] - v, a[2] + v}};
      if (f % 2) l[2] = {a[0] - v, a[1], a[2] + (f == 3 ? v : 0) + v};
      if (test::cross_of(test::sub(l[1], l[0]), test::sub(l[2], l[0])) == IVec3{0, 0, 0}) continue;
      loops.push_back(l);
    }
    std::vector<Operand> operands(1);
    operands[0].leaf = test::make_leaf(loops);
    Job job(operands);
    const mpq_class third(1, static_cast<unsigned long>(job.prime()));
    for (uint32_t p = 0; p < job.polygons().size(); ++p) {
      job.ensure_planes(p);
      const Plane& s = job.planes().plane(job.polygons()[p].support.index());
      through += value_at(s, {third, third, third}).get_den() == 1;
    }
    compare(random, operands, 6, hits);
  }
  EXPECT_GT(through, 100);
  for (const int n : hits) EXPECT_GT(n, 100);
}

// Straight angles anywhere: corners in line with an edge do not say where its inner side is.
TEST(CornerTrace, OfFacesWithStraightCorners) {
  std::vector<test::Loop> loops = test::with_middles(test::box_loops({0, 0, 0}, {4, 4, 4}));
  for (int turn = 0; turn < 8; ++turn) {
    const std::vector<Operand> operands{test::operand_of(test::make_leaf(loops))};
    Job job(operands);
    for (int64_t x = -1; x < 5; ++x) {
      for (int64_t y = -1; y < 5; ++y) {
        for (int64_t z = -1; z < 5; ++z) {
          bool inside = false;
          for (uint32_t p = 0; p < 6; ++p) inside ^= ray_crosses(job, p, {x, y, z});
          const auto within = [](int64_t c) { return c >= 0 && c < 4; };
          ASSERT_EQ(inside, within(x) && within(y) && within(z)) << x << ' ' << y << ' ' << z;
        }
      }
    }
    for (test::Loop& loop : loops) std::rotate(loop.begin(), loop.begin() + 1, loop.end());
  }
}

// A triangle so thin that doubles do not tell its inner side, with a line of walls through its
// middle.
TEST(CornerTrace, OfTrianglesThatDoublesCannotTell) {
  int64_t a = 1, b = 1;
  while (b < int64_t{1} << 24) std::tie(a, b) = std::pair(b, a + b);
  int hit = 0;
  // Sums of corners are 3 y + 2 a + b and so on: a step of the numbers gives other remainders.
  for (int step = 0; step < 8; ++step) {
    std::tie(a, b) = std::pair(b, a + b);
    for (const int64_t y : {0, 1}) {
      const int64_t z = 0, far = 3 << 20;
      const IVec3 u{0, far + y, z}, v{0, u[1] + a, u[2] + b}, w{0, v[1] + b, v[2] + a + b};
      const int64_t sum_y = u[1] + v[1] + w[1], sum_z = u[2] + v[2] + w[2];
      if (((sum_y % 3) + 3) % 3 != 1 || ((sum_z % 3) + 3) % 3 != 1) continue;
      for (const bool reverse : {false, true}) {
        test::Loop loop{u, v, w};
        if (reverse) std::reverse(loop.begin(), loop.end());
        const std::vector<Operand> operands{test::operand_of(test::make_leaf({loop}))};
        Job job(operands);
        ASSERT_EQ(job.prime(), 3);
        EXPECT_TRUE(ray_crosses(job, 0, {5, (sum_y - 1) / 3, (sum_z - 1) / 3}));
        EXPECT_FALSE(ray_crosses(job, 0, {-5, (sum_y - 1) / 3, (sum_z - 1) / 3}));
        EXPECT_FALSE(ray_crosses(job, 0, {5, (sum_y - 1) / 3, (sum_z - 1) / 3 + 1}));
        ++hit;
      }
    }
  }
  EXPECT_GT(hit, 0);
}

}  // namespace
}  // namespace csgrun::corner_trace_test
