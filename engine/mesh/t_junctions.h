// Corners of neighbours inside the edges of faces.
#pragma once

#include <vector>

#include "engine/mesh/merge_faces.h"
#include "engine/mesh/whole_order.h"

namespace csgrun {

/// Inserts into the loops of faces the points at which neighbours have corners: afterwards each
/// directed edge between consecutive points has as many reverses as copies (Campen & Kobbelt 2010,
/// section 4.3). New edges inherit the plane. The rim of what is untouched counts as edges of
/// faces. False when the faces do not close.
bool resolve_t_junctions(std::vector<MergedFace>& faces, CellGeometry& geometry, PlaneTable& planes,
                         const WholeOrder& whole);

}  // namespace csgrun
