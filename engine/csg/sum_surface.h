// The surface of all cells, or of all sweeps, of a Minkowski sum.
#pragma once

#include <optional>
#include <vector>

#include "engine/bsp/operand.h"
#include "engine/csg/sum_cells.h"
#include "engine/csg/sum_sweeps.h"

namespace csgrun {

/// Closed, crossing itself where cells overlap: a point is wrapped by it as often as there are
/// cells, or sweeps, that hold it. Faces are planar and convex.
struct SumSurface {
  std::vector<IVec3> points;  ///< distinct
  std::vector<uint32_t> corners;
  std::vector<uint32_t> face_starts{0};
};

/// The boundaries of the cells, less what two of them have in common, once with each sense. Each
/// is a vertex of one operand and a face of the other, or an edge of each, so names tell what is
/// the same. (These are the kinds of faces that the convolution of the two surfaces has; each
/// counts by how the number of cells changes across it, not by an Euler number.)
///
/// Nothing if there were more than 2^24 before. O(n log n) for n of them.
std::optional<SumSurface> sum_surface(const LeafGeometry& a, const LeafGeometry& b,
                                      const SumCells& cells);

/// The same of A + middle and of what is swept. Where faces run along a face or an edge of B, sides
/// of what they sweep are in one plane, each a face of its own.
std::optional<SumSurface> sum_surface(const LeafGeometry& a, const LeafGeometry& b,
                                      const SumSweeps& sweeps);

}  // namespace csgrun
