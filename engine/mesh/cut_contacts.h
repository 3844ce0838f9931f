// Faces that hold wedges of material together which touch only along a line.
#pragma once

#include <span>
#include <vector>

#include "engine/mesh/merge_faces.h"

namespace csgrun {

/// Cuts each face along the edges of others that touch it from inside, on a way through the face
/// from rim to rim: behind such a line there is no material, so the two parts of the face belong to
/// different wedges (docs/decisions/0002, rule 6). Lines that end inside the face leave it whole.
/// REQUIRES: T-junctions resolved. True when something was cut: then the faces are in canonical
/// order again, and T-junctions must be resolved once more.
/// Only the faces `near` (ascending) are looked at: no others touch anything.
bool cut_at_contacts(std::vector<MergedFace>& faces, std::span<const uint32_t> near,
                     CellGeometry& geometry, const PlaneTable& planes);

}  // namespace csgrun
