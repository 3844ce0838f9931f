// How finely linear_extrude cuts its height and its outlines: OpenSCAD's rules.
#pragma once

#include <csgrun/primitives/shape2d.h>

namespace csgrun {

/// The number of slices as a double, at least 1 and perhaps absurdly large. `height` is the length
/// of the height vector.
double slices_of(const Shape2D& shape, const LinearExtrudeOptions& options, double height);

/// The loops with vertices added on long edges, for twists and uneven scales.
std::vector<Shape2D::Loop> split_outlines(const Shape2D& shape, const LinearExtrudeOptions& options,
                                          int slices);

/// The point of slice i of n: turned first, then scaled.
glm::dvec2 slice_point(const LinearExtrudeOptions& options, const glm::dvec2& p, int i, int n);

}  // namespace csgrun
