#include "engine/bsp/cell_geometry.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>

#include "engine/base/parallel.h"
#include "engine/exact/grid_meeting.h"

namespace csgrun {
namespace {

int tier_for(const PlaneTable& planes, uint32_t plane, int xyz_bits, int w_bits,
             SignCounters& counters) {
  const int bits =
      widths::side(xyz_bits, w_bits, planes.normal_bits(plane), planes.offset_bits(plane)) + 1;
  int tier = 0;
  while (bits > kTierBits[tier]) ++tier;
  ++counters.exact[tier];
  return tier;
}

}  // namespace

int exact_side_of(const PlaneTable& planes, uint32_t plane, const IVec3& point,
                  SignCounters& counters) {
  const auto magnitudes = static_cast<uint64_t>(std::abs(point[0])) |
                          static_cast<uint64_t>(std::abs(point[1])) |
                          static_cast<uint64_t>(std::abs(point[2]));
  return exact_side(planes.plane(plane), point,
                    tier_for(planes, plane, std::bit_width(magnitudes), 1, counters));
}

int exact_side_of(const PlaneTable& planes, uint32_t plane, const Point& point,
                  SignCounters& counters) {
  return exact_side(planes.plane(plane), point,
                    tier_for(planes, plane, point.xyz_bits, point.w_bits, counters));
}

CellGeometry::CellGeometry(const PlaneTable& planes, const Job* job) : planes_(&planes), job_(job) {
  if (job) {
    vertex_stamp_.assign(job->vertex_count(), 0);
    vertex_point_.resize(job->vertex_count());
  }
}

void CellGeometry::clear() {
  points_.clear();
  exact_.clear();
  corners_.clear();
  edges_.clear();
  ++stamp_;
}

uint32_t CellGeometry::vertex_point(uint32_t vertex) {
  if (has_vertex_point(vertex)) return vertex_point_[vertex];
  const uint32_t p = add_points(1);
  set_vertex_point(p, vertex);
  return p;
}

uint32_t CellGeometry::add_vertex_points(std::span<const uint32_t> vertices) {
  const uint32_t first = add_points(vertices.size());
  for_each_range(vertices.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      set_vertex_point(first + static_cast<uint32_t>(i), vertices[i]);
    }
  });
  return first;
}

void CellGeometry::set_vertex_point(uint32_t p, uint32_t vertex) {
  vertex_stamp_[vertex] = stamp_;
  vertex_point_[vertex] = p;
  const Job::VertexName name = job_->vertex_name(vertex);
  points_[p] = {job_->rounded(vertex), name.planes, vertex, kNone, name.is_on_grid};
}

uint32_t CellGeometry::add_point(const std::array<uint32_t, 3>& planes) {
  // The exact point is 200 bytes and seldom asked for: to make it again is less than to store it.
  return add_point(planes,
                   csgrun::rounded(intersect(planes_->plane(planes[0]), planes_->plane(planes[1]),
                                             planes_->plane(planes[2]))));
}

uint32_t CellGeometry::add_point(const std::array<uint32_t, 3>& planes,
                                 const std::array<double, 3>& rounded) {
  return add_point(planes, rounded, false);
}

uint32_t CellGeometry::add_point(const std::array<uint32_t, 3>& planes,
                                 const std::array<double, 3>& rounded, bool is_on_grid) {
  points_.push_back({rounded, planes, kNone, kNone, is_on_grid});
  return static_cast<uint32_t>(points_.size() - 1);
}

Point CellGeometry::value(uint32_t p) const {
  const StoredPoint& s = points_[p];
  if (s.exact != kNone) return exact_[s.exact];
  if (is_found_on_grid(p)) {
    const IVec3 at = s.on_grid();
    return grid_point(at[0], at[1], at[2]);
  }
  if (s.vertex != kNone) return job_->exact(s.vertex);
  return intersect(planes_->plane(s.planes[0]), planes_->plane(s.planes[1]),
                   planes_->plane(s.planes[2]));
}

