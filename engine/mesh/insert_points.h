// Points within a face that is triangulated already.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/triangulate.h"

namespace csgrun {

/// Makes each point, which lies within the triangulated face and on none of its fixed edges, a
/// corner of triangles: one triangle becomes three, or two that have an edge on which the point
/// lies become four. Every triangle has positive area, exactly. O(points x triangles). False when a
/// point lies in no triangle.
bool insert_points(std::span<const uint32_t> points, const PlanarOracle& oracle,
                   std::vector<std::array<uint32_t, 3>>& triangles);

}  // namespace csgrun
