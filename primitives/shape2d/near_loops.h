// Booleans of which most loops of one operand are not near the others: a plate that gets one more
// hole. These stay as they are.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "primitives/shape2d/shape_factory.h"

namespace csgrun {

/// A Boolean on a grid, of shapes in the world's frame.
struct GridBoolean {
  const Grid2D& grid;
  const std::vector<Shape2D>& shapes;
  BooleanOp op;
  const std::function<bool(int32_t, int32_t)>& inside;  ///< the op's, as in extract_regions
};

/// What arranging all loops would give, if it is enough to arrange few; else nothing. The shape
/// with the most loops (of a difference the first) must have come from an arrangement on the grid.
/// O(n), and O(m log m) mostly for m corners of loops that are in the box of the other shapes, and
/// of those that touch these.
std::optional<Shape2D> boolean_of_near_loops(const GridBoolean& boolean);

}  // namespace csgrun
