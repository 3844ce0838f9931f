// Solids that a construction asks for: evaluated, on one grid.
#pragma once

#include <functional>
#include <vector>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/evaluate.h>
#include <csgrun/engine/solid.h>

namespace csgrun {

struct EvaluatedParts {
  GridStep step;
  std::vector<SolidPtr> solids;
  /// Whether each is convex; not known (false) unless that was asked for.
  std::vector<uint8_t> is_convex;
};

/// Evaluates trees without constructions on one common grid, whose step is chosen but is at least
/// `least`, unless that is automatic or the user has asked for one.
using EvaluateParts = std::function<Result<EvaluatedParts>(const std::vector<NodePtr>&,
                                                           bool ask_convex, const GridStep& least)>;

}  // namespace csgrun
