// Where a closed surface is no manifold.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

struct NonManifold {
  /// Edges, by their vertices, that are not those of two faces which run them in opposite
  /// directions.
  std::vector<std::array<uint32_t, 2>> edges;
  /// Vertices whose faces are more than one fan, but for the ends of these edges.
  std::vector<uint32_t> vertices;
  /// As LeafGeometry::opposite, of all other edges; UINT32_MAX for these. Empty for a leaf whose
  /// own are known.
  std::vector<uint32_t> opposite;

  /// Calls visit(v, w) for each edge, and visit(v, v) for each vertex.
  template <class Visit>
  void each(Visit&& visit) const {
    for (const auto& [v, w] : edges) visit(v, w);
    for (const uint32_t v : vertices) visit(v, v);
  }
};

/// Ascending. A leaf whose opposite edges are known has no such edges. O(n).
NonManifold find_non_manifold(const LeafGeometry& leaf);

}  // namespace csgrun
