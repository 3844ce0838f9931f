#include "engine/mesh/exact_sum.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace csgrun {
namespace {

constexpr int64_t kBase = int64_t{1} << 32;
/// Each term adds less than 2^32 to a digit of 63 bits.
constexpr uint32_t kTermsPerCarry = 1u << 30;

/// |x| = mantissa * 2^exponent.
uint64_t split(double x, int& exponent) {
  const auto bits = std::bit_cast<uint64_t>(x);
  const auto field = static_cast<int>((bits >> 52) & 0x7ff);
  const uint64_t fraction = bits & ((uint64_t{1} << 52) - 1);
  exponent = std::max(field, 1) - 1075;
  return field == 0 ? fraction : fraction | (uint64_t{1} << 52);
}

}  // namespace

/// Makes the digits from `first` to `last` part of the number.
void ExactSum::use(int first, int last) {
  if (highest_ < 0) {
    lowest_ = first;
    highest_ = first - 1;
  }
  while (lowest_ > first) digits_[static_cast<size_t>(--lowest_)] = 0;
  while (highest_ < last) digits_[static_cast<size_t>(++highest_)] = 0;
}

void ExactSum::add(double x, double y, double z, bool negative) {
  if (x == 0 || y == 0 || z == 0) return;
  int ex = 0, ey = 0, ez = 0;
  const uint64_t mx = split(x, ex), my = split(y, ey), mz = split(z, ez);
  negative ^= std::signbit(x) ^ std::signbit(y) ^ std::signbit(z);
  // 53 * 53 * 53 bits, as digits of 32.
  const auto product = static_cast<unsigned __int128>(mx) * my;
  const auto low = static_cast<unsigned __int128>(static_cast<uint64_t>(product)) * mz;
  const auto high =
      static_cast<unsigned __int128>(static_cast<uint64_t>(product >> 64)) * mz + (low >> 64);
  const uint64_t words[3] = {static_cast<uint64_t>(low), static_cast<uint64_t>(high),
                             static_cast<uint64_t>(high >> 64)};
  const int position = ex + ey + ez + kBias;
  const int first = position / 32, shift = position % 32;
  use(first, first + 5);
  uint64_t carry_in = 0;
  for (int i = 0; i < 6; ++i) {
    const uint64_t digit = (words[i / 2] >> (32 * (i % 2))) & 0xffffffffu;
    const uint64_t shifted = (digit << shift) | carry_in;
    carry_in = shifted >> 32;
    const auto value = static_cast<int64_t>(shifted & 0xffffffffu);
    digits_[static_cast<size_t>(first + i)] += negative ? -value : value;
  }
  if (++pending_ >= kTermsPerCarry) carry();
}

void ExactSum::carry() {
  pending_ = 0;
  if (highest_ < 0) return;
  int64_t carry_in = 0;
  // Every digit but the highest ends in [0, 2^32), so that one has the sign of the sum.
  for (int i = lowest_; i <= highest_; ++i) {
    const int64_t value = digits_[static_cast<size_t>(i)] + carry_in;
    carry_in = value >> 32;
    digits_[static_cast<size_t>(i)] = value - carry_in * kBase;
  }
  if (carry_in != 0 && highest_ + 1 < kDigits) {
    use(lowest_, highest_ + 1);
    digits_[static_cast<size_t>(highest_)] += carry_in;
  }
}

int ExactSum::sign() {
  // After this the digits below the highest are not negative.
  carry();
  for (int i = highest_; i >= lowest_; --i) {
    const int64_t digit = digits_[static_cast<size_t>(i)];
    if (digit != 0) return digit < 0 ? -1 : 1;
  }
  return 0;
}

double ExactSum::divided(uint32_t divisor) {
  const int s = sign();
  if (s == 0) return 0;
  if (s < 0) {
    for (int i = lowest_; i <= highest_; ++i) digits_[static_cast<size_t>(i)] *= -1;
    carry();
  }
  while (digits_[static_cast<size_t>(highest_)] == 0) --highest_;
  // Long division, with three digits of quotient below the lowest: the rest only matters as "not
  // 0".
  uint64_t rest = 0;
  unsigned __int128 top = 0;  // the leading digits of the quotient
  int exponent = 0, taken = 0;
  bool sticky = false;
  for (int i = highest_; i >= lowest_ - 3; --i) {
    const uint64_t digit =
        i >= lowest_ ? static_cast<uint64_t>(digits_[static_cast<size_t>(i)]) : 0;
    const uint64_t dividend = (rest << 32) | digit;
    const uint64_t quotient = dividend / divisor;
    rest = dividend % divisor;
    if (taken == 0 && quotient == 0) continue;
    if (taken < 3) {  // at least 65 bits
      top = (top << 32) | quotient;
      exponent = 32 * i - kBias;
      ++taken;
    } else {
      sticky |= quotient != 0;
    }
  }
  sticky |= rest != 0;
  int extra = -53;  // bits below the 53 that stay
  for (unsigned __int128 t = top; t != 0; t >>= 1) ++extra;
  const unsigned __int128 half = static_cast<unsigned __int128>(1) << (extra - 1);
  const unsigned __int128 below = top & (2 * half - 1);
  auto mantissa = static_cast<uint64_t>(top >> extra);
  if (below > half || (below == half && (sticky || (mantissa & 1) != 0))) ++mantissa;
  return s * std::ldexp(static_cast<double>(mantissa), exponent + extra);
}

}  // namespace csgrun
