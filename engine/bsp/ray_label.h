// Whether a point is inside an operand, told by doubles with certainty, or not told.
#pragma once

#include "engine/bsp/pruned_expression.h"
#include "engine/bsp/ray_boxes.h"
#include "engine/bsp/vertex_signs.h"

namespace csgrun {

/// Counts the polygons of an operand that a ray from the point meets. kUnknown when doubles leave
/// any of them open for several rays. `error` bounds the error of each coordinate. REQUIRES: the
/// point is not on the operand's surface. O(n) box tests; `boxes` tell most, from the second point
/// on.
Inside ray_label(const Job& job, VertexSigns& signs, RayBoxes& boxes, uint32_t operand,
                 const std::array<double, 3>& point, double error);

}  // namespace csgrun
