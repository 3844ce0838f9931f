#include "engine/mesh/triangle_normals.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/bsp/grid_planes.h"

namespace csgrun {
namespace {

/// Of a triangle whose normal may not be a double: reduced first, as that of a plane is.
std::array<double, 3> wide_normal(const IVec3& p, const IVec3& q, const IVec3& r) {
  PlaneTable table;
  const PlaneId plane = table.intern(plane_through(p, q, r));
  const auto& n = table.approximate(plane.index());
  const double sign = plane.flipped() ? -1 : 1;
  return {sign * n[0], sign * n[1], sign * n[2]};
}

/// Whether corners are near enough to the first one for a normal of at most 2^53.
bool is_compact(const IVec3& p, const IVec3& q, const IVec3& r) {
  constexpr int64_t kNear = int64_t{1} << 26;
  bool all = true;
  for (size_t k = 0; k < 3; ++k) {
    all = all && std::abs(q[k] - p[k]) <= kNear && std::abs(r[k] - p[k]) <= kNear;
  }
  return all;
}

}  // namespace

glm::dvec3 direction(const std::array<double, 3>& normal) {
  const double longest =
      std::max({std::fabs(normal[0]), std::fabs(normal[1]), std::fabs(normal[2])});
  // -0 + 0 = 0
  return {normal[0] / longest + 0.0, normal[1] / longest + 0.0, normal[2] / longest + 0.0};
}

glm::dvec3 outward_direction(const UntouchedPart& part, uint32_t face) {
  const auto corners = part.triangle(face);
  // Moving a triangle does not turn it.
  const IVec3 &p = part.leaf->vertices[corners[0]], &q = part.leaf->vertices[corners[1]],
              &r = part.leaf->vertices[corners[2]];
  if (!is_compact(p, q, r)) return direction(wide_normal(p, q, r));
  const int64_t ux = q[0] - p[0], uy = q[1] - p[1], uz = q[2] - p[2];
  const int64_t vx = r[0] - p[0], vy = r[1] - p[1], vz = r[2] - p[2];
  return direction({static_cast<double>(uy * vz - uz * vy), static_cast<double>(uz * vx - ux * vz),
                    static_cast<double>(ux * vy - uy * vx)});
}

}  // namespace csgrun
