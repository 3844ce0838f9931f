// A critical cell solved as the paper has it (Campen & Kobbelt 2010, chapters 4.2 and 5): a
// labelled BSP per operand, merged into one tree (Naylor et al. 1990), and the boundary extracted
// from its nodes (Thibault 1987). Slower than CellSolver and built on other decisions: the oracle
// in the process that CellSolver is compared with.
#pragma once

#include <array>
#include <cstdint>

#include "engine/bsp/fragment_set.h"
#include "engine/bsp/octree.h"

namespace csgrun {

/// Adds the result's boundary inside a critical cell to `out`. The pieces differ from those of
/// CellSolver::solve; the regions that they form and their labels do not. `geometry` belongs to
/// the octree's job and is cleared. O(n^3) regions for n polygons in general position.
void solve_literal_cell(CellGeometry& geometry, const Octree& tree, const CriticalCell& cell,
                        const std::array<uint32_t, 6>& walls, FragmentSet& out);

}  // namespace csgrun
