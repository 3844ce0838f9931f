// Sums and differences of 64-bit limbs with what is carried from one to the next. Compilers turn
// chains of these into the instructions that are made for it, which of 128-bit sums they do not.
#pragma once

#include <cstdint>

namespace csgrun {

/// a + b + carry (0 or 1), modulo 2^64; `carry` becomes what is carried over.
inline uint64_t add_carry(uint64_t a, uint64_t b, unsigned char& carry) {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  unsigned long long sum = 0;
  carry = __builtin_ia32_addcarryx_u64(carry, a, b, &sum);
  return sum;
#else
  const auto sum = static_cast<unsigned __int128>(a) + b + carry;
  carry = static_cast<unsigned char>(sum >> 64);
  return static_cast<uint64_t>(sum);
#endif
}

/// a - b - borrow (0 or 1), modulo 2^64; `borrow` becomes what is borrowed.
inline uint64_t subtract_borrow(uint64_t a, uint64_t b, unsigned char& borrow) {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  unsigned long long difference = 0;
  borrow = __builtin_ia32_sbb_u64(borrow, a, b, &difference);
  return difference;
#else
  const auto difference = static_cast<unsigned __int128>(a) - b - borrow;
  borrow = static_cast<unsigned char>(difference >> 64) & 1;
  return static_cast<uint64_t>(difference);
#endif
}

}  // namespace csgrun
