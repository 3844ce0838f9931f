// Is a point inside a result? Exactly, by counting the faces above it.
#pragma once

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/operand.h"

namespace csgrun {

/// +1 when the grid point is inside the solid, 0 on its boundary, -1 outside. O(edges), most of
/// them decided by doubles.
int locate(const BoundaryMesh& boundary, const IVec3& point);

}  // namespace csgrun
