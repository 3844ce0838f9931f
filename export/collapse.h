// What is left of a closed surface when some of its points become equal.
//
// A triangle with two equal corners vanishes; two triangles of one connected surface that are each
// other's reverse cancel. Where a triangle vanishes its two remaining sides lie on one another, so
// the surfaces behind them are glued together; where two triangles cancel, the surfaces behind each
// pair of opposite sides are. Following such gluings from a surviving half-edge always ends at
// exactly one other surviving half-edge of opposite direction: the walk alternates between two
// perfect matchings. So the result is closed and oriented without a look at coordinates, and edges
// where many faces meet keep the pairing that was exact before rounding.
//
// Vertices are then the fans of that gluing. Two edges may still join the same two fans (a thin
// neck that became a seam): their four half-edges are glued crosswise, which cuts the surface along
// the seam and splits both fans. Labels of fans are only ever refined, so one pass suffices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "export/half_edges.h"

namespace csgrun {

struct CollapsedSurface {
  std::vector<uint32_t> triangles;  ///< the surviving ones, ascending
  std::vector<Triangle> vertices;   ///< of each: numbers of new vertices, 0 .. origin.size()-1
  std::vector<uint32_t> twins;      ///< by half-edges of the surviving triangles, renumbered
  std::vector<uint32_t> origin;     ///< per new vertex: an old vertex at the same place, ascending
  uint64_t dropped = 0;             ///< triangles with two equal corners
  uint64_t cancelled = 0;           ///< triangles that lay on their own reverse
};

/// Collapses a closed surface. `twins` are those of `triangles`; `place` maps each vertex to a
/// number of its rounded coordinates. Deterministic. O(n log n).
CollapsedSurface collapse(std::span<const Triangle> triangles, std::span<const uint32_t> twins,
                          std::span<const uint32_t> place);

}  // namespace csgrun
