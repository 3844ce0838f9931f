// A hash of grid points.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/bsp/operand.h"

namespace csgrun {

struct PointHash {
  size_t operator()(const IVec3& p) const {
    uint64_t h = 0;
    for (const int64_t c : p) {
      h = (h ^ static_cast<uint64_t>(c)) * 0xff51afd7ed558ccdULL;
      h ^= h >> 32;
    }
    return static_cast<size_t>(h);
  }
};

}  // namespace csgrun
