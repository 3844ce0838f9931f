#include "engine/exact/predicates.h"

#include <algorithm>
#include <cassert>

#include "engine/exact/forced_tier.h"

namespace csgrun {
namespace {

/// Low limbs of the coordinates suffice: the sum is taken modulo 2^(64 R), and the tier was chosen
/// so that the true value fits R limbs.
template <int R>
int side(const Plane& plane, const Point& p) {
  constexpr int kLow = R < kPointLimbs ? R : kPointLimbs;
  using Low = Int<kLow>;
  const auto coefficient = [](Int128 v) { return Int<2>::from_int128(v); };
  const Int<R> value = multiply<R>(Low::from(p.x), coefficient(plane.a)) +
                       multiply<R>(Low::from(p.y), coefficient(plane.b)) +
                       multiply<R>(Low::from(p.z), coefficient(plane.c)) +
                       multiply<R>(Low::from(p.w), coefficient(plane.d));
  return value.sign();
}

}  // namespace

int exact_tier(const Plane& plane, const Point& p) {
  const int normal = bit_width(plane.a, plane.b, plane.c);
  const int bits = widths::side(p.xyz_bits, p.w_bits, normal, bit_width(plane.d)) + 1;
  for (int t = 0; t < static_cast<int>(kTierBits.size()); ++t) {
    if (bits <= kTierBits[t]) return t;
  }
  assert(false && "a plane or a point is wider than widths.h allows");
  return static_cast<int>(kTierBits.size()) - 1;
}

int exact_side(const Plane& plane, const Point& p, int tier) {
  switch (std::max(tier, forced_tier)) {
    case 0:
      return side<1>(plane, p);
    case 1:
      return side<2>(plane, p);
    case 2:
      return side<3>(plane, p);
    case 3:
      return side<4>(plane, p);
    case 4:
      return side<6>(plane, p);
    default:
      return side<8>(plane, p);
  }
}

int exact_side(const Plane& plane, const std::array<int64_t, 3>& p, int tier) {
  if (std::max(tier, forced_tier) > 1) {
    return exact_side(plane, grid_point(p[0], p[1], p[2]), tier);
  }
  if (tier == 0) {
    const auto low = [](Int128 v) { return static_cast<int64_t>(v); };
    const int64_t value =
        low(plane.a) * p[0] + low(plane.b) * p[1] + low(plane.c) * p[2] + low(plane.d);
    return value > 0 ? 1 : value < 0 ? -1 : 0;
  }
  const Int128 value = plane.a * p[0] + plane.b * p[1] + plane.c * p[2] + plane.d;
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

}  // namespace csgrun
