#include "engine/mesh/natural.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace csgrun {
namespace {

void trim(Natural& a) {
  while (!a.empty() && a.back() == 0) a.pop_back();
}

}  // namespace

Natural natural(UInt128 value) {
  Natural r{static_cast<uint64_t>(value), static_cast<uint64_t>(value >> 64)};
  trim(r);
  return r;
}

int bit_width(const Natural& a) {
  return a.empty() ? 0 : static_cast<int>(64 * a.size()) - std::countl_zero(a.back());
}

int compare(const Natural& a, const Natural& b) {
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  for (size_t i = a.size(); i-- > 0;) {
    if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
  }
  return 0;
}

Natural add(const Natural& a, const Natural& b) {
  Natural r(std::max(a.size(), b.size()) + 1);
  uint64_t carry = 0;
  for (size_t i = 0; i < r.size(); ++i) {
    const UInt128 sum =
        static_cast<UInt128>(i < a.size() ? a[i] : 0) + (i < b.size() ? b[i] : 0) + carry;
    r[i] = static_cast<uint64_t>(sum);
    carry = static_cast<uint64_t>(sum >> 64);
  }
  trim(r);
  return r;
}

Natural subtract(const Natural& a, const Natural& b) {
  Natural r(a.size());
  uint64_t borrow = 0;
  for (size_t i = 0; i < r.size(); ++i) {
    const UInt128 difference = static_cast<UInt128>(a[i]) - (i < b.size() ? b[i] : 0) - borrow;
    r[i] = static_cast<uint64_t>(difference);
    borrow = static_cast<uint64_t>(difference >> 64) & 1;
  }
  trim(r);
  return r;
}

Natural multiply(const Natural& a, const Natural& b) {
  Natural r(a.size() + b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    uint64_t carry = 0;
    for (size_t j = 0; j < b.size(); ++j) {
      const UInt128 t = static_cast<UInt128>(a[i]) * b[j] + r[i + j] + carry;
      r[i + j] = static_cast<uint64_t>(t);
      carry = static_cast<uint64_t>(t >> 64);
    }
    r[i + b.size()] = carry;
  }
  trim(r);
  return r;
}

Natural shift_left(const Natural& a, int bits) {
  if (a.empty()) return a;
  const auto whole = static_cast<size_t>(bits / 64);
  const int part = bits % 64;
  Natural r(a.size() + whole + 1);
  for (size_t i = 0; i < a.size(); ++i) {
    r[i + whole] |= a[i] << part;
    if (part) r[i + whole + 1] = a[i] >> (64 - part);
  }
  trim(r);
  return r;
}

void divide_normalised(std::span<uint64_t> numerator, std::span<const uint64_t> divisor,
                       std::span<uint64_t> quotient) {
  // Knuth, The Art of Computer Programming 2, algorithm D, in base 2^64.
  const size_t n = divisor.size();
  const uint64_t top = divisor[n - 1], second = n > 1 ? divisor[n - 2] : 0;
  for (size_t j = quotient.size(); j-- > 0;) {
    uint64_t* const u = numerator.data() + j;
    const UInt128 head = static_cast<UInt128>(u[n]) << 64 | u[n - 1];
    UInt128 guess, rest;
    if (u[n] >= top) {  // equal: the quotient digit would not fit
      guess = ~0ull;
      rest = head - guess * top;
    } else {
      guess = head / top;
      rest = head % top;
    }
    while (n > 1 && (rest >> 64) == 0 && guess * second > (rest << 64 | u[n - 2])) {
      --guess;
      rest += top;
    }
    const auto digit = static_cast<uint64_t>(guess);
    uint64_t carry = 0, borrow = 0;
    for (size_t i = 0; i < n; ++i) {
      const UInt128 product = static_cast<UInt128>(digit) * divisor[i] + carry;
      carry = static_cast<uint64_t>(product >> 64);
      const UInt128 t = static_cast<UInt128>(u[i]) - static_cast<uint64_t>(product) - borrow;
      u[i] = static_cast<uint64_t>(t);
      borrow = static_cast<uint64_t>(t >> 64) & 1;
    }
    const UInt128 t = static_cast<UInt128>(u[n]) - carry - borrow;
    u[n] = static_cast<uint64_t>(t);
    quotient[j] = digit;
    if (t >> 64) {  // the digit was one too large
      --quotient[j];
      uint64_t over = 0;
      for (size_t i = 0; i < n; ++i) {
        const UInt128 sum = static_cast<UInt128>(u[i]) + divisor[i] + over;
        u[i] = static_cast<uint64_t>(sum);
        over = static_cast<uint64_t>(sum >> 64);
      }
      u[n] += over;
    }
  }
}

double round_quotient(const Natural& numerator, const Natural& denominator, int exponent) {
  if (numerator.empty()) return 0;
  // Shifted so that the quotient has 64 or 65 bits and the divisor is normalised.
  const int lift = 64 * static_cast<int>(denominator.size()) - bit_width(denominator);
  const Natural divisor = shift_left(denominator, lift);
  const int scale = 64 - (bit_width(numerator) - bit_width(denominator));
  Natural dividend, scaled_divisor = divisor;
  if (scale + lift >= 0) {
    dividend = shift_left(numerator, scale + lift);
  } else {
    // Whole limbs go to the divisor: it stays normalised.
    const int limbs = (-(scale + lift) + 63) / 64;
    scaled_divisor.insert(scaled_divisor.begin(), static_cast<size_t>(limbs), 0);
    dividend = shift_left(numerator, scale + lift + 64 * limbs);
  }
  dividend.resize(scaled_divisor.size() + 2);
  std::array<uint64_t, 2> digits{};
  divide_normalised(dividend, scaled_divisor, digits);
  const UInt128 quotient = static_cast<UInt128>(digits[1]) << 64 | digits[0];
  const bool exact =
      std::all_of(dividend.begin(), dividend.end(), [](uint64_t x) { return x == 0; });

  const int width = quotient >> 64 ? 65 : 64;
  int drop = width - 53;
  drop = std::max(drop, -1074 - (exponent - scale));  // subnormal results have fewer bits
  if (drop > 66) return 0;
  const UInt128 half = static_cast<UInt128>(1) << (drop - 1);
  const UInt128 low = quotient & ((half << 1) - 1);
  auto mantissa = static_cast<uint64_t>(quotient >> drop);
  if (low > half || (low == half && (!exact || (mantissa & 1)))) ++mantissa;
  return std::ldexp(static_cast<double>(mantissa), exponent - scale + drop);
}

Signed add(const Signed& a, const Signed& b) {
  if (a.negative == b.negative) return {a.negative, add(a.magnitude, b.magnitude)};
  const int order = compare(a.magnitude, b.magnitude);
  if (order == 0) return {};
  return order > 0 ? Signed{a.negative, subtract(a.magnitude, b.magnitude)}
                   : Signed{b.negative, subtract(b.magnitude, a.magnitude)};
}

Signed multiply(const Signed& a, const Natural& b) {
  Natural product = multiply(a.magnitude, b);
  const bool negative = a.negative && !product.empty();
  return {negative, std::move(product)};
}

double round_quotient(const Signed& numerator, const Natural& denominator, int exponent) {
  const double value = round_quotient(numerator.magnitude, denominator, exponent);
  return numerator.negative && value != 0 ? -value : value;
}

}  // namespace csgrun
