// One job from operands to what is left of them: polygons kept as they are, and pieces of others.
#pragma once

#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>

#include "engine/bsp/assemble.h"
#include "engine/bsp/fragment_set.h"
#include "engine/bsp/job.h"
#include "engine/bsp/near_faces.h"

namespace csgrun {

struct EvaluatedJob {
  std::vector<FragmentSet> sets;
  std::vector<WholePolygon> whole;
  std::vector<FarFaces> far;  ///< see WholeFaces::far
  Touching touching;
  /// Nothing was evaluated, as the job does not have all faces, and must.
  bool needs_all_faces = false;
  /// The same, as too much overlaps for one job (KernelOptions::stop_when_crowded).
  bool is_crowded = false;
};

/// Evaluates `expression` over a job of `operands`, none of them in pieces, as evaluate_boolean
/// (kernel.h) does, which assembles what this gives. `stats` is added to. Errors: those of
/// evaluate_boolean.
Result<EvaluatedJob> evaluate_job(Job& job, const std::vector<Operand>& operands,
                                  const Expression& expression, const GridBox& region,
                                  const KernelOptions& options, EvaluateStats& stats);

/// Where single operands touch themselves, or the result may do so since facets of theirs become
/// one face; those in pieces are left out. O(n) for leaves that are not known to have single fans.
Touching touching_before(const std::vector<Operand>& operands);

}  // namespace csgrun
