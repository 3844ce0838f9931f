// Volume and centroid of a result that has not been presented: no triangulation needed.
#pragma once

#include <glm/vec3.hpp>

#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>

#include "engine/bsp/boundary_mesh.h"

namespace csgrun {

/// The exact volume in mm^3, rounded once. Each loop is a fan of signed triangles from its first
/// corner: holes and reflex corners take away what they must. O(n).
Result<double> boundary_volume(const BoundaryMesh& boundary, const GridStep& step);
/// The centre of mass in mm, each coordinate rounded once; of the same triangles.
Result<glm::dvec3> boundary_centroid(const BoundaryMesh& boundary, const GridStep& step);

}  // namespace csgrun
