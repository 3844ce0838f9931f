// A grid of boxes that tells where several operands may have surface.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/base/subsets.h"
#include "engine/bsp/job.h"

namespace csgrun {

/// Boxes whose sides are powers of two and differ by a factor of two at most.
class CoarseGrid {
 public:
  /// In a cell; else the number of an operand, and one.
  static constexpr uint32_t kNobody = 0, kSeveral = ~0u;
  /// Polygons that are in more cells than this on the average are too large for a grid.
  static constexpr size_t kMostCellsEach = 16;
  /// Along an axis: places are 16-bit integers.
  static constexpr size_t kMostInRow = 32000;

  /// So many are of use for so many polygons, of which `limit` in a cell are few.
  static size_t most_cells(size_t polygons, uint32_t limit) {
    // So many times as many as would do if polygons were evenly spread: surfaces are not.
    constexpr size_t kOverLimit = 8;
    constexpr size_t kMost = size_t{1} << 21;  // more are not worth the memory
    return std::min(kMost, kOverLimit * polygons / limit);
  }

  /// Over a box, of at most so many cells.
  CoarseGrid(const PolygonBox& bounds, size_t most_cells) : bounds_(bounds) {
    constexpr unsigned kWhole = 31;
    shift_.fill(kWhole);
    for (size_t k = 0; k < 3; ++k) count_[k] = place(k, bounds.hi[k]) + 1;
    while (true) {
      const size_t k = std::max_element(shift_.begin(), shift_.end()) - shift_.begin();
      if (shift_[k] == 0) break;
      --shift_[k];
      const size_t before = count_[k];
      count_[k] = place(k, bounds.hi[k]) + 1;
      if (count_[k] <= kMostInRow && count_[0] * count_[1] * count_[2] <= most_cells) continue;
      ++shift_[k];
      count_[k] = before;
      break;
    }
    for (size_t axes = 0; axes < second_.size(); ++axes) {
      second_[axes] =
          (axes & 1) + (axes >> 1 & 1) * count_[0] + (axes >> 2) * count_[0] * count_[1];
    }
    for (size_t k = 0; k < 3; ++k) last_[k] = static_cast<int16_t>(count_[k] - 1);
    stride_ = {1, static_cast<int>(count_[0]), static_cast<int>(count_[0] * count_[1])};
    cells_.resize(count_[0] * count_[1] * count_[2]);
    for_each_range(cells_.size(), [&](size_t begin, size_t end) {
      std::fill(cells_.data() + begin, cells_.data() + end, kNobody);
    });
  }

  /// Marks a cell with the surface of an operand (its number and one); of polygons
  /// that are covered only where others have some. What is there after all of them does not depend
  /// on who comes first. Several threads may mark at the same time.
  /// Returns whether the cell has several then.
  static bool mark(uint32_t& cell, uint32_t own, bool are_covered) {
    const std::atomic_ref<uint32_t> shared(cell);
    uint32_t known = shared.load(std::memory_order_relaxed);
    while (known != own && known != kSeveral) {
      if (known == kNobody && are_covered) return false;
      const uint32_t then = known == kNobody ? own : kSeveral;
      if (shared.compare_exchange_weak(known, then, std::memory_order_relaxed)) {
        return then == kSeveral;
      }
    }
    return known == kSeveral;
  }

  /// The cell of a point along each axis: one before the first or one after the last where it is
  /// not in the box. A vector, of which the processor compares all numbers at once; the fourth is
  /// not used.
  using Place = int16_t __attribute__((vector_size(8)));
  template <class Coordinate>
  [[nodiscard]] Place place_of(const std::array<Coordinate, 3>& point) const {
    Place place{};
    for (size_t k = 0; k < 3; ++k) {
      const int64_t from = std::max<int64_t>(int64_t{point[k]} - bounds_.lo[k], -1);
      const int64_t length = int64_t{bounds_.hi[k]} - bounds_.lo[k];
      place[k] = static_cast<int16_t>(from > length ? int64_t{last_[k]} + 1 : from >> shift_[k]);
    }
    return place;
  }

