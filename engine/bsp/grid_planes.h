// The planes of a polygon over grid points: its support, and one through each edge.
#pragma once

#include <cassert>

#include "engine/bsp/operand.h"
#include "engine/exact/plane.h"

namespace csgrun {

/// Plane through three grid points; the normal follows the right-hand rule.
inline Plane plane_through(const IVec3& p, const IVec3& q, const IVec3& r) {
  const Int128 ux = q[0] - p[0], uy = q[1] - p[1], uz = q[2] - p[2];
  const Int128 vx = r[0] - p[0], vy = r[1] - p[1], vz = r[2] - p[2];
  Plane s{uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx, 0};
  s.d = -(s.a * p[0] + s.b * p[1] + s.c * p[2]);
  return s;
}

/// The plane of a weakly convex loop of `count` grid points, `vertex(i)` for i below 2 `count`.
template <class Vertex>
Plane support_of_loop(uint32_t count, Vertex&& vertex) {
  // The first corner that is not a 180 degree one; a convex loop turns left there.
  Plane support;
  for (uint32_t i = 0; i < count && support.a == 0 && support.b == 0 && support.c == 0; ++i) {
    support = plane_through(vertex(i), vertex(i + 1), vertex(i + 2));
  }
  assert(support.a != 0 || support.b != 0 || support.c != 0);
  return support;
}

/// The axis along which a normal is longest.
inline int dominant_axis(const Plane& p) {
  const Int128 a = p.a < 0 ? -p.a : p.a, b = p.b < 0 ? -p.b : p.b, c = p.c < 0 ? -p.c : p.c;
  return a >= b && a >= c ? 0 : b >= c ? 1 : 2;
}

/// The plane through the edge p q and the direction of an axis: coefficients as small as the edge.
inline Plane edge_plane(const IVec3& p, const IVec3& q, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  std::array<Int128, 3> n{};
  n[i] = q[j] - p[j];
  n[j] = -(q[i] - p[i]);
  return {n[0], n[1], n[2], -(n[0] * p[0] + n[1] * p[1] + n[2] * p[2])};
}

}  // namespace csgrun
