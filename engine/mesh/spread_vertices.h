// Vertices around which nothing can cross.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// A vertex is *spread* when there is a direction in which all its faces face, and its faces, seen
/// from there, surround it once. They then lie in sectors that do not overlap: a map that is one to
/// one on each of them takes no two points to one unless they lie on the ray that two neighbouring
/// sectors have. So two triangles of a spread vertex have nothing in common but corners and edges
/// of both. (Other faces may go on along the ray.)
///
/// A byte for each vertex, 1 if it was seen to be spread; fourteen directions are tried, and
/// corners of 180 degrees given up. REQUIRES: planar convex faces, none degenerate; every directed
/// edge as often as its reverse; coordinates less than 2^30 apart. O(n).
std::vector<uint8_t> find_spread_vertices(const LeafGeometry& leaf);

/// The same, looking at some faces only. REQUIRES: vertices that have others too are spread; they
/// may be told to be or not.
std::vector<uint8_t> find_spread_vertices(const LeafGeometry& leaf,
                                          std::span<const uint32_t> faces);

}  // namespace csgrun
