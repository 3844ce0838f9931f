// Whether a result is convex.
#pragma once

#include "engine/bsp/boundary_mesh.h"

namespace csgrun {

/// Exact: no point of the boundary is in front of the plane of a face. (A regular solid of which
/// that holds is the intersection of the half-spaces behind its faces: else some boundary point
/// would be inside of these all.)
///
/// REQUIRES: faces are spelled out, not named (`parts` is empty). O(planes x points), mostly a few
/// faces where it is not convex.
bool bounds_convex(const BoundaryMesh& mesh);

}  // namespace csgrun
