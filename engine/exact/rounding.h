// Correct rounding of exact quotients to double and float: equal values give equal bits, whatever
// numerator and denominator they came from.
#pragma once

#include "engine/exact/fixed_int.h"

namespace csgrun {

/// Widest numerator and denominator that can be rounded.
constexpr int kQuotientLimbs = 8;

/// numerator / denominator * 2^exponent, rounded to nearest, ties to even. denominator > 0.
/// Fast: one 128-bit division; an exact comparison decides when the quotient is within 2^-60 of a
/// rounding boundary.
double round_to_double(const Int<kQuotientLimbs>& numerator, const Int<kQuotientLimbs>& denominator,
                       int exponent = 0);
/// The 64 leading bits of a number.
struct LeadingBits {
  uint64_t bits = 0;  ///< the first of them set
  int exponent = 0;   ///< the number is in [bits, bits + 1) * 2^exponent
};

/// The same for narrower numbers, several times as fast: quotients of one denominator > 0.
class NarrowQuotients {
 public:
  explicit NarrowQuotients(const Int<4>& denominator);
  /// numerator / denominator * 2^exponent, rounded as by round_to_double.
  [[nodiscard]] double to_double(const Int<4>& numerator, int exponent = 0) const;

 private:
  Int<4> denominator_;
  LeadingBits leading_;
};
inline double round_to_double(const Int<4>& numerator, const Int<4>& denominator,
                              int exponent = 0) {
  return NarrowQuotients(denominator).to_double(numerator, exponent);
}
/// The same for float, subnormal results included.
float round_to_float(const Int<kQuotientLimbs>& numerator, const Int<kQuotientLimbs>& denominator,
                     int exponent = 0);

}  // namespace csgrun
