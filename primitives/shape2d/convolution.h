// The convolution of two loops: what a Minkowski sum of polygons without holes needs, and no more.
#pragma once

#include <vector>

#include "primitives/shape2d/arrangement.h"

namespace csgrun {

/// Adds closed curves whose winding number at a point x is, for regions A and B that have these
/// loops on their left, the number of components of A and x - B in common, less that of their holes
/// (Guibas, Ramshaw, Stolfi 1983, A kinetic framework for computational geometry, 5). It is
/// bilinear: of several loops add that of each pair. Where neither A nor B has holes, what they
/// have in common has none, so it is above 0 exactly inside of the sum.
///
/// Each edge stands at those vertices of the other loop where that turns past the edge's direction;
/// at vertices that turn right it runs backwards. O(n m); for two convex loops n + m segments.
/// REQUIRES: no two corners in a row are equal.
void add_convolution(const GridLoop& a, const GridLoop& b, std::vector<Segment2D>& segments);

}  // namespace csgrun
