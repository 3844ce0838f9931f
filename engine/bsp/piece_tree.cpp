#include "engine/bsp/piece_tree.h"

#include <bit>
#include <utility>

namespace csgrun {
namespace {

double half_surface(const PieceBox& b) {
  const double x = b.hi[0] - b.lo[0], y = b.hi[1] - b.lo[1], z = b.hi[2] - b.lo[2];
  return x * y + y * z + z * x;
}

PieceBox hull(const PieceBox& a, const PieceBox& b) {
  PieceBox r = a;
  r.add(b);
  return r;
}

}  // namespace

/// Halves along the longest axis of the pieces' middles; equal middles by number.
PieceTree::NodePtr PieceTree::build(std::span<Item> items) {
  if (items.empty()) return nullptr;
  if (items.size() <= kLeafSize) {
    auto leaf = std::make_shared<Node>();
    leaf->count = static_cast<uint32_t>(items.size());
    leaf->pieces.reserve(items.size());
    for (const Item& item : items) {
      leaf->pieces.push_back(item.piece);
      leaf->box.add(item.box);
    }
    return leaf;
  }
  PieceBox middles;
  const auto middle = [](const Item& item, size_t k) { return item.box.lo[k] + item.box.hi[k]; };
  for (const Item& item : items) {
    middles.add(std::array{middle(item, 0), middle(item, 1), middle(item, 2)});
  }
  size_t axis = 0;
  for (size_t k = 1; k < 3; ++k) {
    if (middles.hi[k] - middles.lo[k] > middles.hi[axis] - middles.lo[axis]) axis = k;
  }
  const size_t half = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<long>(half), items.end(),
                   [&](const Item& a, const Item& b) {
                     return std::pair(middle(a, axis), a.piece) <
                            std::pair(middle(b, axis), b.piece);
                   });
  return join(build(items.first(half)), build(items.subspan(half)));
}

PieceTree::NodePtr PieceTree::join(NodePtr a, NodePtr b) {
  if (!a) return b;
  if (!b) return a;
  auto node = std::make_shared<Node>();
  node->box = hull(a->box, b->box);
  if (a->height == 0 && b->height == 0 && a->count + b->count <= kLeafSize) {
    node->count = a->count + b->count;
    node->pieces = a->pieces;
    node->pieces.insert(node->pieces.end(), b->pieces.begin(), b->pieces.end());
    return node;
  }
  node->count = a->count + b->count;
  node->height = std::max(a->height, b->height) + 1;
  node->child = {std::move(a), std::move(b)};
  return node;
}

/// Beside a node that is not larger, else on the side whose box grows least.
PieceTree::NodePtr PieceTree::insert(const NodePtr& node, const NodePtr& added) {
  if (node->height == 0 || node->count <= added->count) return join(node, added);
  const auto growth = [&](const NodePtr& child) {
    return half_surface(hull(child->box, added->box)) - half_surface(child->box);
  };
  const auto& [a, b] = node->child;
  return growth(a) <= growth(b) ? join(insert(a, added), b) : join(a, insert(b, added));
}

bool PieceTree::is_too_deep(const Node& node) {
  return node.height > 8 + 3 * static_cast<uint32_t>(std::bit_width(node.count));
}

}  // namespace csgrun
