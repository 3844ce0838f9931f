// Directions of faces, as doubles.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "engine/bsp/boundary_mesh.h"

namespace csgrun {

/// A vector along the normal of a plane: its coordinates divided by the largest, each rounded once.
/// So multiples of a plane have the same, to the bit.
glm::dvec3 direction(const Plane& plane);

/// The direction of the outward normal of an untouched triangle: that of its plane.
glm::dvec3 outward_direction(const UntouchedPart& part, uint32_t face);

}  // namespace csgrun
