// Takes from a roof what is thinner than its coordinates are known.
#pragma once

#include <cstddef>

#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// Where more than three cells of a diagram meet but for rounding, edges of almost no length join
/// their corners; where walls are parallel but for rounding, faces have tails of almost no width.
/// Rounded, such parts turn over, and then nobody could say what the face bounds. Edges shorter
/// than `width` (mm) become points, and tails become edges of the faces on both their sides: a
/// closed surface stays closed. The first `fixed_points` points keep their places, the first
/// `fixed_faces` faces (which may have holes) stay as they are. O(n log n).
void mend_thin_parts(PolygonMesh& mesh, size_t fixed_points, size_t fixed_faces, double width);

}  // namespace csgrun
