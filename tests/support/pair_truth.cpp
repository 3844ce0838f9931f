#include "tests/support/pair_truth.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "engine/bsp/point_index.h"
#include "engine/exact/forced_tier.h"
#include "tests/support/gmp_bridge.h"

namespace csgrun::test {

Rational3 normal_of(const Corners& c) {
  Rational3 n{};
  for (size_t i = 2; i < c.size(); ++i) {
    const Rational3 m = cross(minus(c[i - 1], c[0]), minus(c[i], c[0]));
    for (int k = 0; k < 3; ++k) n[k] += m[k];
  }
  return n;
}

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

Sides sides_of(const Corners& c, const Corners& plane) {
  const Rational3 n = normal_of(plane);
  Sides sides;
  for (size_t i = 0; i < c.size(); ++i) {
    const int s = sgn(dot(n, minus(c[i], plane[0])));
    sides.front += s > 0;
    sides.back += s < 0;
    if (s == 0) sides.on.push_back(i);
  }
  return sides;
}

Corners common_part(Corners c, const Corners& other) {
  const Rational3 n = normal_of(other);
  for (size_t e = 0; e < other.size(); ++e) {
    const Rational3 &from = other[e],
                    inwards = cross(n, minus(other[(e + 1) % other.size()], from));
    Corners left;
    for (size_t i = 0; i < c.size(); ++i) {
      const Rational3 &a = c[i], &b = c[(i + 1) % c.size()];
      const mpq_class s = dot(inwards, minus(a, from)), t = dot(inwards, minus(b, from));
      if (s >= 0) left.push_back(a);
      if (sgn(s) * sgn(t) >= 0) continue;
      Rational3 x;
      for (int k = 0; k < 3; ++k) x[k] = (s * b[k] - t * a[k]) / (s - t);
      left.push_back(x);
    }
    c = std::move(left);
  }
  return c;
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

void check_flat_pair(const Job& job, const PairTest& test, Meeting met, const Contact& contact,
                     bool is_exact, Seen& seen) {
  const Corners a = corners_of(job, contact.p), b = corners_of(job, contact.q);
  const Corners common = common_part(a, b);
  if (met == Meeting::kApart || (is_exact && common.empty())) {
    ASSERT_TRUE(common.empty());
    ASSERT_EQ(met, Meeting::kApart);
    ++seen.flat_apart;
    return;
  }
  ASSERT_TRUE(contact.is_coplanar);
  if (met == Meeting::kContact) {
    ++seen.coplanar;
    return;
  }
  ASSERT_EQ(met, Meeting::kFlatCorner);
  ASSERT_FALSE(common.empty());
  for (const Rational3& point : common) ASSERT_EQ(point, common[0]);
  std::vector<uint32_t> expected, found;
  for (const uint32_t polygon : {contact.p, contact.q}) {
    const Corners own = polygon == contact.p ? a : b;
    const auto at = std::find(own.begin(), own.end(), common[0]);
    ASSERT_NE(at, own.end());
    expected.push_back(job.corners(job.polygons()[polygon])[at - own.begin()]);
  }
  test.add_touching_vertices(contact, found);
  ASSERT_EQ(found, expected);
  ++seen.flat_corner;
}

std::vector<uint32_t> numbers_of_vertices(const Job& job, CellGeometry& geometry) {
  PointIndex index(geometry);
  std::vector<uint32_t> numbers;
  for (uint32_t v = 0; v < job.vertex_count(); ++v) {
    numbers.push_back(index.unique(geometry.vertex_point(v)));
  }
  return numbers;
}

void check_pairs(const std::vector<Operand>& operands, bool with_planes, Seen& seen) {
  Job job(operands);
  for (uint32_t p = 0; p < job.polygons().size(); ++p) job.ensure_planes(p);
  CellGeometry geometry(job.planes(), &job);
  PairTest without_numbers(job), with_numbers(job);
  with_numbers.know_equal_vertices(numbers_of_vertices(job, geometry));
  for (uint32_t p = 0; p < job.polygon_start(1); ++p) {
    for (uint32_t q = job.polygon_start(1); q < job.polygons().size(); ++q) {
      PairTest& test = with_planes && (p + q) % 2 == 1 ? with_numbers : without_numbers;
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
      if (dot(d, d) == 0 && dot(normal_of(a), minus(b[0], a[0])) == 0) {
        const bool is_exact = forced_tier < 0 && job.has_grid_vertices(0) &&
                              job.has_grid_vertices(1) && a.size() == 3 && b.size() == 3;
        contact.p = p, contact.q = q;
        check_flat_pair(job, test, met, contact, is_exact, seen);
        if (::testing::Test::HasFatalFailure()) return;
        continue;
      }
      if (dot(d, d) == 0) {
        ASSERT_EQ(met, Meeting::kApart);
        ASSERT_NE(dot(normal_of(a), minus(b[0], a[0])), 0);
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
      const Sides of_p = sides_of(a, b), of_q = sides_of(b, a);
      ASSERT_EQ(contact.p_front, of_p.front > 0);
      ASSERT_EQ(contact.p_back, of_p.back > 0);
      ASSERT_EQ(contact.q_front, of_q.front > 0);
      ASSERT_EQ(contact.q_back, of_q.back > 0);
      ASSERT_EQ(contact.is_plain, of_p.on.empty() && of_q.on.empty() &&
                                      of_a->first != of_b->first && of_a->first != of_b->second &&
                                      of_a->second != of_b->first && of_a->second != of_b->second);
      std::vector<uint32_t> on, expected;
      test.add_touching_vertices(contact, on);
      for (const size_t i : of_p.on) expected.push_back(job.corners(job.polygons()[p])[i]);
      for (const size_t i : of_q.on) expected.push_back(job.corners(job.polygons()[q])[i]);
      ASSERT_EQ(on, expected);
      ++(contact.is_plain ? seen.plain : seen.touching);
    }
  }
}

}  // namespace csgrun::test
