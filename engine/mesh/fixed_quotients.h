// Quotients by one denominator in fixed point, cut: coordinates of a point.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/exact/point.h"
#include "engine/mesh/natural.h"

namespace csgrun {

constexpr int kCoordinateBits = 42;  ///< of a difference of two points, before the binary point

/// x / w for one w > 0, in units of 2^(-64 K).
template <int K>
class FixedQuotients {
 public:
  explicit FixedQuotients(const Int<kPointLimbs>& w)
      : limbs_((w.bit_width() + 63) / 64),
        lift_(std::countl_zero(w.limb[static_cast<size_t>(limbs_ - 1)])),
        divisor_(lifted<kPointLimbs>(w)) {}

  /// Whether |x / w| < 2^(kCoordinateBits - 1), and then floor(x * 2^(64 K) / w); `cut` is set when
  /// that was not whole.
  bool divide(const Int<kPointLimbs>& x, Int<K + 1>& result, bool& cut) const {
    const Int<kPointLimbs> m = x.magnitude();
    bool whole = true;
    if (!divide_magnitude(m, result, whole)) return false;
    if (x.negative()) result = whole ? -result : -result - Int<K + 1>(1);
    cut = cut || !whole;
    return true;
  }

 private:
  static constexpr uint64_t kLimit = uint64_t{1} << (kCoordinateBits - 1);

  bool divide_magnitude(const Int<kPointLimbs>& m, Int<K + 1>& result, bool& whole) const {
    if constexpr (K == 1) {
      // Nearly all points are that narrow, and loops of a known length are short.
      if (limbs_ == 1) return divide_narrow<1>(m, result, whole);
      if (limbs_ == 2) return divide_narrow<2>(m, result, whole);
      if (limbs_ == 3) return divide_narrow<3>(m, result, whole);
    }
    return divide_wide(m, result, whole);
  }

  /// m * 2^lift.
  template <int N>
  [[nodiscard]] Int<N> lifted(const Int<N>& m) const {
    Int<N> r;
    for (int i = N - 1; i > 0; --i) {
      r.limb[i] = m.limb[i] << lift_ | (m.limb[i - 1] >> 1) >> (63 - lift_);
    }
    r.limb[0] = m.limb[0] << lift_;
    return r;
  }

  /// That over a w of N limbs.
  template <int N>
  bool divide_narrow(const Int<kPointLimbs>& m, Int<2>& result, bool& whole) const {
    uint64_t beyond = (m.limb[N] >> 1) >> (63 - lift_);
    for (int i = N + 1; i < kPointLimbs; ++i) beyond |= m.limb[i];
    Int<N + 1> rest = lifted(Int<N + 1>::from(m));
    if (beyond != 0 || rest.limb[N] >= kLimit) return false;
    result.limb[1] = take_digit(rest);
    if (result.limb[1] >= kLimit) return false;
    for (int i = N; i > 0; --i) rest.limb[i] = rest.limb[i - 1];
    rest.limb[0] = 0;
    result.limb[0] = take_digit(rest);
    whole = rest.is_zero();
    return true;
  }

  /// The quotient of `rest` by the divisor of N limbs, if one limb holds it; `rest` becomes what is
  /// left. Knuth, The Art of Computer Programming 2, algorithm D, in base 2^64.
  template <int M>
  uint64_t take_digit(Int<M>& rest) const {
    constexpr int N = M - 1;
    const auto& w = divisor_.limb;
    const uint64_t top = w[N - 1];
    // By the divisor's first limb a digit is too large by two at most; the second says by how much.
    const UInt128 head = static_cast<UInt128>(rest.limb[N]) << 64 | rest.limb[N - 1];
    uint64_t digit = ~uint64_t{0};
    if (rest.limb[N] < top) digit = static_cast<uint64_t>(head / top);
    if constexpr (N > 1) {
      UInt128 left = head - static_cast<UInt128>(digit) * top;
      while ((left >> 64) == 0 &&
             static_cast<UInt128>(digit) * w[N - 2] > (left << 64 | rest.limb[N - 2])) {
        --digit;
        left += top;
      }
    }
    Int<M> product;
    uint64_t carry = 0;
    for (int i = 0; i < N; ++i) {
      const UInt128 t = static_cast<UInt128>(digit) * w[i] + carry;
      product.limb[i] = static_cast<uint64_t>(t);
      carry = static_cast<uint64_t>(t >> 64);
    }
    product.limb[N] = carry;
    rest -= product;
    if (!rest.negative()) return digit;
    rest += Int<M>::from(divisor_);  // the digit was one too large
    return digit - 1;
  }

  bool divide_wide(const Int<kPointLimbs>& m, Int<K + 1>& result, bool& whole) const {
    const auto n = static_cast<size_t>(limbs_);
    // The dividend in units of 2^(-64 K): its quotient has K + 1 limbs if it is in range.
    std::array<uint64_t, kPointLimbs + K + 2> dividend{};
    const auto lifted_m = lifted(Int<kPointLimbs + 1>::from(m));
    std::copy(lifted_m.limb.begin(), lifted_m.limb.end(), dividend.begin() + K);
    const auto rest = std::span(dividend.data(), n + K + 1);
    const auto is_zero = [](uint64_t limb) { return limb == 0; };
    if (rest.back() >= kLimit ||
        !std::all_of(dividend.begin() + rest.size(), dividend.end(), is_zero)) {
      return false;
    }
    divide_normalised(rest, std::span(divisor_.limb.data(), n), result.limb);
    whole = std::all_of(rest.begin(), rest.end(), is_zero);
    return result.limb[K] < kLimit;
  }

  int limbs_, lift_;
  Int<kPointLimbs> divisor_;  ///< w * 2^lift: the first bit of its limbs is set
};

}  // namespace csgrun
