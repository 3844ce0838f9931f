// Roofs against distances: from the outline (voronoi), and of the larger coordinate (straight, over
// outlines along the axes, where that is what a straight skeleton measures).
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <csgrun/primitives/roof.h>
#include <csgrun/primitives/shape_operations.h>
#include <csgrun/primitives/trig.h>

#include "tests/support/seeded.h"
#include "tests/unit/primitives/mesh_measures.h"
#include "tests/unit/primitives/outlines.h"

namespace csgrun::roof_test {
namespace {

using testing::area;
using testing::box;
using testing::expect_closed;
using testing::good;
using testing::outlines;
using testing::volume;

constexpr RoofMethod kBoth[] = {RoofMethod::kVoronoi, RoofMethod::kStraight};

PolygonMesh roof(const Shape2D& shape, RoofMethod method, double fn = 0) {
  RoofOptions options;
  options.method = method;
  options.facets.fn = fn;
  MeshResult mesh = make_roof(shape, options);
  EXPECT_TRUE(mesh) << (mesh ? "" : mesh.error().message);
  if (!mesh) return {};
  expect_closed(*mesh);
  return *std::move(mesh);
}

Shape2D difference(const Shape2D& a, const Shape2D& b) {
  return good(Shape2D::boolean(BooleanOp::kDifference, {a, b}));
}
Shape2D sum(const std::vector<Shape2D>& all) {
  return good(Shape2D::boolean(BooleanOp::kUnion, all));
}

/// How high the roof is over a point in general position; fans of faces with signs need no
/// triangulation.
double height(const PolygonMesh& mesh, const glm::dvec2& p) {
  double sum = 0;
  testing::for_each_face(mesh, [&](size_t, const auto& loops) {
    if (testing::vector_area2(mesh, loops).z <= 0) return;
    const auto& loop = loops[0];
    for (size_t i = 1; i + 1 < loop.size(); ++i) {
      const glm::dvec3 &a = mesh.points[loop[0]], &b = mesh.points[loop[i]],
                       &c = mesh.points[loop[i + 1]];
      const auto side = [&](const glm::dvec3& s, const glm::dvec3& t) {
        return (t.x - s.x) * (p.y - s.y) - (t.y - s.y) * (p.x - s.x);
      };
      const double u = side(b, c), v = side(c, a), w = side(a, b);
      if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) continue;
      sum += (u * a.z + v * b.z + w * c.z) / (u + v + w) * (u > 0 ? 1 : -1);
    }
  });
  return sum;
}

/// The least distance from the outline.
template <class Norm>
double distance(const Shape2D& shape, const glm::dvec2& p, Norm norm) {
  double least = std::numeric_limits<double>::infinity();
  for (const Shape2D::Loop& loop : shape.loops()) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec2 a = loop[i], d = loop[(i + 1) % loop.size()] - a;
      const double at = std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0);
      least = std::min(least, norm(p - a - at * d));
    }
  }
  return least;
}
double euclidean(const glm::dvec2& v) { return std::sqrt(glm::dot(v, v)); }
double larger(const glm::dvec2& v) { return std::max(std::fabs(v.x), std::fabs(v.y)); }

template <class Norm>
void expect_heights(const PolygonMesh& mesh, const Shape2D& shape, Norm norm, double tolerance,
                    test::Random& random) {
  const auto [low, high] = shape.bounds();
  int inside = 0;
  for (int i = 0; i < 200; ++i) {
    const glm::dvec2 p(low.x + (high.x - low.x) * random.unit(),
                       low.y + (high.y - low.y) * random.unit());
    if (!shape.contains(p)) continue;
    ++inside;
    EXPECT_NEAR(height(mesh, p), distance(shape, p, norm), tolerance) << p.x << ' ' << p.y;
  }
  EXPECT_GT(inside, 0);
}

TEST(Roof, OfARectangleIsAHip) {
  const double a = 10.1, b = 20.3;
  for (const RoofMethod method : kBoth) {
    const PolygonMesh mesh = roof(good(make_square({a, b})), method);
    EXPECT_EQ(mesh.face_count(), 5u);
    EXPECT_EQ(mesh.points.size(), 6u);
    EXPECT_NEAR(volume(mesh), a * a * (b - a) / 4 + a * a * a / 6, 1e-6);
    EXPECT_NEAR(area(mesh), a * b * (1 + std::sqrt(2)), 1e-6);
  }
}

