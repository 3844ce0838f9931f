// Whose boundary a point is when it is inside only few of many operands: what depends on these is
// looked at, not the whole expression.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/pruned_expression.h"

namespace csgrun {

class SparseBoundary {
 public:
  explicit SparseBoundary(const Expression& expression);

  struct Sides {
    uint32_t operand;
    bool front, back;  ///< whether what is there is inside the operand
  };
  /// What PrunedExpression::boundary says of operands that are given once each, all others being
  /// outside. O(k log k) for the k nodes that depend on those given.
  [[nodiscard]] PrunedExpression::Boundary evaluate(std::span<const Sides> given);

 private:
  using Boundary = PrunedExpression::Boundary;
  struct Place {
    uint32_t parent, place;
  };
  struct Child {
    uint32_t place;  ///< among its parent's children
    Boundary value;
    bool was;  ///< its value when everything is outside
  };

  void note(uint32_t node, const Boundary& value);
  [[nodiscard]] Boundary combine(uint32_t node);

  Expression expression_;
  /// By nodes: whose children they are, a node may be that of several or several times.
  std::vector<uint32_t> parent_starts_;
  std::vector<Place> parents_;
  std::vector<uint8_t> is_full_;                ///< per node, when everything is outside
  std::vector<uint32_t> full_children_;         ///< how many of its children are
  std::vector<uint32_t> leaf_starts_, leaves_;  ///< nodes by operands
  std::vector<std::vector<Child>> changed_;     ///< per node: children that are not as they were
  std::vector<uint32_t> queue_;                 ///< nodes that have some, a heap
  Boundary root_;
};

}  // namespace csgrun
