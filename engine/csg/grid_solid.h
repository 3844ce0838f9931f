// Evaluated solids with their corners on the grid, as constructions take them.
#pragma once

#include <string>
#include <vector>

#include <csgrun/engine/evaluate.h>
#include <csgrun/engine/solid.h>

#include "engine/bsp/operand.h"

namespace csgrun {

struct GridSolid {
  std::vector<IVec3> points;  ///< its vertices; may repeat
  /// Convex polygons that cover its faces: indices of points.
  std::vector<std::vector<uint32_t>> patches;
  std::vector<uint32_t> anchors;  ///< a vertex of each connected surface
  size_t rounded = 0;             ///< how many vertices were off the grid
};

/// Coordinates at most 2^40 steps. Errors: kOutOfRange beyond.
Result<GridSolid> grid_solid(const Solid& solid, const GridStep& step, bool with_patches);

/// A note about corners that were rounded: "12 corners of its operands are not on the grid and were
/// rounded to it, by up to half a step of 1.5625e-08 mm".
std::string rounding_note(size_t corners, const GridStep& step);

/// Grid points in millimetres, each coordinate correctly rounded.
std::vector<glm::dvec3> to_millimetres(const std::vector<IVec3>& points, const GridStep& step);

}  // namespace csgrun
