// Regions with holes as regions without: cut open along slits.
#pragma once

#include <optional>
#include <vector>

#include "primitives/shape2d/grid2d.h"

namespace csgrun {

/// The loops of one region, the outer one first, as one loop that runs to each hole along a segment
/// between two corners, around it, and back. The slits lie inside of the region and cross nothing.
/// Nothing if some hole sees no corner, which it does in every region whose loops meet in common
/// corners only. O(h n log n) for h holes when the nearest corners are seen, O(h n^2) at worst.
std::optional<GridLoop> cut_open(const std::vector<GridLoop>& loops);

}  // namespace csgrun
