// Corners of a shape that are noise: rounding left them beside straight edges.
//
// They are part of the outline, and what stands beside the shape has them as well, so results keep
// them. But whoever takes each edge for itself gets other walls from the parts of one, and hairs
// where two edges meet that are all but in line.
#pragma once

#include <vector>

#include <csgrun/primitives/shape2d.h>

namespace csgrun {

/// The loops of the shape, in their order, without corners that are no farther beside the way
/// between those that are left than rounding puts them (Shape2DFactory::noise_of). Points at which
/// outlines touch stay. O(n log n), O(n) where there are none.
std::vector<Shape2D::Loop> loops_without_noise(const Shape2D& shape);

/// The shape of these loops. It does not remember a turn.
Shape2D without_noise_corners(const Shape2D& shape);

}  // namespace csgrun
