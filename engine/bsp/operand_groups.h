// Operands of one operator evaluated in groups: where many of them overlap in planes, as the spokes
// of a wheel do, or go through one another, as balls about one centre do, each of their faces would
// be cut by all of them. What a group leaves has one face there, or few.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <csgrun/engine/error.h>

#include "engine/bsp/operand.h"

namespace csgrun {

/// What is left of a job when groups are evaluated: their results are operands.
struct GroupedJob {
  std::vector<Operand> operands;
  Expression expression;
};

/// Whether an operator has so many operands that they can be grouped.
bool can_be_grouped(const Expression& expression);

/// The operands of one operator that may stand in groups.
struct Groupable {
  BooleanOp op;                        ///< of a group
  std::span<const uint32_t> children;  ///< nodes of the expression
  size_t size;                         ///< of each group; the last one may be smaller
};
/// Those of the operator that has most. REQUIRES: can_be_grouped.
Groupable most_groupable(const Expression& expression);

/// Whether these are many, and not the root's: then all are one group, whose operator is the root
/// of a job, in which what they hide of one another is not looked at (dead_space.h). REQUIRES: as
/// above.
bool is_one_group(const Expression& expression);

/// What a group leaves.
enum class GroupWay : uint8_t {
  kAlone,      ///< what the operator makes of its operands; of what is taken away the union
  kWithFirst,  ///< of a difference, its first child less them: what all of these have in common
};

/// A box around the result of each group. `boxes`: around each operand. REQUIRES: can_be_grouped,
/// and a difference for kWithFirst.
std::vector<GridBox> boxes_of_groups(const Expression& expression, GroupWay way,
                                     std::span<const GridBox> boxes);
/// Whether the groups are of what a difference takes away.
bool are_taken_away(const Expression& expression);

/// Evaluates a group; `region` holds its result.
using EvaluateGroup = std::function<Result<std::shared_ptr<const BoundaryMesh>>(
    const std::vector<Operand>&, const Expression&, const GridBox& region)>;

/// Evaluates groups of operands of the operator that has most, which stand in their order in it, so
/// that where several have surface the same one gives it as in one job. `boxes`: around each
/// operand. REQUIRES: as boxes_of_groups. Errors: those of `evaluate`.
Result<GroupedJob> evaluate_groups(const std::vector<Operand>& operands,
                                   const Expression& expression, GroupWay way,
                                   std::span<const GridBox> boxes, const EvaluateGroup& evaluate);

}  // namespace csgrun
