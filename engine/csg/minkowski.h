// Minkowski sums of solids, on the grid.
#pragma once

#include <variant>
#include <vector>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/evaluate.h>

#include "engine/bsp/operand.h"
#include "engine/csg/sum_surface.h"

namespace csgrun {

/// One operand of a sum, or a part of one that is a union.
struct Summand {
  std::vector<IVec3> points;  ///< of a convex one: it is their hull
  bool is_convex = false;
  /// The boundary, over points of the grid; of a convex one that of its hull, without faces if that
  /// is flat.
  LeafGeometry boundary;
  bool is_simple = false;  ///< the boundary crosses nothing and bounds a solid
  NodePtr node;            ///< the solid as a leaf over these points; not needed of a convex one
};

/// The hull of points.
Summand convex_summand(std::vector<IVec3> points);
/// A solid as a mesh over points of the grid, which is `node`; without faces if the mesh is flat.
Summand solid_summand(const PolygonMesh& mesh, const std::vector<IVec3>& points, NodePtr node);

/// The hull of points; a surface that wraps a solid once or more; a solid.
using SumPart = std::variant<std::vector<IVec3>, SumSurface, NodePtr>;

/// The sum of operands, each a union of summands, as parts whose union it is.
///
/// Two convex summands make the hull of the sums of their points. Others are cut into cells (see
/// sum_cells), or, if one is convex and no more is to be summed with them, into what the other's
/// boundary sweeps (see sum_sweeps). The surface of these is one part; if more is to be summed with
/// them, each cell is a summand.
///
/// A boundary that crosses itself, as it may where its corners were rounded, has no such cells. For
/// solids A and B that are regular closed sets, with a point b of each connected surface of B, a of
/// each of A, and faces f, g of their boundaries:
///   A + B  =  union of A + b, of B + a, and of all f + g,
/// for where x - B moves away from x - b, which is in A, without leaving A for good, it crosses the
/// boundary of A; and there the boundary of B does, or lies within A altogether. If B is convex the
/// last two are f + B. A hull for each pair of faces.
///
/// REQUIRES: two operands or more, none without summands. Errors: kLimit when there are too many
/// cells or hulls, kOutOfRange when sums of points are beyond 2^40 steps.
///
/// Flat summands count like any other. What is flat of a sum is left out beside what is not; where
/// all is flat it is the sum.
Result<std::vector<SumPart>> minkowski_sum(std::vector<std::vector<Summand>> operands,
                                           const GridStep& step);

}  // namespace csgrun
