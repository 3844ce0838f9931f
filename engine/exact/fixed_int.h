// Signed integers of a fixed number of 64-bit limbs, in two's complement.
//
// Sums and products are taken modulo 2^(64 N), as machine integers are: partial sums may wrap as
// long as the final value fits, which is what widths.h computes and asserts. There is no
// allocation, no branch on size and no division; everything inlines.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "engine/exact/carry.h"

namespace csgrun {

using Int128 = __int128;
using UInt128 = unsigned __int128;

template <int N>
struct Int {
  std::array<uint64_t, N> limb{};  ///< least significant first

  Int() = default;
  Int(int64_t v) {  // NOLINT: implicit, as for built-in integers
    limb[0] = static_cast<uint64_t>(v);
    const uint64_t fill = v < 0 ? ~0ull : 0;
    for (int i = 1; i < N; ++i) limb[i] = fill;
  }
  static Int from_int128(Int128 v) {
    Int r;
    r.limb[0] = static_cast<uint64_t>(v);
    if constexpr (N > 1) r.limb[1] = static_cast<uint64_t>(v >> 64);
    const uint64_t fill = v < 0 ? ~0ull : 0;
    for (int i = 2; i < N; ++i) r.limb[i] = fill;
    return r;
  }
  /// Sign-extends, or keeps the low limbs.
  template <int M>
  static Int from(const Int<M>& v) {
    Int r;
    const uint64_t fill = v.negative() ? ~0ull : 0;
    for (int i = 0; i < N; ++i) r.limb[i] = i < M ? v.limb[i] : fill;
    return r;
  }

  [[nodiscard]] bool negative() const { return static_cast<int64_t>(limb[N - 1]) < 0; }
  [[nodiscard]] bool is_zero() const {
    uint64_t any = 0;
    for (int i = 0; i < N; ++i) any |= limb[i];
    return any == 0;
  }
  [[nodiscard]] int sign() const { return negative() ? -1 : is_zero() ? 0 : 1; }

  Int operator+(const Int& o) const {
    Int r;
    unsigned char carry = 0;
    for (int i = 0; i < N; ++i) r.limb[i] = add_carry(limb[i], o.limb[i], carry);
    return r;
  }
  Int operator-(const Int& o) const {
    Int r;
    unsigned char borrow = 0;
    for (int i = 0; i < N; ++i) r.limb[i] = subtract_borrow(limb[i], o.limb[i], borrow);
    return r;
  }
  Int operator-() const { return Int() - *this; }
  Int& operator+=(const Int& o) { return *this = *this + o; }
  Int& operator-=(const Int& o) { return *this = *this - o; }
  bool operator==(const Int&) const = default;

  /// *this * 2^bits, modulo 2^(64 N). 0 <= bits < 64 N.
  [[nodiscard]] Int shifted_left(int bits) const {
    Int r;
    const int whole = bits / 64, part = bits % 64;
    for (int i = N - 1; i >= whole; --i) {
      r.limb[i] = limb[i - whole] << part;
      if (part && i > whole) r.limb[i] |= limb[i - whole - 1] >> (64 - part);
    }
    return r;
  }
  [[nodiscard]] Int magnitude() const {
    // Signs are as good as random: no branch on them.
    const uint64_t sign = -static_cast<uint64_t>(negative());
    Int r;
    for (int i = 0; i < N; ++i) r.limb[i] = limb[i] ^ sign;
    unsigned char borrow = 0;
    for (int i = 0; i < N; ++i) r.limb[i] = subtract_borrow(r.limb[i], sign, borrow);
    return r;
  }
  /// Number of bits of the magnitude: 0 for zero.
  [[nodiscard]] int bit_width() const {
    const Int m = magnitude();
    for (int i = N - 1; i >= 0; --i) {
      if (m.limb[i]) return 64 * i + 64 - std::countl_zero(m.limb[i]);
    }
    return 0;
  }
};

/// a * b modulo 2^(64 R).
template <int R, int A, int B>
inline Int<R> multiply(const Int<A>& a, const Int<B>& b) {
  Int<R> r;
  for (int i = 0; i < A && i < R; ++i) {
    uint64_t carry = 0;
    for (int j = 0; j < B && i + j < R; ++j) {
      const UInt128 t = static_cast<UInt128>(a.limb[i]) * b.limb[j] + r.limb[i + j] + carry;
      r.limb[i + j] = static_cast<uint64_t>(t);
      carry = static_cast<uint64_t>(t >> 64);
    }
    if (i + B < R) r.limb[i + B] = carry;
  }
  // As unsigned limbs a negative number reads 2^(64 A) too large: take the excess off again.
  if constexpr (A < R) {
    if (a.negative()) {
      unsigned char borrow = 0;
      for (int i = A; i < R; ++i) {
        const uint64_t sub = i - A < B ? b.limb[i - A] : (b.negative() ? ~0ull : 0);
        r.limb[i] = subtract_borrow(r.limb[i], sub, borrow);
      }
    }
  }
  if constexpr (B < R) {
    if (b.negative()) {
      unsigned char borrow = 0;
      for (int i = B; i < R; ++i) {
        r.limb[i] = subtract_borrow(r.limb[i], i - B < A ? a.limb[i - B] : 0, borrow);
      }
    }
  }
  return r;
}

/// -1, 0, +1 as a < b, a == b, a > b.
template <int N>
inline int compare(const Int<N>& a, const Int<N>& b) {
  if (a.negative() != b.negative()) return a.negative() ? -1 : 1;
  for (int i = N - 1; i >= 0; --i) {
    if (a.limb[i] != b.limb[i]) return a.limb[i] < b.limb[i] ? -1 : 1;
  }
  return 0;
}

/// Nearest double (relative error at most 2^-52).
template <int N>
inline double to_double(const Int<N>& v) {
  const Int<N> m = v.magnitude();
  double r = 0;
  int i = N - 1;
  while (i > 0 && m.limb[i] == 0) --i;
  // Two limbs carry at least 65 significant bits; what lies below changes the last place at most.
  if (i == 0) {
    r = static_cast<double>(m.limb[0]);
  } else {
    const UInt128 top = (static_cast<UInt128>(m.limb[i]) << 64) | m.limb[i - 1];
    r = static_cast<double>(top);
    for (int k = 1; k < i; ++k) r *= 0x1p64;
  }
  return v.negative() ? -r : r;
}

}  // namespace csgrun
