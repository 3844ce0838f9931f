// Points as homogeneous integers: the exact value of "where three planes meet".
#pragma once

#include <array>

#include "engine/exact/fixed_int.h"
#include "engine/exact/plane.h"
#include "engine/exact/widths.h"

namespace csgrun {

constexpr int kPointLimbs = widths::limbs(widths::kMaxPointXyz);
static_assert(widths::limbs(widths::kMaxPointW) <= kPointLimbs);
static_assert(kPointLimbs == 6, "the storage below was sized for the widths of widths.h");

/// The point (x/w, y/w, z/w), w > 0. Coordinates are full sign-extended integers; `bits` are the
/// widths of the magnitudes, which choose the tier of a predicate.
struct Point {
  Int<kPointLimbs> x, y, z, w;
  int xyz_bits = 0, w_bits = 0;
};

/// A point of the grid: w = 1.
Point grid_point(int64_t x, int64_t y, int64_t z);

/// Fills in the widths of a point whose coordinates were set by hand, and makes w positive.
void normalise(Point& p);

/// Where three planes meet. REQUIRES: they meet in one point. 35 to 150 ns by the planes' widths.
/// Source: Cramer's rule; the widths are those of widths::point_w and point_xyz.
Point intersect(const Plane& p, const Plane& q, const Plane& r);

/// x y z rounded to double, each correctly: equal points have equal bits.
std::array<double, 3> rounded(const Point& p);

/// Exact order along one axis (0, 1, 2): -1, 0, +1.
int compare_along(const Point& p, const Point& q, int axis);
/// Exact lexicographic order x, y, z.
int compare(const Point& p, const Point& q);

}  // namespace csgrun
