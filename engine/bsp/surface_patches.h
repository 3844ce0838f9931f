// A surface taken apart: patches, which cross nothing and have one volume on each side, and
// classes, the groups of parts that hang together.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/job.h"

namespace csgrun {

struct SurfacePatches {
  /// Per polygon: its patch, or kNone for a polygon that crosses another.
  std::vector<uint32_t> patch_of;
  uint32_t patch_count = 0;
  /// Per patch: a vertex of one of its polygons, if possible of one that touches a polygon that
  /// crosses.
  std::vector<uint32_t> witness;
  /// Per class: vertices in which several patches meet.
  std::vector<std::vector<uint32_t>> junctions;
  /// Per polygon: its class. Polygons of one class hang together by common vertices or by crossings
  /// (the equivalence classes of Campen & Kobbelt 2010, section 6.2). Numbered by first polygons.
  std::vector<uint32_t> class_of;
  uint32_t class_count = 0;
};

/// Takes the only operand of a job apart. `crossings` are pairs of faces of a leaf; `crosses` says
/// for each polygon whether it is in one of them. Neighbours belong to one patch if they meet in a
/// whole edge that no third polygon touches; where that is not obvious a patch may be found in
/// several pieces. Makes the planes of no polygon. O(n log n).
SurfacePatches find_patches(const Job& job, std::span<const std::array<uint32_t, 2>> crossings,
                            std::span<const uint8_t> crosses);

}  // namespace csgrun
