// Operands of Minkowski sums that enclose nothing on the grid: points, segments, polygons.
#pragma once

#include <vector>

#include "engine/csg/grid.h"
#include "engine/csg/minkowski.h"
#include "engine/csg/operand_leaves.h"

namespace csgrun {

/// A leaf that encloses no volume on the grid, as convex summands whose union it is: its sum with a
/// solid is the solid moved along it, and not nothing. A hull of points, or a mesh that is convex,
/// is one; of others there is one for each convex part of a face, or for the segment that a face
/// became, each once and in order. None for a leaf without points.
///
/// REQUIRES: a leaf. Errors: kOutOfRange when a point is beyond 2^40 steps.
Result<std::vector<Summand>> flat_summands(const PlacedNode& leaf, const GridStep& step);

}  // namespace csgrun
