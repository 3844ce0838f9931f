// Vertices of surfaces no edge of which has more than two triangles: most are such.
#pragma once

#include "engine/base/counting_order.h"
#include "engine/mesh/vertex_fans.h"
#include "engine/mesh/whole_order.h"

namespace csgrun {

/// Does what split_fans does if each edge is of two triangles, one each way, or of one triangle and
/// of the rim of what is untouched; false if not, and the fans are to be made anew. Looks at each
/// point by itself. `by_point`: the corners of triangles by their points. O(n) where few triangles
/// have a point in common, O(n log n) at worst.
bool make_simple_fans(const TriangleSet& set, const CountingOrder& by_point,
                      const WholeOrder& whole, VertexFans& fans);

}  // namespace csgrun
