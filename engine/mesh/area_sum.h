// Has a loop any area, or is what is computed nothing but rounding?
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace csgrun {

/// The vector area of loops, with a bound of its rounding.
class AreaSum {
 public:
  AreaSum(const std::vector<glm::dvec3>& points, uint32_t origin)
      : points_(points), origin_(points[origin]) {}

  void add_loop(std::span<const uint32_t> loop) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec3 p = points_[loop[i]] - origin_;
      const glm::dvec3 q = points_[loop[i + 1 < loop.size() ? i + 1 : 0]] - origin_;
      for (int k = 0; k < 3; ++k) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        area_[k] += p[u] * q[v] - p[v] * q[u];
        magnitude_[k] += std::fabs(p[u] * q[v]) + std::fabs(p[v] * q[u]);
      }
    }
  }

  [[nodiscard]] bool is_rounding() const {
    for (int k = 0; k < 3; ++k) {
      // Differences and products are rounded: 4 half units each; the sum's rounding is left out, it
      // matters for faces of thousands of corners only, whose area is never that small.
      if (std::fabs(area_[k]) > 0x1p-51 * magnitude_[k]) return false;
    }
    return true;
  }

 private:
  const std::vector<glm::dvec3>& points_;
  glm::dvec3 origin_, area_{0.0}, magnitude_{0.0};
};

}  // namespace csgrun
