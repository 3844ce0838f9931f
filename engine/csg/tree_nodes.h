// What is asked of nodes of a tree in several places.
#pragma once

#include <span>

#include <csgrun/engine/csg_tree.h>

namespace csgrun {

/// What is evaluated of a node: its children, or the tree that stands for it.
inline std::span<const NodePtr> evaluated_children(const Node& node) {
  if (node.same_solid()) return {&node.same_solid(), 1};
  return node.children();
}

inline bool is_minkowski_sum(const Node& node) {
  return node.kind() == NodeKind::kConstruction &&
         node.construction() == Construction::kMinkowskiSum;
}

}  // namespace csgrun
