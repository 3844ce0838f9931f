// One triangle against eight, or eight boxes, at once: which are certainly apart from it along one
// of its own directions.
#pragma once

#include <array>
#include <cstdint>

#include "engine/bsp/packed_boxes.h"

namespace csgrun {

/// The corners of eight triangles, in floats: [corner][axis][lane].
struct alignas(16) EightTriangles {
  std::array<std::array<std::array<float, 8>, 3>, 3> at;
};

/// What a triangle takes up along its normal and, in its plane, across each of its sides; a little
/// more than that: if all corners of another triangle, rounded to floats, are beyond a bound along
/// one direction, the triangles have no point in common. Nor have they if that is so of the part of
/// the other one between the two bounds along the normal, across one of the sides: of two triangles
/// that pass through each other's plane and are apart there always is such a side.
class Slabs {
 public:
  /// `reach` is not below any coordinate of this triangle or of others, in magnitude. A triangle
  /// that doubles take for one without area is apart from nothing.
  Slabs(const std::array<std::array<double, 3>, 3>& corners, double reach);
  Slabs() = default;

  /// A bit for each of the eight that is apart, of those in `which`, but for those that may be in
  /// the plane of this one.
  [[nodiscard]] uint32_t apart_in_space(const EightTriangles& others, uint32_t which) const;
  /// A bit for each of eight boxes that is apart, of those in `which`; their bounds are rounded to
  /// floats too.
  [[nodiscard]] uint32_t apart(const EightBoxes& boxes, uint32_t which) const;

 private:
  struct Slab {
    std::array<float, 3> along{};
    float lo = 0, hi = 0;
  };
  /// Which of the eight are beyond a slab, and which in it.
  struct Places {
    uint32_t beyond = 0, inside = 0;
  };
  static Places places(const Slab& slab, const EightTriangles& others, uint32_t which);
  static uint32_t beyond(const Slab& slab, const EightBoxes& boxes);
  /// Those that are beyond one of the slabs across the sides.
  [[nodiscard]] uint32_t beyond_sides(const EightTriangles& others, uint32_t which) const;

  /// Those whose part in the slab along the normal is beyond one of the others.
  [[nodiscard]] uint32_t beyond_where_clipped(const EightTriangles& others, uint32_t which) const;

  std::array<Slab, 4> slabs_;  ///< the first along the normal
  float slack_ = 0;            ///< more than what clipping adds to what rounding does
};

}  // namespace csgrun
