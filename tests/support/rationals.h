// Doubles as rationals: the truth behind exact sums and roundings.
#pragma once

#include <cmath>
#include <cstdint>

#include <boost/multiprecision/cpp_int.hpp>

namespace csgrun::testing {

/// x as a rational, exactly.
inline boost::multiprecision::cpp_rational rational(double x) {
  int exponent = 0;
  const auto mantissa = static_cast<int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  exponent -= 53;
  const boost::multiprecision::cpp_int power = boost::multiprecision::cpp_int(1)
                                               << std::abs(exponent);
  return exponent >= 0
             ? boost::multiprecision::cpp_rational(boost::multiprecision::cpp_int(mantissa) * power)
             : boost::multiprecision::cpp_rational(boost::multiprecision::cpp_int(mantissa), power);
}

/// Whether no double is nearer to the rational than x is, and of two equally near ones x is even.
inline bool is_nearest(const boost::multiprecision::cpp_rational& exact, double x) {
  const boost::multiprecision::cpp_rational error = abs(rational(x) - exact);
  for (const double other : {std::nextafter(x, -1e308), std::nextafter(x, 1e308)}) {
    const boost::multiprecision::cpp_rational its = abs(rational(other) - exact);
    if (its < error) return false;
    int unused = 0;
    if (its == error && (static_cast<int64_t>(std::ldexp(std::frexp(x, &unused), 53)) & 1) != 0)
      return false;
  }
  return true;
}

}  // namespace csgrun::testing
