#include "primitives/solids/box_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace csgrun {

double box_gap(const std::array<glm::dvec3, 2>& box, const std::array<glm::dvec3, 3>& triangle) {
  const glm::dvec3 middle = box[0] / 2.0 + box[1] / 2.0, half = box[1] / 2.0 - box[0] / 2.0;
  const std::array<glm::dvec3, 3> corners{triangle[0] - middle, triangle[1] - middle,
                                          triangle[2] - middle};
  double widest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const auto [low, high] = std::minmax({corners[0][i], corners[1][i], corners[2][i]});
    widest = std::max({widest, low - half[i], -half[i] - high});
  }
  const auto try_axis = [&](const glm::dvec3& axis) {
    const double length = glm::length(axis);
    if (!(length > 0)) return;
    const double reach = glm::dot(half, glm::abs(axis));
    const auto [low, high] = std::minmax(
        {glm::dot(corners[0], axis), glm::dot(corners[1], axis), glm::dot(corners[2], axis)});
    widest = std::max({widest, (low - reach) / length, (-reach - high) / length});
  };
  const std::array<glm::dvec3, 3> edges{corners[1] - corners[0], corners[2] - corners[1],
                                        corners[0] - corners[2]};
  try_axis(glm::cross(edges[0], edges[1]));
  for (const glm::dvec3& edge : edges) {
    try_axis({0, -edge.z, edge.y});
    try_axis({edge.z, 0, -edge.x});
    try_axis({-edge.y, edge.x, 0});
  }
  return widest;
}

}  // namespace csgrun
