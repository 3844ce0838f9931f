// How two polygons meet, against rationals: the part of each on the line of both planes.
#include "engine/bsp/pair_test.h"

#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

#include "tests/support/exact_measures.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_frames.h"

namespace csgrun {
namespace {

using namespace test;  // NOLINT: a test

using Corners = std::vector<Rational3>;

Rational3 minus(const Rational3& a, const Rational3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Rational3 cross(const Rational3& a, const Rational3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
mpq_class dot(const Rational3& a, const Rational3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Rational3 normal_of(const Corners& c) {
  Rational3 n{};
  for (size_t i = 2; i < c.size(); ++i) {
    const Rational3 m = cross(minus(c[i - 1], c[0]), minus(c[i], c[0]));
    for (int k = 0; k < 3; ++k) n[k] += m[k];
  }
  return n;
}

/// The part of a polygon in the plane of another one, along d.
using Interval = std::optional<std::pair<mpq_class, mpq_class>>;
Interval interval_of(const Corners& c, const Corners& plane, const Rational3& d) {
  const Rational3 n = normal_of(plane);
  Interval r;
  const auto include = [&](const mpq_class& t) {
    if (!r) r = {t, t};
    r->first = std::min(r->first, t);
    r->second = std::max(r->second, t);
  };
  for (size_t i = 0; i < c.size(); ++i) {
    const Rational3 &a = c[i], &b = c[(i + 1) % c.size()];
    const mpq_class s = dot(n, minus(a, plane[0])), t = dot(n, minus(b, plane[0]));
    if (s == 0) include(dot(d, a));
    if (sgn(s) * sgn(t) < 0) {
      Rational3 x;
      for (int k = 0; k < 3; ++k) x[k] = (s * b[k] - t * a[k]) / (s - t);
      include(dot(d, x));
    }
  }
  return r;
}

Corners corners_of(const Job& job, uint32_t polygon) {
  Corners c;
  for (const uint32_t v : job.corners(job.polygons()[polygon])) {
    const GmpPoint g = to_gmp(job.exact(v));
    c.push_back({mpq_class(g.x) / g.w, mpq_class(g.y) / g.w, mpq_class(g.z) / g.w});
  }
  return c;
}

mpq_class place_of(Job& job, const Contact& c, const Contact::End& end, const Rational3& d) {
  Point x;
  if (end.vertex != kNone) {
    x = job.exact(end.vertex);
  } else {
    const JobPolygon &own = job.polygons()[end.on_p ? c.p : c.q],
                     &other = job.polygons()[end.on_p ? c.q : c.p];
    x = intersect(job.planes().plane(own.support.index()),
                  job.planes().plane(job.edge_planes(own)[end.edge]),
                  job.planes().plane(other.support.index()));
  }
  const GmpPoint g = to_gmp(x);
  return dot(d, {mpq_class(g.x) / g.w, mpq_class(g.y) / g.w, mpq_class(g.z) / g.w});
}

struct Seen {
  int apart = 0, plain = 0, touching = 0, coplanar = 0, unsure = 0;
};

void check_pairs(const std::vector<Operand>& operands, bool with_planes, Seen& seen) {
  Job job(operands);
  for (uint32_t p = 0; p < job.polygons().size(); ++p) job.ensure_planes(p);
  CellGeometry geometry(job.planes(), &job);
  PairTest test(job);
  for (uint32_t p = 0; p < job.polygon_start(1); ++p) {
    for (uint32_t q = job.polygon_start(1); q < job.polygons().size(); ++q) {
      Contact contact;
      const Meeting met = test.run(p, q, with_planes ? &geometry : nullptr, contact);
      const bool is_sure = with_planes || (job.has_grid_vertices(0) && job.has_grid_vertices(1));
      if (met == Meeting::kUndecided) {
        ASSERT_FALSE(is_sure);
        ++seen.unsure;
        continue;
      }
      const Corners a = corners_of(job, p), b = corners_of(job, q);
      const Rational3 d = cross(normal_of(a), normal_of(b));
      if (met == Meeting::kContact && contact.is_coplanar) {
        ASSERT_EQ(dot(d, d), 0);
        ASSERT_EQ(dot(normal_of(a), minus(b[0], a[0])), 0);
        ++seen.coplanar;
        continue;
      }
      if (dot(d, d) == 0) {
        ASSERT_EQ(met, Meeting::kApart);
        continue;
      }
      const Interval of_a = interval_of(a, b, d), of_b = interval_of(b, a, d);
      const bool meets = of_a && of_b && of_a->first <= of_b->second && of_b->first <= of_a->second;
      ASSERT_EQ(met == Meeting::kContact, meets);
      if (!meets) {
        ++seen.apart;
        continue;
      }
      ASSERT_EQ(place_of(job, contact, contact.lower, d), std::max(of_a->first, of_b->first));
      ASSERT_EQ(place_of(job, contact, contact.upper, d), std::min(of_a->second, of_b->second));
      ++(contact.is_plain ? seen.plain : seen.touching);
    }
  }
}

TEST(PairTest, AgainstIntervalsInRationals) {
  Random random(411);
  Seen seen;
  for (int i = 0; i < 60; ++i) {
    check_pairs({operand_of(random_leaf(random)), operand_of(random_leaf(random))}, i % 2 == 0,
                seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.apart, 1000);
  EXPECT_GT(seen.plain, 100);
  EXPECT_GT(seen.touching, 100);
  EXPECT_GT(seen.coplanar, 10);
}

// Rounded corners leave much open, which planes tell.
TEST(PairTest, InFrames) {
  Random random(415);
  Seen seen;
  for (int i = 0; i < 8; ++i) {
    std::vector<Operand> operands{operand_of(make_leaf(random_loops(random, 3))),
                                  operand_of(make_leaf(random_loops(random, 3)))};
    operands[1].frame = random_frame(random);
    if (i % 2) operands[0].frame = operands[1].frame;  // touching, mostly
    if (i % 4 == 2) operands[0].frame = random_frame(random);
    check_pairs(operands, i % 3 != 0, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.plain, 20);
  EXPECT_GT(seen.touching, 20);
  EXPECT_GT(seen.unsure, 20);
}

// Three corners of a face that are in line say nothing of its plane.
TEST(PairTest, OfFacesWithStraightCorners) {
  Random random(416);
  Seen seen;
  for (int i = 0; i < 40; ++i) {
    std::vector<Loop> loops = box_loops({0, 0, 0}, {4, 2 + i % 3 * 2, 4});
    for (Loop& loop : loops) {
      Loop with_middles;
      for (size_t c = 0; c < loop.size(); ++c) {
        const IVec3 &a = loop[c], &b = loop[(c + 1) % loop.size()];
        with_middles.push_back(a);
        with_middles.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
      }
      std::rotate(with_middles.begin(), with_middles.begin() + i % 8, with_middles.end());
      loop = with_middles;
    }
    std::vector<Operand> operands{operand_of(make_leaf(loops)),
                                  operand_of(make_leaf(random_loops(random, 7)))};
    IVec3 move{};
    for (int64_t& c : move) c = random.integer(-9, 9);
    operands[0].translation = operands[1].translation = move;
    check_pairs(operands, false, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.plain, 50);
}

}  // namespace
}  // namespace csgrun
