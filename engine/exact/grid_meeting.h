// Points whose rounded coordinates are their exact ones.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "engine/exact/plane.h"

namespace csgrun {

/// Whether the planes, which meet in one point, meet in the grid point that its correctly rounded
/// coordinates name. A few nanoseconds; false for far points and for planes of very many bits.
inline bool meet_on_grid(const Plane& p, const Plane& q, const Plane& r,
                         const std::array<double, 3>& rounded) {
  constexpr double kFar = 0x1p30;
  constexpr int kNormalBits = 90;
  static_assert(kNormalBits + 30 < 125 && widths::kMaxOffset < 125);
  std::array<Int128, 3> at{};
  for (size_t k = 0; k < 3; ++k) {
    if (rounded[k] != std::floor(rounded[k]) || std::fabs(rounded[k]) > kFar) return false;
    at[k] = static_cast<int64_t>(rounded[k]);
  }
  const auto holds = [&](const Plane& s) {
    if (bit_width(s.a, s.b, s.c) > kNormalBits) return false;
    return s.a * at[0] + s.b * at[1] + s.c * at[2] + s.d == 0;
  };
  return holds(p) && holds(q) && holds(r);
}

}  // namespace csgrun
