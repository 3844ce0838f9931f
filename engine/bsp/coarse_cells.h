// The first step of finding pairs: a grid over all polygons, of which only the cells count that
// polygons of several operands share.
#pragma once

#include "engine/bsp/coarse_grid.h"
#include "engine/bsp/pair_cells.h"

namespace csgrun {

/// Cells with polygons of at least two operands, not all of which are in `covered` (per polygon;
/// empty: none is), by their boxes, which hold the lower corners of all overlaps of boxes of
/// different operands. Those in `left_out` are in no cell. Where polygons are few, or large, it is
/// one cell with all of them, whatever is left out. `surface` counts what is in no such cell, in
/// cells of `limit` polygons. O(n).
PairCells find_coarse_cells(const Job& job, std::span<const uint8_t> covered, uint32_t limit,
                            std::span<const uint8_t> left_out = {});

/// The cells of a grid that several operands have marked, with the polygons that meet them: `cells`
/// are those that each polygon meets. So many more polygons, which are `far`, meet none. The marks
/// are gone after that.
PairCells list_shared_cells(CoarseGrid& grid, std::span<const CoarseGrid::Cells> cells, size_t far,
                            uint32_t limit);
/// The same where no cell is shared.
PairCells no_shared_cells(size_t polygons, uint32_t limit);

}  // namespace csgrun
