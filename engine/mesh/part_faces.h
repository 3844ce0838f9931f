// Faces some of whose triangles are no neighbours any more.
#pragma once

#include <csgrun/engine/solid.h>

namespace csgrun {

/// Parts each face along the diagonals whose triangles have vertices of their own there: where two
/// edges between the same two vertices were parted, of which one ran through the face
/// (docs/decisions/0002, rule 6). Afterwards each directed edge of all loops occurs once, and so
/// does its reverse. REQUIRES: triangles stand in the order of their faces. O(n log n).
void part_faces(Solid& solid);

}  // namespace csgrun
