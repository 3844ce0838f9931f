// Offsets of offsets: they have no more points than they need, and the shape that they should.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/shape_operations.h>

#include "tests/unit/primitives/csg_trees.h"

namespace csgrun::nested_offsets_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

size_t corners_of(const Shape2D& shape) {
  size_t count = 0;
  for (const Shape2D::Loop& loop : shape.loops()) count += loop.size();
  return count;
}

Shape2D rounded(const Shape2D& shape, double r, const Facets& facets) {
  OffsetOptions options;
  options.distance = r;
  options.facets = facets;
  const Result<Shape2D> result = offset_shape(shape, options);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? *result : Shape2D();
}

/// How far a point is from the square [0, side]^2.
double distance_to_square(const glm::dvec2& p, double side) {
  return std::hypot(std::max({-p.x, p.x - side, 0.0}), std::max({-p.y, p.y - side, 0.0}));
}

TEST(NestedOffsets, OfASquareStayNearTheTrueOne) {
  for (const double fn : {8, 32, 90, 200, 1000}) {
    Shape2D shape = *make_square({10, 10}, {false, false});
    const Facets facets{fn, 12, 2};
    // The sides of an arc of r are r (1 - cos(180 / fn)) from it, farther out or in; those of the
    // next level are on corners that turn by half of that, and so on.
    const double sag = 1 - std::cos(kPi / fn), grid = 1e-6;
    for (int level = 1; level <= 8; ++level) {
      shape = rounded(shape, 1, facets);
      // 240 corners of 1.5 degrees make a turn, and each may have become two; or it is one arc.
      EXPECT_LE(corners_of(shape), 2 * 240 + 8 + 2 * fn) << fn << " " << level;
      ASSERT_EQ(shape.loops().size(), 1u);
      const Shape2D::Loop& loop = shape.loops()[0];
      for (size_t i = 0; i < loop.size(); ++i) {
        const glm::dvec2 middle = 0.5 * (loop[i] + loop[(i + 1) % loop.size()]);
        for (const glm::dvec2& p : {loop[i], middle}) {
          EXPECT_LE(distance_to_square(p, 10), level + level * sag + grid) << fn << " " << level;
          EXPECT_GE(distance_to_square(p, 10), level - level * sag - grid) << fn << " " << level;
        }
      }
      // Steiner's formula; one polygon of fn corners has less than all levels together.
      const double exact = 100 + 40 * level + kPi * level * level,
                   least = 100 + 40 * level + fn / 2 * std::sin(2 * kPi / fn) * level * level;
      EXPECT_GE(shape.area(), least - grid) << fn << " " << level;
      EXPECT_LE(shape.area(), exact * (1 + 2e-6)) << fn << " " << level;
    }
  }
}

TEST(NestedOffsets, WholeStepsStayWhole) {
  // 8 steps at each corner of the square. Then a step at each corner within an arc and half of one
  // at its ends: two points at each corner, as OpenSCAD has them, whatever the angles' noise is.
  const Facets facets{32, 12, 2};
  const Shape2D once = rounded(*make_square({10, 10}, {false, false}), 1, facets);
  EXPECT_EQ(corners_of(once), 36u);
  EXPECT_EQ(corners_of(rounded(once, 1, facets)), 72u);
  EXPECT_EQ(corners_of(rounded(rounded(once, 1, facets), 1, facets)), 144u);
  // A circle of points with six digits, as trees have them.
  std::string points;
  for (int k = 0; k < 32; ++k) {
    char text[64];
    std::snprintf(text, sizeof text, "%s[%.6g, %.6g]", k > 0 ? ", " : "",
                  50 * std::cos(2 * kPi * k / 32), 50 * std::sin(2 * kPi * k / 32));
    points += text;
  }
  EXPECT_EQ(corners_of(testing::parse("offset(r = 3, $fn = 32, $fa = 12, $fs = 2) { polygon(points "
                                      "= [" +
                                      points + "]); }")
                           .shape),
            64u);
}

