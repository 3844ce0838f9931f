// What the operands of a hull or a Minkowski sum are made of, seen from the construction.
#pragma once

#include <optional>
#include <vector>

#include <csgrun/engine/csg_tree.h>

namespace csgrun {

/// A node under the transforms above it, and the appearance that covers its own.
struct PlacedNode {
  NodePtr node;
  Affine map;
  const Appearance* paint = nullptr;

  /// As a tree.
  [[nodiscard]] NodePtr tree() const;
};

/// The members of the union of `operands`: leaves and whatever is no union, each once, in tree
/// order. Empty nodes are left out. Uses constant stack.
std::vector<PlacedNode> union_members(const std::vector<NodePtr>& operands);

/// A turn that stands under all leaves of the members, if it is the same for all and not the
/// identity: leaves are then quantised in the frame of that turn, so what is made of them had
/// better be, too. `forth` turns, `back` is its inverse.
struct CommonTurn {
  Affine forth, back;
};
std::optional<CommonTurn> common_turn(const std::vector<PlacedNode>& members);

/// The appearance that the first leaf of a member has, or null.
const Appearance* first_appearance(const PlacedNode& member);

}  // namespace csgrun
