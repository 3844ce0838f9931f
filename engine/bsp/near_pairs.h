// Pairs of faces of two leaves whose boxes overlap, found before there is a job: most faces that
// share a coarse cell with the other leaf have none.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/bsp/pair_cells.h"
#include "engine/bsp/polygon_box.h"

namespace csgrun {

struct NearPairs {
  std::vector<std::array<uint32_t, 2>> pairs;  ///< of the first leaf and of the second
  std::vector<uint32_t> starts;                ///< where those of each cell begin, and the end
  /// As PairCells has them.
  uint64_t visited = 0, surface = 0;
};

/// Of faces by their boxes, those of the second leaf from number `second` on; `cells` are those
/// that both reach. Nothing where boxes tell little: of crowds, or if a face is in many pairs.
/// O(n), parallel.
std::optional<NearPairs> find_near_pairs(const PairCells& cells, std::span<const PolygonBox> boxes,
                                         uint32_t second);

}  // namespace csgrun
