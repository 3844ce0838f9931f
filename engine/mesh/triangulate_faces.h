// The triangles of all faces of a result.
#pragma once

#include <cstddef>
#include <vector>

#include <csgrun/engine/error.h>

#include "engine/mesh/merge_faces.h"
#include "engine/mesh/vertex_fans.h"

namespace csgrun {

/// Triangulates faces, on several threads, and takes better diagonals where there are any: each
/// triangle from its lowest point, those of a face together, faces in their order. The first
/// `in_order` points of the geometry are numbered in lexicographic order. O(n log n). Errors:
/// kInternal when the loops of a face are not such.
Result<TriangleSet> triangulate_faces(const std::vector<MergedFace>& faces,
                                      const CellGeometry& geometry, const PlaneTable& planes,
                                      size_t in_order);

}  // namespace csgrun
