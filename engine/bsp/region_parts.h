// Regions of a store of pieces, made convex when an operation comes near. Most never are: what one
// operation cut is seldom near the next.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/convexify.h"
#include "engine/bsp/piece_store.h"

namespace csgrun {

class RegionParts {
 public:
  /// `wall(axis, m)` gives the plane of a wall, see convexify.h.
  RegionParts(PieceStore& store, std::function<uint32_t(int, int64_t)> wall)
      : store_(store), wall_(std::move(wall)), geometry_(store.planes, nullptr) {}

  /// The convex pieces of a region, which the store keeps. They stand in its place: of the same
  /// face, and together as large.
  PieceStore::Parts of(uint32_t region);

 private:
  uint32_t point_of(uint32_t stored);
  void make(uint32_t region);

  PieceStore& store_;
  const std::function<uint32_t(int, int64_t)> wall_;
  CellGeometry geometry_;
  std::vector<uint32_t> stored_;  ///< per point of the geometry
  std::vector<Fragment> fragments_;
};

}  // namespace csgrun
