// Sums of two doubles: 106 bits, on plain IEEE operations.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "engine/exact/fixed_int.h"

namespace csgrun {

/// hi + lo, |lo| at most half a unit in the last place of hi. Each operation has a relative error
/// of a few 2^-104 (sums: of terms of one sign). REQUIRES: no contraction, no overflow.
struct DoubleDouble {
  double hi = 0, lo = 0;

  static DoubleDouble sum(double a, double b) {
    const double s = a + b, t = s - a;
    return {s, (a - (s - t)) + (b - t)};
  }
  static DoubleDouble product(double a, double b) {
    const double p = a * b;
    return {p, std::fma(a, b, -p)};
  }
  DoubleDouble operator+(const DoubleDouble& o) const {
    const DoubleDouble s = sum(hi, o.hi), t = sum(lo, o.lo);
    const DoubleDouble u = sum(s.hi, s.lo + t.hi);
    return sum(u.hi, u.lo + t.lo);
  }
  DoubleDouble operator*(const DoubleDouble& o) const {
    const DoubleDouble p = product(hi, o.hi);
    return sum(p.hi, p.lo + (hi * o.lo + lo * o.hi));
  }
  DoubleDouble operator/(const DoubleDouble& o) const {
    const double q = hi / o.hi;
    const DoubleDouble r = *this + o * DoubleDouble{-q, 0};
    const double q2 = r.hi / o.hi;
    const DoubleDouble r2 = r + o * DoubleDouble{-q2, 0};
    return sum(q, q2) + DoubleDouble{r2.hi / o.hi, 0};
  }
  [[nodiscard]] DoubleDouble scaled(int exponent) const {
    return {std::ldexp(hi, exponent), std::ldexp(lo, exponent)};
  }
  [[nodiscard]] DoubleDouble square_root() const {
    if (hi == 0) return {};
    const double x = std::sqrt(hi);
    const DoubleDouble rest = *this + product(x, -x);
    return sum(x, rest.hi / (2 * x));
  }
};

/// value * 2^(64 limbs) to 106 leading bits; what lies below 2^-1000 is dropped. REQUIRES: less
/// than 2^1000.
template <int N>
DoubleDouble double_double(const Int<N>& value, int limbs = 0) {
  const Int<N> m = value.magnitude();
  int top = N - 1;
  while (top > 0 && m.limb[top] == 0) --top;
  // Three limbs hold at least 129 significant bits; halves of limbs are exact in a double.
  DoubleDouble r;
  for (int i = top; i >= 0 && i > top - 3; --i) {
    const int exponent = 1023 + 64 * (i + limbs);
    if (exponent < 1) break;
    const double unit = std::bit_cast<double>(static_cast<uint64_t>(exponent) << 52);
    const double high = static_cast<double>(m.limb[i] >> 32) * 0x1p32 * unit;
    const double low = static_cast<double>(m.limb[i] & 0xffffffff) * unit;
    r = r + DoubleDouble::sum(high, low);
  }
  return value.negative() ? DoubleDouble{-r.hi, -r.lo} : r;
}

}  // namespace csgrun
