#include "engine/mesh/rational_text.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace csgrun {
namespace {

constexpr uint64_t kDigitsBase = 10'000'000'000'000'000'000u;  // 10^19, the largest in 64 bits
constexpr size_t kDigits = 19;

int trailing_zeros(const Natural& a) {
  size_t limb = 0;
  while (a[limb] == 0) ++limb;
  return static_cast<int>(64 * limb) + std::countr_zero(a[limb]);
}

void shift_right(Natural& a, int bits) {
  const auto whole = static_cast<size_t>(bits / 64);
  const int part = bits % 64;
  a.erase(a.begin(), a.begin() + static_cast<ptrdiff_t>(whole));
  for (size_t i = 0; part != 0 && i < a.size(); ++i)
    a[i] = a[i] >> part | (i + 1 < a.size() ? a[i + 1] << (64 - part) : 0);
  while (!a.empty() && a.back() == 0) a.pop_back();
}

/// a -= b. REQUIRES: a >= b.
void subtract_from(Natural& a, const Natural& b) {
  uint64_t borrow = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const UInt128 difference = static_cast<UInt128>(a[i]) - (i < b.size() ? b[i] : 0) - borrow;
    a[i] = static_cast<uint64_t>(difference);
    borrow = static_cast<uint64_t>(difference >> 64) & 1;
  }
  while (!a.empty() && a.back() == 0) a.pop_back();
}

/// Of odd numbers, by Stein's algorithm (1967): no division.
Natural odd_gcd(Natural a, Natural b) {
  while (true) {
    const int order = compare(a, b);
    if (order == 0) return a;
    if (order < 0) std::swap(a, b);
    subtract_from(a, b);
    shift_right(a, trailing_zeros(a));
  }
}

/// a / b, where b divides a.
Natural exact_quotient(const Natural& a, const Natural& b) {
  const int shift = 63 - (bit_width(b) - 1) % 64;
  const Natural divisor = shift_left(b, shift);
  Natural numerator = shift_left(a, shift);
  numerator.resize(std::max(numerator.size(), divisor.size()) + 1, 0);
  Natural quotient(numerator.size() - divisor.size(), 0);
  divide_normalised(numerator, divisor, quotient);
  while (!quotient.empty() && quotient.back() == 0) quotient.pop_back();
  return quotient;
}

std::string decimal(Natural a) {
  std::string text;  // backwards
  while (!a.empty()) {
    UInt128 rest = 0;
    for (size_t i = a.size(); i-- > 0;) {
      const UInt128 dividend = rest << 64 | a[i];
      a[i] = static_cast<uint64_t>(dividend / kDigitsBase);
      rest = dividend % kDigitsBase;
    }
    while (!a.empty() && a.back() == 0) a.pop_back();
    auto digits = static_cast<uint64_t>(rest);
    for (size_t k = 0; k < kDigits && (digits != 0 || !a.empty()); ++k, digits /= 10)
      text += static_cast<char>('0' + digits % 10);
  }
  if (text.empty()) return "0";
  std::reverse(text.begin(), text.end());
  return text;
}

}  // namespace

std::string rational_text(Signed numerator, Natural denominator, int exponent) {
  Natural& above = numerator.magnitude;
  if (above.empty()) return "0";
  // Powers of two go into the exponent, and from there to one side.
  const int twos_above = trailing_zeros(above), twos_below = trailing_zeros(denominator);
  shift_right(above, twos_above);
  shift_right(denominator, twos_below);
  exponent += twos_above - twos_below;
  if (bit_width(denominator) > 1) {
    const Natural common = odd_gcd(above, denominator);
    if (bit_width(common) > 1) {
      above = exact_quotient(above, common);
      denominator = exact_quotient(denominator, common);
    }
  }
  if (exponent > 0) above = shift_left(above, exponent);
  if (exponent < 0) denominator = shift_left(denominator, -exponent);
  std::string text = numerator.negative ? "-" : "";
  text += decimal(above);
  if (bit_width(denominator) > 1) text += '/' + decimal(denominator);
  return text;
}

}  // namespace csgrun
