// The usual leaf: its faces are planar and convex as they come, or quadrilaterals of a convex body
// that rounding bent, so that little is left to do but to give equal points one number.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <csgrun/engine/polygon_mesh.h>

#include "engine/bsp/operand.h"

namespace csgrun {

struct ConvexFaces {
  /// The vertices that the faces use, in the order of their first use; no opposite edges yet.
  LeafGeometry leaf;
  GridBox box;  ///< of the vertices
  /// Points became one or faces were left out, so that faces may lie on each other's back.
  bool merged = false;
};

/// What merging equal points and make_convex_faces would give, as long as these find nothing to do
/// but to leave out triangles that lie on a line and to split bent quadrilaterals of a mesh that
/// promises to be convex: none when another face has holes, is not planar and convex, or becomes so
/// by that, or when points are 2^30 steps or more apart. O(n).
std::optional<ConvexFaces> take_convex_faces(const PolygonMesh& mesh,
                                             const std::vector<IVec3>& points, bool turn,
                                             const FaceNumbers& appearance);

/// Whether some face has one other face for all its neighbours and is thus its reverse. `opposite`
/// as in LeafGeometry, not empty.
bool has_reversed_pair(const LeafGeometry& leaf, const std::vector<uint32_t>& opposite);

}  // namespace csgrun
