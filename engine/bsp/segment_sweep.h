// Pairs of segments whose boxes meet, by a sweep along the axis on which they are shortest.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

namespace csgrun {

class SegmentSweep {
 public:
  void clear() { boxes_.clear(); }
  /// Adds the segment of the next number. Ends are rounded coordinates: rounding keeps order, so
  /// boxes of rounded ends meet where the true ones do.
  void add(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    Box box;
    for (int k = 0; k < 3; ++k) box[k] = {std::min(a[k], b[k]), std::max(a[k], b[k])};
    boxes_.push_back(box);
  }
  /// Calls visit(s, t) once for each pair that is near. O(n log n), and the pairs that meet along
  /// the axis.
  template <class Visit>
  void for_each_pair(Visit&& visit) {
    const int axis = best_axis();
    order_.clear();
    for (uint32_t s = 0; s < boxes_.size(); ++s) order_.push_back(s);
    std::sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
      return std::tie(boxes_[a][axis][0], a) < std::tie(boxes_[b][axis][0], b);
    });
    active_.clear();
    for (const uint32_t t : order_) {
      std::erase_if(active_, [&](uint32_t s) { return boxes_[s][axis][1] < boxes_[t][axis][0]; });
      for (const uint32_t s : active_) {
        bool near = true;
        for (int k = 0; k < 3; ++k) {
          near &= boxes_[s][k][0] <= boxes_[t][k][1] && boxes_[t][k][0] <= boxes_[s][k][1];
        }
        if (near) visit(s, t);
      }
      active_.push_back(t);
    }
  }

 private:
  using Box = std::array<std::array<double, 2>, 3>;

  /// Where the segments are shortest in comparison with all of them together.
  [[nodiscard]] int best_axis() const {
    int best = 0;
    double least = 2;  // the sum of a share of at most 1 each is compared per segment
    for (int k = 0; k < 3; ++k) {
      double lo = 0, hi = 0, sum = 0;
      for (size_t s = 0; s < boxes_.size(); ++s) {
        const auto& [a, b] = boxes_[s][k];
        lo = s == 0 ? a : std::min(lo, a);
        hi = s == 0 ? b : std::max(hi, b);
        sum += b - a;
      }
      if (hi <= lo) continue;
      const double share = sum / (hi - lo) / static_cast<double>(boxes_.size());
      if (share < least) least = share, best = k;
    }
    return best;
  }

  std::vector<Box> boxes_;
  std::vector<uint32_t> order_, active_;
};

}  // namespace csgrun
