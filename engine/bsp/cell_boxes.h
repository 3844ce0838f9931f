// The boxes of what is in a cell, side by side: many are held against one at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/bsp/polygon_box.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace csgrun {

/// Keeps its memory from one cell to the next.
class CellBoxes {
 public:
  static constexpr uint32_t kAtOnce = 32;

  /// `count` boxes, box(i) each, all of which meet the cell from `lo` on.
  template <class Box>
  void load(const std::array<int32_t, 3>& lo, uint32_t count, Box&& box) {
    const size_t padded = size_t{count} + kLanes - 1;
    for (size_t k = 0; k < 3; ++k) {
      lo_[k].resize(padded);
      hi_[k].resize(padded);
    }
    starts_.assign(padded, 0);
    for (uint32_t i = 0; i < count; ++i) {
      const PolygonBox& own = box(i);
      for (size_t k = 0; k < 3; ++k) {
        lo_[k][i] = own.lo[k];
        hi_[k][i] = own.hi[k];
        if (own.lo[k] >= lo[k]) starts_[i] |= 1u << k;
      }
    }
  }

  /// A bit for each of `count` boxes from `first` on, kAtOnce at most, which overlaps box j, with
  /// an overlap whose lowest corner is in the cell: as all of them meet it, either starts in it
  /// along each axis.
  [[nodiscard]] uint32_t compare(uint32_t first, uint32_t count, uint32_t j) const {
    uint32_t bits = 0;
#if defined(__SSE2__)
    const auto all = [](uint32_t x) { return _mm_set1_epi32(static_cast<int>(x)); };
    const auto four = [](const auto& from, size_t at) {
      return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from.data() + at));
    };
    const __m128i own_starts = all(starts_[j]), all_axes = all(kAllAxes);
    __m128i own_lo[3], own_hi[3];
    for (size_t k = 0; k < 3; ++k) {
      own_lo[k] = _mm_set1_epi32(lo_[k][j]);
      own_hi[k] = _mm_set1_epi32(hi_[k][j]);
    }
    for (uint32_t i = 0; i < count; i += kLanes) {
      const size_t at = size_t{first} + i;
      __m128i apart = _mm_cmpgt_epi32(four(lo_[0], at), own_hi[0]);
      apart = _mm_or_si128(apart, _mm_cmpgt_epi32(own_lo[0], four(hi_[0], at)));
      for (size_t k = 1; k < 3; ++k) {
        apart = _mm_or_si128(apart, _mm_cmpgt_epi32(four(lo_[k], at), own_hi[k]));
        apart = _mm_or_si128(apart, _mm_cmpgt_epi32(own_lo[k], four(hi_[k], at)));
      }
      const __m128i starts = _mm_cmpeq_epi32(_mm_or_si128(four(starts_, at), own_starts), all_axes);
      const __m128i meet = _mm_andnot_si128(apart, starts);
      bits |= static_cast<uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(meet))) << i;
    }
    if (count < kAtOnce) bits &= (1u << count) - 1;
#else
    for (uint32_t i = 0; i < count; ++i) {
      const size_t at = size_t{first} + i;
      bool meet = (starts_[at] | starts_[j]) == kAllAxes;
      for (size_t k = 0; k < 3; ++k) {
        meet = meet & (lo_[k][at] <= hi_[k][j]) & (hi_[k][at] >= lo_[k][j]);
      }
      bits |= static_cast<uint32_t>(meet) << i;
    }
#endif
    return bits;
  }

 private:
  static constexpr uint32_t kAllAxes = 7;
  static constexpr uint32_t kLanes = 4;

  // Up to kLanes - 1 more than there are boxes: lanes that are read and not looked at.
  std::array<std::vector<int32_t>, 3> lo_, hi_;
  std::vector<uint32_t> starts_;  ///< along which axes the box has its lower end in the cell
};

}  // namespace csgrun
