// Extrusions with rounded edges against the areas of their layers: an outline of area A and length
// P whose edges have moved inwards by t has the area A - P t + K t^2, where K is the sum of the
// tangents of half the turns of its corners.
#include <cmath>

#include <gtest/gtest.h>

#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/trig.h>

#include "tests/unit/primitives/mesh_measures.h"
#include "tests/unit/primitives/outlines.h"

namespace csgrun {
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

/// The volume of a band of radius r with the outline's numbers.
double band(double area, double length, double tangents, double r) {
  const auto area_at = [&](double t) { return area - length * t + tangents * t * t; };
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t0 = r - r * std::cos(M_PI / 2 * i / kSteps);
    const double t1 = r - r * std::cos(M_PI / 2 * (i + 1) / kSteps);
    const double rise =
        r * (std::sin(M_PI / 2 * (i + 1) / kSteps) - std::sin(M_PI / 2 * i / kSteps));
    sum += rise / 6 * (area_at(t0) + 4 * area_at((t0 + t1) / 2) + area_at(t1));
  }
  return sum;
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
  const std::string too_wide = "linear_extrude: round must leave the outline its form: ";
  EXPECT_EQ(message(box(0, 0, 9, 9), rounded(20, 0, 5)),
            too_wide + "5 does not fit, the most that does is about 4.499");
  const Shape2D frame = outlines({box(0, 0, 20, 20).loops()[0], box(6, 6, 14, 14).loops()[0]});
  EXPECT_EQ(message(frame, rounded(20, 4, 0)),
            too_wide + "4 does not fit, the most that does is about 2.999");
  // Walls meet where no edge has vanished: a neck of 2 between two squares.
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
  EXPECT_EQ(message(neck, rounded(20, 0, 2)),
            too_wide + "2 does not fit, the most that does is about 0.999");
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
}  // namespace csgrun
