#include "tests/unit/primitives/outlines.h"

#include <cmath>

#include <gtest/gtest.h>

namespace csgrun::testing {

Shape2D good(const Result<Shape2D>& result) {
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? *result : Shape2D();
}

Shape2D outlines(const std::vector<Shape2D::Loop>& loops) {
  return good(Shape2D::from_outlines(loops));
}

Shape2D box(double x0, double y0, double x1, double y1) {
  return outlines({{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}});
}

double length_of(const Shape2D& shape) {
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
