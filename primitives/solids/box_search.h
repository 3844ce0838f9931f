// Boxes in a tree of boxes: which are near to one of them, and which are around another one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace csgrun {

class BoxSearch {
 public:
  using Box = std::array<glm::dvec3, 2>;  ///< its lowest and its highest corner

  /// O(n log^2 n).
  explicit BoxSearch(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    around_.resize(4 * boxes_.size());
    if (!boxes_.empty()) build(1, 0, order_.size());
  }

  /// The widest gap between two boxes along an axis; not positive when they meet.
  static double gap(const Box& a, const Box& b) {
    double widest = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) widest = std::max({widest, b[0][i] - a[1][i], a[0][i] - b[1][i]});
    return widest;
  }

  /// The least gap between a box and another one, of those that are wider than `near`, a number
  /// that is not negative: infinite if there are none.
  [[nodiscard]] double least_gap(uint32_t box, double near) const {
    double least = std::numeric_limits<double>::infinity();
    // What is around several boxes is no farther away than these, also when rounded.
    visit([&](const Box& around) { return gap(boxes_[box], around) < least; },
          [&](uint32_t i) {
            const double own = gap(boxes_[box], boxes_[i]);
            if (i != box && own > near) least = std::min(least, own);
          });
    return least;
  }

  /// The others to which a gap is not wider than that, ascending.
  [[nodiscard]] std::vector<uint32_t> near(uint32_t box, double distance) const {
    std::vector<uint32_t> found;
    visit([&](const Box& around) { return gap(boxes_[box], around) <= distance; },
          [&](uint32_t i) {
            if (i != box && gap(boxes_[box], boxes_[i]) <= distance) found.push_back(i);
          });
    std::sort(found.begin(), found.end());
    return found;
  }

  /// Those that hold all of a box, ascending.
  [[nodiscard]] std::vector<uint32_t> holding(const Box& box) const {
    const auto holds = [&](const Box& around) {
      bool all = true;
      for (int i = 0; i < 3; ++i) all &= around[0][i] <= box[0][i] && around[1][i] >= box[1][i];
      return all;
    };
    std::vector<uint32_t> found;
    visit(holds, [&](uint32_t i) {
      if (holds(boxes_[i])) found.push_back(i);
    });
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  /// Node `n` stands for the places [begin, end), its children 2n and 2n + 1 for their halves.
  void build(size_t n, size_t begin, size_t end) {
    Box& around = around_[n] = boxes_[order_[begin]];
    for (size_t i = begin + 1; i < end; ++i) {
      around[0] = glm::min(around[0], boxes_[order_[i]][0]);
      around[1] = glm::max(around[1], boxes_[order_[i]][1]);
    }
    if (end - begin == 1) return;
    const glm::dvec3 size = around[1] - around[0];
    int axis = size.y > size.x ? 1 : 0;
    if (size.z > size[axis]) axis = 2;
    const auto place = [&](uint32_t i) {
      return std::pair(boxes_[i][0][axis] / 2 + boxes_[i][1][axis] / 2, i);
    };
    const size_t middle = begin + (end - begin) / 2;
    const auto first = order_.begin();
    std::nth_element(first + static_cast<long>(begin), first + static_cast<long>(middle),
                     first + static_cast<long>(end),
                     [&](uint32_t a, uint32_t b) { return place(a) < place(b); });
    build(2 * n, begin, middle);
    build(2 * n + 1, middle, end);
  }

  /// Calls f(i) for boxes below nodes that, with all above them, are `of_interest`.
  template <class OfInterest, class F>
  void visit(OfInterest&& of_interest, F&& f) const {
    struct Step {
      size_t node, begin, end;
    };
    std::vector<Step> stack;
    if (!boxes_.empty()) stack.push_back({1, 0, order_.size()});
    while (!stack.empty()) {
      const Step top = stack.back();
      stack.pop_back();
      if (!of_interest(around_[top.node])) continue;
      if (top.end - top.begin == 1) {
        f(order_[top.begin]);
        continue;
      }
      const size_t middle = top.begin + (top.end - top.begin) / 2;
      stack.push_back({2 * top.node, top.begin, middle});
      stack.push_back({2 * top.node + 1, middle, top.end});
    }
  }

  std::vector<Box> boxes_;
  std::vector<uint32_t> order_;
  std::vector<Box> around_;  ///< by nodes; the first is node 1
};

}  // namespace csgrun
