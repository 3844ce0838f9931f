#include "engine/mesh/triangle_normals.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/bsp/grid_planes.h"
#include "engine/exact/rounding.h"

namespace csgrun {
namespace {

Int128 size_of(Int128 v) { return v < 0 ? -v : v; }

/// The direction of the normal of a triangle whose sides are short enough for whole numbers that
/// are doubles; false for any other. The same to the bit: a common divisor leaves the quotients as
/// they are.
bool short_direction(const IVec3& a, const IVec3& b, const IVec3& c, glm::dvec3& result) {
  constexpr int64_t kShort = int64_t{1} << 25;
  IVec3 u{}, v{};
  bool is_short = true;
  for (size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k], v[k] = c[k] - a[k];
    is_short = is_short & (std::abs(u[k]) < kShort) & (std::abs(v[k]) < kShort);
  }
  if (!is_short) return false;
  const auto x = static_cast<double>(u[1] * v[2] - u[2] * v[1]),
             y = static_cast<double>(u[2] * v[0] - u[0] * v[2]),
             z = static_cast<double>(u[0] * v[1] - u[1] * v[0]);
  const double longest = std::max({std::fabs(x), std::fabs(y), std::fabs(z)});
  result = {x / longest, y / longest, z / longest};
  return true;
}

}  // namespace

glm::dvec3 direction(const Plane& plane) {
  constexpr Int128 kExact = Int128{1} << 53;
  const Int128 longest = std::max({size_of(plane.a), size_of(plane.b), size_of(plane.c)});
  // Whole numbers that are doubles have a quotient that is rounded once, too.
  const auto quotient = [&](Int128 v) {
    if (longest <= kExact) {
      return static_cast<double>(static_cast<int64_t>(v)) /
             static_cast<double>(static_cast<int64_t>(longest));
    }
    return round_to_double(Int<4>::from_int128(v), Int<4>::from_int128(longest));
  };
  return {quotient(plane.a), quotient(plane.b), quotient(plane.c)};
}

glm::dvec3 outward_direction(const UntouchedPart& part, uint32_t face) {
  const auto corners = part.triangle(face);
  // Moving a triangle does not turn it.
  const auto at = [&](size_t i) -> const IVec3& { return part.leaf->vertices[corners[i]]; };
  if (part.map.is_identity()) {
    glm::dvec3 result;
    if (short_direction(at(0), at(1), at(2), result)) return result;
  }
  return direction(part.map.plane(plane_through(at(0), at(1), at(2))));
}

}  // namespace csgrun
