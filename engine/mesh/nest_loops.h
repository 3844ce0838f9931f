// Which holes belong to which outer loop.
#pragma once

#include <vector>

#include "engine/bsp/regions.h"

namespace csgrun {

/// Parts the loops of a region into connected faces: an outer loop first, then its holes. Exact.
/// O(outer loops x holes) box tests, and rays for those that pass, from the innermost on.
std::vector<std::vector<std::vector<DirectedEdge>>> nest_loops(PlaneId support,
                                                               const RegionLoops& loops,
                                                               PointView& points,
                                                               const PlaneTable& planes);

}  // namespace csgrun
