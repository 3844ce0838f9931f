// The faces of a tool that a result in pieces comes near. Of a ball that is sunk into a plate these
// are the ones around its rim there; all others are only asked for their fate (bsp/patch_fates).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/operand.h"
#include "engine/bsp/polygon_box.h"

namespace csgrun {

/// The faces of a leaf on the grid, moved by whole steps, that reach a cell of a small grid which
/// one of some boxes reaches too; ascending. No other face meets what is in the boxes, and nothing
/// there is at a vertex of another one. `around`: the leaf's own box. O(faces + boxes).
std::vector<uint32_t> faces_near(const LeafGeometry& leaf, const IVec3& translation,
                                 const PolygonBox& around, std::span<const PolygonBox> boxes);

}  // namespace csgrun
