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
  [[nodiscard]] bool holds(const PieceBox& b) const {
    return lo[0] <= b.lo[0] && b.hi[0] <= hi[0] && lo[1] <= b.lo[1] && b.hi[1] <= hi[1] &&
           lo[2] <= b.lo[2] && b.hi[2] <= hi[2];
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
    /// A point of the store for each end and axis that reaches as far as any below, when somebody
    /// asked; else ~0.
    mutable std::array<std::array<uint32_t, 3>, 2> ends{{{~0u, ~0u, ~0u}, {~0u, ~0u, ~0u}}};
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

  /// The pieces without those that are `gone`, of this tree or not, ascending, and with `added`.
  /// `box_of(piece)` is the box of a piece. O(k log n) for k nodes around the boxes of the pieces
  /// that are gone, amortised: a part that has become too deep is put together anew from its
  /// leaves.
  template <class BoxOf>
  [[nodiscard]] PieceTree changed(std::span<const uint32_t> gone,
                                  const std::vector<uint32_t>& added, BoxOf&& box_of) const {
    PieceTree result;
    std::vector<Item> items = items_of(gone, box_of);
    std::vector<Item*> looked_for;
    looked_for.reserve(4 * items.size());
    for (Item& item : items) looked_for.push_back(&item);
    result.root_ = without(root_, looked_for, 0, box_of);
    if (!added.empty()) {
      items = items_of(added, box_of);
      const NodePtr more = build(items);
      result.root_ = result.root_ ? insert(result.root_, more) : more;
    }
    return result;
  }

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
    bool is_found = false;  ///< by without(): it is nowhere else
  };
  static NodePtr build(std::span<Item> items);
  static NodePtr join(NodePtr a, NodePtr b);
  static NodePtr insert(const NodePtr& node, const NodePtr& added);
  static void collect_leaves(const NodePtr& node, std::vector<NodePtr>& leaves);
  static NodePtr over_leaves(std::span<NodePtr> leaves);

  /// The node without the pieces from `first` on in a list, which is as it was afterwards.
  template <class BoxOf>
  static NodePtr without(const NodePtr& node, std::vector<Item*>& gone, size_t first,
                         BoxOf& box_of);
  template <class BoxOf>
  static std::vector<Item> items_of(std::span<const uint32_t> pieces, BoxOf& box_of) {
    std::vector<Item> items;
    items.reserve(pieces.size());
    for (const uint32_t p : pieces) items.push_back({p, box_of(p)});
    return items;
  }

  NodePtr root_;
};

template <class BoxOf>
PieceTree::NodePtr PieceTree::without(const NodePtr& node, std::vector<Item*>& gone, size_t first,
                                      BoxOf& box_of) {
  if (!node) return node;
  const size_t end = gone.size();
  for (size_t i = first; i < end; ++i) {
    if (!gone[i]->is_found && node->box.holds(gone[i]->box)) gone.push_back(gone[i]);
  }
  NodePtr result = node;
  if (gone.size() == end) return result;
  if (node->height > 0) {
    NodePtr a = without(node->child[0], gone, end, box_of);
    NodePtr b = without(node->child[1], gone, end, box_of);
    if (a != node->child[0] || b != node->child[1]) result = join(std::move(a), std::move(b));
  } else {
    std::vector<uint32_t> kept;
    kept.reserve(node->pieces.size());
    for (const uint32_t p : node->pieces) {
      const auto item = std::find_if(gone.begin() + static_cast<long>(end), gone.end(),
                                     [&](const Item* i) { return i->piece == p; });
      if (item != gone.end()) {
        (*item)->is_found = true;
      } else {
        kept.push_back(p);
      }
    }
    if (kept.size() < node->pieces.size()) {
      std::vector<Item> items = items_of(kept, box_of);
      result = build(items);
    }
  }
  gone.resize(end);
  return result;
}

}  // namespace csgrun
