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

  /// The number in the geometry. The supports of both polygons must have been made.
  uint32_t point(uint32_t polygon, uint32_t edge, uint32_t through) {
    const JobPolygon& p = job_.polygons()[polygon];
    const auto corners = job_.corners(p);
    const uint32_t a = corners[edge], b = corners[edge + 1 < p.count ? edge + 1 : 0];
    const Name name{std::min(a, b), std::max(a, b), through};
    size_t s = hash(name) & (slots_.size() - 1);
    for (; slots_[s].point != kNone; s = (s + 1) & (slots_.size() - 1)) {
      if (slots_[s].name == name) return slots_[s].point;
    }
    const uint32_t x =
        index_.unique(geometry_.add_point({p.support.index(), job_.edge_plane(polygon, edge),
                                           job_.polygons()[through].support.index()}));
    slots_[s] = {name, x};
    if (++count_ * 2 > slots_.size()) grow();
    return x;
  }

 private:
  struct Name {
    uint32_t low = 0, high = 0, through = 0;
    bool operator==(const Name&) const = default;
  };
  struct Slot {
    Name name;
    uint32_t point = kNone;
  };

  static size_t hash(const Name& n) {
    uint64_t h = (static_cast<uint64_t>(n.low) << 32 | n.high) * 0x9fb21c651e98df25ull;
    h = (h ^ (h >> 32) ^ n.through) * 0x9fb21c651e98df25ull;
    return static_cast<size_t>(h ^ (h >> 32));
  }
  void grow() {
    std::vector<Slot> old(slots_.size() * 2);
    std::swap(old, slots_);
    for (const Slot& slot : old) {
      if (slot.point == kNone) continue;
      size_t s = hash(slot.name) & (slots_.size() - 1);
      while (slots_[s].point != kNone) s = (s + 1) & (slots_.size() - 1);
      slots_[s] = slot;
    }
  }

  Job& job_;
  CellGeometry& geometry_;
  PointIndex& index_;
  std::vector<Slot> slots_;
  size_t count_ = 0;
};

}  // namespace csgrun
