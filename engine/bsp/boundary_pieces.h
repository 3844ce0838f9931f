// A boundary as the first version of a result in pieces.
#pragma once

#include <memory>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/result_pieces.h"

namespace csgrun {

/// The pieces of a boundary where it stands. What it names of leaves becomes groups of faces, which
/// an operation looks into where it comes near; what it spells out is made convex. O(n).
PiecesPtr pieces_of(const std::shared_ptr<const BoundaryMesh>& boundary);

}  // namespace csgrun
