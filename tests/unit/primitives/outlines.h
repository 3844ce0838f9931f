// Outlines for the tests, which fail where one is refused.
#pragma once

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

}  // namespace csgrun::testing