  /// The cells that a box meets: in rows of `count[0]`, from `first` on.
  struct Cells {
    uint32_t first;
    std::array<uint8_t, 3> more;  ///< along each axis, so many more than one
    bool any;

    [[nodiscard]] size_t count() const {
      return any ? (more[0] + size_t{1}) * (more[1] + size_t{1}) * (more[2] + size_t{1}) : 0;
    }
  };
  /// Those of the box between two places. False when there are too many to name.
  bool find_cells(Place lo, Place hi, Cells& cells) const {
    constexpr int kMostMore = 255;
    const Place none{};
    lo = lo > none ? lo : none;
    hi = hi < last_ ? hi : last_;
    const Place more = hi - lo;
    cells.any = more[0] >= 0 && more[1] >= 0 && more[2] >= 0;
    cells.first = static_cast<uint32_t>(lo[0] + lo[1] * stride_[1] + lo[2] * stride_[2]);
    for (size_t k = 0; k < 3; ++k) cells.more[k] = static_cast<uint8_t>(more[k]);
    return !cells.any || std::max({more[0], more[1], more[2]}) <= kMostMore;
  }
  bool find_cells(const PolygonBox& box, Cells& cells) const {
    return find_cells(place_of(box.lo), place_of(box.hi), cells);
  }
  /// Calls visit(cell) for each.
  template <class Visit>
  void each_cell(const Cells& cells, Visit&& visit) {
    if (!cells.any) return;
    const uint32_t more =
        cells.more[0] | uint32_t{cells.more[1]} << 8 | uint32_t{cells.more[2]} << 16;
    if ((more & ~0x010101u) == 0) {
      // Two along some axes: a bit for each of these. Nearly all are of this kind.
      const uint32_t axes = (more | more >> 7 | more >> 14) & 7;
      for_each_subset(axes, [&](uint32_t some) { visit(cells_[cells.first + second_[some]]); });
      return;
    }
    uint32_t* layer = cells_.data() + cells.first;
    for (size_t z = 0; z <= cells.more[2]; ++z, layer += count_[0] * count_[1]) {
      uint32_t* row = layer;
      for (size_t y = 0; y <= cells.more[1]; ++y, row += count_[0]) {
        for (size_t x = 0; x <= cells.more[0]; ++x) visit(row[x]);
      }
    }
  }
  /// Calls visit(cell, bounds) for all cells with kSeveral.
  template <class Visit>
  void each_shared(Visit&& visit) {
    size_t at = 0;
    for (size_t z = 0; z < count_[2]; ++z) {
      for (size_t y = 0; y < count_[1]; ++y) {
        for (size_t x = 0; x < count_[0]; ++x, ++at) {
          if (cells_[at] == kSeveral) visit(cells_[at], bounds_of_cell({x, y, z}));
        }
      }
    }
  }

 private:
  [[nodiscard]] size_t place(size_t axis, int32_t coordinate) const {
    // Boxes are within 2^30: differences fit.
    return (static_cast<uint32_t>(coordinate) - static_cast<uint32_t>(bounds_.lo[axis])) >>
           shift_[axis];
  }
  [[nodiscard]] PolygonBox bounds_of_cell(const std::array<size_t, 3>& cell) const {
    PolygonBox box{};
    for (size_t k = 0; k < 3; ++k) {
      const int64_t lo = bounds_.lo[k] + static_cast<int64_t>(cell[k] << shift_[k]);
      const int64_t hi = lo + (int64_t{1} << shift_[k]) - 1;
      box.lo[k] = static_cast<int32_t>(lo);
      box.hi[k] = static_cast<int32_t>(std::min<int64_t>(hi, bounds_.hi[k]));
    }
    return box;
  }

  const PolygonBox bounds_;
  std::array<unsigned, 3> shift_{};
  std::array<size_t, 3> count_{};
  Place last_{};  ///< the last along each axis
  std::array<int, 3> stride_{};
  std::array<size_t, 8> second_{};  ///< from a cell to the next along several axes, a bit for each
  RawVector<uint32_t> cells_;
};

}  // namespace csgrun