bool CellGeometry::meets_on_grid(const StoredPoint& s) const {
  return meet_on_grid(planes_->plane(s.planes[0]), planes_->plane(s.planes[1]),
                      planes_->plane(s.planes[2]), s.rounded);
}

const Point& CellGeometry::exact(uint32_t p) {
  if (points_[p].exact == kNone) {
    exact_.push_back(value(p));
    points_[p].exact = static_cast<uint32_t>(exact_.size() - 1);
  }
  return exact_[points_[p].exact];
}

Fragment CellGeometry::load(uint32_t polygon) {
  const JobPolygon& p = job_->polygons()[polygon];
  Fragment f{p.support, polygon, static_cast<uint32_t>(corners_.size()), p.count};
  for (const uint32_t v : job_->corners(p)) corners_.push_back(vertex_point(v));
  for (const uint32_t e : job_->edge_planes(p)) edges_.push_back(e);
  return f;
}

Fragment CellGeometry::make_fragment(PlaneId support, const std::vector<uint32_t>& points,
                                     const std::vector<uint32_t>& edges) {
  Fragment f{support, kNone, static_cast<uint32_t>(corners_.size()),
             static_cast<uint32_t>(points.size())};
  corners_.insert(corners_.end(), points.begin(), points.end());
  edges_.insert(edges_.end(), edges.begin(), edges.end());
  return f;
}

int CellGeometry::side(uint32_t plane, uint32_t p) {
  return side_of(*planes_, plane, points_[p], counters, [&]() -> const Point& { return exact(p); });
}

int CellGeometry::side_of_vertex(uint32_t plane, uint32_t vertex) {
  if (const int sign = filter_side(planes_->approximate(plane), job_->rounded(vertex))) {
    ++counters.filter;
    return sign;
  }
  if (has_vertex_point(vertex)) return side(plane, vertex_point_[vertex]);
  const Job::VertexName name = job_->vertex_name(vertex);
  const StoredPoint point{job_->rounded(vertex), name.planes, vertex, kNone, name.is_on_grid};
  return side_of(*planes_, plane, point, counters, [&] { return job_->exact(vertex); });
}

Side CellGeometry::classify(const Fragment& f, uint32_t plane) {
  if (f.support.index() == plane) return Side::kOn;
  bool front = false, back = false;
  for (uint32_t i = 0; i < f.count; ++i) {
    const int s = side(plane, corners_[f.first + i]);
    front |= s > 0;
    back |= s < 0;
    if (front && back) return Side::kSplit;
  }
  assert(front || back);
  return front ? Side::kFront : Side::kBack;
}

Side CellGeometry::split(const Fragment& f, uint32_t plane, Fragment& front, Fragment& back) {
  if (f.support.index() == plane) {
    met_plane = true;
    return Side::kOn;
  }
  signs_.resize(f.count);
  bool any_front = false, any_back = false;
  for (uint32_t i = 0; i < f.count; ++i) {
    signs_[i] = static_cast<int8_t>(side(plane, corners_[f.first + i]));
    any_front |= signs_[i] > 0;
    any_back |= signs_[i] < 0;
    met_plane |= signs_[i] == 0;
  }
  if (!any_back) return Side::kFront;
  if (!any_front) return Side::kBack;

  // Walk the loop once for each piece. A crossed edge gives a new corner; both pieces get the
  // cutting plane as the plane of their new edge.
  uint32_t cut_of_edge[2] = {kNone, kNone}, cut_point[2] = {kNone, kNone};
  const auto crossing = [&](uint32_t i) {
    const int k = cut_of_edge[0] == i ? 0 : cut_of_edge[1] == i ? 1 : -1;
    if (k >= 0) return cut_point[k];
    const int slot = cut_of_edge[0] == kNone ? 0 : 1;
    cut_of_edge[slot] = i;
    return cut_point[slot] = add_point({f.support.index(), edges_[f.first + i], plane});
  };
  const auto piece = [&](int keep) {
    Fragment r{f.support, f.polygon, static_cast<uint32_t>(corners_.size()), 0};
    for (uint32_t i = 0; i < f.count; ++i) {
      const uint32_t next = i + 1 < f.count ? i + 1 : 0;
      const int s = signs_[i] * keep, t = signs_[next] * keep;
      const uint32_t corner = corners_[f.first + i], edge = edges_[f.first + i];
      if (s >= 0) {
        // A corner on the plane starts the new edge when the loop leaves the piece here.
        corners_.push_back(corner);
        edges_.push_back(s == 0 && t < 0 ? plane : edge);
        if (s > 0 && t < 0) {
          const uint32_t x = crossing(i);
          corners_.push_back(x);
          edges_.push_back(plane);
        }
      } else if (t > 0) {
        const uint32_t x = crossing(i);
        corners_.push_back(x);
        edges_.push_back(edge);
      }
    }
    r.count = static_cast<uint32_t>(corners_.size()) - r.first;
    return r;
  };
  front = piece(1);
  back = piece(-1);
  return Side::kSplit;
}

