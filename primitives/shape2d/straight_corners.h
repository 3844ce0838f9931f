// Corners of a loop that are none but for rounding.
#pragma once

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include <csgrun/primitives/shape2d.h>

namespace csgrun {

/// Whether b is on the way from a to c, nowhere off by more than `noise`.
inline bool is_on_way(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, double noise) {
  const glm::dvec2 way = c - a, to = b - a;
  return glm::dot(to, c - b) > 0 &&
         std::fabs(way.x * to.y - way.y * to.x) <= noise * glm::length(way);
}

/// The loop without corners that are on the way between those that are kept, each by its
/// noise(corner); the loop itself if less than a triangle would be left. O(n).
template <class Noise>
Shape2D::Loop without_straight_corners(const Shape2D::Loop& loop, Noise&& noise) {
  constexpr size_t kMostInARow = 64;  // each is looked at again with those after it
  const size_t n = loop.size();
  const auto at = [&](size_t i) -> const glm::dvec2& { return loop[i % n]; };
  size_t first = 0;
  while (first < n && is_on_way(at(first + n - 1), at(first), at(first + 1), noise(at(first)))) {
    ++first;
  }
  if (first == n) return loop;
  Shape2D::Loop kept{loop[first]};
  for (size_t last = first, i = first + 1; i < first + n; ++i) {
    bool drop = i - last <= kMostInARow;
    for (size_t j = last + 1; drop && j <= i; ++j) {
      drop = is_on_way(at(last), at(j), at(i + 1), noise(at(j)));
    }
    if (drop) continue;
    kept.push_back(at(i));
    last = i;
  }
  return kept.size() < 3 ? loop : kept;
}

}  // namespace csgrun
