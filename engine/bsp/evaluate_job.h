// One job from operands to what is left of them: polygons kept as they are, and pieces of others.
#pragma once

#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>

#include "engine/bsp/assemble.h"
#include "engine/bsp/fragment_set.h"
#include "engine/bsp/job.h"

namespace csgrun {

struct EvaluatedJob {
  std::vector<FragmentSet> sets;
  std::vector<WholePolygon> whole;
  Touching touching;
};

/// Evaluates `expression` over a job of `operands`, none of them in pieces, as evaluate_boolean
/// (kernel.h) does, which assembles what this gives. `stats` is added to. Errors: those of
/// evaluate_boolean.
Result<EvaluatedJob> evaluate_job(Job& job, const std::vector<Operand>& operands,
                                  const Expression& expression, const GridBox& region,
                                  const KernelOptions& options, EvaluateStats& stats);

/// Where single operands may touch themselves; those in pieces are left out.
Touching touching_before(const std::vector<Operand>& operands);

/// Neighbours in the list are near each other mostly; a result has no use for a box a contact, and
/// one of a long chain does not carry all of those before. Leaves kMostTouches at most.
constexpr size_t kMostTouches = 4096;
void keep_few(std::vector<GridBox>& boxes);
/// Adds boxes, and keeps few.
void add_touching(Touching& touching, const std::vector<GridBox>& more);

}  // namespace csgrun
