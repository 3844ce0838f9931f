// A solid from a function of space: where it is negative.
#pragma once

#include <array>
#include <functional>

#include <glm/vec3.hpp>

#include <csgrun/primitives/solids.h>

namespace csgrun {

/// The solid in which `field` is negative, within the box `bounds` (lowest and greatest corner),
/// whose sides close it where the field is negative on them. The field is asked on a lattice of
/// about `step` (each side of the box is cut into equal parts no longer than it) and taken as
/// linear in the six tetrahedra of each of its cells, so the surface is closed whatever the
/// function does, and details smaller than a step may be missed.
///
/// Errors: kInvalidArgument when the box is empty, when there would be too many points, or when the
/// field is negative nowhere, or everywhere on the sides of the box and not inside (its sign is
/// that of another convention). O(points of the lattice) calls, in ascending z, y, x; exceptions of
/// the field pass through. Kuhn's division of cubes; Bloomenthal, "An implicit surface polygonizer"
/// (Graphics Gems IV, 1994) describes the method.
MeshResult make_level_set(const std::function<double(const glm::dvec3&)>& field,
                          const std::array<glm::dvec3, 2>& bounds, double step);

}  // namespace csgrun
