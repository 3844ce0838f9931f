// What a level plane cuts of a boundary.
#pragma once

#include <cstdint>
#include <vector>

#include <csgrun/engine/evaluate.h>

#include "engine/bsp/boundary_mesh.h"

namespace csgrun {

/// The outline of the solid just above the plane z = `level` (grid steps), as
/// Evaluator::section has it: where it crosses one plane of the solid there is one segment, however
/// many faces are there. Corners are where three planes meet, correctly rounded. O(corners), and
/// O(k log k) for k edges that cross the level. REQUIRES: the boundary has no parts (see expanded).
std::vector<SectionSegment> level_section(const BoundaryMesh& boundary, int64_t level,
                                          const GridStep& step);

}  // namespace csgrun
