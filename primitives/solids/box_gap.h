// How far a box is from triangles, at least.
#pragma once

#include <array>

#include <glm/vec3.hpp>

namespace csgrun {

/// A lower bound of the distance of a triangle from the box between two corners, and not positive
/// if they meet: the widest gap along the axes of the box, the normal of the triangle and the cross
/// products of their edges, one of which parts them if any plane does. Right but for the rounding
/// of doubles.
double box_gap(const std::array<glm::dvec3, 2>& box, const std::array<glm::dvec3, 3>& triangle);

}  // namespace csgrun
