// Where the solids of a tree are, and where they fill everything: bounds by boxes.
#pragma once

#include <unordered_map>

#include <csgrun/engine/csg_tree.h>

#include "engine/csg/point_box.h"

namespace csgrun {

/// Bounds of the solid of a node, in its own coordinates, but for the rounding of doubles.
struct SolidBounds {
  /// Around all of it; everything where that is not known before it is evaluated.
  PointBox box = PointBox::everything();
  /// All of `full` that is not in `hole` is inside; nothing where none is known.
  PointBox full = PointBox::nothing(), hole = PointBox::nothing();
  /// It is a Minkowski sum, or has one below it, one operand of which reaches far.
  bool has_far_sum = false;
};

/// Remembers the bounds of nodes, and keeps these.
class TreeBounds {
 public:
  /// mm; the finest grid reaches to 2^27 steps of 1e-6 mm.
  static constexpr double kFar = 128;

  /// Finds those of a node and of all below it. Uses constant stack. O(nodes, and points of leaves,
  /// that are new).
  const SolidBounds& find(const NodePtr& root);
  /// Those of a node below one that was asked for; nothing is known of no node.
  [[nodiscard]] const SolidBounds& of(const NodePtr& node) const {
    return node ? known_.at(node) : unknown_;
  }
  void clear() { known_.clear(); }

 private:
  [[nodiscard]] SolidBounds make(const Node& node) const;
  [[nodiscard]] SolidBounds of_boolean(const Node& node) const;
  [[nodiscard]] SolidBounds of_sum(const Node& node) const;

  std::unordered_map<NodePtr, SolidBounds> known_;
  SolidBounds unknown_;
};

/// Whether it reaches beyond TreeBounds::kFar.
bool is_far(const PointBox& box);

/// The box of all sums of a point of each; nothing if there are none.
PointBox sum(const PointBox& a, const PointBox& b);

}  // namespace csgrun
