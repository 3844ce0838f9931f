// Points within edges, where an edge of its own is needed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/merge_faces.h"

namespace csgrun {

/// Puts a new point, near the middle, into each of the given edges (points, the lower first) of all
/// faces that have it. The point lies where an axis-parallel plane at a coordinate with few binary
/// places meets the edge, so it is exact like all others; an edge that is shorter than 2^-20 steps
/// stays. False when nothing was divided.
bool divide_edges(std::vector<MergedFace>& faces, CellGeometry& geometry, PlaneTable& planes,
                  std::span<const std::array<uint32_t, 2>> edges);

}  // namespace csgrun
