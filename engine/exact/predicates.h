// The one predicate of the kernel: on which side of a plane does a point lie?
//
// Three tiers: a double filter; equality of plane ids (in point_store.h, where points remember the
// planes that they were made from); exact integers of 64 to 512 bits. The exact tiers are there for
// zeros: a filter failure on a non-zero value hardly ever occurs.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "engine/exact/plane.h"
#include "engine/exact/point.h"

namespace csgrun {

/// How often each tier answered.
struct SignCounters {
  uint64_t filter = 0, symbolic = 0;
  std::array<uint64_t, 6> exact{};  ///< 64, 128, 192, 256, 384, 512 bits

  void add(const SignCounters& o) {
    filter += o.filter, symbolic += o.symbolic;
    for (size_t i = 0; i < exact.size(); ++i) exact[i] += o.exact[i];
  }
  void subtract(const SignCounters& o) {
    filter -= o.filter, symbolic -= o.symbolic;
    for (size_t i = 0; i < exact.size(); ++i) exact[i] -= o.exact[i];
  }
};

constexpr std::array<int, 6> kTierBits{64, 128, 192, 256, 384, 512};
static_assert(widths::kMaxSide < kTierBits.back());

/// The tier (index into kTierBits) that holds the value of a plane at a point.
int exact_tier(const Plane& plane, const Point& point);

/// The sign of plane at point, exactly: +1 on the side that the normal points to. Computed in the
/// given tier, which must be at least exact_tier(plane, point).
int exact_side(const Plane& plane, const Point& point, int tier);
/// The same for a point of the grid.
int exact_side(const Plane& plane, const std::array<int64_t, 3>& point, int tier);
inline int exact_side(const Plane& plane, const Point& point) {
  return exact_side(plane, point, exact_tier(plane, point));
}

/// The sign by doubles, or 0 when unsure. `plane` has coefficients with relative error u = 2^-53
/// each (one rounding), `point` coordinates with relative error u (rounded correctly).
///
/// Error bound: each product a x carries three factors (1 + e), |e| <= u (coefficient, coordinate,
/// product), the offset one; the three sums add at most three more. With M = |ax| + |by| + |cz| +
/// |d| as computed, the total error is at most ((1+u)^6 - 1) M' where M' <= (1 + u)^6 M is the
/// exact sum, so below 6.1 u (1 + 7u) M < 8 u M.
inline int filter_side(const std::array<double, 4>& plane, const std::array<double, 3>& point) {
  const double ax = plane[0] * point[0], by = plane[1] * point[1], cz = plane[2] * point[2];
  const double value = ax + by + cz + plane[3];
  const double bound =
      0x1p-50 * (std::fabs(ax) + std::fabs(by) + std::fabs(cz) + std::fabs(plane[3]));
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

}  // namespace csgrun
