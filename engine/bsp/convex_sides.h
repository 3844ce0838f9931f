// Whether points are inside of convex leaves, by all their planes in doubles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/number_map.h"
#include "engine/bsp/frame_map.h"
#include "engine/bsp/operand.h"
#include "engine/bsp/ray_label.h"

namespace csgrun {

/// A plane in doubles, with a normal of length one, about.
using UnitPlane = std::array<double, 4>;
/// That of a face of a leaf, in the world; `map`: of the operand's frame. At points below 2^30 its
/// value is off by much less than a step: the offset, below 2^31, by 2^-20, and so is the normal's
/// part.
UnitPlane unit_plane(const Operand& operand, const FrameMap& map, size_t face);
/// How far a point is in front of a plane.
inline double above(const UnitPlane& p, const std::array<double, 3>& point) {
  return p[0] * point[0] + p[1] * point[1] + p[2] * point[2] + p[3];
}

/// Not for several threads at the same time; copies know what was known.
class ConvexSides {
 public:
  /// Where a point is that is wrong by less than a step along each axis; kUnknown where it may be
  /// no more than that away from the surface, or from a plane that goes on beyond it. REQUIRES: the
  /// operand is a convex leaf with faces, and all coordinates are below 2^30. O(faces).
  Inside side(const std::vector<Operand>& operands, uint32_t operand,
              const std::array<double, 3>& point);

 private:
  NumberMap place_;  ///< of operands asked about in:
  std::vector<std::vector<UnitPlane>> planes_;
};

}  // namespace csgrun
