// Trees without constructions: hulls, Minkowski sums and what else is made of evaluated solids
// become leaves, transforms and unions.
#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include <csgrun/engine/csg_tree.h>

#include "engine/csg/evaluated_parts.h"
#include "engine/csg/warnings.h"

namespace csgrun {

/// Remembers what it has made, so that a tree that grew costs what is new of it.
class Constructions {
 public:
  Constructions(EvaluateParts evaluate, Warnings& warnings)
      : evaluate_(std::move(evaluate)), warnings_(warnings) {}

  /// The same solid without constructions; the tree itself if it has none. Innermost ones come
  /// first; their operands are evaluated. Uses constant stack. Errors: those of the evaluation,
  /// kInvalidArgument and kLimit, at the construction's line.
  Result<NodePtr> expand(const NodePtr& root);
  void clear();

 private:
  Result<NodePtr> rebuilt(const Node& node, std::vector<NodePtr> children);
  Result<NodePtr> make(const Node& node, const std::vector<NodePtr>& operands);
  Result<NodePtr> make_hull(const Node& node, const std::vector<NodePtr>& operands);
  Result<NodePtr> make_sum(const Node& node, const std::vector<NodePtr>& operands);
  Result<std::array<double, 3>> lengths(const NodePtr& operand);
  Result<NodePtr> make_resized(const Node& node, const NodePtr& operand);

  EvaluateParts evaluate_;
  Warnings& warnings_;
  std::unordered_map<const Node*, NodePtr> made_;
  std::vector<NodePtr> alive_;  ///< keys of made_ stay valid
};

}  // namespace csgrun
