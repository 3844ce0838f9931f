// The kernel: Boolean expressions over plane-form operands, localised to critical cells
// (Campen & Kobbelt 2010, chapters 4 and 5).
#pragma once

#include <string>
#include <vector>

#include <csgrun/engine/evaluate.h>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/operand.h"

namespace csgrun {

/// Evaluates `expression` over `operands` inside `region` (grid steps, world), which must contain
/// the whole result; operands may reach beyond it. The value is canonical: a function of the
/// geometry, the labels and the expression only (docs/decisions/0002-canonical-form.md). `stats` is
/// added to. Boundaries of operands
/// may have parts, which are spelled out where a job cannot take them (can_stand_named); the result
/// has some if the options ask for it. Errors: kCancelled,
/// kOutOfRange, kInternal.
Result<std::shared_ptr<const BoundaryMesh>> evaluate_boolean(const std::vector<Operand>& operands,
                                                             const Expression& expression,
                                                             const GridBox& region,
                                                             const KernelOptions& options,
                                                             EvaluateStats& stats);

}  // namespace csgrun
