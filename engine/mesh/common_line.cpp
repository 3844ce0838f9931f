#include "engine/mesh/common_line.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace csgrun {
namespace {

/// What a face has of the line in which its plane meets another, along an axis, as doubles tell
/// it: within the bounds for certain. A corner at an end is named if nothing else may be there.
struct LineInterval {
  double lo = HUGE_VAL, hi = -HUGE_VAL;
  uint32_t lo_corner = kNone, hi_corner = kNone;

  void include(double from, double to, uint32_t corner) {
    if (from < lo) {
      lo = from, lo_corner = corner;
    } else if (from == lo && corner != lo_corner) {
      lo_corner = kNone;
    }
    if (to > hi) {
      hi = to, hi_corner = corner;
    } else if (to == hi && corner != hi_corner) {
      hi_corner = kNone;
    }
  }
};

/// False when the face does not pass through the plane.
bool interval(const MergedFace& face, uint32_t plane, int axis, CellGeometry& geometry,
              const PlaneTable& planes, LineInterval& on_line) {
  const std::array<double, 4>& n = planes.approximate(plane);
  const auto value = [&](const std::array<double, 3>& p, double& error) {
    const double x = n[0] * p[0], y = n[1] * p[1], z = n[2] * p[2];
    // Four times what the filter of signs allows for.
    error = 0x1p-48 * (std::fabs(x) + std::fabs(y) + std::fabs(z) + std::fabs(n[3]));
    return x + y + z + n[3];
  };
  bool front = false, back = false;
  for (const auto& loop : face.loops) {
    for (const DirectedEdge& e : loop) {
      const int here = geometry.side(plane, e.from), there = geometry.side(plane, e.to);
      front |= here > 0;
      back |= here < 0;
      const auto &p = geometry.point(e.from).rounded, &q = geometry.point(e.to).rounded;
      if (here == 0) on_line.include(p[axis], p[axis], e.from);
      if (here * there >= 0) continue;
      double p_error = 0, q_error = 0;
      const double at_p = value(p, p_error), at_q = value(q, q_error);
      const double lo = std::min(p[axis], q[axis]), hi = std::max(p[axis], q[axis]);
      const double sum = std::fabs(at_p) + std::fabs(at_q), error = p_error + q_error;
      if (sum <= 2 * error) {
        on_line.include(lo, hi, kNone);
        continue;
      }
      const double x = p[axis] + (q[axis] - p[axis]) * (std::fabs(at_p) / sum);
      const double margin = (hi - lo) * 4 * error / sum + 0x1p-50 * (std::fabs(lo) + std::fabs(hi));
      on_line.include(std::max(lo, x - margin), std::min(hi, x + margin), kNone);
    }
  }
  return front && back;
}

}  // namespace

bool may_share_line(const MergedFace& f, const MergedFace& g, CellGeometry& geometry,
                    const PlaneTable& planes) {
  const uint32_t f_plane = f.plane.index(), g_plane = g.plane.index();
  const auto &m = planes.approximate(f_plane), &n = planes.approximate(g_plane);
  int axis = 0;
  double longest = -1;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double size = std::fabs(m[i] * n[j] - m[j] * n[i]);
    if (size > longest) longest = size, axis = k;
  }
  LineInterval of_f, of_g;
  if (!interval(g, f_plane, axis, geometry, planes, of_g) ||
      !interval(f, g_plane, axis, geometry, planes, of_f)) {
    return false;
  }
  if (of_f.hi < of_g.lo || of_g.hi < of_f.lo) return false;
  const bool corner_only = (of_f.hi_corner != kNone && of_f.hi_corner == of_g.lo_corner) ||
                           (of_g.hi_corner != kNone && of_g.hi_corner == of_f.lo_corner);
  return !corner_only;
}

}  // namespace csgrun
