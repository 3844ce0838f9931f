// The affine maps that scripts name: moves, turns, reflections.
#pragma once

#include <optional>

#include <csgrun/engine/csg_tree.h>

namespace csgrun {

Affine translation(const glm::dvec3& v);

/// About X, Y or Z (0, 1, 2); exact at multiples of 90 degrees.
Affine axis_rotation(int axis, double degrees);

/// About an axis through the origin, of any length; exactly axis_rotation along a coordinate axis.
/// About no axis at all it is the identity.
Affine rotation_about(const glm::dvec3& axis, double degrees);

/// At the plane through the origin with this normal; without one it is the identity.
Affine reflection(const glm::dvec3& normal);

/// The map that undoes `map`; nothing where there is none.
std::optional<Affine> inverse(const Affine& map);

}  // namespace csgrun
