// Which directed edges of a leaf are each other's reverse.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

struct EdgePairing {
  /// Every directed edge occurs as often as its reverse.
  bool is_balanced = false;
  /// As LeafGeometry::opposite.
  std::vector<uint32_t> opposite;
};

/// REQUIRES: vertices are distinct, no loop has the same corner twice in a row. O(n) for surfaces
/// of bounded valence, O(n log n) at worst.
EdgePairing pair_edges(const LeafGeometry& leaf);

}  // namespace csgrun
