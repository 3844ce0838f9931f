// The pieces of a result in space: a tree of boxes whose versions share what is the same in both.
//
// Nodes never change. A version with other pieces copies the nodes on the way to them; all others
// belong to both.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <span>
#include <vector>

#include <csgrun/engine/evaluate.h>

#include "engine/base/double_double.h"
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
  /// Its middle, times two.
  [[nodiscard]] std::array<double, 3> twice_middle() const {
    return {lo[0] + hi[0], lo[1] + hi[1], lo[2] + hi[2]};
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

/// What adds up to an area (mesh/pieces_area).
struct PieceArea {
  DoubleDouble twice_area;  ///< steps^2
  uint64_t corners = 0;
  bool is_cut = false;  ///< some corner's coordinates were cut
};

class PieceTree {
 public:
  struct Node {
    PieceBox box;
    uint32_t count = 0;   ///< of pieces below
    uint32_t height = 0;  ///< 0: a leaf
    std::array<std::shared_ptr<const Node>, 2> child;
    std::array<PieceBox, 2> child_box;  ///< here, too: most children are looked at no closer
    std::vector<uint32_t> pieces;       ///< of a leaf
    mutable bool has_sums = false;
    mutable PieceSums sums;                         ///< of the pieces below, when somebody asked
    mutable std::unique_ptr<const PieceArea> area;  ///< the same, else null
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
    if (root_ && may_meet(root_->box)) each_below(*root_, may_meet, f);
  }

  /// The pieces without those that are `gone`, of this tree or not, ascending, and with `added`.
  /// `box_of(piece)` is the box of a piece, which stays where it is. The boxes of all nodes above
  /// those of the tree that are gone `may_meet(box)`. O(k) for k such nodes and O(log n) for what
  /// is added, amortised: a part that has become too deep is put together anew from its leaves.
  template <class BoxOf, class MayMeet>
  [[nodiscard]] PieceTree changed(std::span<const uint32_t> gone,
                                  const std::vector<uint32_t>& added, BoxOf&& box_of,
                                  MayMeet&& may_meet) const {
    PieceTree result;
    Gone left(gone);
    const bool may_lose = root_ && may_meet(root_->box);
    result.root_ = may_lose ? without(root_, left, box_of, may_meet) : root_;
    if (!added.empty()) {
      std::vector<Item> items = items_of(added, box_of);
      const NodePtr more = build(items);
      result.root_ = result.root_ ? insert(result.root_, more) : more;
    }
    return result;
  }
  /// The same, looking everywhere.
  template <class BoxOf>
  [[nodiscard]] PieceTree changed(std::span<const uint32_t> gone,
                                  const std::vector<uint32_t>& added, BoxOf&& box_of) const {
    return changed(gone, added, box_of, [](const PieceBox&) { return true; });
  }

 private:
  static constexpr size_t kLeafSize = 16;

  template <class MayMeet, class F>
  static void each_below(const Node& node, MayMeet& may_meet, F& f) {
    for (const uint32_t p : node.pieces) f(p);
    for (size_t c = 0; c < 2; ++c) {
      if (node.child[c] && may_meet(node.child_box[c])) each_below(*node.child[c], may_meet, f);
    }
  }

  struct Item {
    uint32_t piece;
    const PieceBox* box;
    std::array<double, 3> middle;  ///< of the box, times two
  };
  /// Pieces that are looked for, until all were found.
  struct Gone {
    explicit Gone(std::span<const uint32_t> all) : pieces(all), left(all.size()) {
      for (const uint32_t p : all) bits[p / 64 % kWords] |= bit(p);
    }
    [[nodiscard]] bool holds(uint32_t piece) const {
      return (bits[piece / 64 % kWords] & bit(piece)) != 0 &&
             std::binary_search(pieces.begin(), pieces.end(), piece);
    }
    static uint64_t bit(uint32_t piece) { return uint64_t{1} << piece % 64; }

    static constexpr size_t kWords = 64;
    std::span<const uint32_t> pieces;     ///< ascending
    std::array<uint64_t, kWords> bits{};  ///< of the last twelve digits: few others have theirs set
    size_t left;
  };
  static NodePtr build(std::span<Item> items);
  static NodePtr join(NodePtr a, NodePtr b);
  static NodePtr insert(const NodePtr& node, const NodePtr& added);
  static void collect_leaves(const NodePtr& node, std::vector<NodePtr>& leaves);
  static NodePtr over_leaves(std::span<NodePtr> leaves);

  /// A node that may have some of the pieces that are gone, without them.
  template <class BoxOf, class MayMeet>
  static NodePtr without(const NodePtr& node, Gone& gone, BoxOf& box_of, MayMeet& may_meet);
  template <class BoxOf>
  static std::vector<Item> items_of(std::span<const uint32_t> pieces, BoxOf& box_of) {
    std::vector<Item> items;
    items.reserve(pieces.size());
    for (const uint32_t p : pieces) {
      const PieceBox& box = box_of(p);
      items.push_back({p, &box, box.twice_middle()});
    }
    return items;
  }

  NodePtr root_;
};

template <class BoxOf, class MayMeet>
PieceTree::NodePtr PieceTree::without(const NodePtr& node, Gone& gone, BoxOf& box_of,
                                      MayMeet& may_meet) {
  if (node->height > 0) {
    std::array<NodePtr, 2> child = node->child;
    for (size_t c = 0; c < 2 && gone.left > 0; ++c) {
      if (may_meet(node->child_box[c])) child[c] = without(child[c], gone, box_of, may_meet);
    }
    if (child == node->child) return node;
    return join(std::move(child[0]), std::move(child[1]));
  }
  const auto is_gone = [&](uint32_t p) { return gone.holds(p); };
  const auto count = std::count_if(node->pieces.begin(), node->pieces.end(), is_gone);
  if (count == 0) return node;
  gone.left -= static_cast<size_t>(count);
  std::vector<uint32_t> kept;
  kept.reserve(node->pieces.size());
  std::remove_copy_if(node->pieces.begin(), node->pieces.end(), std::back_inserter(kept), is_gone);
  std::vector<Item> items = items_of(kept, box_of);
  return build(items);
}

}  // namespace csgrun
