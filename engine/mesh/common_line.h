// What two faces have of the line in which their planes meet, told by doubles.
#pragma once

#include "engine/bsp/cell_geometry.h"
#include "engine/mesh/merge_faces.h"

namespace csgrun {

/// Whether two faces may pass through the planes of one another and have more of the line of these
/// in common than a corner of both: hardly ever. False for certain only. O(edges of both).
bool may_share_line(const MergedFace& f, const MergedFace& g, CellGeometry& geometry,
                    const PlaneTable& planes);

}  // namespace csgrun
