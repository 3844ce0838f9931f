// Natural numbers of any size, for the few steps that are not worth a width of their own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/exact/fixed_int.h"

namespace csgrun {

/// Limbs of 64 bits, least significant first, without leading zeros; zero is empty.
using Natural = std::vector<uint64_t>;

Natural natural(UInt128 value);
/// The magnitude of a fixed-width integer.
template <int N>
Natural natural(const Int<N>& value) {
  const Int<N> m = value.magnitude();
  Natural r(m.limb.begin(), m.limb.end());
  while (!r.empty() && r.back() == 0) r.pop_back();
  return r;
}

int bit_width(const Natural& a);
int compare(const Natural& a, const Natural& b);
Natural add(const Natural& a, const Natural& b);
/// REQUIRES: a >= b.
Natural subtract(const Natural& a, const Natural& b);
Natural multiply(const Natural& a, const Natural& b);
Natural shift_left(const Natural& a, int bits);

/// Schoolbook division in place, without allocation: `numerator` becomes the remainder.
/// REQUIRES: the divisor's last limb has its top bit set (shift both); numerator.size() >
/// divisor.size(), and the numerator's last limb is less than the divisor's;
/// quotient.size() == numerator.size() - divisor.size().
void divide_normalised(std::span<uint64_t> numerator, std::span<const uint64_t> divisor,
                       std::span<uint64_t> quotient);

/// numerator / denominator * 2^exponent, rounded once, to nearest, ties to even; subnormal and
/// infinite results as IEEE has them. REQUIRES: denominator > 0.
double round_quotient(const Natural& numerator, const Natural& denominator, int exponent);

/// A natural number with a sign; zero is not negative.
struct Signed {
  bool negative = false;
  Natural magnitude;
};
template <int N>
Signed signed_value(const Int<N>& value) {
  return {value.negative(), natural(value)};
}
Signed add(const Signed& a, const Signed& b);
Signed multiply(const Signed& a, const Natural& b);
double round_quotient(const Signed& numerator, const Natural& denominator, int exponent);

}  // namespace csgrun
