// Minkowski sums of solids that reach far beyond all that is seen of the sum.
#pragma once

#include <cstddef>
#include <unordered_map>
#include <vector>

#include <csgrun/engine/csg_tree.h>

#include "engine/csg/point_box.h"
#include "engine/csg/tree_bounds.h"

namespace csgrun {

/// Cuts off far parts of summands before these are evaluated: a part is made smaller all around as
/// the complement's sum with a ball, within a box that users choose as they like, of 10 m or of
/// 1e10 mm. On a grid that holds it little would be left of the part. A point of a sum that is seen
/// depends on its operands only as far around it as the others reach.
///
/// Remembers what it made, so that the same tree is the same again.
class FarSummands {
 public:
  /// A tree of the same solid: the tree itself if there is nothing to cut. Uses constant stack.
  /// O(nodes that are new below it).
  NodePtr cut(const NodePtr& root);
  void clear();

 private:
  /// A node, and the box of what is seen of it in its own coordinates.
  struct Place {
    NodePtr node;
    PointBox seen;
    bool is_summand;  ///< or a member of a union that is one
    bool operator==(const Place&) const = default;
  };
  struct PlaceHash {
    size_t operator()(const Place& place) const;
  };

  [[nodiscard]] Place child(const Place& place, size_t index) const;
  [[nodiscard]] bool may_be_cut(const Place& place) const;
  [[nodiscard]] NodePtr make(const Place& place, std::vector<NodePtr> children) const;

  TreeBounds bounds_;
  std::unordered_map<Place, NodePtr, PlaceHash> made_;  ///< of nodes that `bounds_` keeps
};

}  // namespace csgrun
