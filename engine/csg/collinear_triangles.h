// Triangles of a mesh that lie on a line, as slivers do after rounding: they are left out, and
// where one spans several corners of its neighbours these get them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// A face that was left out of a leaf: it had three corners on a line, two of them maybe equal.
struct LeftOut {
  uint32_t face;  ///< its number in the mesh
  std::array<uint32_t, 3> corners;
};

/// Makes of a leaf without these faces, which ascend, what drop_collinear_loops (mesh/loop_faces)
/// makes of all faces: edges between corners of collinear ones are split where these say, and
/// nothing happens to others. False, and the leaf is not changed, if a face would not be convex
/// then. REQUIRES: faces of the leaf are convex polygons. O(n).
bool split_at_collinear(LeafGeometry& leaf, std::span<const LeftOut> left_out);

}  // namespace csgrun
