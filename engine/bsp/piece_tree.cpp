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

/// Parts things by the middles of their boxes along the axis on which these differ most; equal ones
/// by number. Returns where the second half begins.
template <class T, class MiddleOf, class NumberOf>
size_t halve(std::span<T> items, MiddleOf&& middle_of, NumberOf&& number_of) {
  PieceBox middles;
  for (const T& item : items) middles.add(middle_of(item));
  size_t axis = 0;
  for (size_t k = 1; k < 3; ++k) {
    if (middles.hi[k] - middles.lo[k] > middles.hi[axis] - middles.lo[axis]) axis = k;
  }
  const size_t half = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<long>(half), items.end(),
                   [&](const T& a, const T& b) {
                     const double x = middle_of(a)[axis], y = middle_of(b)[axis];
                     return x < y || (x == y && number_of(a) < number_of(b));
                   });
  return half;
}

/// Far more than a tree of halves would have.
bool is_too_deep(const PieceTree::Node& node) {
  return node.height > 6 + 2 * static_cast<uint32_t>(std::bit_width(node.count));
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
      leaf->box.add(*item.box);
    }
    return leaf;
  }
  const size_t half = halve(
      items, [](const Item& item) -> const std::array<double, 3>& { return item.middle; },
      [](const Item& item) { return item.piece; });
  return join(build(items.first(half)), build(items.subspan(half)));
}

void PieceTree::collect_leaves(const NodePtr& node, std::vector<NodePtr>& leaves) {
  if (node->height == 0) {
    leaves.push_back(node);
    return;
  }
  for (const NodePtr& child : node->child) collect_leaves(child, leaves);
}

/// The same over leaves.
PieceTree::NodePtr PieceTree::over_leaves(std::span<NodePtr> leaves) {
  if (leaves.size() == 1) return leaves.front();
  const size_t half = halve(
      leaves, [](const NodePtr& leaf) { return leaf->box.twice_middle(); },
      [](const NodePtr& leaf) { return leaf->pieces.front(); });
  return join(over_leaves(leaves.first(half)), over_leaves(leaves.subspan(half)));
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
  node->child_box = {a->box, b->box};
  node->child = {std::move(a), std::move(b)};
  return node;
}

/// Beside a node that is not larger, else on the side whose box grows least, or which has fewer.
PieceTree::NodePtr PieceTree::insert(const NodePtr& node, const NodePtr& added) {
  if (node->height == 0 || node->count <= added->count) return join(node, added);
  const auto cost = [&](size_t c) {
    const PieceBox& box = node->child_box[c];
    return std::pair(half_surface(hull(box, added->box)) - half_surface(box),
                     node->child[c]->count);
  };
  const auto& [a, b] = node->child;
  NodePtr result = cost(0) <= cost(1) ? join(insert(a, added), b) : join(a, insert(b, added));
  if (!is_too_deep(*result)) return result;
  std::vector<NodePtr> leaves;
  collect_leaves(result, leaves);
  return over_leaves(leaves);
}

}  // namespace csgrun
