// The volume of a result that has not been presented: no triangulation needed.
#pragma once

#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>

#include "engine/bsp/boundary_mesh.h"

namespace csgrun {

/// The exact volume in mm^3, rounded once. Each loop is a fan of signed triangles from its first
/// corner: holes and reflex corners take away what they must. O(n).
Result<double> boundary_volume(const BoundaryMesh& boundary, const GridStep& step);

}  // namespace csgrun
