// Boxes by the squares of a grid in x and y that they meet, to find those that hold a point.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/counting_order.h"

namespace csgrun {

class SquareBins {
 public:
  /// A box seen along z, below 2^62. One with lo > hi holds nothing; others are longer than
  /// nothing.
  struct Box {
    std::array<double, 2> lo, hi;
  };

  /// Of no boxes. REQUIRES: nobody asks for any.
  SquareBins() = default;
  /// `per_side`: so many squares along either axis at most, at least one. Fewer where boxes would
  /// meet many squares each, so O(boxes) but for the boxes that one square holds.
  SquareBins(std::span<const Box> boxes, uint32_t per_side) {
    divide(boxes, per_side);
    // Boxes meet one square each at last.
    while (count_entries(boxes) > kMostEach * boxes.size()) divide(boxes, per_side_ / 2);
    std::vector<std::pair<uint32_t, uint32_t>> entries;  // square, box
    for (uint32_t i = 0; i < boxes.size(); ++i) {
      const Box& b = boxes[i];
      for (uint32_t y = place(1, b.lo[1]); y <= place(1, b.hi[1]); ++y) {
        for (uint32_t x = place(0, b.lo[0]); x <= place(0, b.hi[0]); ++x) {
          entries.emplace_back(y * per_side_ + x, i);
        }
      }
    }
    in_square_.sort(entries.size(), size_t{per_side_} * per_side_,
                    [&](size_t e) { return entries[e].first; });
    for (uint32_t& e : in_square_.order) e = entries[e].second;
  }

  /// Those that hold a point, and some near it, ascending.
  [[nodiscard]] std::span<const uint32_t> at(double x, double y) const {
    const uint32_t s = place(1, y) * per_side_ + place(0, x);
    return {in_square_.order.data() + in_square_.starts[s],
            in_square_.starts[s + 1] - in_square_.starts[s]};
  }

  /// Pairs of a square and a box that meets it: what is kept.
  [[nodiscard]] size_t size() const { return in_square_.order.size(); }

 private:
  void divide(std::span<const Box> boxes, uint32_t per_side) {
    per_side_ = per_side;
    for (int k = 0; k < 2; ++k) {
      double lo = kFar, hi = -kFar;
      for (const Box& b : boxes) {
        lo = std::min(lo, b.lo[k]);
        hi = std::max(hi, b.hi[k]);
      }
      lo_[k] = lo;
      per_step_[k] = per_side / (hi - lo);
    }
  }

  [[nodiscard]] size_t count_entries(std::span<const Box> boxes) const {
    size_t count = 0;
    for (const Box& b : boxes) {
      if (b.lo[0] > b.hi[0] || b.lo[1] > b.hi[1]) continue;
      count += size_t{place(0, b.hi[0]) - place(0, b.lo[0]) + 1} *
               (place(1, b.hi[1]) - place(1, b.lo[1]) + 1);
    }
    return count;
  }

  /// Monotone: what is between the ends of a box is in a square between theirs.
  [[nodiscard]] uint32_t place(int axis, double coordinate) const {
    const double at = (coordinate - lo_[axis]) * per_step_[axis];
    return static_cast<uint32_t>(std::clamp(at, 0.0, static_cast<double>(per_side_ - 1)));
  }

  static constexpr double kFar = 0x1p62;
  static constexpr size_t kMostEach = 16;  ///< squares, on average

  uint32_t per_side_ = 1;
  std::array<double, 2> lo_{}, per_step_{};
  CountingOrder in_square_;
};

}  // namespace csgrun
