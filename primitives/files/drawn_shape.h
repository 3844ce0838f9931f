// The shape that the outlines of a drawing enclose.
#pragma once

#include <vector>

#include <csgrun/primitives/shape2d.h>

namespace csgrun {

/// As Shape2D::from_outlines, without points on straight lines, and without pieces and holes that
/// are narrower than two steps of the grid: lines that a drawing goes along there and back, turned
/// or skewed, are apart by rounding only.
Result<Shape2D> drawn_shape(const std::vector<Shape2D::Loop>& outlines, FillRule fill);

}  // namespace csgrun
