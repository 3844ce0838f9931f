// Planes: exact integer coefficients, interned, so that coplanarity is equality of ids.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/raw_vector.h"
#include "engine/exact/fixed_int.h"
#include "engine/exact/widths.h"

namespace csgrun {

/// The plane a x + b y + c z + d = 0 over grid coordinates. Its positive side is where the value is
/// positive: the normal points there.
struct Plane {
  Int128 a = 0, b = 0, c = 0, d = 0;

  bool operator==(const Plane&) const = default;
  [[nodiscard]] Plane reversed() const { return {-a, -b, -c, -d}; }
};

static_assert(widths::limbs(widths::kMaxNormal) <= 2 && widths::limbs(widths::kMaxOffset) <= 2,
              "plane coefficients must fit 128 bits");

// Signs are as good as random: nothing here branches on them.
inline UInt128 magnitude(Int128 v) {
  const auto sign = static_cast<UInt128>(v >> 127);
  return (static_cast<UInt128>(v) ^ sign) - sign;
}
inline int width_of_magnitude(UInt128 v) {
  const auto high = static_cast<uint64_t>(v >> 64);
  const uint64_t word = high != 0 ? high : static_cast<uint64_t>(v);
  return (high != 0 ? 128 : 64) - std::countl_zero(word | 1) - static_cast<int>(word == 0);
}
/// Number of bits of the magnitude, and of the largest one of three.
inline int bit_width(Int128 v) { return width_of_magnitude(magnitude(v)); }
inline int bit_width(Int128 a, Int128 b, Int128 c) {
  return width_of_magnitude(magnitude(a) | magnitude(b) | magnitude(c));
}

/// The nearest double. Nearly all coefficients fit 64 bits, which convert at once.
inline double to_double(Int128 v) {
  const auto low = static_cast<int64_t>(v);
  return low == v ? static_cast<double>(low) : static_cast<double>(v);
}

/// A plane's number in its table, with a bit that says on which side the normal points: flip() is
/// the same plane seen from behind.
class PlaneId {
 public:
  PlaneId() = default;
  PlaneId(uint32_t index, bool flipped) : value_(index << 1 | (flipped ? 1u : 0u)) {}

  [[nodiscard]] uint32_t index() const { return value_ >> 1; }
  [[nodiscard]] bool flipped() const { return value_ & 1; }
  [[nodiscard]] PlaneId flip() const { return from_value(value_ ^ 1); }
  [[nodiscard]] uint32_t value() const { return value_; }
  static PlaneId from_value(uint32_t v) {
    PlaneId r;
    r.value_ = v;
    return r;
  }
  [[nodiscard]] bool valid() const { return value_ != ~0u; }
  bool operator==(const PlaneId&) const = default;
  auto operator<=>(const PlaneId&) const = default;

 private:
  uint32_t value_ = ~0u;
};

/// A plane as a table stores it, with its hash: what takes time of entering it, and may be done on
/// any thread.
struct ReducedPlane {
  Plane plane;
  uint32_t hash;
  bool flipped;  ///< `plane` is the reverse
};
/// REQUIRES: the normal is not zero, widths as in widths.h.
ReducedPlane reduce(const Plane& plane);
/// The same, for a plane as a table stores it.
ReducedPlane as_stored(const Plane& plane);

/// All planes of one evaluation. Each is stored once: reduced by the greatest common divisor of its
/// four coefficients, with the first non-zero normal component positive.
class PlaneTable {
 public:
  /// The id of a plane; its flipped() bit is set when the stored orientation is the reverse.
  /// REQUIRES: the normal is not zero, widths as in widths.h.
  PlaneId intern(const Plane& plane);
  /// The same, for what was computed before.
  PlaneId intern_computed(const ReducedPlane& plane);
  /// Makes room for so many more planes at once; without it the table grows by doubling.
  void make_room(size_t more);
  /// Fetches what it will look at, soon.
  void expect(const ReducedPlane& plane) const {
    if (!slots_.empty()) __builtin_prefetch(&slots_[plane.hash & (slots_.size() - 1)]);
  }
  /// Takes over the planes of another table, as they stand there, under their numbers. REQUIRES:
  /// the table is empty; each plane is there once.
  void adopt(std::span<const Plane> planes);

  [[nodiscard]] const Plane& plane(uint32_t index) const { return planes_[index]; }
  /// The plane with the orientation of the id.
  [[nodiscard]] Plane oriented(PlaneId id) const {
    return id.flipped() ? planes_[id.index()].reversed() : planes_[id.index()];
  }
  /// Coefficients rounded to double (relative error 2^-52), for filters.
  [[nodiscard]] const std::array<double, 4>& approximate(uint32_t index) const {
    return approximate_[index];
  }
  [[nodiscard]] int normal_bits(uint32_t index) const { return bits_[index][0]; }
  [[nodiscard]] int offset_bits(uint32_t index) const { return bits_[index][1]; }
  [[nodiscard]] size_t size() const { return planes_.size(); }

 private:
  struct Slot {
    uint32_t hash = 0;
    uint32_t plane = 0;  ///< index + 1, or 0
  };

  void add(const Plane& plane);
  void reserve(size_t count);
  void make_slots(size_t count);
  void enter_all(size_t slots);
  void enter(uint32_t hash, uint32_t index);

  std::vector<Plane> planes_;
  std::vector<std::array<double, 4>> approximate_;
  std::vector<std::array<uint8_t, 2>> bits_;
  RawVector<Slot> slots_;  ///< open addressing
  size_t entered_ = 0;     ///< so many planes have slots: none of those taken over until asked for
};

}  // namespace csgrun
