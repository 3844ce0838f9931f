// Thin triangles taken out of a mesh by turning edges.
#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "export/rounding.h"

namespace csgrun {

/// Turns the longest edge of each of the triangles, whose area is next to nothing, so that its
/// middle corner comes to lie on that edge of the neighbour; both new triangles belong to the
/// neighbour's face. Left alone are edges that would be there twice, and those whose turning makes
/// a triangle without area or turned over from its face. Returns the number of edges turned; keeps
/// the mesh a manifold by index. O(degrees of the corners) each.
uint64_t turn_longest_edges(RoundedMesh& mesh, std::span<const uint32_t> triangles,
                            std::span<const glm::dvec3> directions);

}  // namespace csgrun
