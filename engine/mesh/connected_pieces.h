// Which pieces of one plane hang together along lines.
#pragma once

#include <vector>

#include "engine/bsp/regions.h"
#include "engine/bsp/union_find.h"

namespace csgrun {

/// A directed edge of a piece, interior on its left.
struct PieceEdge {
  DirectedEdge edge;
  uint32_t piece;
};

/// Joins the pieces of a plane that have a stretch of a line in common, one on each side, wherever
/// their corners on it are, and takes these stretches out of the edges: those left of the pieces
/// that hang together bound their union, broken where neighbours have corners. The pieces do not
/// overlap. Exact. False when two lines have one key, see LineKey. O(n log n).
bool join_neighbours(PlaneId support, std::vector<PieceEdge>& edges, PointView& points,
                     const PlaneTable& planes, UnionFind& pieces);

}  // namespace csgrun
