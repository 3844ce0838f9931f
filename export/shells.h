// Surfaces that rounding turned inside out, or that came to the wrong side of others.
//
// The triangles of a mesh that crosses itself nowhere fall into sheets: neighbours over edges which
// only two triangles have, by coordinates. In front of a sheet the winding number of the mesh is
// the same all over, and one more behind it. So a mesh is the boundary of a solid, with winding
// numbers 0 outside and 1 inside, if and only if it is 0 in front of each sheet. It is not where a
// thin body was turned inside out (then it is -1 there), or where a void popped out through a wall,
// or a body got into another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <csgrun/engine/exact_triangles.h>

namespace csgrun {

/// One triangle of each sheet with a winding number other than 0 in front, ascending. Exact, by one
/// ray for each sheet. REQUIRES: closed, without crossings; points of equal coordinates have one
/// number. O(n log n), and the rays.
std::vector<uint32_t> inverted_sheets(const TriangleView& mesh);

}  // namespace csgrun
