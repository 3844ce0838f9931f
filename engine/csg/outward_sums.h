// The parts of a Minkowski sum with a convex solid that lie outside of the other solid.
#pragma once

#include <vector>

#include "engine/csg/grid_solid.h"

namespace csgrun {

/// What A + B, for B convex, has outside of A + b, for a point b in the inside of B.
struct OutwardSums {
  IVec3 centre;  ///< b
  /// Convex solids, each as points that it is the hull of: all of them and A + b are A + B.
  std::vector<std::vector<IVec3>> bodies;
};

/// Let B grow from b on. A point of A + B that is not in A + b is met at some size of B for the
/// first time, where B touches A from outside. Were there points that are met only where no plane
/// parts the two locally, they would be inner points of a region of such, in which the size at
/// which a point is met had no slope; but it has one towards the point of A that was met. So all
/// points are covered by those sums of a face, an edge or a corner of A with what of B is extreme
/// where their normals are:
///   - of a face with the corners that are extreme along its normal,
///   - of a convex edge with those that are extreme between the normals of its two faces,
///   - of a corner with those that are extreme along any direction in the polar of its cone,
/// and the same scaled down to b, which the hull with b has. Reflex edges and corners have nothing
/// outside. Where a whole face of B is extreme, the same holds within the plane: one point of it is
/// enough for the inside of A's face, and edges and convex corners have what is extreme there.
///
/// One body is made for each convex polygon of A's faces, with what its edges and corners need that
/// no other one has. It may have more of B than it needs (signs are of doubles, with a bound); it
/// is in A + B all the same. A polygon with corners that were rounded need not be flat: it is
/// summed with all of B, which has what its edges and corners need, whatever they are.
///
/// `convex` are the corners of B, on the grid. No bodies and no centre (false) when no grid point
/// is well inside of B: the caller sums whole faces then. O(|A| |B|).
bool outward_sums(const GridSolid& a, const std::vector<IVec3>& convex, OutwardSums& result);

}  // namespace csgrun
