// Evaluated solids with their corners on the grid, as constructions take them.
#pragma once

#include <string>
#include <vector>

#include <csgrun/engine/evaluate.h>
#include <csgrun/engine/polygon_mesh.h>
#include <csgrun/engine/solid.h>

#include "engine/bsp/operand.h"

namespace csgrun {

struct GridSolid {
  std::vector<IVec3> points;  ///< its vertices; may repeat
  size_t rounded = 0;         ///< how many vertices were off the grid
};

/// Coordinates at most 2^40 steps. Errors: kOutOfRange beyond.
Result<GridSolid> grid_solid(const Solid& solid, const GridStep& step);

/// A solid as a mesh over its vertices where they are on the grid. Its faces are parts of the
/// solid's, as large as they are easily made: convex polygons whose corners were on the grid, so
/// that they are flat, and triangles.
PolygonMesh patch_mesh(const Solid& solid, const GridSolid& on_grid, const GridStep& step);

/// A note about corners that were rounded: "12 corners of its operands lie off the grid and were
/// rounded to it, by up to half a step of 1.5625e-08 mm".
std::string rounding_note(size_t corners, const GridStep& step);

/// Grid points in millimetres, each coordinate correctly rounded.
std::vector<glm::dvec3> to_millimetres(const std::vector<IVec3>& points, const GridStep& step);

}  // namespace csgrun
