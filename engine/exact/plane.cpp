#include "engine/exact/plane.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/exact/forced_tier.h"

namespace csgrun {
namespace {

UInt128 magnitude(Int128 v) { return v < 0 ? -static_cast<UInt128>(v) : static_cast<UInt128>(v); }

UInt128 gcd(UInt128 a, UInt128 b) {
  // 128-bit remainders only while a number needs them: nearly all coefficients fit 64 bits.
  while (b != 0) {
    if ((a >> 64) == 0 && (b >> 64) == 0) {
      return std::gcd(static_cast<uint64_t>(a), static_cast<uint64_t>(b));
    }
    a = std::exchange(b, a % b);
  }
  return a;
}

uint64_t mix(uint64_t h, Int128 v) {
  h ^= static_cast<uint64_t>(v) + 0x9e3779b97f4a7c15ull + (h << 6) + (h >> 2);
  h *= 0xff51afd7ed558ccdull;
  h ^= static_cast<uint64_t>(v >> 64) + (h >> 29);
  return h * 0xc4ceb9fe1a85ec53ull;
}

uint64_t hash(const Plane& p) {
  uint64_t h = mix(mix(mix(mix(0, p.a), p.b), p.c), p.d);
  return h ^ (h >> 32);
}

}  // namespace

int bit_width(Int128 v) {
  const UInt128 m = magnitude(v);
  const auto high = static_cast<uint64_t>(m >> 64);
  return high ? 128 - std::countl_zero(high) : 64 - std::countl_zero(static_cast<uint64_t>(m));
}

PlaneTable::PlaneTable() : slots_(64, 0), mask_(63) {}

void PlaneTable::grow() {
  slots_.assign(slots_.size() * 2, 0);
  mask_ = slots_.size() - 1;
  for (uint32_t i = 0; i < planes_.size(); ++i) {
    size_t s = hash(planes_[i]) & mask_;
    while (slots_[s]) s = (s + 1) & mask_;
    slots_[s] = i + 1;
  }
}

PlaneId PlaneTable::intern(const Plane& plane) {
  Plane p = plane;
  const bool flipped = p.a < 0 || (p.a == 0 && (p.b < 0 || (p.b == 0 && p.c < 0)));
  if (flipped) p = p.reversed();
  assert(p.a != 0 || p.b != 0 || p.c != 0);
  UInt128 g = gcd(magnitude(p.a), magnitude(p.b));
  if (g != 1) g = gcd(g, magnitude(p.c));
  if (g != 1) g = gcd(g, magnitude(p.d));
  if (g != 1) {
    const auto divisor = static_cast<Int128>(g);
    p = {p.a / divisor, p.b / divisor, p.c / divisor, p.d / divisor};
  }
  size_t s = hash(p) & mask_;
  for (; slots_[s]; s = (s + 1) & mask_) {
    if (planes_[slots_[s] - 1] == p) return {slots_[s] - 1, flipped};
  }
  const auto index = static_cast<uint32_t>(planes_.size());
  const int normal = std::max({bit_width(p.a), bit_width(p.b), bit_width(p.c)});
  const int offset = bit_width(p.d);
  assert(normal <= widths::kMaxNormal && offset <= widths::kMaxOffset);
  planes_.push_back(p);
  approximate_.push_back({static_cast<double>(p.a), static_cast<double>(p.b),
                          static_cast<double>(p.c), static_cast<double>(p.d)});
  // A sum with it compares as neither positive nor negative.
  if (forced_tier >= 0) approximate_.back()[3] = std::numeric_limits<double>::quiet_NaN();
  bits_.push_back({static_cast<uint8_t>(normal), static_cast<uint8_t>(offset)});
  slots_[s] = index + 1;
  if (planes_.size() * 2 > slots_.size()) grow();
  return {index, flipped};
}

}  // namespace csgrun
