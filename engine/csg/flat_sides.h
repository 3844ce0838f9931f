// Convex bodies with as few faces as they have: coplanar neighbours of one label become one
// polygon.
#pragma once

#include "engine/bsp/operand.h"

namespace csgrun {

/// Joins neighbours that lie in one plane and have equal facets, surfaces and appearances, where
/// together they are a convex polygon; corners at which that leaves an edge straight on for both of
/// its faces go. What the leaf is, and what is made of it, stays the same.
///
/// REQUIRES: a convex leaf, opposite edges known. O(n).
void join_flat_faces(LeafGeometry& leaf);

}  // namespace csgrun
