#include "engine/bsp/literal_merge.h"

#include <cassert>

namespace csgrun {

int32_t MergedBsp::leaf(const Labels& labels) {
  const auto [it, is_new] = leaf_of_.try_emplace(labels, -1 - static_cast<int32_t>(labels_.size()));
  if (is_new) labels_.push_back(labels);
  return it->second;
}

int32_t MergedBsp::make(uint32_t plane, int32_t front, int32_t back) {
  if (front == back && front < 0) return front;
  nodes_.push_back({plane, front, back});
  return static_cast<int32_t>(nodes_.size() - 1);
}

void MergedBsp::add(const LocalBsp& operand) {
  root_ = merge(root_, import_tree(operand, operand.root()), cell_);
}

int32_t MergedBsp::import_tree(const LocalBsp& operand, int32_t from) {
  if (from < 0) return leaf({from == LocalBsp::kInside});
  const LocalBsp::Node& n = operand.nodes()[from];
  const int32_t front = import_tree(operand, n.front);
  return make(n.plane, front, import_tree(operand, n.back));
}

int32_t MergedBsp::merge(int32_t a, int32_t b, const ConvexRegion& region) {
  if (b < 0) return append_leaf(a, b);
  if (a < 0) return prepend_leaf(a, b);
  const Node n = nodes_[a];
  assert(region.classify(points_, n.plane) == Side::kSplit);
  const Halves other = partition(b, region, n.plane);
  ConvexRegion front, back;
  region.split(points_, n.plane, front, back);
  const int32_t merged_front = merge(n.front, other.front, front);
  return make(n.plane, merged_front, merge(n.back, other.back, back));
}

int32_t MergedBsp::append_leaf(int32_t a, int32_t b) {
  if (a < 0) {
    Labels joined = labels(a);
    joined.insert(joined.end(), labels(b).begin(), labels(b).end());
    return leaf(joined);
  }
  const Node n = nodes_[a];
  const int32_t front = append_leaf(n.front, b);
  return make(n.plane, front, append_leaf(n.back, b));
}

int32_t MergedBsp::prepend_leaf(int32_t a, int32_t b) {
  if (b < 0) return append_leaf(a, b);
  const Node n = nodes_[b];
  const int32_t front = prepend_leaf(a, n.front);
  return make(n.plane, front, prepend_leaf(a, n.back));
}

MergedBsp::Halves MergedBsp::partition(int32_t t, const ConvexRegion& region, uint32_t plane) {
  if (t < 0) return {t, t};
  const Node n = nodes_[t];
  if (n.plane == plane) return {n.front, n.back};
  assert(region.classify(points_, n.plane) == Side::kSplit);
  ConvexRegion front, back;
  region.split(points_, n.plane, front, back);
  // The node goes on dividing a half only if the half has room on both of its sides; otherwise the
  // half gets the one child that reaches into it.
  const Side side_of_front = front.classify(points_, plane);
  const Side side_of_back = back.classify(points_, plane);
  const Halves f =
      side_of_front == Side::kSplit ? partition(n.front, front, plane) : Halves{n.front, n.front};
  const Halves b =
      side_of_back == Side::kSplit ? partition(n.back, back, plane) : Halves{n.back, n.back};
  const auto half = [&](Side beyond, int32_t from_front, int32_t from_back) {
    if (side_of_front == beyond) return from_back;
    if (side_of_back == beyond) return from_front;
    return make(n.plane, from_front, from_back);
  };
  const int32_t in_front = half(Side::kBack, f.front, b.front);
  return {in_front, half(Side::kFront, f.back, b.back)};
}

}  // namespace csgrun
