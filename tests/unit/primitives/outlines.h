// Outlines for the tests, which fail where one is refused.
#pragma once

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <csgrun/primitives/shape2d.h>

namespace csgrun::testing {

inline Shape2D good(const Result<Shape2D>& result) {
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? *result : Shape2D();
}

inline Shape2D outlines(const std::vector<Shape2D::Loop>& loops) {
  return good(Shape2D::from_outlines(loops));
}

inline Shape2D box(double x0, double y0, double x1, double y1) {
  return outlines({{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}});
}

/// Of all loops, mm.
inline double length_of(const Shape2D& shape) {
  double length = 0;
  for (const Shape2D::Loop& loop : shape.loops()) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec2 way = loop[(i + 1) % loop.size()] - loop[i];
      length += std::hypot(way.x, way.y);
    }
  }
  return length;
}

}  // namespace csgrun::testing
