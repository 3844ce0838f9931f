// Arithmetic with about 106 bits as unevaluated sums of two doubles (Dekker 1971, Knuth
// TAOCP 4.2.2), with the same bits on every IEEE machine; long double would not. It keeps the
// frames of transforms and the sums of measures free of rounding noise of our own.
#pragma once

#include <cmath>

namespace csgrun {

/// hi + lo, |lo| at most half a unit in the last place of hi. Each operation has a relative error
/// of a few 2^-104 (sums: of terms of one sign). REQUIRES: no contraction, no overflow.
struct DoubleDouble {
  double hi = 0, lo = 0;

  DoubleDouble() = default;
  DoubleDouble(double h) : hi(h) {}  // NOLINT: implicit by design
  DoubleDouble(double h, double l) : hi(h), lo(l) {}

  static DoubleDouble sum(double a, double b) {
    const double s = a + b, t = s - a;
    return {s, (a - (s - t)) + (b - t)};
  }
  static DoubleDouble product(double a, double b) {
    const double p = a * b;
    return {p, std::fma(a, b, -p)};
  }
  [[nodiscard]] double value() const { return hi + lo; }
  /// Times 2^exponent, exactly.
  [[nodiscard]] DoubleDouble scaled(int exponent) const {
    return {std::ldexp(hi, exponent), std::ldexp(lo, exponent)};
  }
};

inline DoubleDouble operator-(const DoubleDouble& a) { return {-a.hi, -a.lo}; }

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble s = DoubleDouble::sum(a.hi, b.hi), t = DoubleDouble::sum(a.lo, b.lo);
  const DoubleDouble u = DoubleDouble::sum(s.hi, s.lo + t.hi);
  return DoubleDouble::sum(u.hi, u.lo + t.lo);
}
inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble p = DoubleDouble::product(a.hi, b.hi);
  return DoubleDouble::sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double q1 = a.hi / b.hi;
  const DoubleDouble r1 = a - b * q1;
  const double q2 = r1.hi / b.hi;
  const DoubleDouble r2 = r1 - b * q2;
  return DoubleDouble::sum(q1, q2) + r2.hi / b.hi;
}

/// One Newton step from the double root. REQUIRES: `a` is not negative.
inline DoubleDouble sqrt(const DoubleDouble& a) {
  if (a.hi == 0) return {};
  const double s = std::sqrt(a.hi);
  const DoubleDouble rest = a - DoubleDouble::product(s, s);
  return DoubleDouble::sum(s, rest.hi / (2 * s));
}

}  // namespace csgrun