TEST(Roof, OfAPolygonAroundACircleIsAPyramid) {
  for (const int n : {3, 4, 5, 7, 12, 100, 128, 500}) {
    const Shape2D shape = good(make_circle(10, {double(n), 12, 2}));
    const double inner = 10 * cos_deg(180.0 / n);
    for (const RoofMethod method : kBoth) {
      const PolygonMesh mesh = roof(shape, method);
      EXPECT_NEAR(volume(mesh) / (shape.area() * inner / 3), 1, 1e-6) << n;
      // All edges meet at once, and exactly.
      EXPECT_EQ(mesh.points.size(), size_t(n) + 1) << "the apex is one point";
    }
  }
}

TEST(Roof, OfAnLShape) {
  const Shape2D shape = sum({box(0, 0, 20, 10), box(0, 0, 10, 20)});
  // Two hips of width 10, joined: prisms of 25 mm^2 along 10 mm each, half pyramids at the ends,
  // and mitres at the corner.
  const PolygonMesh straight = roof(shape, RoofMethod::kStraight);
  EXPECT_NEAR(volume(straight), 2 * (25 * 15.0 - 125.0 / 3), 1e-9);
  EXPECT_NEAR(area(straight), shape.area() * (1 + std::sqrt(2)), 1e-9);
  EXPECT_EQ(straight.face_count(), 7u);
  // The cone takes the place of the two planes that meet over the inner corner.
  const PolygonMesh round = roof(shape, RoofMethod::kVoronoi, 256);
  EXPECT_GT(volume(round), volume(straight) + 5);
  const double top = 10 / (1 + std::sqrt(0.5));
  double highest = 0;
  for (const glm::dvec3& p : round.points) highest = std::max(highest, p.z);
  EXPECT_NEAR(highest, top, 1e-6);  // as far from the corner as from both outer walls
}

TEST(Roof, OfARingHasEavesInside) {
  const Shape2D shape = difference(box(-15, -15, 15, 15), box(-5, -5, 5, 5));
  const PolygonMesh straight = roof(shape, RoofMethod::kStraight);
  EXPECT_NEAR(volume(straight), 20 * 4 * 25, 1e-9);  // its ridge is a square of 20 mm
  EXPECT_EQ(testing::euler_number(straight), 0);
  EXPECT_EQ(testing::euler_number(roof(shape, RoofMethod::kVoronoi, 64)), 0);
}

TEST(Roof, OfOutlinesThatTouchIsTheirOwn) {
  const Shape2D shape = sum({box(0, 0, 10, 10), box(10, 10, 20, 20)});
  const Shape2D holed = difference(box(0, 0, 20, 20), box(0, 0, 10, 10));
  const Shape2D pinched =
      difference(difference(box(0, 0, 40, 40), box(10, 10, 20, 20)), box(20, 20, 30, 30));
  for (const RoofMethod method : kBoth) {
    EXPECT_NEAR(volume(roof(shape, method)), 2 * 1000.0 / 6, 1e-9);
    EXPECT_GT(volume(roof(holed, method)), 0);
    EXPECT_GT(volume(roof(pinched, method)), 0);
  }
  test::Random random(7);
  expect_heights(roof(pinched, RoofMethod::kStraight), pinched, larger, 1e-6, random);
}

TEST(Roof, VoronoiIsTheDistanceFromTheOutline) {
  test::Random random(11);
  for (int round = 0; round < 40; ++round) {
    // A star with holes; corners that point inwards, and some that face each other.
    std::vector<Shape2D::Loop> loops(1);
    const int corners = 5 + round % 9;
    for (int i = 0; i < corners; ++i) {
      const double r = 4 + 16 * random.unit(), turn = (i + 0.8 * random.unit()) * 360 / corners;
      loops[0].emplace_back(r * cos_deg(turn), r * sin_deg(turn));
    }
    Shape2D shape = difference(outlines(loops), good(make_circle(2, {5, 12, 2})));
    if (round % 2 == 1) shape = difference(shape, box(3, 3, 5 + random.unit(), 4));
    expect_heights(roof(shape, RoofMethod::kVoronoi, 2000), shape, euclidean, 2e-4, random);
  }
}

