// Whole faces that others only rest on: along edges, or with corners, that are their own.
#pragma once

#include <vector>

#include "engine/bsp/assemble.h"
#include "engine/bsp/contact_table.h"
#include "engine/bsp/touch_finder.h"

namespace csgrun {

/// Clears WholePolygon::is_met of triangles of convex leaves that are as good as untouched though
/// other surfaces meet them, as the sides of a hole are met by the face that it is drilled in:
///
/// - Whatever meets one ends in corners of its own, and is not in its plane. So no edge of it is
///   broken, and it is not merged with another operand's face.
/// - At each of these corners, what is kept is one round of outlines (`finder`, after find()):
///   whole ones of this leaf alone, and parts of cut polygons, which are spelled out. Nothing else
///   that is kept passes the corner (TouchFinder::note_passage).
/// - No two edges of the leaf lead straight on there. Say that all faces spelled out at the corner
///   had a straight angle: each edge between two of them would be the reverse of the one before it,
///   and the last, an edge of the leaf, the first one or its reverse. So one of them has a true
///   corner, and the point is one of the boundary's.
///
/// REQUIRES: nothing was left to cells; the touched vertices have points, which are in the finder's
/// index. O(contacts of such polygons), parallel.
void release_rims(const Job& job, const ContactTable& contacts, const CellGeometry& geometry,
                  const TouchFinder& finder, std::vector<WholePolygon>& whole);

}  // namespace csgrun
