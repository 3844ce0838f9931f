// Whether a surface is that of a convex body.
#pragma once

#include "engine/bsp/operand.h"

namespace csgrun {

struct ConvexSurface {
  bool is_convex = false;
  bool has_flat_edges = false;  ///< of a convex one: some neighbours lie in one plane
};

/// Convex is only the surface of one convex body, facing outwards, whose faces meet in corners and
/// edges of both only: no neighbour of a face is in front of it, around every vertex the surface is
/// the graph of a function, and it is connected. A closed surface that is convex everywhere near
/// itself is the boundary of a convex body (van Heijenoort 1952); without the look at vertices it
/// might wind around itself, as the great icosahedron does. Not told of leaves that are not of
/// triangles, and where a vertex was not seen to be spread.
///
/// `box` is that of the vertices. REQUIRES: opposite edges, or none known (then not convex); no
/// degenerate face. O(n); where it is not convex it mostly ends after a few faces.
ConvexSurface find_convex_surface(const LeafGeometry& leaf, const GridBox& box);

}  // namespace csgrun
