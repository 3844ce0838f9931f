// Arithmetic modulo a 61-bit prime: to tell whether a rational sum is exactly a given value.
#pragma once

#include <cstdint>

#include "engine/exact/fixed_int.h"

namespace csgrun {

/// The field of integers modulo a prime 2^61 - k, k < 2^9: products are reduced without dividing.
class PrimeField {
 public:
  explicit PrimeField(uint64_t prime) : prime_(prime), k_((uint64_t{1} << 61) - prime) {}

  [[nodiscard]] uint64_t add(uint64_t a, uint64_t b) const {
    const uint64_t s = a + b;
    return s >= prime_ ? s - prime_ : s;
  }
  [[nodiscard]] uint64_t subtract(uint64_t a, uint64_t b) const {
    return a >= b ? a - b : a + prime_ - b;
  }
  [[nodiscard]] uint64_t multiply(uint64_t a, uint64_t b) const {
    return reduce(static_cast<UInt128>(a) * b);
  }
  [[nodiscard]] uint64_t power(uint64_t a, uint64_t exponent) const {
    uint64_t r = 1;
    for (; exponent; exponent >>= 1, a = multiply(a, a)) {
      if (exponent & 1) r = multiply(r, a);
    }
    return r;
  }
  /// REQUIRES: a is not zero.
  [[nodiscard]] uint64_t inverse(uint64_t a) const { return power(a, prime_ - 2); }
  [[nodiscard]] uint64_t power_of_two(int exponent) const {
    return exponent >= 0 ? power(2, static_cast<uint64_t>(exponent))
                         : inverse(power(2, static_cast<uint64_t>(-exponent)));
  }
  [[nodiscard]] uint64_t residue(int64_t v) const {
    const uint64_t r = reduce(v < 0 ? 0 - static_cast<uint64_t>(v) : static_cast<uint64_t>(v));
    return v < 0 ? subtract(0, r) : r;
  }
  template <int N>
  [[nodiscard]] uint64_t residue(const Int<N>& v) const {
    const Int<N> m = v.magnitude();
    uint64_t r = 0;
    for (int i = N - 1; i >= 0; --i) {
      r = reduce(static_cast<UInt128>(r) << 64 | m.limb[i]);
    }
    return v.negative() ? subtract(0, r) : r;
  }

 private:
  /// REQUIRES: v < 2^125. 2^61 is k: what lies above is put back below, k times.
  [[nodiscard]] uint64_t reduce(UInt128 v) const {
    constexpr uint64_t kMask = (uint64_t{1} << 61) - 1;
    const UInt128 once = (v >> 61) * k_ + (static_cast<uint64_t>(v) & kMask);  // < 2^74
    const uint64_t twice =
        static_cast<uint64_t>(once >> 61) * k_ + (static_cast<uint64_t>(once) & kMask);
    return twice >= prime_ ? twice - prime_ : twice;
  }

  uint64_t prime_, k_;
};

}  // namespace csgrun