TEST(Roof, WithoutDivisionBordersBetweenCornersAreStraight) {
  // Two corners that face each other at 4 mm: OpenSCAD's roof runs level between them.
  const Shape2D shape = outlines({{{-10, -10},
                                   {-2, -10},
                                   {0, -2},
                                   {2, -10},
                                   {10, -10},
                                   {10, 10},
                                   {2, 10},
                                   {0, 2},
                                   {-2, 10},
                                   {-10, 10}}});
  RoofOptions options;
  options.facets.fn = 500;
  test::Random random(3);
  expect_heights(*make_roof(shape, options), shape, euclidean, 1e-3, random);
  EXPECT_NEAR(height(*make_roof(shape, options), {1e-4, 1e-5}), 2, 1e-2);
  options.divide_between_corners = false;
  EXPECT_GT(height(*make_roof(shape, options), {1e-4, 1e-5}), 2.5);
}

TEST(Roof, StraightOverOutlinesAlongTheAxesIsTheLargerDistance) {
  test::Random random(13);
  for (int round = 0; round < 150; ++round) {
    Shape2D shape;
    for (int i = 0; i < 3 + round % 8; ++i) {
      const auto whole = [&](int most) { return std::floor(random.unit() * most); };
      const double x = whole(20), y = whole(20);
      const Shape2D piece = box(x, y, x + 1 + whole(14), y + 1 + whole(14));
      shape = i % 3 == 2 ? difference(shape, piece) : sum({shape, piece});
    }
    if (shape.empty()) continue;
    const PolygonMesh mesh = roof(shape, RoofMethod::kStraight);
    expect_heights(mesh, shape, larger, 1e-6, random);
    EXPECT_NEAR(area(mesh) / (shape.area() * (1 + std::sqrt(2))), 1, 1e-9);
  }
}

TEST(Roof, IsTheDistanceFromTheOutlineWhereNothingPointsInwards) {
  test::Random random(17);
  for (int round = 0; round < 40; ++round) {
    Shape2D::Loop points;
    for (int i = 0; i < 12; ++i) points.emplace_back(20 * random.unit(), 20 * random.unit());
    const Shape2D shape = good(hull_of_shapes({outlines({{points[0], points[1], points[2]}}),
                                               outlines({{points[3], points[4], points[5]}})}));
    for (const RoofMethod method : kBoth) {
      expect_heights(roof(shape, method), shape, euclidean, 1e-6, random);
    }
  }
}

TEST(Roof, StraightHasSlopeOneEverywhere) {
  test::Random random(19);
  for (int round = 0; round < 60; ++round) {
    Shape2D shape;
    for (int i = 0; i < 6; ++i) {
      Affine place;
      const double turn = round % 2 == 0 ? 45 * i : 360 * random.unit();
      place.m[0] = {cos_deg(turn), -sin_deg(turn), 0, std::floor(12 * random.unit())};
      place.m[1] = {sin_deg(turn), cos_deg(turn), 0, std::floor(12 * random.unit())};
      const Shape2D piece = good(good(make_square({1 + 8 * random.unit(), 5})).transformed(place));
      shape = i % 3 == 2 ? difference(shape, piece) : sum({shape, piece});
    }
    if (shape.empty()) continue;
    const PolygonMesh mesh = roof(shape, RoofMethod::kStraight);
    EXPECT_NEAR(area(mesh) / (shape.area() * (1 + std::sqrt(2))), 1, 1e-6) << round;
  }
}

TEST(Roof, RefusesWhatItCannotDo) {
  EXPECT_EQ(make_roof(Shape2D(), {}).error().message, "roof: the shape is empty");
  RoofOptions options;
  options.facets.fa = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(make_roof(box(0, 0, 1, 1), options).error().message,
            "roof: fa must be finite, got nan");
  options = {};
  options.facets.fn = 1e12;
  const Shape2D ell = sum({box(0, 0, 20, 10), box(0, 0, 10, 20)});
  EXPECT_EQ(make_roof(ell, options).error().code, ErrorCode::kLimit);
  EXPECT_EQ(make_roof(ell, options).error().message,
            "roof: its curved faces would have more than 16777216 points, which is the limit; take "
            "fewer facets (fn, fa, fs)");
  options = {};
  options.method = RoofMethod::kStraight;
  const Shape2D round = good(make_circle(10, {10001, 12, 2}));
  EXPECT_EQ(make_roof(round, options).error().message,
            "roof: method \"straight\" takes up to 10000 edges, got 10001");
}

}  // namespace
}  // namespace csgrun::roof_test
