// How the triangles of a mesh hang together, by half-edges. OpenMesh, which has them, stays
// behind this.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <csgrun/engine/error.h>

namespace csgrun {

/// How the triangles of a mesh hang together.
struct MeshTopology {
  uint32_t components = 0;  ///< connected surfaces
  int64_t genus = 0;        ///< sum over the components, holes filled
  bool closed = true;       ///< no boundary edge
  uint64_t boundary_edges = 0;
  std::vector<uint32_t> component_of_triangle;  ///< numbered in the order of their first triangles
};

/// Builds a half-edge mesh of `triangles` and walks over it. Vertices without triangles do not
/// count. The mesh must be an oriented 2-manifold by index, with or without boundary; if it is not
/// (an edge twice in one direction, a vertex of several fans, a corner twice in a triangle) the
/// error is kInvalidMesh and names the first place by index. O(n); about a second for a million
/// triangles.
Result<MeshTopology> analyse_topology(std::span<const std::array<uint32_t, 3>> triangles,
                                      size_t vertex_count);

}  // namespace csgrun
