// The leading bits of exact integers, for measures.
#pragma once

#include <bit>
#include <cstdint>

#include "engine/base/double_double.h"
#include "engine/exact/fixed_int.h"

namespace csgrun {

/// value * 2^(64 limbs) to 106 leading bits; what lies below 2^-1000 is dropped. REQUIRES: less
/// than 2^1000.
template <int N>
DoubleDouble double_double(const Int<N>& value, int limbs = 0) {
  const Int<N> m = value.magnitude();
  int top = N - 1;
  while (top > 0 && m.limb[top] == 0) --top;
  // Three limbs hold at least 129 significant bits; halves of limbs are exact in a double.
  DoubleDouble r;
  for (int i = top; i >= 0 && i > top - 3; --i) {
    const int exponent = 1023 + 64 * (i + limbs);
    if (exponent < 1) break;
    const double unit = std::bit_cast<double>(static_cast<uint64_t>(exponent) << 52);
    const double high = static_cast<double>(m.limb[i] >> 32) * 0x1p32 * unit;
    const double low = static_cast<double>(m.limb[i] & 0xffffffff) * unit;
    r = r + DoubleDouble::sum(high, low);
  }
  return value.negative() ? DoubleDouble{-r.hi, -r.lo} : r;
}

}  // namespace csgrun
