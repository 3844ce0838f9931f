// Minkowski sums of solids, on the grid.
#pragma once

#include <vector>

#include <csgrun/engine/csg_tree.h>

#include "engine/csg/evaluated_parts.h"
#include "engine/csg/grid_solid.h"

namespace csgrun {

/// One operand of a sum, or a part of one that is a union.
struct Summand {
  GridSolid solid;
  bool is_convex = false;  ///< then its points are all that counts
  NodePtr node;            ///< the solid as a leaf over the points; not needed of a convex one
};

/// The sum of unions of summands, as summands: their union is the sum.
///
/// Convex and convex: the hull of the sums of their points. Else, for solids A and B that are
/// regular closed sets, with a point b of each connected surface of B, a of each of A, and faces f,
/// g of their boundaries:
///   A + B  =  union of A + b, of B + a, and of all f + g,
/// for where x - B moves away from x - b, which is in A, without leaving A for good, it crosses the
/// boundary of A; and there the boundary of B does, or lies within A altogether. If B is convex the
/// last two are f + B. Faces are convex polygons, so f + g is the hull of sums of their corners;
/// what is flat of these bounds others. A and B are the solids over their points on the grid: were
/// those that were rounded in the faces alone, gaps would open between these and A + b. Cost: a
/// hull for each pair of faces.
///
/// Errors: kLimit when that is more than 2^26 pairs of points, kOutOfRange when sums of points are
/// beyond 2^40 steps.
Result<std::vector<Summand>> minkowski_sum(const std::vector<Summand>& a,
                                           const std::vector<Summand>& b, const GridStep& step);

}  // namespace csgrun
