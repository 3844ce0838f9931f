// The walls of a cell as planes, and what a cell holds of a polygon.
#pragma once

#include <array>
#include <cstdint>

#include "engine/bsp/cell_box.h"
#include "engine/bsp/cell_geometry.h"

namespace csgrun {

/// Plane indices: lower and upper wall along x, then y, then z.
using CellWalls = std::array<uint32_t, 6>;

/// Makes the walls of a cell known. Not thread-safe; called before cells are solved.
CellWalls walls_of(Job& job, const CellBox& box);

/// Clips a fragment to the cell; false when nothing is left.
bool clip_to_cell(CellGeometry& geometry, const Job& job, const CellBox& box,
                  const CellWalls& walls, Fragment& f);

}  // namespace csgrun
