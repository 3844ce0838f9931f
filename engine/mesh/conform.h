// Where surfaces of a result touch without sharing a corner or an edge: what touches becomes part
// of what is touched.
#pragma once

#include <span>
#include <vector>

#include "engine/mesh/merge_faces.h"

namespace csgrun {

/// Makes the faces a complex: two of them meet in corners and edges that both have, or nowhere. A
/// corner that lies within an edge of another face breaks it; edges that cross in a point of
/// contact are broken there; a corner within a face becomes one of its `points`, an edge within a
/// face one of its `slits`. So a contact is the same numbers on either side, and stays one when
/// coordinates are rounded. No surface is moved.
///
/// REQUIRES: faces that do not cross, T-junctions resolved. Exact; doubles decide nearly always.
/// Cost: O(n log n) and the pairs of faces whose boxes meet, as often as a contact is looked at; of
/// edges that run in a face's plane, the pairs that meet there. Edges that only leave a corner of
/// the face are none of these: n faces around a corner are n^2 pairs, and not n^3.
///
/// Only the faces `near` (ascending) are looked at: no others touch anything.
void conform_contacts(std::vector<MergedFace>& faces, std::span<const uint32_t> near,
                      CellGeometry& geometry, const PlaneTable& planes);

}  // namespace csgrun
