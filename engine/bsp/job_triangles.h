// The triangles of a job, as slabs want them.
#pragma once

#include <cstdint>
#include <span>

#include "engine/bsp/job.h"
#include "engine/bsp/slabs.h"

namespace csgrun {

/// The corners of eight polygons, as far as they are triangles.
struct JobTriangles {
  EightTriangles corners;
  uint32_t which = 0;  ///< a bit for each that is one

  /// REQUIRES: no more than eight.
  JobTriangles(const Job& job, std::span<const uint32_t> polygons);
};

/// The slabs of a polygon that is a triangle; `reach` as for these.
Slabs slabs_of(const Job& job, uint32_t polygon, double reach);

/// No corner of the job's polygons is further out along an axis.
double reach_of(const Job& job);

}  // namespace csgrun
