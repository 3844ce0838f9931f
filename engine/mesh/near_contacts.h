// Which faces contacts can concern.
#pragma once

#include <span>
#include <vector>

#include "engine/mesh/merge_faces.h"

namespace csgrun {

/// The faces, ascending, whose boxes overlap one of `touches`; all faces if there are none of these
/// (see BoundaryMesh::touches). O(n log n).
std::vector<uint32_t> faces_near(std::span<const GridBox> touches,
                                 const std::vector<MergedFace>& faces,
                                 const CellGeometry& geometry);

}  // namespace csgrun
