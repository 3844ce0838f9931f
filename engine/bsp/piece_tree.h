// The pieces of a result in space: a tree of boxes whose versions share what is the same in both.
//
// Nodes never change. A version with other pieces copies the nodes on the way to them; all others
// belong to both.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <csgrun/engine/evaluate.h>

#include "engine/exact/fixed_int.h"

namespace csgrun {

/// Box of correctly rounded coordinates, closed. Rounding keeps the order along an axis, so boxes
/// of things that meet meet.
struct PieceBox {
  std::array<double, 3> lo{HUGE_VAL, HUGE_VAL, HUGE_VAL}, hi{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void add(const std::array<double, 3>& p) {
    for (size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
  void add(const PieceBox& b) {
    for (size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], b.lo[k]);
      hi[k] = std::max(hi[k], b.hi[k]);
    }
  }
  [[nodiscard]] bool meets(const PieceBox& b) const {
    return lo[0] <= b.hi[0] && b.lo[0] <= hi[0] && lo[1] <= b.hi[1] && b.lo[1] <= hi[1] &&
           lo[2] <= b.hi[2] && b.lo[2] <= hi[2];
  }
  [[nodiscard]] bool meets_any(std::span<const PieceBox> boxes) const {
    return std::any_of(boxes.begin(), boxes.end(), [&](const PieceBox& b) { return meets(b); });
  }
};

/// What adds up over pieces, without rounding: parts of a volume (mesh/pieces_measures). Points are
/// cut to 64 fractional bits and taken relative to the store's origin.
struct PieceSums {
  Int<6> six_volumes;      ///< sum of the determinants of the cut points, * 2^-192
  double twice_area = 0;   ///< no less than twice the area of triangles with a cut point
  double edges = 0;        ///< no less than the length of their edges
  uint64_t triangles = 0;  ///< their number
};

class PieceTree {
 public:
  struct Node {
    PieceBox box;
    uint32_t count = 0;   ///< of pieces below
    uint32_t height = 0;  ///< 0: a leaf
    std::array<std::shared_ptr<const Node>, 2> child;
    std::vector<uint32_t> pieces;  ///< of a leaf
    mutable bool has_sums = false;
    mutable PieceSums sums;  ///< of the pieces below, when somebody asked
    /// The least and the greatest coordinates in mm, when somebody asked, and the step for which:
    /// results are shared between grids on which they have the same whole numbers.
    mutable std::array<std::array<double, 3>, 2> extent{};
    mutable GridStep extent_step;
    mutable uint8_t known_ends = 0;  ///< which of the six were asked for: bit 3 end + axis
  };
  using NodePtr = std::shared_ptr<const Node>;

  [[nodiscard]] const NodePtr& root() const { return root_; }
  [[nodiscard]] size_t size() const { return root_ ? root_->count : 0; }
  /// The box of all pieces; turned inside out when there are none.
  [[nodiscard]] PieceBox box() const { return root_ ? root_->box : PieceBox{}; }

  /// Calls f(piece) for the pieces in leaves all of whose nodes `may_meet(box)`.
  template <class MayMeet, class F>
  void each(MayMeet&& may_meet, F&& f) const {
    if (root_) each_below(*root_, may_meet, f);
  }

  /// The pieces without those for which `is_gone(piece)`, which are looked for in these boxes, and
  /// with `added`. `box_of(piece)` is the box of a piece. O(k log n) for k nodes in the boxes,
  /// amortised: a part that has become too deep is put together anew from its leaves.
  template <class IsGone, class BoxOf>
  [[nodiscard]] PieceTree changed(std::span<const PieceBox> where, IsGone&& is_gone,
                                  std::vector<uint32_t> added, BoxOf&& box_of) const;

 private:
  static constexpr size_t kLeafSize = 16;

  template <class MayMeet, class F>
  static void each_below(const Node& node, MayMeet& may_meet, F& f) {
    if (!may_meet(node.box)) return;
    for (const uint32_t p : node.pieces) f(p);
    for (const NodePtr& child : node.child) {
      if (child) each_below(*child, may_meet, f);
    }
  }

  struct Item {
    uint32_t piece;
    PieceBox box;
  };
  static NodePtr build(std::span<Item> items);
  static NodePtr join(NodePtr a, NodePtr b);
  static NodePtr insert(const NodePtr& node, const NodePtr& added);
  static void collect_leaves(const NodePtr& node, std::vector<NodePtr>& leaves);
  static NodePtr over_leaves(std::span<NodePtr> leaves);

  template <class IsGone, class BoxOf>
  static NodePtr without(const NodePtr& node, std::span<const PieceBox> where, IsGone& is_gone,
                         BoxOf& box_of);
  template <class BoxOf>
  static std::vector<Item> items_of(const std::vector<uint32_t>& pieces, BoxOf& box_of) {
    std::vector<Item> items;
    items.reserve(pieces.size());
    for (const uint32_t p : pieces) items.push_back({p, box_of(p)});
    return items;
  }

  NodePtr root_;
};

template <class IsGone, class BoxOf>
PieceTree::NodePtr PieceTree::without(const NodePtr& node, std::span<const PieceBox> where,
                                      IsGone& is_gone, BoxOf& box_of) {
  if (!node || !node->box.meets_any(where)) return node;
  if (node->height > 0) {
    NodePtr a = without(node->child[0], where, is_gone, box_of);
    NodePtr b = without(node->child[1], where, is_gone, box_of);
    if (a == node->child[0] && b == node->child[1]) return node;
    return join(std::move(a), std::move(b));
  }
  if (std::none_of(node->pieces.begin(), node->pieces.end(), is_gone)) return node;
  std::vector<Item> items;
  items.reserve(node->pieces.size());
  for (const uint32_t p : node->pieces) {
    if (!is_gone(p)) items.push_back({p, box_of(p)});
  }
  return build(items);
}

template <class IsGone, class BoxOf>
PieceTree PieceTree::changed(std::span<const PieceBox> where, IsGone&& is_gone,
                             std::vector<uint32_t> added, BoxOf&& box_of) const {
  PieceTree result;
  result.root_ = without(root_, where, is_gone, box_of);
  if (!added.empty()) {
    std::vector<Item> items = items_of(added, box_of);
    const NodePtr more = build(items);
    result.root_ = result.root_ ? insert(result.root_, more) : more;
  }
  return result;
}

}  // namespace csgrun
