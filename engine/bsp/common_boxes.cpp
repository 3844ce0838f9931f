#include "engine/bsp/common_boxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "engine/bsp/piece_tree.h"

namespace csgrun {
namespace {

using Position = std::array<double, 3>;
using Points = std::vector<Position>;

Position between(const Position& a, const Position& b, double t) {
  Position at{};
  for (size_t k = 0; k < 3; ++k) at[k] = a[k] + t * (b[k] - a[k]);
  return at;
}

/// Values along the normal of a polygon, about 0 in its plane.
class Heights {
 public:
  Heights(const Job& job, const JobPolygon& polygon) {
    const auto corners = job.corners(polygon);
    origin_ = job.rounded(corners[0]);
    const auto way = [&](uint32_t i, size_t k) { return job.rounded(corners[i])[k] - origin_[k]; };
    for (uint32_t i = 1; i + 1 < corners.size(); ++i) {
      for (size_t k = 0; k < 3; ++k) {
        const size_t u = (k + 1) % 3, v = (k + 2) % 3;
        const double plus = way(i, u) * way(i + 1, v), minus = way(i, v) * way(i + 1, u);
        normal_[k] += plus - minus;
        normal_size_ += std::fabs(plus) + std::fabs(minus);
      }
    }
  }

  [[nodiscard]] double at(const Position& p) const {
    double sum = 0;
    for (size_t k = 0; k < 3; ++k) sum += normal_[k] * (p[k] - origin_[k]);
    return sum;
  }
  /// What all points of the plane are below that are no further away than the corners of a polygon.
  /// A height is off by less than 2^-45 of the size of the normal times the furthest way; this is
  /// so much more that the place where an edge passes it may be off as well.
  [[nodiscard]] double near(const Job& job, std::span<const uint32_t> corners) const {
    double reach = 0;
    for (const uint32_t c : corners) {
      for (size_t k = 0; k < 3; ++k) {
        reach = std::max(reach, std::fabs(job.rounded(c)[k] - origin_[k]));
      }
    }
    return 0x1p-30 * normal_size_ * reach;
  }

 private:
  Position origin_{}, normal_{};
  double normal_size_ = 0;  ///< sum of the sizes of the products that the normal consists of
};

/// The corners of the part of a polygon that is near another one's plane.
Points near_plane(const Job& job, const JobPolygon& polygon, const JobPolygon& of_plane) {
  const Heights heights(job, of_plane);
  const auto corners = job.corners(polygon);
  const double near = heights.near(job, corners);
  Points points;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Position &a = job.rounded(corners[i]),
                   &b = job.rounded(corners[i + 1 < corners.size() ? i + 1 : 0]);
    const double at_a = heights.at(a), at_b = heights.at(b);
    if (std::fabs(at_a) <= near) points.push_back(a);
    for (const double level : {-near, near}) {
      if ((at_a < level) == (at_b < level)) continue;
      points.push_back(between(a, b, (level - at_a) / (at_b - at_a)));
    }
  }
  return points;
}

/// The box of the part of the hull of some points that lies in [lo, hi] along an axis: its corners
/// are points, or lie between two of them.
PieceBox box_of_slice(const Points& points, size_t axis, double lo, double hi) {
  PieceBox box;
  for (size_t i = 0; i < points.size(); ++i) {
    const Position& a = points[i];
    if (lo <= a[axis] && a[axis] <= hi) box.add(a);
    for (size_t j = 0; j < i; ++j) {
      const Position& b = points[j];
      for (const double level : {lo, hi}) {
        if ((a[axis] < level) == (b[axis] < level)) continue;
        box.add(between(a, b, (level - a[axis]) / (b[axis] - a[axis])));
      }
    }
  }
  return box;
}

}  // namespace

void add_common_boxes(const Job& job, uint32_t p, uint32_t q, uint32_t slices,
                      std::vector<GridBox>& boxes) {
  PolygonBox overlap = job.boxes()[p];
  overlap.clip(job.boxes()[q]);
  GridBox all;
  size_t axis = 0;
  // Boxes of polygons are clamped: what is beyond is not looked at. Rounded corners of a small
  // polygon may be off by more than what is near.
  bool is_known = job.has_grid_vertices(job.polygons()[p].operand) &&
                  job.has_grid_vertices(job.polygons()[q].operand);
  for (size_t k = 0; k < 3; ++k) {
    constexpr int64_t kLimit = int64_t{1} << 29;
    all.lo[k] = overlap.lo[k], all.hi[k] = overlap.hi[k];
    is_known = is_known && all.lo[k] > -kLimit && all.hi[k] < kLimit;
    if (all.hi[k] - all.lo[k] > all.hi[axis] - all.lo[axis]) axis = k;
  }
  if (!is_known) {
    boxes.push_back(all);
    return;
  }
  const Points of_p = near_plane(job, job.polygons()[p], job.polygons()[q]),
               of_q = near_plane(job, job.polygons()[q], job.polygons()[p]);
  const auto lowest = static_cast<double>(all.lo[axis]),
             length = static_cast<double>(all.hi[axis] - all.lo[axis]);
  for (uint32_t s = 0; s < slices; ++s) {
    const double lo = lowest + length * s / slices, hi = lowest + length * (s + 1) / slices;
    const PieceBox p_box = box_of_slice(of_p, axis, lo, hi),
                   q_box = box_of_slice(of_q, axis, lo, hi);
    GridBox box;
    bool is_empty = false;
    for (size_t k = 0; k < 3; ++k) {
      // A step more: places between points are rounded, as corners may be.
      const double from = std::max(p_box.lo[k], q_box.lo[k]) - 1,
                   to = std::min(p_box.hi[k], q_box.hi[k]) + 1;
      is_empty |= !(from <= to);
      if (is_empty) break;
      box.lo[k] = std::max(all.lo[k], static_cast<int64_t>(std::floor(from)));
      box.hi[k] = std::min(all.hi[k], static_cast<int64_t>(std::ceil(to)));
    }
    if (!is_empty && !box.empty()) boxes.push_back(box);
  }
}

}  // namespace csgrun
