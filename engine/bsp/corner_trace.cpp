#include "engine/bsp/corner_trace.h"

#include <cassert>

namespace csgrun {
namespace {

using WideValue = Int<6>;
// Below: products of two plane coefficients and a corner coordinate times the prime.
static_assert(2 * widths::kMaxNormal + 64 + 4 < 64 * 6 &&
              widths::kMaxNormal + widths::kMaxOffset + 32 + 4 < 64 * 6);

std::array<Int128, 3> normal_of(const Plane& p) { return {p.a, p.b, p.c}; }

WideValue wide_product(Int128 a, Int128 b) {
  return multiply<6>(Int<2>::from_int128(a), Int<2>::from_int128(b));
}

}  // namespace

int side_of_corner(const Plane& plane, const IVec3& corner, int64_t prime) {
  const auto n = normal_of(plane);
  WideValue value = wide_product(plane.d, prime);
  for (int k = 0; k < 3; ++k)
    value += wide_product(n[k], static_cast<Int128>(prime) * corner[k] + 1);
  if (const int s = value.sign()) return s;
  for (const Int128 c : n) {
    if (c != 0) return c > 0 ? 1 : -1;
  }
  assert(false);
  return 0;
}

bool line_hits(const Job& job, const JobPolygon& polygon, const IVec3& corner, int axis) {
  const Plane support = job.planes().plane(polygon.support.index());
  const auto s = normal_of(support);
  if (s[axis] == 0) return false;
  const int support_sign = s[axis] > 0 ? 1 : -1;
  const int i = axis == 0 ? 1 : 0, j = axis == 2 ? 1 : 2;  // i < j: the order of the moves
  const int64_t p = job.prime();
  const Int128 ci = static_cast<Int128>(p) * corner[i] + 1,
               cj = static_cast<Int128>(p) * corner[j] + 1;
  const auto edges = job.edge_planes(polygon);
  const auto corners = job.corners(polygon);
  for (size_t k = 0; k < edges.size(); ++k) {
    const Plane& edge = job.planes().plane(edges[k]);
    const auto e = normal_of(edge);
    // The edge's plane where the line meets the support, times the support's component (signed).
    const auto coefficient = [&](int c) {
      return wide_product(s[axis], e[c]) - wide_product(e[axis], s[c]);
    };
    const WideValue by_i = coefficient(i), by_j = coefficient(j);
    const WideValue constant = wide_product(s[axis], edge.d) - wide_product(e[axis], support.d);
    const auto times = [](const WideValue& v, Int128 f) {
      return multiply<6>(v, Int<2>::from_int128(f));
    };
    int at_line = (times(by_i, ci) + times(by_j, cj) + times(constant, p)).sign();
    if (at_line == 0) at_line = by_i.sign();
    if (at_line == 0) at_line = by_j.sign();
    at_line *= support_sign;
    // The inner side of the edge is where the polygon's other corners are.
    int inner = 0;
    for (size_t c = 0; c < corners.size() && inner == 0; ++c) {
      if (c == k || c == (k + 1) % corners.size()) continue;
      inner = filter_side(job.planes().approximate(edges[k]), job.rounded(corners[c]));
      if (inner == 0) inner = exact_side(edge, job.exact(corners[c]));
    }
    assert(inner != 0 && at_line != 0);
    if (at_line != inner) return false;
  }
  return true;
}

int winding_step(Job& job, uint32_t polygon, const IVec3& corner, int axis, int64_t to) {
  const PolygonBox& box = job.boxes()[polygon];
  for (int k = 0; k < 3; ++k) {
    if (k == axis) {
      if (box.hi[k] <= corner[k] || box.lo[k] > to) return 0;
    } else if (box.lo[k] > corner[k] || box.hi[k] <= corner[k]) {
      return 0;
    }
  }
  job.ensure_planes(polygon);
  const JobPolygon& p = job.polygons()[polygon];
  IVec3 end = corner;
  end[axis] = to;
  const Plane support = job.planes().plane(p.support.index());
  const int before = side_of_corner(support, corner, job.prime());
  if (before == side_of_corner(support, end, job.prime()) || !line_hits(job, p, corner, axis)) {
    return 0;
  }
  return (before > 0) != p.support.flipped() ? 1 : -1;
}

bool segment_crosses(Job& job, uint32_t polygon, const IVec3& corner, int axis, int64_t to) {
  return winding_step(job, polygon, corner, axis, to) != 0;
}

bool ray_crosses(Job& job, uint32_t polygon, const IVec3& corner) {
  const PolygonBox& box = job.boxes()[polygon];
  if (box.lo[0] > corner[0]) return false;
  for (int k = 1; k < 3; ++k) {
    if (box.lo[k] > corner[k] || box.hi[k] <= corner[k]) return false;
  }
  job.ensure_planes(polygon);
  const JobPolygon& p = job.polygons()[polygon];
  const Plane support = job.planes().plane(p.support.index());
  const int at_infinity = support.a > 0 ? -1 : 1;
  return side_of_corner(support, corner, job.prime()) != at_infinity &&
         line_hits(job, p, corner, 0);
}

}  // namespace csgrun
