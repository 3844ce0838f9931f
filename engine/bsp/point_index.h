// Equal points get one number. Coordinates are correctly rounded, so equal points have equal
// doubles: a hash of these finds the candidates, exact signs confirm.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/cell_geometry.h"

namespace csgrun {

class PointIndex {
 public:
  explicit PointIndex(CellGeometry& geometry) : geometry_(geometry), slots_(kFewSlots) {}

  /// Forgets all points.
  void clear() {
    slots_.assign(kFewSlots, {});
    known_.clear();
    count_ = 0;
  }

  /// The same, and lets go of their memory.
  void release() {
    slots_ = std::vector<Slot>(kFewSlots);
    known_ = std::vector<uint32_t>();
    count_ = 0;
  }

  /// The first point that equals `p`; `p` itself when it is new. `p` must be in the geometry.
  uint32_t unique(uint32_t p) {
    if (p < known_.size() && known_[p] != kNone) return known_[p];
    if (p >= known_.size()) known_.resize(geometry_.point_count() + kFewSlots, kNone);
    return known_[p] = find_or_add(p);
  }
  /// Asks for many, one after another or, with the same outcome, on several threads.
  void make_unique(std::span<const uint32_t> points);

  /// What unique() said of a point. Several threads may ask.
  [[nodiscard]] uint32_t known(uint32_t p) const { return known_[p]; }
  /// The same, or kNone if it was not asked for the point.
  [[nodiscard]] uint32_t known_or_none(uint32_t p) const {
    return p < known_.size() ? known_[p] : kNone;
  }

 private:
  static constexpr size_t kFewSlots = 64;  // a power of two
  struct Slot {
    uint32_t hash = 0, point = kNone;
  };

  uint32_t find_or_add(uint32_t p) {
    const uint32_t own = hash(p);
    const size_t last = slots_.size() - 1;
    size_t s = own & last;
    for (; slots_[s].point != kNone; s = (s + 1) & last) {
      if (slots_[s].hash == own && equal(geometry_, slots_[s].point, p)) return slots_[s].point;
    }
    slots_[s] = {own, p};
    make_room(++count_);
    return p;
  }
  [[nodiscard]] uint32_t hash(uint32_t p) const { return hash(geometry_.point(p).rounded); }
  static uint32_t hash(const std::array<double, 3>& rounded) {
    uint64_t h = 0;
    for (const double c : rounded) {
      h = (h ^ std::bit_cast<uint64_t>(c + 0.0)) * 0x9fb21c651e98df25ull;  // -0 + 0 = 0
      h ^= h >> 32;
    }
    return static_cast<uint32_t>(h);
  }
  /// `exactly`: the geometry, or a view of it.
  template <class Exactly>
  bool equal(Exactly& exactly, uint32_t p, uint32_t q) const {
    const auto a = geometry_.point(p), b = geometry_.point(q);
    if (a.rounded != b.rounded) return false;
    if (a.vertex != kNone && a.vertex == b.vertex) return true;
    if (a.is_on_grid && b.is_on_grid) return true;
    // p is q when it lies on three planes that meet in q only.
    const auto on_planes = [&](uint32_t point, const std::array<uint32_t, 3>& planes) {
      return std::all_of(planes.begin(), planes.end(),
                         [&](uint32_t plane) { return exactly.side(plane, point) == 0; });
    };
    if (b.planes[0] != kNone) return on_planes(p, b.planes);
    if (a.planes[0] != kNone) return on_planes(q, a.planes);
    return compare(exactly.exact(p), exactly.exact(q)) == 0;
  }
  /// For so many points in all: half of the slots stay empty.
  void make_room(size_t count) {
    if (count * 2 <= slots_.size()) return;
    std::vector<Slot> old(std::bit_ceil(count * 2));
    std::swap(old, slots_);
    for (const Slot& slot : old) {
      if (slot.point == kNone) continue;
      size_t s = slot.hash & (slots_.size() - 1);
      while (slots_[s].point != kNone) s = (s + 1) & (slots_.size() - 1);
      slots_[s] = slot;
    }
  }
  void make_unique_in_shards(std::span<const uint32_t> points);

  CellGeometry& geometry_;
  std::vector<Slot> slots_;
  std::vector<uint32_t> known_;  ///< per point of the geometry that was asked for: its number
  size_t count_ = 0;
};

}  // namespace csgrun
