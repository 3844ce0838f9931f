// Whether a surface is that of a convex body.
#pragma once

#include "engine/bsp/operand.h"

namespace csgrun {

struct ConvexSurface {
  bool is_convex = false;
  bool has_flat_edges = false;  ///< of a convex one: some neighbours lie in one plane
};

/// Convex is only the surface of one convex body, facing outwards, whose faces meet in corners and
/// edges of both only: no neighbour of a face is in front of it, and the surface is the graph of a
/// function of the direction from the middle of its box (star_surface.h), or, where that is not
/// within, near every vertex the graph of a function, and connected. A closed surface that is
/// convex everywhere near itself is the boundary of a convex body (van Heijenoort 1952); with edges
/// alone it might wind around itself, as the great icosahedron does. Not told of leaves that are
/// not of triangles, and where a vertex was not seen to be spread.
///
/// `box` is that of the vertices. REQUIRES: opposite edges, or none known (then not convex); no
/// degenerate face. O(n); where it is not convex it mostly ends after a few faces.
ConvexSurface find_convex_surface(const LeafGeometry& leaf, const GridBox& box);

}  // namespace csgrun
