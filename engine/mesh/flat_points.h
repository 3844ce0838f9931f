// Do points lie on one line, up to the rounding of what is computed?
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace csgrun {

/// Whether the corners of a face lie on one line, so that it has no plane and no area. Not so for a
/// face that crosses itself, even where its halves cancel in the sum: it covers something. O(n).
inline bool is_flat(const std::vector<glm::dvec3>& points, std::span<const uint32_t> corners) {
  if (corners.empty()) return true;
  const glm::dvec3& origin = points[corners[0]];
  const auto squared = [](const glm::dvec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; };
  glm::dvec3 far(0.0);
  for (const uint32_t v : corners) {
    const glm::dvec3 p = points[v] - origin;
    if (squared(p) > squared(far)) far = p;
  }
  for (const uint32_t v : corners) {
    const glm::dvec3 p = points[v] - origin;
    for (int k = 0; k < 3; ++k) {
      const double plus = far[(k + 1) % 3] * p[(k + 2) % 3];
      const double minus = far[(k + 2) % 3] * p[(k + 1) % 3];
      // Differences and products are rounded: 4 half units each.
      if (std::fabs(plus - minus) > 0x1p-51 * (std::fabs(plus) + std::fabs(minus))) return false;
    }
  }
  return true;
}

}  // namespace csgrun
