// A hash of what a result is, exactly, and of nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/merge_faces.h"
#include "engine/mesh/present.h"

namespace csgrun {

/// 128 bits of the step, the exact points of the faces (rounded coordinates and residues modulo a
/// 61-bit prime), the loops, and the appearances by value. Faces must be in canonical order.
std::array<uint64_t, 2> canonical_hash(const std::vector<MergedFace>& faces, CellGeometry& geometry,
                                       const PresentContext& context);

}  // namespace csgrun
