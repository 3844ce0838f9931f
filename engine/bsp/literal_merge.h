// The merge of labelled BSPs (Naylor, Amanatides, Thibault 1990: "Merging BSP Trees Yields
// Polyhedral Set Operations"): one tree whose leaves carry the labels of all operands.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "engine/bsp/literal_region.h"
#include "engine/bsp/local_bsp.h"

namespace csgrun {

/// Trees are immutable and share subtrees. In each node the plane passes through the interior of
/// the node's region, which is the cell cut by the planes on the way down.
class MergedBsp {
 public:
  struct Node {
    uint32_t plane;       ///< index; front is its positive side
    int32_t front, back;  ///< a node, or a leaf if negative
  };
  /// Per operand in the order of add: whether it is inside.
  using Labels = std::vector<bool>;

  MergedBsp(NamedPoints& points, const std::array<uint32_t, 6>& walls)
      : points_(points), cell_(points, walls), root_(leaf({})) {}

  /// Merges another operand's tree. REQUIRES: it was built from polygons inside the cell.
  void add(const LocalBsp& operand);

  [[nodiscard]] int32_t root() const { return root_; }
  [[nodiscard]] const ConvexRegion& cell() const { return cell_; }
  [[nodiscard]] const Node& node(int32_t index) const { return nodes_[index]; }
  [[nodiscard]] const Labels& labels(int32_t leaf) const { return labels_[-1 - leaf]; }

 private:
  /// A tree restricted to the two sides of a plane.
  struct Halves {
    int32_t front, back;
  };

  int32_t leaf(const Labels& labels);
  /// A node, or its child when both are the same leaf.
  int32_t make(uint32_t plane, int32_t front, int32_t back);
  int32_t import_tree(const LocalBsp& operand, int32_t from);
  /// The tree in which both `a` and `b` are known; both fill the region.
  int32_t merge(int32_t a, int32_t b, const ConvexRegion& region);
  /// Appends the labels of leaf `b` to those of all leaves of `a`; or the other way round.
  int32_t append_leaf(int32_t a, int32_t b);
  int32_t prepend_leaf(int32_t a, int32_t b);
  /// Divides the tree `t`, which fills the region, by a plane that cuts the region.
  Halves partition(int32_t t, const ConvexRegion& region, uint32_t plane);

  NamedPoints& points_;
  ConvexRegion cell_;
  std::vector<Node> nodes_;
  std::vector<Labels> labels_;
  std::map<Labels, int32_t> leaf_of_;
  int32_t root_;
};

}  // namespace csgrun
