// The faces of a tool that a result in pieces comes near. Of a ball that is sunk into a plate these
// are the ones around its rim there; all others are only asked for their fate (bsp/patch_fates).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/operand.h"
#include "engine/bsp/polygon_box.h"

namespace csgrun {

/// The faces of a leaf that reach a cell of a small grid which one of some boxes reaches too;
/// ascending. No other face meets what is in the boxes, and nothing there is at a vertex of another
/// one. `vertices`: where they are, correctly rounded; `around`: the box of all, rounded outwards
/// if these are not whole numbers. O(faces + boxes).
std::vector<uint32_t> faces_near(const LeafGeometry& leaf,
                                 std::span<const std::array<double, 3>> vertices, bool are_whole,
                                 const PolygonBox& around, std::span<const PolygonBox> boxes);

}  // namespace csgrun
