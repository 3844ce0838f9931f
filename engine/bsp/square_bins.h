// Boxes by the squares of a grid that they meet, to find those that hold a point. The grid lies
// across the two axes along which most of them are beside one another.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/counting_order.h"

namespace csgrun {

class SquareBins {
 public:
  /// One below 2^62. One with lo > hi along an axis holds nothing; others are longer than nothing.
  struct Box {
    std::array<double, 3> lo, hi;
  };

  /// Of no boxes. REQUIRES: nobody asks for any.
  SquareBins() = default;
  /// `most`: so many squares at most, at least one. Fewer where boxes would meet many squares each,
  /// so O(boxes) but for the boxes that one square holds.
  SquareBins(std::span<const Box> boxes, uint32_t most) {
    divide(boxes, most);
    // Boxes meet one square each at last.
    while (count_entries(boxes) > kMostEach * boxes.size()) {
      for (size_t i = 0; i < 2; ++i) set_count(i, std::max(1u, count_[i] / 2));
    }
    std::vector<std::pair<uint32_t, uint32_t>> entries;  // square, box
    for (uint32_t i = 0; i < boxes.size(); ++i) {
      const Box& b = boxes[i];
      if (!holds_any(b)) continue;
      for (uint32_t y = place(1, b.lo); y <= place(1, b.hi); ++y) {
        for (uint32_t x = place(0, b.lo); x <= place(0, b.hi); ++x) {
          entries.emplace_back(y * count_[0] + x, i);
        }
      }
    }
    in_square_.sort(entries.size(), size_t{count_[0]} * count_[1],
                    [&](size_t e) { return entries[e].first; });
    for (uint32_t& e : in_square_.order) e = entries[e].second;
  }

  /// Those that hold a point, and some near it, ascending.
  [[nodiscard]] std::span<const uint32_t> at(const std::array<double, 3>& point) const {
    const uint32_t s = place(1, point) * count_[0] + place(0, point);
    return {in_square_.order.data() + in_square_.starts[s],
            in_square_.starts[s + 1] - in_square_.starts[s]};
  }

  /// Pairs of a square and a box that meets it: what is kept.
  [[nodiscard]] size_t size() const { return in_square_.order.size(); }

 private:
  static bool holds_any(const Box& b) {
    return b.lo[0] <= b.hi[0] && b.lo[1] <= b.hi[1] && b.lo[2] <= b.hi[2];
  }

  /// Chooses the axes, and how many squares there are along each: half as wide as boxes are.
  void divide(std::span<const Box> boxes, uint32_t most) {
    std::array<double, 3> beside{};  // how many boxes there is room for beside each other
    for (size_t k = 0; k < 3; ++k) {
      double lo = kFar, hi = -kFar, sum = 0, count = 0;
      for (const Box& b : boxes) {
        if (!holds_any(b)) continue;
        lo = std::min(lo, b.lo[k]);
        hi = std::max(hi, b.hi[k]);
        sum += b.hi[k] - b.lo[k];
        ++count;
      }
      lo_[k] = lo;
      extent_[k] = hi - lo;
      beside[k] = count > 0 ? extent_[k] / (sum / count) : 0;
    }
    std::array<size_t, 3> by_room{0, 1, 2};
    std::stable_sort(by_room.begin(), by_room.end(),
                     [&](size_t a, size_t b) { return beside[a] > beside[b]; });
    axis_ = {by_room[0], by_room[1]};
    const auto wanted = [&](size_t i, double at_most) {
      return static_cast<uint32_t>(
          std::max(1.0, std::min(std::ceil(2 * beside[axis_[i]]), at_most)));
    };
    set_count(1, wanted(1, std::sqrt(most)));
    set_count(0, wanted(0, static_cast<double>(most / count_[1])));
  }

  void set_count(size_t i, uint32_t count) {
    count_[i] = count;
    per_step_[i] = count / extent_[axis_[i]];
  }

  [[nodiscard]] size_t count_entries(std::span<const Box> boxes) const {
    size_t count = 0;
    for (const Box& b : boxes) {
      if (!holds_any(b)) continue;
      count += size_t{place(0, b.hi) - place(0, b.lo) + 1} * (place(1, b.hi) - place(1, b.lo) + 1);
    }
    return count;
  }

  /// Monotone: what is between the ends of a box is in a square between theirs.
  [[nodiscard]] uint32_t place(size_t i, const std::array<double, 3>& point) const {
    const double at = (point[axis_[i]] - lo_[axis_[i]]) * per_step_[i];
    return static_cast<uint32_t>(std::clamp(at, 0.0, static_cast<double>(count_[i] - 1)));
  }

  static constexpr double kFar = 0x1p62;
  static constexpr size_t kMostEach = 16;  ///< squares, on average

  std::array<size_t, 2> axis_{0, 1};
  std::array<uint32_t, 2> count_{1, 1};  ///< of squares along them
  std::array<double, 2> per_step_{};
  std::array<double, 3> lo_{}, extent_{};  ///< of all boxes
  CountingOrder in_square_;
};

}  // namespace csgrun
