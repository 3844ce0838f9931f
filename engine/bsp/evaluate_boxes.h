// Booleans of boxes along the axes, decided on the lattice of their planes.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/operand.h"

namespace csgrun {

/// Evaluates an expression over boxes as it is; nothing where operands are anything else, their
/// lattice is too fine (make_lattice), or there is a symmetric difference. The result knows exactly
/// where it touches itself. `stats` is added to. Error kCancelled. O(n log n) for n boxes, O(cells
/// of the lattice where several boxes have surface, each times the boxes there).
std::optional<Result<std::shared_ptr<BoundaryMesh>>> evaluate_boxes(
    const std::vector<Operand>& operands, const Expression& expression,
    const KernelOptions& options, EvaluateStats& stats);

}  // namespace csgrun
