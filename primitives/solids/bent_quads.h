// Quadrilaterals that are bent, cut as OpenSCAD cuts them.
#pragma once

#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// Cuts each face of four corners that do not lie in one plane, and whose shadow along the axis
/// that it faces does not cross itself, into two triangles, along the diagonal that OpenSCAD takes:
/// over which one a face is bent is a matter of volume, and files do not say it. Faces that are
/// bent by less than 10^-7 of their longest edge stay. O(n).
void cut_bent_quads(PolygonMesh& mesh);

}  // namespace csgrun
