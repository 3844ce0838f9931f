#include "primitives/shape2d/grid2d.h"

#include <cmath>

namespace csgrun {

std::optional<Grid2D> Grid2D::for_extent(double extent) {
  if (!(extent <= 1e12)) return std::nullopt;
  double steps_per_mm = 64e6;  // 2^-6 nm; this and all that follow are exact doubles
  while (extent * steps_per_mm >= static_cast<double>(kMostGrid2D - 1)) steps_per_mm /= 8;
  return Grid2D(steps_per_mm);
}

Point2D Grid2D::snap(const glm::dvec2& p) const {
  auto snap_one = [&](double v) {
    return static_cast<int64_t>(std::floor(v * steps_per_mm_ + (0.5 + 0x1p-12)));
  };
  return {snap_one(p.x), snap_one(p.y)};
}

glm::dvec2 Grid2D::unsnap(const Point2D& p) const {
  return {static_cast<double>(p.x) / steps_per_mm_, static_cast<double>(p.y) / steps_per_mm_};
}

}  // namespace csgrun
