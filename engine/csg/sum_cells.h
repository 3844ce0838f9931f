// The cells that a Minkowski sum of two solids is made of.
#pragma once

#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// An edge and a face, summed: a prism.
struct SumPrism {
  uint32_t low, high;  ///< the ends of the edge; a vertex that is greater as an array is higher
  uint32_t face;
};

/// Solids whose union is A + B.
struct SumCells {
  std::vector<uint32_t> peaks;    ///< vertices of A, each of them summed with all of B
  std::vector<uint32_t> pits;     ///< vertices of B, each of them summed with all of A
  std::vector<SumPrism> a_edges;  ///< edges of A and faces of B
  std::vector<SumPrism> b_edges;  ///< edges of B and faces of A
};

/// Let u be a direction, and x a point of A + B in general position. What A has in common with
/// x - B is not empty, so it has a point p that is farthest along u; and p is one of these:
///   - a corner of A inside of x - B; all edges of A there lead down (against u). x is in p + B.
///   - a corner of x - B inside of A, likewise. x is in A + w, with w = x - p, a corner of B at
///     which all edges lead up.
///   - in an edge e of A and in a face of x - B, which stems from a face g of B. Then e is convex
///     and u a sum, with positive weights, of the normals of its two faces and of that face, which
///     is opposite to that of g: else one could go farther along u. x is in e + g.
///   - in a face of A and an edge of x - B, likewise.
/// So x is in one of the cells of these kinds; and all cells are parts of A + B, which is the
/// closure of its points in general position. Along u, an edge and a face that are parallel, or two
/// faces that are, cannot make a cell with an inside.
///
/// No direction is parallel to anything if u is (1, e, e^2) for an e that is small enough: what is
/// higher is greater in the first coordinate, or else in the second, or the third.
///
/// Of two convex solids A and x - B have one such point only: cells do not overlap. Of others there
/// are as many as there are points to which all of their surroundings lead up.
///
/// REQUIRES: each bounds a solid and crosses nothing; |coordinate| <= 2^40. Where more than two
/// faces meet in an edge, any two are taken for a convex edge if they could be one: a cell too many
/// does no harm. Exact: signs are of doubles where their bounds allow it, else of integers.
/// O(|A| |B|), and quick: one sign for most pairs.
SumCells sum_cells(const LeafGeometry& a, const LeafGeometry& b);

}  // namespace csgrun