int CellGeometry::compare_along(uint32_t p, uint32_t q, int axis) {
  const double a = points_[p].rounded[axis], b = points_[q].rounded[axis];
  if (a != b) return a < b ? -1 : 1;
  if (p == q || (find_on_grid(p) && find_on_grid(q))) return 0;
  exact(p);  // both first: the reference to one must survive the other's construction
  exact(q);
  return csgrun::compare_along(exact(p), exact(q), axis);
}

LineAxis CellGeometry::axis_between(uint32_t p, uint32_t q) {
  const auto &a = points_[p].rounded, &b = points_[q].rounded;
  int best = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::fabs(b[k] - a[k]) > std::fabs(b[best] - a[best])) best = k;
  }
  if (a[best] != b[best]) return {best, a[best] < b[best] ? 1 : -1};
  for (int k = 0; k < 3; ++k) {
    if (const int sign = compare_along(q, p, k)) return {k, sign};
  }
  return {0, 0};
}

namespace {

/// As line_axis, in doubles; sign 0 where they do not tell.
LineAxis line_axis_by_doubles(const Plane& a, const Plane& b) {
  const auto minor = [](Int128 p, Int128 q, Int128 r, Int128 s, double& bound) {
    const double u = to_double(p) * to_double(s), v = to_double(q) * to_double(r);
    // Each product is off by three roundings, their difference by one more.
    bound = 0x1p-50 * (std::fabs(u) + std::fabs(v));
    return u - v;
  };
  std::array<double, 3> bound{};
  const std::array<double, 3> d{minor(a.b, a.c, b.b, b.c, bound[0]),
                                minor(a.c, a.a, b.c, b.a, bound[1]),
                                minor(a.a, a.b, b.a, b.b, bound[2])};
  int best = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::fabs(d[k]) > std::fabs(d[best])) best = k;
  }
  return {best, std::fabs(d[best]) <= bound[best] ? 0 : d[best] > 0 ? 1 : -1};
}

}  // namespace

LineAxis line_axis(const Plane& a, const Plane& b) {
  if (const LineAxis quick = line_axis_by_doubles(a, b); quick.sign != 0) return quick;
  using N = Int<2>;
  const auto minor = [](Int128 p, Int128 q, Int128 r, Int128 s) {
    return multiply<4>(N::from_int128(p), N::from_int128(s)) -
           multiply<4>(N::from_int128(q), N::from_int128(r));
  };
  const std::array<Int<4>, 3> d{minor(a.b, a.c, b.b, b.c), minor(a.c, a.a, b.c, b.a),
                                minor(a.a, a.b, b.a, b.b)};
  LineAxis best;
  double largest = -1;
  for (int k = 0; k < 3; ++k) {
    const double size = std::fabs(to_double(d[k]));
    if (size > largest) largest = size, best = {k, d[k].sign()};
  }
  assert(best.sign != 0);
  return best;
}

}  // namespace csgrun
