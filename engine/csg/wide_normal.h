// Normals of faces over points of the grid, and signs with them: of doubles where their bounds
// allow it, else of integers.
#pragma once

#include <array>
#include <cmath>

#include "engine/bsp/operand.h"
#include "engine/csg/wide_cross.h"

namespace csgrun {

inline int sign_of(const Int128& x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// Along the normal of a face. Components are at most 2^83.
struct WideNormal {
  Vec128 exact{};
  std::array<double, 3> near{};  ///< each within 2^-52 of it; 0 only if that is

  /// REQUIRES: |coordinate| <= 2^40.
  static WideNormal of(const LeafGeometry& leaf, uint32_t face) {
    const uint32_t begin = leaf.face_starts[face], end = leaf.face_starts[face + 1];
    const auto at = [&](uint32_t c) { return leaf.vertices[leaf.corners[c]]; };
    WideNormal result;
    for (uint32_t c = begin + 2; c < end && is_zero(result.exact); ++c) {
      result.exact = cross(at(begin), at(c - 1), at(c));
    }
    for (int i = 0; i < 3; ++i) result.near[i] = static_cast<double>(result.exact[i]);
    return result;
  }

  /// REQUIRES: |d| <= 2^41; the product is then below 2^126.
  [[nodiscard]] Int128 dot(const IVec3& d) const {
    Int128 sum = 0;
    for (int i = 0; i < 3; ++i) sum += exact[i] * d[i];
    return sum;
  }
  /// The sign of that.
  [[nodiscard]] int side(const IVec3& d) const {
    double sum = 0, size = 0;
    for (int i = 0; i < 3; ++i) {
      const double product = near[i] * static_cast<double>(d[i]);
      sum += product;
      size += std::fabs(product);
    }
    // Each product is within 2^-51 of itself, and two sums are rounded.
    if (std::fabs(sum) > size * 0x1p-49) return sum > 0 ? 1 : -1;
    return sign_of(dot(d));
  }
};

}  // namespace csgrun
