// Evaluated solids with their corners on the grid, as constructions take them.
#pragma once

#include <string>
#include <vector>

#include <csgrun/engine/evaluate.h>
#include <csgrun/engine/solid.h>

#include "engine/bsp/operand.h"

namespace csgrun {

struct GridSolid {
  /// A convex polygon that is a part of a face.
  struct Patch {
    std::vector<uint32_t> corners;  ///< indices of points, counter-clockwise from outside
    uint32_t face;
    glm::dvec3 normal;     ///< unit, outwards, within 1e-15; that of the face
    bool is_exact = true;  ///< no corner was rounded: these are the solid's own, in one plane
  };
  /// An edge between two faces that are not in one plane.
  struct Rim {
    uint32_t from, to;      ///< indices of points, as `patch` runs it
    uint32_t patch, other;  ///< the patches beside it
    bool is_convex;
  };

  std::vector<IVec3> points;  ///< its vertices; may repeat
  std::vector<Patch> patches;
  std::vector<Rim> rims;
  std::vector<uint32_t> anchors;  ///< a vertex of each connected surface
  size_t rounded = 0;             ///< how many vertices were off the grid
};

/// Patches, rims and anchors only if they are asked for. Coordinates at most 2^40 steps. Errors:
/// kOutOfRange beyond.
Result<GridSolid> grid_solid(const Solid& solid, const GridStep& step, bool with_patches);

/// A note about corners that were rounded: "12 corners of its operands lie off the grid and were
/// rounded to it, by up to half a step of 1.5625e-08 mm".
std::string rounding_note(size_t corners, const GridStep& step);

/// Grid points in millimetres, each coordinate correctly rounded.
std::vector<glm::dvec3> to_millimetres(const std::vector<IVec3>& points, const GridStep& step);

}  // namespace csgrun
