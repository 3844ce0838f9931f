// The closed surfaces that a surface consists of.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// Faces, ascending.
using Shell = std::vector<uint32_t>;

/// The faces of a leaf in shells that are closed each by itself, in the order of their first faces.
/// The winding number of a point is the sum of its winding numbers by the shells.
///
/// Faces hang together by their edges. Where an edge has more than two faces, the first that runs
/// it one way is joined with the first that runs it back, and so on: bodies that follow one another
/// in a file stay apart, also where they have faces, edges or corners in common. Parts of one facet
/// that is kept are in one shell. O(n log n).
std::vector<Shell> closed_shells(const LeafGeometry& leaf);

/// Some of the faces as a leaf: its vertices are those that they use, in their order. The
/// opposite edges are not known, and nothing of what a leaf may know of its surface.
LeafGeometry leaf_of_faces(const LeafGeometry& leaf, std::span<const uint32_t> faces);

}  // namespace csgrun
