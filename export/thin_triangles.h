// Triangles of next to no width taken out of a mesh.
#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include <csgrun/engine/error.h>

#include "export/rounding.h"

namespace csgrun {

struct ThinnedOut {
  uint64_t turned = 0;  ///< edges
  uint64_t merged = 0;  ///< vertices that went to another one
  double farthest = 0;  ///< mm: no point of the surface moved by more
};

/// Takes those of the triangles out that are less than `width` (mm) wide: of caps the longest edge
/// is turned (edge_flips.h), of needles the two ends of the short side become one vertex, at the
/// place of one of them. So next to an edge of the model along which corners lie that are off it by
/// a rounding, there are no triangles any more that look anywhere. Whether less is wrong then is
/// for who calls to see. Vertices and triangles are numbered anew, and outlines are lost, if
/// anything was taken out. Errors: as of move_vertices().
Result<ThinnedOut> take_out_thin(RoundedMesh& mesh, std::span<const uint32_t> triangles,
                                 double width, std::span<const glm::dvec3> directions);

}  // namespace csgrun
