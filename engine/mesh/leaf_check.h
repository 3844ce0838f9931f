// Checks of quantised leaves: where the surface crosses itself, and whether it bounds a solid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// All pairs (f, g), f < g, of faces that meet other than in edges and vertices that both have, in
/// order. Touching counts: duplicates of faces and coplanar faces that overlap, also when folded
/// over a common edge; an edge that pierces a face or rests on it; a vertex of one face inside
/// another.
///
/// REQUIRES: planar convex faces over distinct vertices. Exact: a tree of boxes finds the pairs
/// that may meet, double filters and then exact signs decide (Campen & Kobbelt 2010, section 6.2).
/// O(n log n) and the pairs whose boxes meet, on as many threads as the calling arena has, with the
/// same result for any number.
std::vector<std::array<uint32_t, 2>> find_self_intersections(const LeafGeometry& leaf);

struct SurfaceCheck {
  std::vector<std::array<uint32_t, 2>> crossings;  ///< as find_self_intersections has them
  /// Without crossings: whether the winding number is 1 behind each face and 0 in front. Not so for
  /// shells in shells that face the same way, nor for inverted ones.
  bool bounds_solid = false;
  /// Without crossings: all faces are connected by edges of two faces each.
  bool connected = false;
  /// Without crossings: the faces at each vertex are one fan. False where LeafGeometry::opposite
  /// is empty.
  bool has_single_fans = false;
};

/// Examines a surface exactly; one ray for each connected part finds its winding number. REQUIRES:
/// as above, and directed edges balanced. Faster where the leaf knows its opposite edges.
SurfaceCheck check_surface(const LeafGeometry& leaf);

/// A point near the place where two faces of a leaf meet, in grid steps: for messages.
std::array<double, 3> intersection_place(const LeafGeometry& leaf, uint32_t f, uint32_t g);

}  // namespace csgrun
