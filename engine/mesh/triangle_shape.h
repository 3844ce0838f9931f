// The box of a triangle over doubles, and from where it is seen with area.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <csgrun/engine/exact_triangles.h>

#include "engine/mesh/box_tree.h"

namespace csgrun {

using TriangleCorners = std::array<glm::dvec3, 3>;

inline TriangleCorners corners_of(const TriangleView& mesh, uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return {mesh.points[a], mesh.points[b], mesh.points[c]};
}

inline Box box_of(const TriangleCorners& t) {
  Box box{};
  for (int k = 0; k < 3; ++k) {
    const auto [lo, hi] = std::minmax({t[0][k], t[1][k], t[2][k]});
    box.lo[static_cast<size_t>(k)] = lo;
    box.hi[static_cast<size_t>(k)] = hi;
  }
  return box;
}

/// From where a triangle is seen with area: the axis, and the sign of its area from there.
struct TriangleAspect {
  int axis = 0;
  int sign = 0;  ///< 0: a triangle without area
};

/// The axis of the largest component of the normal, as doubles have it, is the least work for
/// filters; the sign is exact.
inline TriangleAspect aspect_of(const TriangleCorners& t) {
  const glm::dvec3 u = t[1] - t[0], v = t[2] - t[0];
  glm::dvec3 size;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    size[k] = std::abs(u[i] * v[j] - u[j] * v[i]);
  }
  const int best = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  for (int k = 0; k < 3; ++k) {
    const int axis = (best + k) % 3;
    if (const int sign = orient_along(axis, t[0], t[1], t[2]); sign != 0) return {axis, sign};
  }
  return {};
}

}  // namespace csgrun
