// Sums of two doubles: 106 bits, on plain IEEE operations.
#pragma once

#include <cmath>

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

/// value * 2^exponent to 106 leading bits.
template <int N>
DoubleDouble double_double(const Int<N>& value, int exponent) {
  const Int<N> m = value.magnitude();
  const int width = m.bit_width();
  // The leading 106 bits as two halves, each exact in a double.
  const auto bits_at = [&](int from) -> uint64_t {  // 53 bits whose lowest is bit `from`
    uint64_t r = 0;
    const int low = from < 0 ? 0 : from;
    const int whole = low / 64, part = low % 64;
    if (whole < N) r = m.limb[whole] >> part;
    if (part && whole + 1 < N) r |= m.limb[whole + 1] << (64 - part);
    if (from < 0) r = from <= -64 ? 0 : r << -from;
    return r & ((uint64_t{1} << 53) - 1);
  };
  const double high = std::ldexp(static_cast<double>(bits_at(width - 53)), width - 53 + exponent);
  const double low = std::ldexp(static_cast<double>(bits_at(width - 106)), width - 106 + exponent);
  return value.negative() ? DoubleDouble::sum(-high, -low) : DoubleDouble::sum(high, low);
}

}  // namespace csgrun
