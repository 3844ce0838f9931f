// Cross products of differences of grid points, in 128 bits.
#pragma once

#include <array>

#include "engine/bsp/operand.h"
#include "engine/exact/fixed_int.h"

namespace csgrun {

using Vec128 = std::array<Int128, 3>;

/// (b - a) x (c - a). REQUIRES: |coordinate| <= 2^40; differences are then at most 2^41, components
/// at most 2^83.
inline Vec128 cross(const IVec3& a, const IVec3& b, const IVec3& c) {
  std::array<Int128, 3> u, v;
  for (int i = 0; i < 3; ++i) {
    u[i] = b[i] - a[i];
    v[i] = c[i] - a[i];
  }
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// On which side of the plane through a, b and c, counter-clockwise from its front, p is: +1 in
/// front. REQUIRES: |coordinate| <= 2^40; the volume is then below 2^126.
inline int side(const IVec3& a, const IVec3& b, const IVec3& c, const IVec3& p) {
  const Vec128 normal = cross(a, b, c);
  Int128 volume = 0;
  for (int i = 0; i < 3; ++i) volume += normal[i] * (p[i] - a[i]);
  return volume > 0 ? 1 : volume < 0 ? -1 : 0;
}

inline bool is_zero(const Vec128& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

}  // namespace csgrun
