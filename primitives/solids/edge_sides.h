// The flat sides of a solid: which of its faces are one plane, up to the rounding of their corners.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/solid.h>

namespace csgrun {

struct FlatSides {
  std::vector<uint32_t> of;    ///< by triangle: its side
  std::vector<uint32_t> face;  ///< by side: one of the faces that make it
  /// By side: of length 1, outwards, if its faces are flat by the user's numbers only. Planes of
  /// such faces say less: a narrow one's turns by much when a corner moves by a step.
  std::vector<std::optional<glm::dvec3>> normal;
  double roughness = 0;  ///< mm: so far apart are two planes that such a side lies between, at most
};

/// `twins`: by half-edge of the triangles, the one that runs back. Sides hang together. O(t log t)
/// for t triangles, and for each face that is joined to others, the corners of these.
FlatSides flat_sides(const Solid& solid, std::span<const uint32_t> twins, double grid_step_mm);

}  // namespace csgrun
