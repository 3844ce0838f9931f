// Boxes of which those that meet another are found without looking at all.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace csgrun {

/// An upright box, closed. Starts as one that holds nothing.
struct Box3 {
  glm::dvec3 low{1e300}, high{-1e300};

  void add(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void add(const Box3& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  [[nodiscard]] bool meets(const Box3& other) const {
    for (int i = 0; i < 3; ++i) {
      if (low[i] > other.high[i] || other.low[i] > high[i]) return false;
    }
    return true;
  }
};

/// A binary tree, halved at the median of the boxes' middles along their longest extent. Made in
/// O(n log^2 n).
class Box3Tree {
 public:
  explicit Box3Tree(std::vector<Box3> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!boxes_.empty()) build(0, static_cast<uint32_t>(boxes_.size()));
  }

  /// Calls `found` with the number of each box that meets `box`, in no certain order, until it says
  /// false.
  template <class Found>
  void find(const Box3& box, Found found) const {
    std::vector<uint32_t> open;
    if (!nodes_.empty()) open.push_back(0);
    while (!open.empty()) {
      const uint32_t at = open.back();
      const Node& node = nodes_[at];
      open.pop_back();
      if (!node.box.meets(box)) continue;
      if (node.second != 0) {
        open.push_back(node.second);
        open.push_back(at + 1);
        continue;
      }
      for (uint32_t i = node.begin; i < node.end; ++i) {
        if (boxes_[order_[i]].meets(box) && !found(order_[i])) return;
      }
    }
  }

 private:
  static constexpr uint32_t kLeafSize = 8;
  /// An inner node is followed by its first child.
  struct Node {
    Box3 box;
    uint32_t begin = 0, end = 0, second = 0;
  };

  void build(uint32_t begin, uint32_t end) {
    const size_t at = nodes_.size();
    nodes_.push_back({{}, begin, end, 0});
    Box3 middles;
    for (uint32_t i = begin; i < end; ++i) {
      nodes_[at].box.add(boxes_[order_[i]]);
      middles.add(middle(order_[i]));
    }
    if (end - begin <= kLeafSize) return;
    const glm::dvec3 size = middles.high - middles.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const uint32_t half = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                     [&](uint32_t a, uint32_t b) { return middle(a)[axis] < middle(b)[axis]; });
    build(begin, half);
    nodes_[at].second = static_cast<uint32_t>(nodes_.size());
    build(half, end);
  }
  [[nodiscard]] glm::dvec3 middle(uint32_t i) const {
    return (boxes_[i].low + boxes_[i].high) / 2.0;
  }

  std::vector<Box3> boxes_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace csgrun
