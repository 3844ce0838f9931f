// The points of a geometry for one of several threads that read it: what has to be known exactly is
// worked out, and kept, by each for itself.
#pragma once

#include <array>
#include <cstdint>

#include "engine/base/chunked_vector.h"
#include "engine/base/number_map.h"
#include "engine/bsp/cell_geometry.h"

namespace csgrun {

class PointView {
 public:
  /// While there are views of it the geometry forgets no point; none is added while it is read.
  explicit PointView(const CellGeometry& geometry) : geometry_(&geometry) {}

  [[nodiscard]] const std::array<double, 3>& rounded(uint32_t p) const {
    return geometry_->point(p).rounded;
  }
  /// Valid as long as the view.
  const Point& exact(uint32_t p) {
    const auto [place, is_new] = place_.find_or_add(p, static_cast<uint32_t>(exact_.size()));
    if (is_new) exact_.push_back(geometry_->value(p));
    return exact_[place];
  }
  /// Sign of the stored plane `plane` at a point, as CellGeometry::side.
  int side(uint32_t plane, uint32_t p) {
    return side_of(geometry_->planes(), plane, geometry_->point(p), counters,
                   [&]() -> const Point& { return exact(p); });
  }
  /// -1, 0, +1: the order of two points along an axis. Exact.
  int compare_along(uint32_t p, uint32_t q, int axis) {
    const double a = rounded(p)[axis], b = rounded(q)[axis];
    if (a != b) return a < b ? -1 : 1;
    if (p == q || (geometry_->is_found_on_grid(p) && geometry_->is_found_on_grid(q))) return 0;
    return csgrun::compare_along(exact(p), exact(q), axis);
  }

  SignCounters counters;

 private:
  const CellGeometry* geometry_;
  NumberMap place_;  ///< of points in:
  ChunkedVector<Point, 16> exact_;
};

}  // namespace csgrun
