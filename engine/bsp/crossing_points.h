// Points in which an edge of one operand passes through a polygon of another one, by name: the
// edge's vertices, whichever face it is seen from, and the polygon. Names that mean one point get
// one number.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/bsp/point_index.h"

namespace csgrun {

class CrossingPoints {
 public:
  CrossingPoints(Job& job, CellGeometry& geometry, PointIndex& index)
      : job_(job), geometry_(geometry), index_(index), slots_(1024) {}

  /// Fetches what number() will look at, soon.
  void expect(uint32_t polygon, uint32_t edge, uint32_t through) const {
    __builtin_prefetch(&slots_[hash(name_of(polygon, edge, through)) & (slots_.size() - 1)]);
  }
  /// The number of a crossing, from 0 on.
  uint32_t number(uint32_t polygon, uint32_t edge, uint32_t through) {
    const Name name = name_of(polygon, edge, through);
    const uint32_t own = hash(name);
    size_t s = own & (slots_.size() - 1);
    for (; slots_[s].crossing != kNone; s = (s + 1) & (slots_.size() - 1)) {
      if (slots_[s].hash == own && crossings_[slots_[s].crossing].name == name) {
        return slots_[s].crossing;
      }
    }
    const auto number = static_cast<uint32_t>(crossings_.size());
    slots_[s] = {own, number};
    crossings_.push_back({name, {polygon, edge}});
    if (crossings_.size() * 2 > slots_.size()) grow();
    return number;
  }

  /// Makes the points of all crossings that have none, on several threads.
  void make_points();

  /// The number in the geometry of a crossing's point, which must have been made.
  [[nodiscard]] uint32_t point(uint32_t crossing) const { return points_[crossing]; }

 private:
  struct Name {
    uint32_t low = 0, high = 0, through = 0;
    bool operator==(const Name&) const = default;
  };
  struct Slot {
    uint32_t hash = 0, crossing = kNone;
  };
  struct Crossing {
    Name name;
    PolygonEdge edge;
  };
  [[nodiscard]] Name name_of(uint32_t polygon, uint32_t edge, uint32_t through) const {
    const JobPolygon& p = job_.polygons()[polygon];
    const auto corners = job_.corners(p);
    const uint32_t a = corners[edge], b = corners[edge + 1 < p.count ? edge + 1 : 0];
    return {std::min(a, b), std::max(a, b), through};
  }
  static uint32_t hash(const Name& n) {
    uint64_t h = (static_cast<uint64_t>(n.low) << 32 | n.high) * 0x9fb21c651e98df25ull;
    h = (h ^ (h >> 32) ^ n.through) * 0x9fb21c651e98df25ull;
    return static_cast<uint32_t>(h ^ (h >> 32));
  }
  void grow() {
    std::vector<Slot> old(slots_.size() * 2);
    std::swap(old, slots_);
    for (const Slot& slot : old) {
      if (slot.crossing == kNone) continue;
      size_t s = slot.hash & (slots_.size() - 1);
      while (slots_[s].crossing != kNone) s = (s + 1) & (slots_.size() - 1);
      slots_[s] = slot;
    }
  }

  Job& job_;
  CellGeometry& geometry_;
  PointIndex& index_;
  std::vector<Slot> slots_;
  std::vector<Crossing> crossings_;
  std::vector<uint32_t> points_;  ///< of the crossings, as far as they were made
};

}  // namespace csgrun
