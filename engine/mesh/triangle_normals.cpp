#include "engine/mesh/triangle_normals.h"

#include <algorithm>

#include "engine/bsp/grid_planes.h"
#include "engine/exact/rounding.h"

namespace csgrun {
namespace {

Int128 size_of(Int128 v) { return v < 0 ? -v : v; }

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
  return direction(part.map.plane(plane_through(at(0), at(1), at(2))));
}

}  // namespace csgrun
