// A static tree over boxes, for finding those that overlap a given one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace csgrun {

/// Axis-aligned box, closed. Coordinates are exact in double where the caller's are.
struct Box {
  std::array<double, 3> lo, hi;

  [[nodiscard]] bool overlaps(const Box& o) const {
    // Without branches: which of the six decides is as good as random.
    return (lo[0] <= o.hi[0]) & (o.lo[0] <= hi[0]) & (lo[1] <= o.hi[1]) & (o.lo[1] <= hi[1]) &
           (lo[2] <= o.hi[2]) & (o.lo[2] <= hi[2]);
  }
  void include(const Box& o);
};

/// Boxes in the order of a space-filling curve, in groups, under a complete binary tree. Copes with
/// boxes of very different sizes. Building costs O(n log n).
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Calls `visit(j)` for every j whose box overlaps `box`.
  template <class Visit>
  void visit_all(const Box& box, Visit visit) const {
    descend(box, -1, visit);
  }

  /// Calls `visit(j)` for every j > i whose box overlaps the box of i, in no particular (but
  /// deterministic) order.
  template <class Visit>
  void visit_later(uint32_t i, Visit visit) const {
    descend(boxes_[i], i, [&](uint32_t j) {
      if (j > i) visit(j);
    });
  }

  /// Two nodes of the tree (or one, twice) whose boxes may hold pairs that overlap.
  using Task = std::array<uint32_t, 2>;
  /// All pairs of boxes that may overlap, as tasks, about `wanted` of them or more if there are
  /// many boxes: a function of the boxes and of `wanted` only.
  [[nodiscard]] std::vector<Task> pair_tasks(size_t wanted) const;
  /// Calls `visit(i, j)`, i < j, for each pair of a task that overlaps. Over all tasks each pair
  /// occurs once. Thread-safe. Cheaper than looking for the partners of each box in turn.
  template <class Visit>
  void visit_pairs(const Task& task, Visit visit) const {
    std::vector<Task> stack{task};
    while (!stack.empty()) {
      const auto [a, b] = stack.back();
      stack.pop_back();
      if (a != b && !nodes_[a].box.overlaps(nodes_[b].box)) continue;
      if (a < group_base_) {
        divide(a, b, stack);
      } else {
        visit_groups(a, b, visit);
      }
    }
  }

 private:
  static constexpr size_t kGroup = 4;
  struct Node {
    Box box;
    int64_t last;  ///< the largest number below, -1 if none
  };

  /// Visits what may be above `least` and overlaps.
  template <class Visit>
  void descend(const Box& box, int64_t least, Visit visit) const {
    std::array<uint32_t, 128> stack;
    size_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = 1;
    while (depth > 0) {
      const uint32_t at = stack[--depth];
      const Node& node = nodes_[at];
      if (node.last <= least || !node.box.overlaps(box)) continue;
      if (at < group_base_) {
        stack[depth++] = 2 * at + 1;
        stack[depth++] = 2 * at;
        continue;
      }
      for (size_t k = begin_of(at); k < end_of(at); ++k) {
        if (sorted_[k].overlaps(box)) visit(order_[k]);
      }
    }
  }
  template <class Visit>
  void visit_groups(uint32_t a, uint32_t b, Visit visit) const {
    for (size_t k = begin_of(a); k < end_of(a); ++k) {
      for (size_t l = a == b ? k + 1 : begin_of(b); l < end_of(b); ++l) {
        if (!sorted_[k].overlaps(sorted_[l])) continue;
        visit(std::min(order_[k], order_[l]), std::max(order_[k], order_[l]));
      }
    }
  }
  /// All pairs of children of two nodes of one level.
  static void divide(uint32_t a, uint32_t b, std::vector<Task>& tasks) {
    if (a != b) tasks.push_back({2 * a + 1, 2 * b});
    tasks.push_back({2 * a, 2 * b + 1});
    tasks.push_back({2 * a + 1, 2 * b + 1});
    tasks.push_back({2 * a, 2 * b});
  }
  [[nodiscard]] size_t begin_of(uint32_t group) const {
    return std::min(order_.size(), size_t{group - group_base_} * kGroup);
  }
  [[nodiscard]] size_t end_of(uint32_t group) const {
    return std::min(order_.size(), (size_t{group - group_base_} + 1) * kGroup);
  }

  const std::vector<Box>& boxes_;
  std::vector<uint32_t> order_;
  std::vector<Box> sorted_;  ///< by order_
  std::vector<Node> nodes_;  ///< children of k are 2k and 2k + 1
  uint32_t group_base_ = 0;  ///< the first of the nodes that stand for groups
};

}  // namespace csgrun
