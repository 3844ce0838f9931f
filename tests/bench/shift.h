// The smallest shift that a float32 can express, on a grid (Campen & Kobbelt 2010, chapter 7).
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include <csgrun/engine/evaluate.h>
#include <csgrun/engine/polygon_mesh.h>

namespace csgrun::bench {

/// The grid of shifted meshes: 2^-20 mm, which 27 bits carry to 128 mm.
constexpr int kShiftExponent = -20;

inline GridStep shift_step() {
  GridStep step;
  step.numerator = 1;
  step.exponent = kShiftExponent;
  return step;
}

/// The mesh scaled by a power of two so that its largest coordinate lies in [64, 128). A mesh
/// without extent stays as it is.
inline PolygonMesh scaled_to_128(PolygonMesh mesh) {
  double reach = 0;
  for (const glm::dvec3& p : mesh.points) {
    reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  if (!(reach > 0)) return mesh;
  const double scale = std::ldexp(1.0, 6 - std::ilogb(reach));
  for (glm::dvec3& p : mesh.points) p *= scale;
  return mesh;
}

/// One unit in the last place of x as a float32, at least one step; both in steps.
inline int64_t float_ulp_in_steps(int64_t x) {
  constexpr int kFloatDigits = 24;
  const int digits = std::bit_width(static_cast<uint64_t>(std::llabs(x)));
  return int64_t{1} << std::max(0, digits - kFloatDigits);
}

}  // namespace csgrun::bench
