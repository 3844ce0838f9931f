// Does a polygon stand between two corners of a cell? Exact, and never degenerate: corners are
// moved by (e, e^2, e^3) with an infinitely small e > 0 (simulation of simplicity).
#pragma once

#include <array>

#include "engine/bsp/job.h"
#include "engine/exact/predicates.h"

namespace csgrun {

/// Sign of a plane at the moved corner (lo + 1/p): never 0.
int side_of_corner(const Plane& plane, const IVec3& corner, int64_t prime);

/// Whether the line parallel to `axis` through the moved corner passes through the polygon (its
/// planes must have been made). False for a polygon parallel to the axis.
bool line_hits(const Job& job, const JobPolygon& polygon, const IVec3& corner, int axis);

/// Whether the segment from the moved corner along `axis` to the coordinate `to` (+ 1/p) crosses
/// the polygon; makes its planes if its box allows it.
bool segment_crosses(Job& job, uint32_t polygon, const IVec3& corner, int axis, int64_t to);

/// By how much a surface's winding number changes along the same segment where it crosses the
/// polygon: +1 from the polygon's front to its back, -1 the other way, 0 where it does not cross.
int winding_step(Job& job, uint32_t polygon, const IVec3& corner, int axis, int64_t to);

/// Whether the ray from the moved corner to minus infinity along x crosses the polygon.
bool ray_crosses(Job& job, uint32_t polygon, const IVec3& corner);

}  // namespace csgrun
