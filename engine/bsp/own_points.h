// Points that all polygons share, in a geometry that holds what is on one of them: each has one
// number there, as equal points have one in the index of all.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/raw_vector.h"
#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/point_index.h"

namespace csgrun {

class OwnPoints {
 public:
  /// `index`: of the `shared` geometry.
  OwnPoints(const CellGeometry& shared, const PointIndex& index, CellGeometry& own)
      : shared_(shared),
        index_(index),
        own_(own),
        stamp_of_(shared.point_count(), 0),
        number_(shared.point_count()) {}

  /// The geometry was cleared for the next polygon.
  void clear() {
    ++stamp_;
    shared_of_.clear();
  }
  /// The number here of a point of the shared geometry.
  uint32_t of(uint32_t shared) {
    if (stamp_of_[shared] == stamp_) return number_[shared];
    stamp_of_[shared] = stamp_;
    const CellGeometry::StoredPoint& s = shared_.point(shared);
    const uint32_t own =
        s.vertex != kNone ? own_.vertex_point(s.vertex) : own_.add_point(s.planes, s.rounded);
    if (own >= shared_of_.size()) shared_of_.resize(own_.point_count(), kNone);
    shared_of_[own] = shared;
    return number_[shared] = own;
  }
  /// The same of the point of a vertex that is in the index.
  uint32_t of_vertex(uint32_t vertex) {
    return of(index_.known(shared_.made_vertex_point(vertex)));
  }
  /// The point of the shared geometry that has a number here, or kNone.
  [[nodiscard]] uint32_t shared_of(uint32_t own) const {
    return own < shared_of_.size() ? shared_of_[own] : kNone;
  }

 private:
  const CellGeometry& shared_;
  const PointIndex& index_;
  CellGeometry& own_;
  /// Per point of the shared geometry: the polygon for which it has a number here, and that one.
  std::vector<uint32_t> stamp_of_;
  RawVector<uint32_t> number_;
  uint32_t stamp_ = 0;
  std::vector<uint32_t> shared_of_;  ///< per point here
};

}  // namespace csgrun
