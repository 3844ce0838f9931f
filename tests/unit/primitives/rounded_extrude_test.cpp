// Extrusions with rounded edges against the areas of their layers: an outline of area A and length
// P whose edges have moved inwards by t has the area A - P t + K t^2, where K is the sum of the
// tangents of half the turns of its corners. Beyond where that holds, the areas of offsets.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/shape_operations.h>
#include <csgrun/primitives/trig.h>

#include "tests/support/seeded.h"
#include "tests/unit/primitives/mesh_measures.h"
#include "tests/unit/primitives/outlines.h"

namespace csgrun::rounded_extrude_test {
namespace {

using testing::box;
using testing::euler_number;
using testing::expect_closed;
using testing::outlines;
using testing::volume;

constexpr int kSteps = 8;  // of a quarter

LinearExtrudeOptions rounded(double height, double bottom, double top) {
  LinearExtrudeOptions options;
  options.height = height;
  options.round = {bottom, top};
  options.facets.fn = 4 * kSteps;
  return options;
}

PolygonMesh good(const Shape2D& shape, const LinearExtrudeOptions& options) {
  const MeshResult r = linear_extrude(shape, options);
  EXPECT_TRUE(r) << (r ? "" : r.error().message);
  if (!r) return {};
  expect_closed(*r);
  return *r;
}

/// The volume of a band of radius r, of the area at each inset, which is quadratic between places
/// where the outline changes its form.
template <class Area>
double band_of(Area area_at, double r, const std::vector<double>& changes = {}) {
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t0 = r - r * std::cos(M_PI / 2 * i / kSteps);
    const double t1 = r - r * std::cos(M_PI / 2 * (i + 1) / kSteps);
    const double rise =
        r * (std::sin(M_PI / 2 * (i + 1) / kSteps) - std::sin(M_PI / 2 * i / kSteps));
    double from = t0;
    const auto add_to = [&](double to) {
      sum += rise * (to - from) / (t1 - t0) / 6 *
             (area_at(from) + 4 * area_at((from + to) / 2) + area_at(to));
      from = to;
    };
    for (const double change : changes) {
      if (t0 < change && change < t1) add_to(change);
    }
    add_to(t1);
  }
  return sum;
}

/// The same with the outline's numbers.
double band(double area, double length, double tangents, double r) {
  return band_of([&](double t) { return area - length * t + tangents * t * t; }, r);
}

TEST(RoundedExtrude, HasTheAreasOfItsLayers) {
  const Shape2D square = box(-5, -5, 5, 5);
  EXPECT_NEAR(volume(good(square, rounded(10, 2, 2))), 6 * 100 + 2 * band(100, 40, 4, 2), 1e-9);
  EXPECT_NEAR(volume(good(square, rounded(10, 0, 3))), 7 * 100 + band(100, 40, 4, 3), 1e-9);
  EXPECT_NEAR(volume(good(square, rounded(10, 1, 0))), 9 * 100 + band(100, 40, 4, 1), 1e-9);
  // No wall is left between them.
  EXPECT_NEAR(volume(good(square, rounded(5, 2, 3))), band(100, 40, 4, 2) + band(100, 40, 4, 3),
              1e-9);
  // Five corners turn left, one right.
  const Shape2D ell = outlines({{{0, 0}, {20, 0}, {20, 8}, {8, 8}, {8, 20}, {0, 20}}});
  EXPECT_NEAR(volume(good(ell, rounded(10, 3.5, 1))),
              5.5 * 256 + band(256, 80, 5 - 1, 3.5) + band(256, 80, 5 - 1, 1), 1e-9);
  // A hole grows: its corners turn right.
  const Shape2D frame = outlines({box(0, 0, 20, 20).loops()[0], box(6, 6, 14, 14).loops()[0]});
  const PolygonMesh ring = good(frame, rounded(10, 2.9, 0));
  EXPECT_NEAR(volume(ring), 7.1 * 336 + band(336, 112, 4 - 4, 2.9), 1e-9);
  EXPECT_EQ(euler_number(ring), 0);
  // A sharp corner (its tip turns by 143 degrees, so it runs far inwards) and an obtuse one.
  const Shape2D kite = outlines({{{0, -30}, {10, 0}, {0, 3}, {-10, 0}}});
  const double tip = std::atan2(30, 10), flat = std::atan2(3, 10);
  const double tangents =
      std::tan(tip) + std::tan(flat) + 2 * std::tan((M_PI * 2 - 2 * tip - 2 * flat) / 4);
  const double length = 2 * (std::sqrt(1000.0) + std::sqrt(109.0));
  EXPECT_NEAR(volume(good(kite, rounded(10, 2, 0))), 8 * 330 + band(330, length, tangents, 2),
              1e-9);
}

TEST(RoundedExtrude, MayComeDownToAPointOrARidge) {
  const PolygonMesh dome = good(box(-5, -5, 5, 5), rounded(8, 0, 5));
  EXPECT_NEAR(volume(dome), 300 + band(100, 40, 4, 5), 1e-9);
  EXPECT_EQ(euler_number(dome), 2);
  const PolygonMesh loaf = good(box(0, 0, 20, 8), rounded(8, 4, 4));
  EXPECT_NEAR(volume(loaf), 2 * band(160, 56, 4, 4), 1e-9);
  EXPECT_EQ(euler_number(loaf), 2);
  const Shape2D disc = *make_circle(10, Facets{24, 12, 2});
  const double inner = 10 * cos_deg(7.5);
  EXPECT_EQ(euler_number(good(disc, rounded(30, inner, inner))), 2);
  // Each piece for itself: the small one has come down to its point, the large one has not.
  const Shape2D two = outlines({box(0, 0, 4, 4).loops()[0], box(9, 0, 29, 20).loops()[0]});
  EXPECT_NEAR(volume(good(two, rounded(5, 0, 2))),
              3 * 416 + band(16, 16, 4, 2) + band(400, 80, 4, 2), 1e-9);
}

TEST(RoundedExtrude, GoesOnWhereTheOutlineChangesItsForm) {
  // Two squares with a neck of 2 between them: its walls meet at 1, and leave a ridge.
  const Shape2D neck = outlines({{{0, 0},
                                  {10, 0},
                                  {10, 4},
                                  {20, 4},
                                  {20, 0},
                                  {30, 0},
                                  {30, 10},
                                  {20, 10},
                                  {20, 6},
                                  {10, 6},
                                  {10, 10},
                                  {0, 10}}});
  const auto of_neck = [](double t) {
    return t < 1 ? 220 - 96 * t + 4 * t * t : 2 * (10 - 2 * t) * (10 - 2 * t);
  };
  const PolygonMesh barbell = good(neck, rounded(20, 0, 2));
  EXPECT_NEAR(volume(barbell), 18 * 220 + band_of(of_neck, 2, {1}), 1e-6);
  EXPECT_EQ(euler_number(barbell), 2);
  const PolygonMesh both = good(neck, rounded(7, 4, 3));
  EXPECT_NEAR(volume(both), band_of(of_neck, 4, {1}) + band_of(of_neck, 3, {1}), 1e-6);
  EXPECT_EQ(euler_number(both), 2);
  // An edge of 0.2 in a corner cut off vanishes at 0.2 / (2 - 2 tan(22.5 deg)).
  const double cut = 0.2 / std::sqrt(2.0), gone = cut / (2 - std::sqrt(2.0));
  const Shape2D plate = outlines({{{0, 0}, {10 - cut, 0}, {10, cut}, {10, 10}, {0, 10}}});
  const auto of_plate = [&](double t) {
    const double side = 10 - 2 * t, left = cut - (2 - std::sqrt(2.0)) * t;
    return side * side - (t < gone ? left * left / 2 : 0);
  };
  EXPECT_NEAR(volume(good(plate, rounded(9, 3, 1))),
              5 * of_plate(0) + band_of(of_plate, 3, {gone}) + band_of(of_plate, 1, {gone}), 1e-6);
  // Rings: the hole reaches the edge on one side, a thin wall becomes a ridge; it stays a ring.
  const Shape2D ring = outlines({box(0, 0, 20, 20).loops()[0], box(2, 6, 10, 14).loops()[0]});
  EXPECT_EQ(euler_number(good(ring, rounded(10, 2.5, 4))), 0);
}

/// Where all corners are square, an offset is what is left by a square that goes around the
/// outline.
TEST(RoundedExtrude, HasTheAreasOfOffsets) {
  test::Random random(31);
  for (int round = 0; round < 6; ++round) {
    std::vector<Shape2D::Loop> loops;
    for (int i = 0; i < 9; ++i) {
      const double x = 24 * random.unit(), y = 24 * random.unit();
      const double right = x + 4 + 8 * random.unit(), top = y + 4 + 8 * random.unit();
      loops.push_back({{x, y}, {right, y}, {right, top}, {x, top}});
    }
    const Shape2D shape = testing::good(Shape2D::from_outlines(loops, FillRule::kNonZero));
    const auto area_at = [&](double t) {
      if (t == 0) return shape.area();
      OffsetOptions inwards;
      inwards.distance = -t;
      inwards.join = OffsetJoin::kMitre;
      return testing::good(offset_shape(shape, inwards)).area();
    };
    std::vector<double> steps;  // changes are somewhere between them
    for (int i = 1; i < 100; ++i) steps.push_back(0.02 * i);
    const double expected = 3 * shape.area() + band_of(area_at, 2, steps);
    EXPECT_NEAR(volume(good(shape, rounded(5, 0, 2))), expected, 1e-5 * expected) << round;
  }
}

TEST(RoundedExtrude, StandsWhereOthersDo) {
  LinearExtrudeOptions options = rounded(10, 1, 2);
  options.center = true;
  double low = 0, high = 0;
  for (const glm::dvec3& p : good(box(0, 0, 9, 9), options).points) {
    low = std::min(low, p.z);
    high = std::max(high, p.z);
  }
  EXPECT_EQ(low, -5);
  EXPECT_EQ(high, 5);
  // The round edges are shaded, walls and caps are flat.
  const PolygonMesh mesh = good(box(0, 0, 9, 9), rounded(10, 1, 2));
  size_t flat = 0;
  for (const uint32_t surface : mesh.surface) flat += surface == 0 ? 1 : 0;
  EXPECT_EQ(flat, 6u);
  EXPECT_EQ(mesh.face_count(), 6u + 2 * 4 * kSteps);
}

TEST(RoundedExtrude, WhatDoesNotFitIsAnError) {
  const auto message = [](const Shape2D& shape, const LinearExtrudeOptions& options) {
    const MeshResult r = linear_extrude(shape, options);
    return r ? std::string("no error") : r.error().message;
  };
  const std::string too_wide =
      "linear_extrude: round must leave each piece some of its full height: ";
  EXPECT_EQ(message(box(0, 0, 9, 9), rounded(20, 0, 5)),
            too_wide + "5 does not fit, the most that does is about 4.5");
  const Shape2D frame = outlines({box(0, 0, 20, 20).loops()[0], box(6, 6, 14, 14).loops()[0]});
  EXPECT_EQ(message(frame, rounded(20, 4, 0)),
            too_wide + "4 does not fit, the most that does is about 3");
  std::vector<Shape2D::Loop> saw(1);
  for (int i = 0; i < 12000; ++i) {
    const double r = i % 2 == 0 ? 20 : 20.5, angle = 2 * M_PI * (i + 0.2 * (i % 2)) / 12000;
    saw[0].emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  EXPECT_EQ(message(outlines(saw), rounded(20, 0, 1)),
            "linear_extrude: round changes the form of this outline, which takes its roof: method "
            "\"straight\" takes up to 10000 edges, got 12000");
  EXPECT_EQ(message(box(0, 0, 9, 9), rounded(5, 3, 3)),
            "linear_extrude: round must leave room at the bottom and at the top: 3 and 3 are more "
            "than the height of 5");
  LinearExtrudeOptions options = rounded(9, 1, 1);
  options.twist = 5;
  EXPECT_EQ(message(box(0, 0, 9, 9), options),
            "linear_extrude: round goes without twist and scale");
  options = rounded(9, 1, 1);
  options.direction = glm::dvec3(1, 0, 4);
  EXPECT_EQ(message(box(0, 0, 9, 9), options),
            "linear_extrude: round goes with a direction along Z only");
  EXPECT_EQ(message(box(0, 0, 9, 9), rounded(9, -1, 1)),
            "linear_extrude: round must not be negative, got -1");
  EXPECT_EQ(message(box(0, 0, 9, 9), rounded(9, std::nan(""), 1)),
            "linear_extrude: round must be finite, got nan");
}

}  // namespace
}  // namespace csgrun::rounded_extrude_test
