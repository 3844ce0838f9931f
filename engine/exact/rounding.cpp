#include "engine/exact/rounding.h"

#include <bit>
#include <cmath>
#include <cstdlib>

namespace csgrun {
namespace {

using Quotient = Int<kQuotientLimbs>;

/// REQUIRES: v > 0.
template <int N>
LeadingBits leading(const Int<N>& v) {
  int top = N - 1;
  while (v.limb[top] == 0) --top;
  const int shift = std::countl_zero(v.limb[top]);
  const uint64_t below = top > 0 ? v.limb[top - 1] : 0;
  return {v.limb[top] << shift | (below >> 1) >> (63 - shift), 64 * top - shift};
}

/// A mantissa of at most `precision` bits and its exponent, rounded to nearest even.
struct Rounded {
  uint64_t mantissa;
  int exponent;
};

Rounded round_quotient(const Quotient& numerator, const Quotient& denominator, int exponent,
                       int precision, int lowest_exponent) {
  const LeadingBits n = leading(numerator), d = leading(denominator);
  // numerator / denominator = quotient * 2^scale up to 8 units of quotient: each truncation is off
  // by less than 2^-63 relatively, and quotient < 2^65.
  const UInt128 quotient = (static_cast<UInt128>(n.bits) << 64) / d.bits;
  const int scale = n.exponent - d.exponent - 64;
  const int width = quotient >> 64 ? 65 : 64;
  int drop = width - precision;
  if (scale + exponent + drop < lowest_exponent) drop = lowest_exponent - scale - exponent;
  if (drop > 66) return {0, 0};
  const UInt128 half = static_cast<UInt128>(1) << (drop - 1);
  const UInt128 low = quotient & ((half << 1) - 1);
  uint64_t mantissa = static_cast<uint64_t>(quotient >> drop);
  const UInt128 distance = low > half ? low - half : half - low;
  bool up;
  if (distance > 16) {
    up = low > half;
  } else {
    // Near the midpoint between two results: compare exactly with it.
    constexpr int kWide = kQuotientLimbs + 3;
    const UInt128 midpoint = (static_cast<UInt128>(mantissa) << drop) + half;
    Int<3> middle;
    middle.limb[0] = static_cast<uint64_t>(midpoint);
    middle.limb[1] = static_cast<uint64_t>(midpoint >> 64);
    Int<kWide> left = Int<kWide>::from(numerator);
    Int<kWide> right = multiply<kWide>(denominator, middle);
    if (scale < 0) {
      left = left.shifted_left(-scale);
    } else {
      right = right.shifted_left(scale);
    }
    const int order = compare(left, right);
    up = order > 0 || (order == 0 && (mantissa & 1));
  }
  return {mantissa + (up ? 1 : 0), scale + exponent + drop};
}

}  // namespace

double round_to_double(const Quotient& numerator, const Quotient& denominator, int exponent) {
  if (numerator.is_zero()) return 0;
  const Rounded r = round_quotient(numerator.magnitude(), denominator, exponent, 53, -1074);
  const double value = std::ldexp(static_cast<double>(r.mantissa), r.exponent);
  return numerator.negative() ? -value : value;
}

NarrowQuotients::NarrowQuotients(const Int<4>& denominator)
    : denominator_(denominator), leading_(leading(denominator)) {}

double NarrowQuotients::to_double(const Int<4>& numerator, int exponent) const {
  if (numerator.is_zero()) return 0;
  const LeadingBits n = leading(numerator.magnitude());
  // 62 or 63 bits of the quotient, which fit a signed number: machines convert these at once, and
  // round to nearest. Cut bits make it less than 1 too large, or less than 2 too small.
  constexpr int kShift = 62;
  const auto quotient =
      static_cast<int64_t>((static_cast<UInt128>(n.bits) << kShift) / leading_.bits);
  const int64_t half = (quotient >> kShift) != 0 ? 1 << 9 : 1 << 8;  // of the double's last bit
  const int64_t beyond = (quotient & (2 * half - 1)) - half;         // the middle of two doubles
  const int power = n.exponent - leading_.exponent - kShift + exponent;
  constexpr int kFarFromSubnormal = 900;
  if (std::abs(beyond) <= 1 || std::abs(power) > kFarFromSubnormal) {
    return round_to_double(Quotient::from(numerator), Quotient::from(denominator_), exponent);
  }
  const double value = static_cast<double>(quotient) *
                       std::bit_cast<double>(static_cast<uint64_t>(power + 1023) << 52);
  // Signs are as good as random: no branch on them.
  const uint64_t sign = static_cast<uint64_t>(numerator.negative()) << 63;
  return std::bit_cast<double>(std::bit_cast<uint64_t>(value) | sign);
}

float round_to_float(const Quotient& numerator, const Quotient& denominator, int exponent) {
  if (numerator.is_zero()) return 0;
  const Rounded r = round_quotient(numerator.magnitude(), denominator, exponent, 24, -149);
  // At most 24 bits and an exponent that a float has: both conversions are exact.
  const auto value = static_cast<float>(std::ldexp(static_cast<double>(r.mantissa), r.exponent));
  return numerator.negative() ? -value : value;
}

}  // namespace csgrun
