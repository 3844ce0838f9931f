// Convex pieces of a face that may have holes and many corners, without new planes through
// constructed points: cuts extend edges that are there, or stand in walls of the grid.
//
// A labelled BSP in two dimensions (Thibault & Naylor 1987 in the plane of the face): the cells
// that end up inside are the pieces. Planes through constructed points would make widths grow from
// operation to operation (EMBER, section 3.2); extensions of edges never do.
#pragma once

#include <functional>
#include <vector>

#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/loop_pieces.h"

namespace csgrun {

/// Appends the convex pieces of the region bounded by `edges` in the plane `support` to `pieces`: a
/// convex loop given in order is the only one itself, over the same points.
/// `wall(axis, m)` gives the plane of a wall; walls lie beyond the region at +-2^29.
void convexify(CellGeometry& geometry, const PlaneTable& planes, PlaneId support,
               std::vector<BoundaryEdge> edges, const std::function<uint32_t(int, int64_t)>& wall,
               std::vector<Fragment>& pieces);

/// The same for a region within a weakly convex cell, the rim of which goes along edges of the
/// region where these have planes of the cell's edges. Loops without holes that fill the cell are
/// divided by themselves (loop_pieces.h). Else what is far beside all other edges is cut off by
/// walls first: lines of edges stay short.
void convexify_within(CellGeometry& geometry, const PlaneTable& planes, const Fragment& cell,
                      const std::vector<BoundaryEdge>& edges,
                      const std::function<uint32_t(int, int64_t)>& wall,
                      std::vector<Fragment>& pieces);

/// What of a region within a cell is not convex: the region as it was given, or what is left of it
/// when something `is_cut_off`.
struct RegionRest {
  Fragment cell;
  std::vector<BoundaryEdge> edges;  ///< of what is left, in no order; none of all of it
  bool is_cut_off = false;
};

/// The beginning of that: makes pieces of a convex region, or of what lies far beside all edges
/// that are not on the rim of the cell. Returns whether there is a rest, which convexify_within is
/// for.
bool cut_off_within(CellGeometry& geometry, const PlaneTable& planes, const Fragment& cell,
                    const std::vector<BoundaryEdge>& edges,
                    const std::function<uint32_t(int, int64_t)>& wall,
                    std::vector<Fragment>& pieces, RegionRest& rest);

}  // namespace csgrun
