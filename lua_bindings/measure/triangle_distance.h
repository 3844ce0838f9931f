// How far two triangle meshes are apart, in doubles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/exact_triangles.h>

namespace csgrun {

struct Distance {
  double length = 0;
  glm::dvec3 from{}, to{};  ///< the nearest points, on the first and on the second mesh
};

/// The least distance of two surfaces that do not cross. Trees of boxes over both, which take
/// O(n log n), and the pairs of boxes that are nearer than the surfaces. REQUIRES: both have
/// triangles.
Distance surface_distance(const TriangleView& a, const TriangleView& b);

}  // namespace csgrun
