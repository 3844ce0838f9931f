// Normals of triangles over grid points, without tables of planes.
#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/mesh/whole_order.h"

namespace csgrun {

/// The outward normal of each triangle as PlaneTable tells that of its plane: reduced, rounded
/// once. O(n).
std::vector<glm::dvec3> outward_normals(const BoundaryMesh& boundary,
                                        std::span<const UntouchedTriangle> triangles);

}  // namespace csgrun
