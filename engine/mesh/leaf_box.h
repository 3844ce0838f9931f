// The box of the vertices of a leaf.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// Empty for no points.
inline GridBox box_of_points(const std::vector<IVec3>& points) {
  GridBox box;
  if (points.empty()) return box;
  box.lo = box.hi = points[0];
  for (const IVec3& p : points) {
    for (size_t k = 0; k < 3; ++k) {
      box.lo[k] = std::min(box.lo[k], p[k]);
      box.hi[k] = std::max(box.hi[k], p[k]);
    }
  }
  return box;
}

}  // namespace csgrun
