// Convex hulls of grid points, exact.
#pragma once

#include <span>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// The boundary of the convex hull: faces are whole (no two lie in one plane) and have no straight
/// corners, vertices are the extreme points, opposite edges are known. The same for any order and
/// repetition of the points. No faces when the points lie in one plane.
///
/// Points are added one at a time, the farthest in front of a face first (Barber, Dobkin &
/// Huhdanpaa 1996, "The quickhull algorithm for convex hulls"). A face sees a point only where that
/// is strictly in front of its plane, which is decided exactly; so what is coplanar needs no care:
/// new triangles are never degenerate, and those of one plane always stay or go together.
///
/// REQUIRES: |coordinate| <= 2^40. O(n log n) expected.
LeafGeometry convex_hull(std::span<const IVec3> points);

}  // namespace csgrun
