// Better triangles for a face that is triangulated already: diagonals are flipped towards the
// constrained Delaunay triangulation (Lawson 1977). Slivers, which rounding to a file's precision
// would turn over, are left only where the face itself is as thin.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/mesh/triangulate.h"

namespace csgrun {

/// Correctly rounded coordinates of a point, in any unit.
using RoundedPosition = std::function<const std::array<double, 3>&(uint32_t)>;

/// Flips diagonals of one face's triangles. `loops` are those that triangulate_face was given,
/// `triangles` its result. What that promises still holds: directed edges of the loops stay, slits
/// included, and every triangle has positive area, exactly. Which of two diagonals is better is
/// judged from rounded coordinates, by the angles opposite to it in space; a diagonal stays unless
/// the other one is better by a clear margin, so points on a circle cause no flips. Afterwards each
/// triangle begins with its lowest point and triangles are sorted: the result depends on which
/// triangles were given, not on their order. At most 16 flips
/// for each triangle, then whatever diagonals there are stay: O(n log n).
void improve_triangles(std::span<const std::vector<uint32_t>> loops, const PlanarOracle& oracle,
                       const RoundedPosition& position,
                       std::vector<std::array<uint32_t, 3>>& triangles);

}  // namespace csgrun
