#include "engine/mesh/to_millimetres.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/exact/rounding.h"
#include "engine/mesh/rational_text.h"

namespace csgrun {
namespace {

/// A double in the middle of two floats says on which side the exact value is only if it is exact;
/// subnormal numbers have other middles.
bool tells_float(double correctly_rounded) {
  if (correctly_rounded == 0) return true;
  const bool is_middle = (std::bit_cast<uint64_t>(correctly_rounded) & 0x1fffffff) == 0x10000000;
  return !is_middle && std::fabs(correctly_rounded) > 0x1p-120 &&
         std::fabs(correctly_rounded) < 0x1p120;
}

}  // namespace

ToMillimetres::ToMillimetres(const GridStep& step) : step_(step) {
  constexpr int64_t kExact = int64_t{1} << 53;
  constexpr int kMostExponent = 900;
  if (step.denominator > kExact || std::abs(step.exponent) > kMostExponent) return;
  quick_limit_ = kExact / step.numerator;
  denominator_ = static_cast<double>(step.denominator);
  scale_ = std::ldexp(1.0, step.exponent);
}

/// One division of whole numbers, rounded once, and a power of two. False when that is not certain
/// to be right.
bool ToMillimetres::quick(int64_t coordinate, double& mm, float& single) const {
  if (coordinate >= quick_limit_ || coordinate <= -quick_limit_) return false;
  const auto numerator = static_cast<double>(coordinate * step_.numerator);
  mm = numerator / denominator_ * scale_;
  single = static_cast<float>(mm);
  return tells_float(mm);
}

void ToMillimetres::position(const IVec3& p, glm::dvec3& mm, std::array<float, 3>& single) const {
  for (int k = 0; k < 3; ++k) {
    if (quick(p[k], mm[k], single[k])) continue;
    divide(grid_point(p[0], p[1], p[2]), mm, single);
    return;
  }
}

void ToMillimetres::position(const Point& p, glm::dvec3& mm, std::array<float, 3>& single) const {
  if (p.w_bits == 1 && p.xyz_bits < 63) {
    const auto whole = [](const Int<kPointLimbs>& c) { return static_cast<int64_t>(c.limb[0]); };
    position(IVec3{whole(p.x), whole(p.y), whole(p.z)}, mm, single);
  } else {
    divide(p, mm, single);
  }
}

void ToMillimetres::divide(const Point& p, glm::dvec3& mm, std::array<float, 3>& single) const {
  static_assert(widths::kMaxPointXyz + 63 < 64 * kQuotientLimbs);
  const Int<kPointLimbs>* coordinate[3] = {&p.x, &p.y, &p.z};
  using Q = Int<kQuotientLimbs>;
  const auto round = [&]<int N>(const auto& to_double) {
    const Int<1> times(step_.numerator);
    for (int k = 0; k < 3; ++k) {
      const auto numerator =
          multiply<N>(Int<std::min(N, kPointLimbs)>::from(*coordinate[k]), times);
      mm[k] = to_double(numerator);
      if (tells_float(mm[k])) {
        single[k] = static_cast<float>(mm[k]);
      } else {
        const auto denominator = multiply<kQuotientLimbs>(p.w, Int<1>(step_.denominator));
        single[k] = round_to_float(Q::from(numerator), denominator, step_.exponent);
      }
    }
  };
  if (std::max(p.xyz_bits, p.w_bits) + 63 < 256) {
    const NarrowQuotients over_w(multiply<4>(Int<4>::from(p.w), Int<1>(step_.denominator)));
    round.template operator()<4>(
        [&](const Int<4>& numerator) { return over_w.to_double(numerator, step_.exponent); });
  } else {
    const auto denominator = multiply<kQuotientLimbs>(p.w, Int<1>(step_.denominator));
    round.template operator()<kQuotientLimbs>([&](const Q& numerator) {
      return round_to_double(numerator, denominator, step_.exponent);
    });
  }
}

std::array<std::string, 3> ToMillimetres::text(const Point& p) const {
  const Natural denominator = multiply(natural(p.w), natural(Int<1>(step_.denominator)));
  const Natural numerator = natural(Int<1>(step_.numerator));
  const auto of = [&](const Int<kPointLimbs>& coordinate) {
    return rational_text(multiply(signed_value(coordinate), numerator), denominator,
                         step_.exponent);
  };
  return {of(p.x), of(p.y), of(p.z)};
}

}  // namespace csgrun
