// The plane of a polygon over grid points, seen along an axis: which way corners turn, exactly.
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "engine/bsp/job.h"
#include "engine/exact/fixed_int.h"

namespace csgrun {

/// Along an axis that does not lie in the plane of a polygon. REQUIRES: the vertices that are asked
/// about lie on the grid.
class FlatView {
 public:
  FlatView(const Job& job, uint32_t polygon) : job_(job) {
    for (; x_ < 3; ++x_) {
      y_ = x_ < 2 ? x_ + 1 : 0;
      if (way_round(polygon) != 0) break;
    }
    assert(x_ < 3);  // it has an area
  }

  /// Which way a convex polygon of the plane runs round as it is seen: +1 is counter-clockwise.
  [[nodiscard]] int way_round(uint32_t polygon) const {
    const auto corners = job_.corners(job_.polygons()[polygon]);
    for (size_t c = 2; c < corners.size(); ++c) {
      if (const int way = turn(corners[0], corners[c - 1], corners[c])) return way;
    }
    return 0;
  }

  /// +1 when c is seen on the left of the way from a to b. Differences of coordinates have 41 bits
  /// at most (widths::kFarGrid): doubles hold them. Their products, of 82, are rounded by a part of
  /// 2^-53 each, and so is the difference of these, unless they are small.
  [[nodiscard]] int turn(uint32_t a, uint32_t b, uint32_t c) const {
    const auto &at = job_.rounded(a), &to = job_.rounded(b), &of = job_.rounded(c);
    const double ux = to[x_] - at[x_], uy = to[y_] - at[y_], vx = of[x_] - at[x_],
                 vy = of[y_] - at[y_];
    const double left = ux * vy, right = uy * vx, det = left - right;
    const double size = std::fabs(left) + std::fabs(right);
    if (size < 0x1p53 || std::fabs(det) > 0x1p-51 * size) return (det > 0) - (det < 0);
    const auto whole = [](double v) { return static_cast<Int128>(static_cast<int64_t>(v)); };
    const Int128 exact = whole(ux) * whole(vy) - whole(uy) * whole(vx);
    return exact > 0 ? 1 : exact < 0 ? -1 : 0;
  }

 private:
  const Job& job_;
  size_t x_ = 0, y_ = 1;
};

}  // namespace csgrun
