// Signs of determinants of doubles: a filter answers nearly always, exact sums of products the
// rest.
#include <algorithm>
#include <cmath>

#include <csgrun/engine/exact_triangles.h>

#include "engine/mesh/exact_determinant.h"

namespace csgrun {
namespace {

/// Products below this may have lost bits to underflow.
constexpr double kSmallest = 0x1p-900;

/// Whether the double `difference` is a - b without rounding (Knuth's two-sum: what was lost).
bool is_exact(double a, double b, double difference) {
  const double b_there = a - difference;
  const double a_there = difference + b_there;
  return a - a_there == 0 && b_there - b == 0;
}

bool is_exact(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& difference) {
  return is_exact(a.x, b.x, difference.x) && is_exact(a.y, b.y, difference.y) &&
         is_exact(a.z, b.z, difference.z);
}

}  // namespace

int orient(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  const glm::dvec3 ad = a - d, bd = b - d, cd = c - d;
  const double bc = bd.x * cd.y, cb = cd.x * bd.y, ca = cd.x * ad.y, ac = ad.x * cd.y,
               ab = ad.x * bd.y, ba = bd.x * ad.y;
  const double determinant = ad.z * (bc - cb) + bd.z * (ca - ac) + cd.z * (ab - ba);
  const double permanent = (std::abs(bc) + std::abs(cb)) * std::abs(ad.z) +
                           (std::abs(ca) + std::abs(ac)) * std::abs(bd.z) +
                           (std::abs(ab) + std::abs(ba)) * std::abs(cd.z);
  // Shewchuk 1997, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
  // Predicates", section 4.3: the error is at most (7 + 56 u) u times the permanent, u = 2^-53;
  // 8 u covers it.
  constexpr double kBound = 8 * 0x1p-53;
  if (permanent > kSmallest && std::abs(determinant) > kBound * permanent)
    return determinant > 0 ? -1 : 1;
  ExactSum sum;
  // Near neighbours on a common lattice have exact differences: a quarter of the terms.
  if (is_exact(a, d, ad) && is_exact(b, d, bd) && is_exact(c, d, cd)) {
    add_determinant(sum, ad, bd, cd, true);
  } else {
    add_determinant(sum, a, b, c, d, false);
  }
  return sum.sign();
}

int orient_along(int axis, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double left = (a[u] - c[u]) * (b[v] - c[v]), right = (a[v] - c[v]) * (b[u] - c[u]);
  // As above, section 4.2: (3 + 16 u) u.
  constexpr double kBound = 4 * 0x1p-53;
  const double size = std::abs(left) + std::abs(right);
  if (size > kSmallest && std::abs(left - right) > kBound * size) return left > right ? 1 : -1;
  ExactSum sum;
  add_area(sum, u, v, a, b, c);
  return sum.sign();
}

bool is_degenerate(const TriangleView& mesh, uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  for (int axis = 0; axis < 3; ++axis) {
    if (orient_along(axis, mesh.points[a], mesh.points[b], mesh.points[c]) != 0) return false;
  }
  return true;
}

int facing(const TriangleView& mesh, uint32_t triangle, const glm::dvec3& direction) {
  const auto& corners = mesh.triangles[triangle];
  const glm::dvec3 &a = mesh.points[corners[0]], &b = mesh.points[corners[1]],
                   &c = mesh.points[corners[2]];
  const glm::dvec3 u = b - a, v = c - a;
  double value = 0, size = 0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double left = u[i] * v[j], right = u[j] * v[i];
    value += (left - right) * direction[k];
    size += (std::abs(left) + std::abs(right)) * std::abs(direction[k]);
  }
  // The same determinant as orient's, but for the third column, which is exact here.
  constexpr double kBound = 8 * 0x1p-53;
  if (size > kSmallest && std::abs(value) > kBound * size) return value > 0 ? 1 : -1;
  ExactSum sum;  // (a x b + b x c + c x a) . direction
  const glm::dvec3* p[3] = {&a, &b, &c};
  for (int side = 0; side < 3; ++side) {
    const glm::dvec3 &from = *p[side], &to = *p[(side + 1) % 3];
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      sum.add(from[i], to[j], direction[k]);
      sum.add(from[j], to[i], direction[k], true);
    }
  }
  return sum.sign();
}

double exact_volume(const TriangleView& mesh) {
  ExactSum sum;
  for (const auto& [a, b, c] : mesh.triangles)
    add_determinant(sum, mesh.points[a], mesh.points[b], mesh.points[c], false);
  return sum.divided(6);
}

}  // namespace csgrun
