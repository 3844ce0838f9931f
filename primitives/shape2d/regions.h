// From an arrangement to clean loops: which segments bound the result, and how they join.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "primitives/shape2d/arrangement.h"

namespace csgrun {

/// Loops of a region and their nesting.
struct GridRegions {
  /// Outer loops counter-clockwise, holes clockwise; each starts at its smallest point, visits a
  /// point once and has no needless collinear point; sorted by their points.
  std::vector<GridLoop> loops;
  /// Per loop: itself for an outer loop, else the outer loop of its region.
  std::vector<uint32_t> outer_of;
  /// Per loop: one of those that it is connected with by points that they have in common, the same
  /// for all of these.
  std::vector<uint32_t> group_of;
};

/// The region where inside(first, rest) holds for the winding numbers of the first operand and of
/// the sum of all others. The unbounded side has (0, 0) and must be outside.
GridRegions extract_regions(const std::vector<Segment2D>& arrangement,
                            const std::function<bool(int32_t, int32_t)>& inside);

/// GridRegions::outer_of of loops that are as above, in any order. O(n log n).
std::vector<uint32_t> find_outer_loops(const std::vector<GridLoop>& loops);

}  // namespace csgrun
