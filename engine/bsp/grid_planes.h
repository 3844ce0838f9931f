// The planes of a polygon over grid points: its support, and one through each edge.
#pragma once

#include <cassert>

#include "engine/bsp/operand.h"
#include "engine/exact/plane.h"

namespace csgrun {

// Differences of grid coordinates have 42 bits: 64-bit integers hold them, 128-bit ones their
// products.
inline Int128 product(int64_t a, int64_t b) { return static_cast<Int128>(a) * b; }

/// (q - p) x (r - p): the normal of the plane through three grid points, by the right-hand rule.
inline std::array<Int128, 3> normal_through(const IVec3& p, const IVec3& q, const IVec3& r) {
  const int64_t ux = q[0] - p[0], uy = q[1] - p[1], uz = q[2] - p[2];
  const int64_t vx = r[0] - p[0], vy = r[1] - p[1], vz = r[2] - p[2];
  return {product(uy, vz) - product(uz, vy), product(uz, vx) - product(ux, vz),
          product(ux, vy) - product(uy, vx)};
}

/// Plane through three grid points; the normal follows the right-hand rule.
inline Plane plane_through(const IVec3& p, const IVec3& q, const IVec3& r) {
  const auto n = normal_through(p, q, r);
  return {n[0], n[1], n[2], -(n[0] * p[0] + n[1] * p[1] + n[2] * p[2])};
}

/// The first corner of a weakly convex loop of `count` grid points, `vertex(i)` for i below 2
/// `count`, that is not a 180 degree one: the loop turns left there.
template <class Vertex>
uint32_t turning_corner([[maybe_unused]] uint32_t count, Vertex&& vertex) {
  uint32_t i = 0;
  const auto is_straight = [&] {
    const auto n = normal_through(vertex(i), vertex(i + 1), vertex(i + 2));
    return n[0] == 0 && n[1] == 0 && n[2] == 0;
  };
  while (is_straight()) ++i;
  assert(i < count);
  return i;
}

/// The plane of such a loop.
template <class Vertex>
Plane support_of_loop(uint32_t count, Vertex&& vertex) {
  const uint32_t i = count == 3 ? 0 : turning_corner(count, vertex);
  return plane_through(vertex(i), vertex(i + 1), vertex(i + 2));
}

/// The axis along which a normal is longest.
inline int dominant_axis(const std::array<Int128, 3>& n) {
  const Int128 a = n[0] < 0 ? -n[0] : n[0], b = n[1] < 0 ? -n[1] : n[1],
               c = n[2] < 0 ? -n[2] : n[2];
  return a >= b && a >= c ? 0 : b >= c ? 1 : 2;
}
inline int dominant_axis(const Plane& p) {
  return dominant_axis(std::array<Int128, 3>{p.a, p.b, p.c});
}

/// The plane through the edge p q and the direction of an axis: coefficients as small as the edge.
inline Plane edge_plane(const IVec3& p, const IVec3& q, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const int64_t along_i = q[j] - p[j], along_j = p[i] - q[i];
  std::array<Int128, 3> n{};
  n[i] = along_i;
  n[j] = along_j;
  return {n[0], n[1], n[2], -(product(along_i, p[i]) + product(along_j, p[j]))};
}

}  // namespace csgrun
