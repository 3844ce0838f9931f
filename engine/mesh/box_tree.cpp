#include "engine/mesh/box_tree.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace csgrun {
namespace {

constexpr double kFinest = 0x1fffff;

/// Puts two zero bits before each of the lowest 21 bits.
uint64_t spread(uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Box kNothing{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

}  // namespace

void Box::include(const Box& o) {
  for (int k = 0; k < 3; ++k) {
    lo[k] = std::min(lo[k], o.lo[k]);
    hi[k] = std::max(hi[k], o.hi[k]);
  }
}

BoxTree::BoxTree(const std::vector<Box>& boxes) : boxes_(boxes) {
  if (boxes.empty()) return;
  Box all = kNothing;
  for (const Box& box : boxes) all.include(box);
  const double extent =
      std::max({all.hi[0] - all.lo[0], all.hi[1] - all.lo[1], all.hi[2] - all.lo[2]});
  const double scale = extent > 0 ? kFinest / extent : 0;

  std::vector<std::pair<uint64_t, uint32_t>> keys(boxes.size());
  for (uint32_t i = 0; i < boxes.size(); ++i) {
    uint64_t code = 0;
    for (int k = 0; k < 3; ++k) {
      const double middle = (boxes[i].lo[k] + boxes[i].hi[k]) / 2;
      const double at = (middle - all.lo[k]) * scale;
      // Where an extent is near the ends of double's range, `at` is infinite or NaN: any order
      // does.
      code |= spread(at <= kFinest ? static_cast<uint64_t>(at) : 0) << k;
    }
    keys[i] = {code, i};
  }
  std::sort(keys.begin(), keys.end());
  order_.resize(boxes.size());
  sorted_.resize(boxes.size());
  for (size_t k = 0; k < keys.size(); ++k) {
    order_[k] = keys[k].second;
    sorted_[k] = boxes[order_[k]];
  }

  const size_t groups = (boxes.size() + kGroup - 1) / kGroup;
  group_base_ = static_cast<uint32_t>(std::bit_ceil(groups));
  nodes_.assign(size_t{group_base_} * 2, {kNothing, -1});
  for (size_t k = 0; k < order_.size(); ++k) {
    Node& node = nodes_[group_base_ + k / kGroup];
    node.box.include(boxes[order_[k]]);
    node.last = std::max<int64_t>(node.last, order_[k]);
  }
  for (size_t at = group_base_; at-- > 1;) {
    nodes_[at] = nodes_[2 * at];
    nodes_[at].box.include(nodes_[2 * at + 1].box);
    nodes_[at].last = std::max(nodes_[at].last, nodes_[2 * at + 1].last);
  }
}

std::vector<BoxTree::Task> BoxTree::pair_tasks(size_t wanted) const {
  std::vector<Task> tasks;
  if (nodes_.empty()) return tasks;
  tasks.push_back({1, 1});
  std::vector<Task> divided;
  // All nodes of all tasks are of one level.
  while (tasks.size() < wanted && !tasks.empty() && tasks[0][0] < group_base_) {
    divided.clear();
    for (const auto& [a, b] : tasks) divide(a, b, divided);
    std::erase_if(divided, [this](const Task& t) {
      return t[0] != t[1] && !nodes_[t[0]].box.overlaps(nodes_[t[1]].box);
    });
    tasks.swap(divided);
  }
  return tasks;
}

}  // namespace csgrun
