// Integers of the reference: 128 bits where they are known to do, GMP elsewhere; and lines and
// abscissae in a plane. Doubles decide a comparison only where their error bound allows.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include <gmpxx.h>

namespace csgrun::reference {

template <class Z>
struct Number;

template <>
struct Number<mpz_class> {
  static mpz_class from(const mpz_class& v) { return v; }
  static mpz_class to_gmp(const mpz_class& v) { return v; }
  static double approximate(const mpz_class& v) { return v.get_d(); }
  static int sign(const mpz_class& v) { return sgn(v); }
  static mpz_class common_divisor(const mpz_class& a, const mpz_class& b) { return gcd(a, b); }
};

template <>
struct Number<__int128> {
  static __int128 from(const mpz_class& v) {
    const mpz_class m = abs(v);
    uint64_t limbs[2] = {0, 0};
    if (mpz_sizeinbase(m.get_mpz_t(), 2) > 126) std::abort();
    mpz_export(limbs, nullptr, -1, 8, 0, 0, m.get_mpz_t());
    const auto r = static_cast<__int128>(static_cast<unsigned __int128>(limbs[1]) << 64 | limbs[0]);
    return v < 0 ? -r : r;
  }
  static mpz_class to_gmp(__int128 v) {
    const auto m = static_cast<unsigned __int128>(v < 0 ? -v : v);
    const uint64_t limbs[2] = {static_cast<uint64_t>(m), static_cast<uint64_t>(m >> 64)};
    mpz_class r;
    mpz_import(r.get_mpz_t(), 2, -1, 8, 0, 0, limbs);
    return v < 0 ? mpz_class(-r) : r;
  }
  static double approximate(__int128 v) { return static_cast<double>(v); }
  static int sign(__int128 v) { return (v > 0) - (v < 0); }
  static __int128 common_divisor(__int128 a, __int128 b) {
    if (a < 0) a = -a;
    if (b < 0) b = -b;
    while (b != 0) {
      if (static_cast<uint64_t>(a) == a && static_cast<uint64_t>(b) == b) {
        uint64_t x = static_cast<uint64_t>(a), y = static_cast<uint64_t>(b);
        while (y != 0) {
          const uint64_t r = x % y;
          x = y, y = r;
        }
        return x;
      }
      const __int128 r = a % b;
      a = b, b = r;
    }
    return a;
  }
};

/// An abscissa num / den, den > 0.
template <class Z>
struct Abscissa {
  Z num = 0, den = 1;
  double near = 0;

  static Abscissa of(Z num, Z den) {
    Abscissa r;
    if (Number<Z>::sign(den) < 0) {
      r.num = -num;
      r.den = -den;
    } else {
      r.num = num;
      r.den = den;
    }
    r.near = Number<Z>::approximate(r.num) / Number<Z>::approximate(r.den);
    return r;
  }
  [[nodiscard]] int compare(const Abscissa& o) const {
    const double gap = near - o.near;
    if (std::fabs(gap) > 0x1p-48 * (std::fabs(near) + std::fabs(o.near))) return gap < 0 ? -1 : 1;
    return Number<Z>::sign(Z(num * o.den - o.num * den));
  }
};

/// The line a u + b v + c = 0 of a plane with axes u, v. b > 0: lines along v are never asked for.
template <class Z>
struct Line {
  Z a = 0, b = 1, c = 0;
  double near_a = 0, near_b = 1, near_c = 0;

  /// False when the line runs along v.
  static bool make(Z a, Z b, Z c, Line& line) {
    const int sign = Number<Z>::sign(b);
    if (sign == 0) return false;
    Z divisor = Number<Z>::common_divisor(Number<Z>::common_divisor(a, b), c);
    if (sign < 0) divisor = -divisor;
    line.a = a / divisor;
    line.b = b / divisor;
    line.c = c / divisor;
    line.near_a = Number<Z>::approximate(line.a);
    line.near_b = Number<Z>::approximate(line.b);
    line.near_c = Number<Z>::approximate(line.c);
    return true;
  }
  bool operator<(const Line& o) const {
    if (a != o.a) return a < o.a;
    if (b != o.b) return b < o.b;
    return c < o.c;
  }
  [[nodiscard]] double height(double u) const { return -(near_a * u + near_c) / near_b; }
  /// Whether this line is above (+1), at (0) or below (-1) another one at u.
  [[nodiscard]] int compare_at(const Abscissa<Z>& u, const Line& o) const {
    const double h = height(u.near), g = o.height(u.near);
    const double bound =
        0x1p-46 * ((std::fabs(near_a * u.near) + std::fabs(near_c)) / near_b +
                   (std::fabs(o.near_a * u.near) + std::fabs(o.near_c)) / o.near_b);
    if (std::fabs(h - g) > bound) return h < g ? -1 : 1;
    return Number<Z>::sign(Z((o.a * u.num + o.c * u.den) * b - (a * u.num + c * u.den) * o.b));
  }
  /// Whether this line is steeper (+1), as steep, or less steep (-1): the order after a meeting.
  [[nodiscard]] int compare_slopes(const Line& o) const {
    return Number<Z>::sign(Z(o.a * b - a * o.b));
  }
  /// Where it meets another line that is not parallel.
  [[nodiscard]] Abscissa<Z> meeting(const Line& o) const {
    return Abscissa<Z>::of(Z(b * o.c - o.b * c), Z(a * o.b - o.a * b));
  }
};

}  // namespace csgrun::reference