TEST(NestedOffsets, ArcsBeginAtTheEdgeBeforeTheCorner) {
  // Five steps a turn do not divide a quarter: the places are those that OpenSCAD gives.
  const auto box = [](const std::string& text) { return testing::parse(text).shape.bounds(); };
  const std::string round = ", $fn = 0, $fa = 12, $fs = 2) { ";
  const Shape2D inwards =
      testing::parse("offset(r = -1" + round +
                     "polygon(points = [[0, 0], [10, 0], [10, 4], [4, 4], [4, 10], [0, 10]]); }")
          .shape;
  ASSERT_EQ(corners_of(inwards), 8u);
  double nearest = 1;
  for (const glm::dvec2& p : inwards.loops()[0])
    nearest = std::min(nearest, std::hypot(p.x - 3.04894348, p.y - 3.69098301));
  EXPECT_LT(nearest, 1e-6);
  // The notch closes, and where the arcs of its corners meet is a corner for the way back.
  const auto [low, high] = box("offset(r = -1" + round + "offset(r = 1" + round +
                               "difference() { square(size = [9, 9]); multmatrix([[1, 0, 0, 4]]) "
                               "{ square(size = [0.5, 5]); } } } }");
  EXPECT_NEAR(low.y, -0.0832556, 1e-6);
  // The image of a mirror has its own edges before corners.
  const auto [left, right] = box("offset(r = 1" + round +
                                 "multmatrix([[-0.8, 0.6, 0, 0], [0.6, 0.8, 0, 0]]) "
                                 "{ polygon(points = [[0, 0], [10, 0], [5, 7]]); } }");
  EXPECT_NEAR(left.x, -8.9999747, 1e-6);
  EXPECT_NEAR(left.y, -0.8178475, 1e-6);
  EXPECT_NEAR(right.y, 9.5532306, 1e-6);
}

TEST(NestedOffsets, OutAndInAgainGivesTheShape) {
  // As much as it had, but at corners, which facets had cut.
  Shape2D shape = *make_square({10, 10}, {false, false});
  const Facets facets{64, 12, 2};
  for (int level = 0; level < 6; ++level) {
    shape = rounded(rounded(shape, 1, facets), -1, facets);
    EXPECT_LE(shape.area(), 100.000001);
    EXPECT_GE(shape.area(), 100 - 0.002 * (level + 1));
  }
  EXPECT_LE(corners_of(shape), 100u);
}

TEST(NestedOffsets, FineOutlinesKeepTheAreaOfAnArc) {
  // A circle of small sides: mitres and arcs differ by far less than the sides and the circle do.
  for (const double fn : {100, 239, 241, 360, 1000}) {
    const Shape2D circle = *make_circle(5, Facets{fn, 12, 2});
    const double of_circle = fn / 2 * std::sin(2 * kPi / fn) * 25;
    const double perimeter = 10 * fn * std::sin(kPi / fn);
    // With the true disc for the offset, and with the polygon that an arc at each corner makes.
    const double exact = of_circle + perimeter + kPi,
                 by_arcs = of_circle + perimeter + fn / 2 * std::sin(2 * kPi / fn);
    const double area = rounded(circle, 1, Facets{fn, 12, 2}).area();
    EXPECT_NEAR(area, by_arcs, 1e-5 * by_arcs) << fn;
    EXPECT_LT(std::fabs(area - exact), 1.0001 * std::fabs(by_arcs - exact) + 1e-6) << fn;
  }
}

TEST(NestedOffsets, TooManyPointsAreRefusedBeforeTheyAreMade) {
  OffsetOptions options;
  options.facets.fn = 1e9;
  const Result<Shape2D> result = offset_shape(*make_square({10, 10}, {false, false}), options);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kLimit);
  EXPECT_EQ(result.error().message.find("offset: 1e+09 fragments make "), 0u)
      << result.error().message;
  // Corners that point inwards, and joins without arcs, need none.
  options.distance = -1;
  EXPECT_TRUE(offset_shape(*make_square({10, 10}, {false, false}), options));
  options.distance = 1;
  options.join = OffsetJoin::kMitre;
  EXPECT_TRUE(offset_shape(*make_square({10, 10}, {false, false}), options));
}

}  // namespace
}  // namespace csgrun::nested_offsets_test
