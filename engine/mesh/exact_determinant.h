// Determinants as exact sums.
#pragma once

#include <glm/vec3.hpp>

#include "engine/mesh/exact_sum.h"

namespace csgrun {

/// Adds det(a, b, c), or its negative.
inline void add_determinant(ExactSum& sum, const glm::dvec3& a, const glm::dvec3& b,
                            const glm::dvec3& c, bool negative) {
  sum.add(a.x, b.y, c.z, negative);
  sum.add(a.y, b.z, c.x, negative);
  sum.add(a.z, b.x, c.y, negative);
  sum.add(a.z, b.y, c.x, !negative);
  sum.add(a.y, b.x, c.z, !negative);
  sum.add(a.x, b.z, c.y, !negative);
}

/// Adds det(b - a, c - a, d - a), or its negative.
inline void add_determinant(ExactSum& sum, const glm::dvec3& a, const glm::dvec3& b,
                            const glm::dvec3& c, const glm::dvec3& d, bool negative) {
  add_determinant(sum, a, b, c, !negative);
  add_determinant(sum, a, b, d, negative);
  add_determinant(sum, a, c, d, !negative);
  add_determinant(sum, b, c, d, negative);
}

/// Adds twice the area of a, b, c seen along the axis after which `u` and `v` follow in cyclic
/// order.
inline void add_area(ExactSum& sum, int u, int v, const glm::dvec3& a, const glm::dvec3& b,
                     const glm::dvec3& c) {
  sum.add(a[u], b[v], 1);
  sum.add(a[v], b[u], 1, true);
  sum.add(b[u], c[v], 1);
  sum.add(b[v], c[u], 1, true);
  sum.add(c[u], a[v], 1);
  sum.add(c[v], a[u], 1, true);
}

}  // namespace csgrun
