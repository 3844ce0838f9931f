// One number for the value of a result: equal for equal solids, whatever way they were computed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/merge_faces.h"
#include "engine/mesh/present.h"
#include "engine/mesh/whole_order.h"

namespace csgrun {

/// 128 bits of the step, the exact points of the faces (rounded coordinates and residues modulo a
/// 61-bit prime), the loops, and the appearances by value. `whole` has the canonical order of the
/// explicit faces and of the untouched ones.
std::array<uint64_t, 2> canonical_hash(const std::vector<MergedFace>& faces,
                                       const WholeOrder& whole, const BoundaryMesh& boundary,
                                       CellGeometry& geometry, const PresentContext& context);

}  // namespace csgrun
