// Where a face touches itself: a corner of one of its wedges in the middle of one of its own edges.
#pragma once

#include <span>
#include <vector>

#include "engine/mesh/merge_faces.h"

namespace csgrun {

/// Whether a point of the edge's support lies on the edge, between its ends. Exact.
bool lies_inside(CellGeometry& geometry, const DirectedEdge& edge, uint32_t point);

/// Appends an edge in parts, between the points that lie inside it; these come in any order and are
/// left in that along the edge. Exact.
void append_broken(CellGeometry& geometry, DirectedEdge edge, std::vector<uint32_t>& inside,
                   std::vector<DirectedEdge>& broken);

/// Breaks the edges of each of the faces `which` at those of its own corners that lie inside them,
/// so that its loops touch in vertices only, as triangulation wants. (A corner that is straight on
/// is none, so the loop that runs past has no vertex there.) Exact; box tests for nearly all pairs.
void break_at_own_corners(std::vector<MergedFace>& faces, std::span<const uint32_t> which,
                          CellGeometry& geometry);

}  // namespace csgrun
