// Directions of faces, as doubles.
#pragma once

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

#include "engine/bsp/boundary_mesh.h"

namespace csgrun {

/// A vector along a normal, given rounded once: its largest coordinate is 1 or -1. Whole multiples
/// of a normal below 2^53 have the same bits.
glm::dvec3 direction(const std::array<double, 3>& normal);

/// The direction of the outward normal of an untouched triangle: that of its plane, to the bit.
glm::dvec3 outward_direction(const UntouchedPart& part, uint32_t face);

}  // namespace csgrun
