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

struct Turned {
  uint64_t count = 0;
  double farthest = 0;  ///< mm: no point of the surface moved by more
};

/// The same for those of the triangles that are caps less than `width` (mm) high, whichever way
/// they look: the middle corner is that near to the longest edge, and farther from its ends. Where
/// there is such a cap beyond that edge, it is turned before, and so on: of a fan of caps, all
/// corners of which lie along one line, each ends up with what is wide beside them. Once for each
/// triangle, at most.
Turned turn_caps(RoundedMesh& mesh, std::span<const uint32_t> triangles, double width,
                 std::span<const glm::dvec3> directions);

}  // namespace csgrun
