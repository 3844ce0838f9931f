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

/// Evaluates trees without constructions on one common grid.
using EvaluateParts =
    std::function<Result<EvaluatedParts>(const std::vector<NodePtr>&, bool ask_convex)>;

}  // namespace csgrun
