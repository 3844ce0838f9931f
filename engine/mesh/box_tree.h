// A static tree over boxes, for finding those that overlap a given one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace csgrun {

/// Axis-aligned box, closed. Coordinates are exact in double where the caller's are.
struct Box {
  std::array<double, 3> lo, hi;

  [[nodiscard]] bool overlaps(const Box& o) const {
    return lo[0] <= o.hi[0] && o.lo[0] <= hi[0] && lo[1] <= o.hi[1] && o.lo[1] <= hi[1] &&
           lo[2] <= o.hi[2] && o.lo[2] <= hi[2];
  }
  void include(const Box& o);
};

/// Boxes in the order of a space-filling curve, in groups, under a complete binary tree. Copes with
/// boxes of very different sizes. Building costs O(n log n).
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Calls `visit(j)` for every j > i whose box overlaps the box of i, in no particular (but
  /// deterministic) order.
  template <class Visit>
  void visit_later(uint32_t i, Visit visit) const {
    const Box& box = boxes_[i];
    std::array<uint32_t, 128> stack;
    size_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = 1;
    while (depth > 0) {
      const uint32_t at = stack[--depth];
      const Node& node = nodes_[at];
      if (node.last <= i || !node.box.overlaps(box)) continue;
      if (at < group_base_) {
        stack[depth++] = 2 * at + 1;
        stack[depth++] = 2 * at;
        continue;
      }
      const size_t begin = size_t{at - group_base_} * kGroup;
      for (size_t k = begin; k < begin + kGroup && k < order_.size(); ++k) {
        const uint32_t j = order_[k];
        if (j > i && boxes_[j].overlaps(box)) visit(j);
      }
    }
  }

 private:
  static constexpr size_t kGroup = 4;
  struct Node {
    Box box;
    int64_t last;  ///< the largest number below, -1 if none
  };

  const std::vector<Box>& boxes_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;  ///< children of k are 2k and 2k + 1
  uint32_t group_base_ = 0;  ///< the first of the nodes that stand for groups
};

}  // namespace csgrun
