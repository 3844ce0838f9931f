// Localisation for one surface that crosses itself: an octree refined, in binary steps, to where
// something has to be found out (Campen & Kobbelt 2010, sections 4.1 and 6.2).
//
// Cells that hold neither a polygon that crosses another nor a witness are left as they are. The
// rest is divided down to m polygons. The winding number at each cell's lowest corner, moved by (e,
// e^2, e^3) for an infinitely small e, is traced from cell to cell as in octree.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/cell_box.h"
#include "engine/bsp/job.h"
#include "engine/bsp/operand.h"

namespace csgrun {

/// A cell that is solved: it holds polygons that cross others, or a witness.
struct SurfaceCell {
  CellBox box;
  int32_t corner_winding;
  uint32_t first_polygon, count;  ///< into SurfaceOctree::polygons
};

struct SurfaceOctree {
  std::vector<SurfaceCell> cells;
  std::vector<uint32_t> polygons;
  uint64_t visited = 0;  ///< cells, inner ones too
};

/// Builds the octree of the job's polygons `polygons`. `crosses` says for each polygon of the job
/// whether it crosses another and all of its cells are to be solved; `witnesses` are vertices of
/// the job: the cell of each is solved. O((n + k) log) for n polygons, k of them in solved cells.
SurfaceOctree build_surface_octree(Job& job, std::span<const uint32_t> polygons,
                                   std::span<const uint8_t> crosses,
                                   std::span<const uint32_t> witnesses,
                                   const KernelOptions& options);

}  // namespace csgrun
