// The boxes of what is in a cell, side by side: many are held against one at once.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/bsp/polygon_box.h"

namespace csgrun {

/// Keeps its memory from one cell to the next.
class CellBoxes {
 public:
  static constexpr uint32_t kAtOnce = 32;

  /// `count` boxes, box(i) each, all of which meet the cell from `lo` on.
  template <class Box>
  void load(const std::array<int32_t, 3>& lo, uint32_t count, Box&& box) {
    for (int k = 0; k < 3; ++k) {
      lo_[k].resize(count);
      hi_[k].resize(count);
    }
    starts_.assign(count, 0);
    for (uint32_t i = 0; i < count; ++i) {
      const PolygonBox& own = box(i);
      for (int k = 0; k < 3; ++k) {
        lo_[k][i] = own.lo[k];
        hi_[k][i] = own.hi[k];
        if (own.lo[k] >= lo[k]) starts_[i] |= 1u << k;
      }
    }
  }

  /// Whether each of `count` boxes from `first` on, kAtOnce at most, overlaps box j, with an
  /// overlap whose lowest corner is in the cell: as all of them meet it, either starts in it along
  /// each axis.
  void compare(uint32_t first, uint32_t count, uint32_t j,
               std::array<uint32_t, kAtOnce>& meets) const {
    std::array<uint32_t, kAtOnce> all;  // on the stack: nothing else can be there
    const uint32_t own_starts = starts_[j], *starts = starts_.data() + first;
    for (uint32_t i = 0; i < count; ++i) all[i] = (starts[i] | own_starts) == kAllAxes ? 1 : 0;
    for (int k = 0; k < 3; ++k) {
      const int32_t own_lo = lo_[k][j], own_hi = hi_[k][j];
      const int32_t *lo = lo_[k].data() + first, *hi = hi_[k].data() + first;
      for (uint32_t i = 0; i < count; ++i) {
        all[i] &= static_cast<uint32_t>(lo[i] <= own_hi) & static_cast<uint32_t>(hi[i] >= own_lo);
      }
    }
    meets = all;
  }

 private:
  static constexpr uint32_t kAllAxes = 7;

  std::array<std::vector<int32_t>, 3> lo_, hi_;
  std::vector<uint32_t> starts_;  ///< along which axes the box has its lower end in the cell
};

}  // namespace csgrun
