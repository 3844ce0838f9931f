// Points in which an edge of one operand passes through a polygon of another one, by name: the
// edge's vertices, whichever face it is seen from, and the polygon. Names that mean one point get
// one number.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "engine/bsp/point_index.h"

namespace csgrun {

class CrossingPoints {
 public:
  /// An edge of a polygon, and the polygon that it passes through.
  struct Place {
    uint32_t polygon, edge, through;
  };

  CrossingPoints(Job& job, CellGeometry& geometry, PointIndex& index)
      : job_(job), geometry_(geometry), index_(index), slots_(kFewSlots) {}

  /// For about so many more than there are. O(all), which is not to be asked for each of them.
  void make_room(size_t more) {
    const size_t all = crossings_.size() + more;
    crossings_.reserve(all);
    if (2 * all > slots_.size()) grow(std::bit_ceil(2 * all));
  }

  /// Fetches what number() will look at, soon.
  void expect(const Place& place) const {
    __builtin_prefetch(&slots_[hash(name_of(place)) & (slots_.size() - 1)]);
  }
  /// The number of a crossing, from 0 on.
  uint32_t number(const Place& place) {
    const Name name = name_of(place);
    Slot& slot = slots_[slot_of(name)];
    if (slot.crossing != kNone) return slot.crossing;
    const auto number = static_cast<uint32_t>(crossings_.size());
    slot = {name, number};
    crossings_.push_back(place);
    if (crossings_.size() * 2 > slots_.size()) grow(slots_.size() * 2);
    return number;
  }

  /// Makes the points of all crossings that have none, on several threads.
  void make_points();

  /// The number in the geometry of a crossing's point, which must have been made.
  [[nodiscard]] uint32_t point(uint32_t crossing) const { return points_[crossing]; }

 private:
  static constexpr size_t kFewSlots = 64;  // a power of two

  struct Name {
    uint32_t low = 0, high = 0, through = 0;
    bool operator==(const Name&) const = default;
  };
  /// With the name itself: what is looked for is seen without a look elsewhere.
  struct alignas(16) Slot {
    Name name;
    uint32_t crossing = kNone;
  };

  [[nodiscard]] Name name_of(const Place& place) const {
    const JobPolygon& p = job_.polygons()[place.polygon];
    const auto corners = job_.corners(p);
    const uint32_t a = corners[place.edge];
    const uint32_t b = corners[place.edge + 1 < p.count ? place.edge + 1 : 0];
    return {std::min(a, b), std::max(a, b), place.through};
  }
  static uint32_t hash(const Name& n) {
    uint64_t h = (static_cast<uint64_t>(n.low) << 32 | n.high) * 0x9fb21c651e98df25ull;
    h = (h ^ (h >> 32) ^ n.through) * 0x9fb21c651e98df25ull;
    return static_cast<uint32_t>(h ^ (h >> 32));
  }
  /// The slot of a name, or an empty one: half of them are.
  [[nodiscard]] size_t slot_of(const Name& name) const {
    size_t s = hash(name) & (slots_.size() - 1);
    while (slots_[s].crossing != kNone && slots_[s].name != name) s = (s + 1) & (slots_.size() - 1);
    return s;
  }
  void grow(size_t slot_count) {
    std::vector<Slot> old(slot_count);
    std::swap(old, slots_);
    for (const Slot& slot : old) {
      if (slot.crossing != kNone) slots_[slot_of(slot.name)] = slot;
    }
  }

  Job& job_;
  CellGeometry& geometry_;
  PointIndex& index_;
  std::vector<Slot> slots_;
  std::vector<Place> crossings_;
  std::vector<uint32_t> points_;  ///< of the crossings, as far as they were made
};

}  // namespace csgrun
