// Outlines for the tests, which fail where one is refused.
#pragma once

#include <vector>

#include <csgrun/primitives/shape2d.h>

namespace csgrun::testing {

Shape2D good(const Result<Shape2D>& result);

Shape2D outlines(const std::vector<Shape2D::Loop>& loops);

Shape2D box(double x0, double y0, double x1, double y1);

/// Of all loops, mm.
double length_of(const Shape2D& shape);

}  // namespace csgrun::testing
