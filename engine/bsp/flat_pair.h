// What two triangles of one plane have in common, if that is little: nothing, or a corner of both.
// Then neither cuts the other. (Caps that are divided into fans have very many such pairs.)
#pragma once

#include <cstdint>

#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/job.h"

namespace csgrun {

enum class FlatMeeting : uint8_t {
  kApart,   ///< not even a point
  kCorner,  ///< one point, and it is a corner of both
  kOther,   ///< more, or another point, or it was not told
};

struct FlatPair {
  FlatMeeting meeting = FlatMeeting::kOther;
  uint32_t p_corner = kNone, q_corner = kNone;  ///< vertices, if it is a corner
};

/// What two polygons have in common. Exact. REQUIRES: they are triangles of one plane, and their
/// operands' vertices lie on the grid.
FlatPair flat_pair(const Job& job, uint32_t p, uint32_t q);

}  // namespace csgrun
