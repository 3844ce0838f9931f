#include "engine/bsp/touch_list.h"

#include <algorithm>
#include <utility>

namespace csgrun {

void keep_few(std::vector<GridBox>& boxes) {
  while (boxes.size() > kMostTouches) {
    size_t kept = 0;
    for (size_t i = 0; i < boxes.size(); i += 2) {
      GridBox hull = boxes[i];
      const GridBox& other = boxes[std::min(i + 1, boxes.size() - 1)];
      for (size_t k = 0; k < 3; ++k) {
        hull.lo[k] = std::min(hull.lo[k], other.lo[k]);
        hull.hi[k] = std::max(hull.hi[k], other.hi[k]);
      }
      boxes[kept++] = hull;
    }
    boxes.resize(kept);
  }
}

TouchList TouchList::with(std::vector<GridBox> more) const {
  if (more.empty()) return *this;
  auto node = std::make_shared<Node>();
  node->count = (last_ ? last_->count : 0) + more.size();
  // This bounds the depth of nodes as well: each has a box at least.
  if (node->count <= kMostTouches) {
    node->boxes = std::move(more);
    node->before = last_;
  } else {
    node->boxes = boxes();
    node->boxes.insert(node->boxes.end(), more.begin(), more.end());
    keep_few(node->boxes);
    node->count = node->boxes.size();
  }
  TouchList result;
  result.last_ = std::move(node);
  return result;
}

std::vector<GridBox> TouchList::boxes() const {
  std::vector<const Node*> nodes;
  for (const Node* node = last_.get(); node; node = node->before.get()) nodes.push_back(node);
  std::vector<GridBox> all;
  if (last_) all.reserve(last_->count);
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
    all.insert(all.end(), (*node)->boxes.begin(), (*node)->boxes.end());
  }
  return all;
}

}  // namespace csgrun
