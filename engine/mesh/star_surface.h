// Whether a surface is that of a body all of which is seen from one point within.
#pragma once

#include "engine/bsp/operand.h"

namespace csgrun {

/// True only for the surface of one connected body, facing outwards, whose faces meet in corners
/// and edges of both only, and which was seen to be *star-shaped*: some point, the centre, is
/// behind all faces.
///
/// Seen from the centre each face covers a part of the sphere of directions, all with the same
/// sense. As the surface is closed, nearly all directions are covered equally often; a ray tells
/// how often. If that is once, the parts tile the sphere. Two faces that met in more than corners
/// and edges of both would cover a direction twice: on either side of an edge there is the face
/// that runs it back, and the faces around a corner go around it once. So the surface is a sphere,
/// a graph over the directions.
///
/// A centre is looked for by relaxation (Agmon 1954; Motzkin & Schoenberg 1954): a point that is
/// not behind a face is reflected in its plane, for some faces at first. A surface that is not
/// star-shaped mostly shows after these. REQUIRES: planar convex faces over distinct vertices, none
/// degenerate; every directed edge as often as its reverse. Exact. O(n), on as many threads as the
/// calling arena has, with the same result for any number.
bool is_star_surface(const LeafGeometry& leaf);

}  // namespace csgrun
