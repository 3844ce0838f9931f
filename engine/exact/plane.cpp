#include "engine/exact/plane.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/exact/forced_tier.h"

namespace csgrun {
namespace {

/// Stein's way. Which of two is less is as good as random: no branch on it.
uint64_t gcd(uint64_t a, uint64_t b) {
  if (a == 0 || b == 0) return a | b;
  const int shift = std::countr_zero(a | b);
  a >>= std::countr_zero(a);
  do {
    b >>= std::countr_zero(b);
    const uint64_t difference = a - b, is_less = -static_cast<uint64_t>(a < b);
    a = b + (difference & is_less);  // the lesser one
    b = (difference ^ is_less) - is_less;
  } while (b != 0);
  return a << shift;
}

bool is_narrow(UInt128 v) { return (v >> 64) == 0; }

UInt128 gcd(UInt128 a, UInt128 b) {
  // 128-bit remainders only while a number needs them: nearly all coefficients fit 64 bits.
  while (b != 0) {
    if (is_narrow(a) && is_narrow(b)) {
      return gcd(static_cast<uint64_t>(a), static_cast<uint64_t>(b));
    }
    a = std::exchange(b, a % b);
  }
  return a;
}

/// The greatest common divisor of the four coefficients.
UInt128 divisor(const Plane& p) {
  UInt128 g = gcd(magnitude(p.a), magnitude(p.b));
  // It is small by now, mostly.
  if (g != 1) g = gcd(g, g == 0 ? magnitude(p.c) : magnitude(p.c) % g);
  if (g != 1) g = gcd(g, magnitude(p.d) % g);
  return g;
}

constexpr size_t kFewSlots = 64;

uint64_t mix(uint64_t h, Int128 v) {
  h ^= static_cast<uint64_t>(v) + 0x9e3779b97f4a7c15ull + (h << 6) + (h >> 2);
  h *= 0xff51afd7ed558ccdull;
  h ^= static_cast<uint64_t>(v >> 64) + (h >> 29);
  return h * 0xc4ceb9fe1a85ec53ull;
}

uint32_t hash(const Plane& p) {
  const uint64_t h = mix(mix(mix(mix(0, p.a), p.b), p.c), p.d);
  return static_cast<uint32_t>(h ^ (h >> 32));
}

/// For a plane without a common divisor.
ReducedPlane with_hash(const Plane& plane) {
  assert(plane.a != 0 || plane.b != 0 || plane.c != 0);
  const Int128 first = plane.a != 0 ? plane.a : plane.b != 0 ? plane.b : plane.c;
  const Int128 sign = first >> 127;
  const auto turned = [&](Int128 v) { return (v ^ sign) - sign; };
  ReducedPlane reduced{
      {turned(plane.a), turned(plane.b), turned(plane.c), turned(plane.d)}, 0, sign != 0};
  reduced.hash = hash(reduced.plane);
  return reduced;
}

}  // namespace

ReducedPlane reduce(const Plane& plane) {
  const UInt128 g = divisor(plane);
  if (g == 1) return with_hash(plane);
  const auto whole = static_cast<Int128>(g);
  return with_hash({plane.a / whole, plane.b / whole, plane.c / whole, plane.d / whole});
}

ReducedPlane as_stored(const Plane& plane) {
  assert(reduce(plane).plane == plane);
  return {plane, hash(plane), false};
}

void PlaneTable::enter(uint32_t hash, uint32_t index) {
  const size_t mask = slots_.size() - 1;
  size_t s = hash & mask;
  while (slots_[s].plane) s = (s + 1) & mask;
  slots_[s] = {hash, index + 1};
}

/// Gives all planes places among so many slots, a power of two.
void PlaneTable::enter_all(size_t slots) {
  RawVector<Slot> old(slots);
  for_each_range(slots, [&](size_t begin, size_t end) {
    std::fill(old.begin() + static_cast<long>(begin), old.begin() + static_cast<long>(end), Slot{});
  });
  std::swap(old, slots_);
  for (const Slot& slot : old) {
    if (slot.plane) enter(slot.hash, slot.plane - 1);
  }
  for (; entered_ < planes_.size(); ++entered_) {
    enter(hash(planes_[entered_]), static_cast<uint32_t>(entered_));
  }
}

void PlaneTable::add(const Plane& p) {
  const int normal = bit_width(p.a, p.b, p.c);
  const int offset = bit_width(p.d);
  assert(normal <= widths::kMaxNormal && offset <= widths::kMaxOffset);
  planes_.push_back(p);
  approximate_.push_back({to_double(p.a), to_double(p.b), to_double(p.c), to_double(p.d)});
  // A sum with it compares as neither positive nor negative.
  if (forced_tier >= 0) approximate_.back()[3] = std::numeric_limits<double>::quiet_NaN();
  bits_.push_back({static_cast<uint8_t>(normal), static_cast<uint8_t>(offset)});
}

void PlaneTable::adopt(std::span<const Plane> planes) {
  assert(planes_.empty());
  slots_.clear();  // room may have been made; the planes get theirs once one is looked for
  reserve(planes.size());
  for (const Plane& p : planes) add(p);
}

void PlaneTable::reserve(size_t count) {
  planes_.reserve(count);
  approximate_.reserve(count);
  bits_.reserve(count);
}

void PlaneTable::make_slots(size_t count) {
  if (count * 2 >= slots_.size()) enter_all(std::bit_ceil(std::max(kFewSlots, count * 4)));
}

void PlaneTable::make_room(size_t more) {
  if (more == 0) return;
  const size_t count = planes_.size() + more;
  // Twice as much: others come mostly, and little by little it takes linear time.
  if (count > planes_.capacity()) reserve(2 * count);
  if (count * 2 >= slots_.size()) enter_all(std::bit_ceil(std::max(kFewSlots, count * 2 + 1)));
}

PlaneId PlaneTable::intern(const Plane& plane) { return intern_computed(reduce(plane)); }

PlaneId PlaneTable::intern_computed(const ReducedPlane& reduced) {
  make_slots(planes_.size());  // after adopt there are none
  const size_t mask = slots_.size() - 1;
  for (size_t s = reduced.hash & mask; slots_[s].plane; s = (s + 1) & mask) {
    const uint32_t index = slots_[s].plane - 1;
    if (slots_[s].hash == reduced.hash && planes_[index] == reduced.plane) {
      return {index, reduced.flipped};
    }
  }
  const auto index = static_cast<uint32_t>(planes_.size());
  add(reduced.plane);
  ++entered_;
  enter(reduced.hash, index);
  return {index, reduced.flipped};
}

}  // namespace csgrun
