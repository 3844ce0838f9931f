// Boxes of polygons, in whole steps.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace csgrun {

/// Small box for culling: outward rounded grid coordinates, clamped to +-kLimit.
struct PolygonBox {
  static constexpr int32_t kLimit = int32_t{1} << 30;

  std::array<int32_t, 3> lo, hi;

  /// One that holds nothing.
  static PolygonBox none() {
    constexpr int32_t lo = std::numeric_limits<int32_t>::min(),
                      hi = std::numeric_limits<int32_t>::max();
    return {{hi, hi, hi}, {lo, lo, lo}};
  }
  static PolygonBox everywhere() {
    const PolygonBox inside_out = none();
    return {inside_out.hi, inside_out.lo};
  }
  void include(const PolygonBox& o) {
    for (size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], o.lo[k]);
      hi[k] = std::max(hi[k], o.hi[k]);
    }
  }
  /// Leaves what another one has, too.
  void clip(const PolygonBox& o) {
    for (size_t k = 0; k < 3; ++k) {
      lo[k] = std::max(lo[k], o.lo[k]);
      hi[k] = std::min(hi[k], o.hi[k]);
    }
  }
  [[nodiscard]] bool meets(const PolygonBox& o) const {
    bool all = true;
    for (size_t k = 0; k < 3; ++k) all &= o.lo[k] <= hi[k] && o.hi[k] >= lo[k];
    return all;
  }
  [[nodiscard]] bool holds(const PolygonBox& o) const {
    bool all = true;
    for (size_t k = 0; k < 3; ++k) all &= lo[k] <= o.lo[k] && o.hi[k] <= hi[k];
    return all;
  }
  [[nodiscard]] bool is_empty() const { return lo[0] > hi[0] || lo[1] > hi[1] || lo[2] > hi[2]; }
};

}  // namespace csgrun
