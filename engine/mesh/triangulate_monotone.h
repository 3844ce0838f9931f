// The quick way to triangulate a small loop that runs along the sweep once and back once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/triangulate.h"

namespace csgrun {

/// Appends the triangles that triangulate_face's sweep makes of a single loop, and returns true;
/// false, with nothing appended, when the loop has more than some dozen corners, turns back more
/// often than at its two ends, or is no face. O(n log n) for n corners, without allocation.
bool triangulate_monotone(std::span<const uint32_t> loop, const PlanarOracle& oracle,
                          std::vector<std::array<uint32_t, 3>>& triangles);

}  // namespace csgrun
