// Pairs of segments whose boxes meet, by a sweep along the axis on which they are shortest, in
// strips across it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
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
  /// the axis in one strip.
  template <class Visit>
  void for_each_pair(Visit&& visit) {
    if (boxes_.size() <= kFewSegments) return for_each_of_few(visit);
    lay_strips();
    order_.clear();
    for (uint32_t s = 0; s < boxes_.size(); ++s) order_.push_back({boxes_[s][axis_][0], s});
    std::sort(order_.begin(), order_.end(), [](const Start& a, const Start& b) {
      return a.at != b.at ? a.at < b.at : a.number < b.number;
    });
    for (const auto& [at, t] : order_) {
      const Box& box = boxes_[t];
      const uint32_t first = strip(box[across_][0]), last = strip(box[across_][1]);
      for (uint32_t i = first; i <= last; ++i) {
        std::vector<Active>& active = active_[i];
        size_t kept = 0;
        for (const Active s : active) {
          if (s.end < box[axis_][0]) continue;
          active[kept++] = s;
          // In the first strip that both are in.
          if (i == std::max(first, s.first) && are_near(boxes_[s.number], box)) visit(s.number, t);
        }
        active.resize(kept);
        active.push_back({box[axis_][1], first, t});
      }
    }
  }

 private:
  using Box = std::array<std::array<double, 2>, 3>;
  struct Start {
    double at;
    uint32_t number;
  };
  /// A segment in a strip, until the sweep has passed its end.
  struct Active {
    double end;
    uint32_t first;  ///< strip
    uint32_t number;
  };

  /// Of so many, each is compared with each.
  static constexpr size_t kFewSegments = 16;
  template <class Visit>
  void for_each_of_few(Visit& visit) {
    for (uint32_t t = 1; t < boxes_.size(); ++t) {
      for (uint32_t s = 0; s < t; ++s) {
        if (are_near(boxes_[s], boxes_[t])) visit(s, t);
      }
    }
  }

  static bool are_near(const Box& a, const Box& b) {
    bool near = true;
    for (int k = 0; k < 3; ++k) near &= a[k][0] <= b[k][1] && b[k][0] <= a[k][1];
    return near;
  }

  /// Chooses the axis of the sweep, where the segments are shortest in comparison with all of them
  /// together, and divides the next best one into strips about as wide as segments are long.
  void lay_strips() {
    constexpr uint32_t kFew = 64, kMost = 4096;
    std::array<double, 3> share{2, 2, 2};  // of the whole, on average: at most 1
    std::array<double, 3> lo{}, hi{};
    for (int k = 0; k < 3; ++k) {
      double sum = 0;
      for (size_t s = 0; s < boxes_.size(); ++s) {
        const auto& [a, b] = boxes_[s][k];
        lo[k] = s == 0 ? a : std::min(lo[k], a);
        hi[k] = s == 0 ? b : std::max(hi[k], b);
        sum += b - a;
      }
      if (hi[k] > lo[k]) share[k] = sum / (hi[k] - lo[k]) / static_cast<double>(boxes_.size());
    }
    axis_ = static_cast<int>(std::min_element(share.begin(), share.end()) - share.begin());
    across_ = (axis_ + 1) % 3;
    if (share[(axis_ + 2) % 3] < share[across_]) across_ = (axis_ + 2) % 3;
    // A segment is in one strip more than it is long, on average two.
    uint32_t count = 1;
    if (boxes_.size() > kFew && share[across_] <= 1) {
      const double wanted = std::min(1 / std::max(share[across_], 1.0 / kMost),
                                     static_cast<double>(boxes_.size()) / kFew);
      count = std::max(static_cast<uint32_t>(wanted), 1u);
    }
    lo_ = lo[across_];
    per_step_ = count > 1 ? count / (hi[across_] - lo_) : 0;
    strips_ = count;
    if (active_.size() < count) active_.resize(count);
    // Others are cleared when they are in use: after a large face they are many.
    for (uint32_t i = 0; i < count; ++i) active_[i].clear();
  }

  /// Monotone.
  [[nodiscard]] uint32_t strip(double coordinate) const {
    return std::min(static_cast<uint32_t>((coordinate - lo_) * per_step_), strips_ - 1);
  }

  std::vector<Box> boxes_;
  std::vector<Start> order_;
  int axis_ = 0, across_ = 0;
  double lo_ = 0, per_step_ = 0;
  uint32_t strips_ = 1;
  std::vector<std::vector<Active>> active_;  ///< per strip
};

}  // namespace csgrun
