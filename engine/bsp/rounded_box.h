// Boxes of points that were rounded.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "engine/base/raw_vector.h"
#include "engine/bsp/polygon_box.h"

namespace csgrun {

struct PieceBox;

/// Points of the world, correctly rounded.
using RoundedPoints = RawVector<std::array<double, 3>>;

/// A coordinate, or the limit of boxes beyond it.
inline double clamp_to_box(double v) {
  constexpr double kLimit = PolygonBox::kLimit;
  return std::clamp(v, -kLimit, kLimit);
}

/// Whether a point is in a box, or may be: each coordinate is wrong by `error` at most.
inline bool may_hold(const PolygonBox& box, const std::array<double, 3>& point, double error) {
  bool all = true;
  for (size_t k = 0; k < 3; ++k) {
    all &= point[k] + error >= box.lo[k] && point[k] - error <= box.hi[k];
  }
  return all;
}

/// The box around one of correctly rounded coordinates, which may stand on either side of the true
/// ones.
PolygonBox rounded_outwards(const PieceBox& box);

/// The same of points; none if some are too far out for boxes.
std::optional<PolygonBox> box_of_rounded(std::span<const std::array<double, 3>> points);

}  // namespace csgrun
