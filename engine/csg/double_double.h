// Arithmetic with about 106 bits as unevaluated sums of two doubles (Dekker 1971, Knuth
// TAOCP 4.2.2). It gives the frames of transforms free of rounding noise of our own, with the same
// bits on every IEEE machine; long double would not.
#pragma once

#include <cmath>

namespace csgrun {

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

/// One Newton step from the double root; `a` must be positive.
inline DoubleDouble sqrt(const DoubleDouble& a) {
  const double s = std::sqrt(a.hi);
  const DoubleDouble rest = a - DoubleDouble::product(s, s);
  return DoubleDouble::sum(s, rest.hi / (2 * s));
}

}  // namespace csgrun
