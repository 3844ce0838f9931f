// Edges and triangles bent to corners that they all but touch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "export/rounding.h"

namespace csgrun {

/// So often are triangles divided that come of divisions: thin ones, all of whose corners are near
/// their edges, would never end it.
constexpr int kGenerations = 4;

/// Where a corner of some of the triangles lies within `tolerance` (mm) of the inside of an edge of
/// one of them, or of the inside of one, that is divided there, by a vertex at the corner's
/// position. Corners no farther than that from the edge's ends, or from a triangle's edges, are
/// left alone, and so are those of the edge's own triangles. Layers that run beside one another get
/// corners in common so: when they are united then, hardly any new points are made, which rounding
/// would bring among them again. The mesh stays a manifold by index; no point of it moves by more
/// than kGenerations times the tolerance. Returns the number of divisions. Deterministic.
/// O(n m) for n triangles and the m corners between their ends along X.
uint64_t divide_at_near_corners(RoundedMesh& mesh, std::span<const uint32_t> triangles,
                                double tolerance);

}  // namespace csgrun
