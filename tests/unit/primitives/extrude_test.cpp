#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/shape2d.h>

#include "tests/unit/primitives/mesh_measures.h"
#include "tests/unit/primitives/outlines.h"

namespace csgrun::extrude_test {
namespace {

using Loop = Shape2D::Loop;
using testing::area;
using testing::box;
using testing::euler_number;
using testing::expect_closed;
using testing::outlines;
using testing::volume;

constexpr double kPi = 3.14159265358979323846;

PolygonMesh extruded(const Shape2D& shape, const LinearExtrudeOptions& options) {
  auto r = linear_extrude(shape, options);
  EXPECT_TRUE(r) << (r ? "" : r.error().message);
  if (!r) return {};
  expect_closed(*r);
  return *r;
}

PolygonMesh turned(const Shape2D& shape, const RotateExtrudeOptions& options) {
  auto r = rotate_extrude(shape, options);
  EXPECT_TRUE(r) << (r ? "" : r.error().message);
  if (!r) return {};
  expect_closed(*r);
  return *r;
}

LinearExtrudeOptions height(double h) {
  LinearExtrudeOptions o;
  o.height = h;
  o.height_given = true;
  return o;
}

/// The first moment of the area about the Y axis.
double moment(const Shape2D& shape) {
  double sum = 0;
  for (const Loop& loop : shape.loops()) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec2 p = loop[i], q = loop[(i + 1) % loop.size()];
      sum += (p.x + q.x) * (p.x * q.y - q.x * p.y) / 6;
    }
  }
  return sum;
}

const Shape2D kHoled =
    outlines({{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}});
// Two squares that touch in a corner, and a hole that touches an edge.
const Shape2D kTouching = outlines({{{0, 0}, {2, 0}, {2, 2}, {0, 2}},
                                    {{2, 2}, {4, 2}, {4, 4}, {2, 4}},
                                    {{1, 0}, {1.5, 1}, {0.5, 1}}});

TEST(LinearExtrude, StraightPrismsHaveQuadsAndCaps) {
  const PolygonMesh mesh = extruded(kHoled, height(2.5));
  EXPECT_NEAR(volume(mesh), 11 * 2.5, 1e-12);
  EXPECT_EQ(mesh.face_count(), 10u);
  EXPECT_EQ(euler_number(mesh), 0);
  EXPECT_EQ(std::count(mesh.surface.begin(), mesh.surface.end(), 0u), 10);
  for (const glm::dvec3& p : mesh.points) EXPECT_TRUE(p.z == 0 || p.z == 2.5);
  LinearExtrudeOptions centred = height(2);
  centred.center = true;
  for (const glm::dvec3& p : extruded(kHoled, centred).points) EXPECT_EQ(std::fabs(p.z), 1);
}

TEST(LinearExtrude, TouchingLoopsStayClosed) {
  for (const double twist : {0.0, 30.0}) {
    for (const glm::dvec2 scale : {glm::dvec2(1), glm::dvec2(0.5), glm::dvec2(0), glm::dvec2(2, 1),
                                   glm::dvec2(0, 1), glm::dvec2(1, 0)}) {
      LinearExtrudeOptions o = height(3);
      o.twist = twist;
      o.scale = scale;
      EXPECT_GT(volume(extruded(kTouching, o)), 0);
      EXPECT_GT(volume(extruded(kHoled, o)), 0);
      o.segments = 30;
      EXPECT_GT(volume(extruded(kTouching, o)), 0);
    }
  }
}

TEST(LinearExtrude, DirectionLeans) {
  LinearExtrudeOptions o = height(10);
  o.direction = glm::dvec3(1, 0, 1);
  const PolygonMesh lean = extruded(box(0, 0, 1, 1), o);
  EXPECT_NEAR(volume(lean), std::sqrt(50.0), 1e-12);
  o.height_given = false;
  o.direction = glm::dvec3(1, 0, 2);
  const PolygonMesh own = extruded(box(0, 0, 1, 1), o);
  EXPECT_NEAR(volume(own), 2, 1e-12);
  double x = 0;
  for (const glm::dvec3& p : own.points) x = std::max(x, p.x);
  EXPECT_EQ(x, 2);
}

TEST(LinearExtrude, ScalesToFrustaPointsAndEdges) {
  LinearExtrudeOptions o = height(3);
  o.scale = {0.5, 0.5};
  EXPECT_NEAR(volume(extruded(box(-1, -1, 1, 1), o)), 4 + 1 + 2, 1e-12);
  o.scale = {0, 0};
  const PolygonMesh pyramid = extruded(box(-1, -1, 1, 1), o);
  EXPECT_EQ(pyramid.points.size(), 5u);
  EXPECT_EQ(pyramid.face_count(), 5u);
  EXPECT_NEAR(volume(pyramid), 4, 1e-12);
  // A wedge: the section at height t is 2 (1 - t) by 2, so half of the box.
  o.scale = {1, 0};
  const PolygonMesh wedge = extruded(box(-1, -1, 1, 1), o);
  EXPECT_NEAR(volume(wedge), 6, 1e-12);
  // A triangle collapsed to a segment, with one corner's image inside the edge of the others. Walls
  // are bent surfaces: their facets come nearer with more slices.
  const Shape2D triangle = outlines({{{-1, -1}, {1, -1}, {0.25, 1}}});
  o.slices = 1;
  EXPECT_NEAR(volume(extruded(triangle, o)), 3, 0.2);
  o.slices = 100;
  EXPECT_NEAR(volume(extruded(triangle, o)), 3, 1e-3);
}

TEST(LinearExtrude, EdgesOnTopAreClosed) {
  Affine move;
  move.m[0][3] = 7;
  for (const double fn : {5.0, 8.0, 30.0}) {
    const Shape2D disc = *make_circle(5, Facets{fn, 12, 2});
    const Shape2D ring =
        *Shape2D::boolean(BooleanOp::kDifference, {disc, *make_circle(4, Facets{fn, 12, 2})});
    for (const Shape2D& shape : {disc, ring, *ring.transformed(move), kTouching}) {
      for (const glm::dvec2 scale : {glm::dvec2(1, 0), glm::dvec2(0, 0.5)}) {
        for (const double twist : {0.0, 45.0}) {
          LinearExtrudeOptions o = height(10);
          o.scale = scale;
          o.twist = twist;
          const PolygonMesh mesh = extruded(shape, o);
          Evaluator evaluator{EvaluateOptions{}};
          const auto solid = evaluator.evaluate(Node::leaf(std::make_shared<PolygonMesh>(mesh)));
          ASSERT_TRUE(solid) << fn << ' ' << scale.x << ' ' << twist << ": "
                             << solid.error().message;
          // Turned walls may cross where all of them come together, by next to nothing.
          EXPECT_NEAR((*solid)->measures.volume, volume(mesh),
                      twist == 0 ? 1e-5 : 3e-4 * volume(mesh))
              << fn << ' ' << scale.x << ' ' << twist;
        }
      }
    }
  }
}

TEST(LinearExtrude, WallsToAnEdgeAreCutAsOpenScadCutsThem) {
  LinearExtrudeOptions o = height(3);
  o.twist = 180;
  o.slices = 20;
  o.scale = {0, 1};
  EXPECT_NEAR(volume(extruded(box(-0.5, 0, 1.5, 1), o)), 3.11114516, 1e-6);
  const Shape2D frame = outlines(
      {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}});
  EXPECT_NEAR(volume(extruded(frame, o)), 4.71501095, 1e-6);
}

TEST(LinearExtrude, TwistTurnsClockwiseSeenFromAbove) {
  LinearExtrudeOptions o = height(10);
  o.twist = 90;
  const PolygonMesh mesh = extruded(box(1, -0.1, 2, 0.1), o);
  bool found = false;
  for (const glm::dvec3& p : mesh.points) {
    found = found || (p.z == 10 && std::fabs(p.x - 0.1) < 1e-12 && std::fabs(p.y + 2) < 1e-12);
  }
  EXPECT_TRUE(found);
  // Finer slices come nearer to the volume of the true helicoid, area times height.
  o.facets.fn = 400;
  const Shape2D square = box(-1, -1, 1, 1);
  EXPECT_NEAR(volume(extruded(square, o)), 40, 0.01);
  o.twist = -90;
  EXPECT_NEAR(volume(extruded(square, o)), 40, 0.01);
}

TEST(LinearExtrude, MirrorImagesHaveEqualVolume) {
  // A twist to the left is the mirror image of one to the right: it must be cut the same way.
  Affine mirror;
  mirror.m[1][1] = -1;
  for (const Shape2D& shape : {kHoled, kTouching, box(-2, -1, 2, 1), box(0, 0, 3, 3)}) {
    const Shape2D mirrored = *shape.transformed(mirror);
    for (const double top : {1.0, 0.3, 2.0, 0.0}) {
      LinearExtrudeOptions o = height(7);
      o.twist = 50;
      o.scale = {top, top};
      LinearExtrudeOptions back = o;
      back.twist = -50;
      EXPECT_NEAR(volume(extruded(shape, o)), volume(extruded(mirrored, back)), 1e-9);
    }
  }
}

TEST(LinearExtrude, SlicesFollowTheRules) {
  auto slices = [](const LinearExtrudeOptions& o, const Shape2D& shape) {
    std::set<double> z;
    for (const glm::dvec3& p : extruded(shape, o).points) z.insert(p.z);
    return static_cast<int>(z.size()) - 1;
  };
  const Shape2D square = box(-5, -5, 5, 5);
  LinearExtrudeOptions o = height(20);
  EXPECT_EQ(slices(o, square), 1);
  o.twist = 90;  // min(90/12, helix of about 22.9/2) = 8
  EXPECT_EQ(slices(o, square), 8);
  o.facets.fs = 10;  // ceil(22.8 / 10) = 3
  EXPECT_EQ(slices(o, square), 3);
  o.facets.fn = 17;
  EXPECT_EQ(slices(o, square), 5);
  o.slices = 4;
  EXPECT_EQ(slices(o, square), 4);
  LinearExtrudeOptions uneven = height(12);
  uneven.scale = {2, 1};  // sqrt(25 + 144) / 2
  EXPECT_EQ(slices(uneven, square), 7);
  uneven.facets.fn = 3;
  EXPECT_EQ(slices(uneven, square), 3);
  // Archimedes' spiral from radius 10 to 5 over a quarter turn, unrolled over a height of 1.
  LinearExtrudeOptions cone = height(1);
  cone.twist = 90;
  cone.scale = {0.5, 0.5};
  cone.facets = {0, 0.01, 0.5};
  double length = 0;
  for (int i = 0; i < 100000; ++i) {
    const double r = 10 - 5 * (i + 0.5) / 100000;
    length += std::hypot(5.0 / 100000, r * kPi / 2 / 100000);
  }
  EXPECT_EQ(slices(cone, box(-6, -8, 6, 8)), std::ceil(std::hypot(length, 1) / 0.5));
}

TEST(LinearExtrude, SegmentsSplitOutlines) {
  LinearExtrudeOptions o = height(20);
  o.twist = 10;
  o.slices = 1;
  const Shape2D square = box(-5, -5, 5, 5);
  auto outline = [&] { return extruded(square, o).points.size() / 2; };
  EXPECT_EQ(outline(), 20u);  // ceil(10/2) pieces an edge
  o.segments = 0;
  EXPECT_EQ(outline(), 4u);
  // As many as there may be, with as many on each of four equal edges.
  o.segments = 10;
  EXPECT_EQ(outline(), 8u);
  o.segments = 12;
  EXPECT_EQ(outline(), 12u);
  o.segments.reset();
  o.facets.fn = 7;
  EXPECT_EQ(outline(), 4u);
  o.facets.fn = 8.9;
  EXPECT_EQ(outline(), 8u);
  o.facets = {0, 12, 0.1};  // 400 by length, but no more than 360 / 12
  EXPECT_EQ(outline(), 28u);
}

TEST(LinearExtrude, SegmentsGoWhereThePiecesAreLongest) {
  // Edges of 10 and 4: 10/1.5, 10/1.5, then 10/2.5 before 4/1.5.
  LinearExtrudeOptions o = height(20);
  o.twist = 10;
  o.slices = 1;
  for (const auto& [segments, by_length, by_width] :
       {std::tuple{6, 2, 1}, std::tuple{8, 3, 1}, std::tuple{10, 4, 1}, std::tuple{12, 4, 2}}) {
    o.segments = segments;
    EXPECT_EQ(extruded(box(-5, -2, 5, 2), o).points.size() / 2,
              static_cast<size_t>(2 * (by_length + by_width)))
        << segments;
  }
}

TEST(LinearExtrude, TheLeanOfTheAxisCutsNoWallInAnotherWay) {
  // Upright and leaning extrusions are slices of the same areas: they have one volume.
  LinearExtrudeOptions upright = height(10), leaning = height(10);
  upright.twist = leaning.twist = 40;
  leaning.direction = glm::dvec3(3, -2, 1);
  leaning.height = 10 * std::sqrt(14.0);
  leaning.height_given = true;
  for (const glm::dvec2 scale : {glm::dvec2(1, 1), glm::dvec2(2, 0.5)}) {
    upright.scale = leaning.scale = scale;
    EXPECT_NEAR(volume(extruded(kHoled, leaning)), volume(extruded(kHoled, upright)), 1e-9);
  }
}

TEST(LinearExtrude, RoundOutlinesAreOneSurface) {
  const Shape2D circle = *make_circle(5, Facets{32, 12, 2});
  const PolygonMesh rod = extruded(circle, height(2));
  EXPECT_EQ(std::count(rod.surface.begin(), rod.surface.end(), 1u), 32);
  const PolygonMesh nut = extruded(*make_circle(5, Facets{8, 12, 2}), height(2));
  EXPECT_EQ(std::count(nut.surface.begin(), nut.surface.end(), 0u), 10);
  LinearExtrudeOptions o = height(5);
  o.twist = 45;
  const PolygonMesh twisted = extruded(box(-1, -1, 1, 1), o);
  EXPECT_EQ(std::set<uint32_t>(twisted.surface.begin(), twisted.surface.end()),
            (std::set<uint32_t>{0, 1, 2, 3, 4}));
}

TEST(LinearExtrude, BadOptionsAreErrors) {
  auto message = [](const LinearExtrudeOptions& o) {
    const auto r = linear_extrude(box(0, 0, 1, 1), o);
    return r ? std::string("no error") : r.error().message;
  };
  EXPECT_EQ(message(height(-1)), "linear_extrude: height must be positive, got -1");
  EXPECT_EQ(message(height(std::nan(""))), "linear_extrude: height must be finite, got nan");
  LinearExtrudeOptions o = height(1);
  o.direction = glm::dvec3(1, 0, 0);
  EXPECT_EQ(message(o), "linear_extrude: v.z must be positive, got 0");
  o = height(1);
  o.scale.y = -1;
  EXPECT_EQ(message(o), "linear_extrude: scale.y must not be negative, got -1");
  o = height(1);
  o.slices = 0;
  EXPECT_EQ(message(o), "linear_extrude: slices must be positive, got 0");
  o = height(1);
  o.twist = 1e12;
  EXPECT_EQ(linear_extrude(box(0, 0, 1, 1), o).error().code, ErrorCode::kLimit);
  EXPECT_EQ(linear_extrude(Shape2D(), height(1)).error().message,
            "linear_extrude: the shape is empty");
}

TEST(RotateExtrude, FullTurnsFollowPappus) {
  for (int n = 3; n <= 40; ++n) {
    const RotateExtrudeOptions o{360, 180, Facets{double(n), 12, 2}};
    const Shape2D off = box(1, 0, 3, 2);
    const double factor = n * std::sin(2 * kPi / n);
    const PolygonMesh ring = turned(off, o);
    EXPECT_NEAR(volume(ring), factor * moment(off), 1e-10);
    EXPECT_EQ(euler_number(ring), 0);
    const Shape2D cone = outlines({{{0, 0}, {2, 0}, {0, 3}}});
    const PolygonMesh solid = turned(cone, o);
    EXPECT_NEAR(volume(solid), factor * moment(cone), 1e-10);
    EXPECT_EQ(solid.points.size(), static_cast<size_t>(n + 2));
    EXPECT_EQ(euler_number(solid), 2);
    EXPECT_NEAR(volume(turned(kHoled, o)), factor * moment(kHoled), 1e-9);
    EXPECT_NEAR(volume(turned(kTouching, o)), factor * moment(kTouching), 1e-9);
  }
}

TEST(RotateExtrude, PartsOfATurnHaveCaps) {
  Affine mirror;
  mirror.m[0][0] = -1;
  for (const double angle : {90.0, -90.0, 200.0, -359.0, 1.0}) {
    for (const Shape2D& shape : {box(0, 0, 2, 1), box(1, -1, 2, 1), kHoled, kTouching}) {
      const RotateExtrudeOptions o{angle, 17, Facets{}};
      const double r = shape.bounds()[1].x;
      const int k = Facets{}.fragments(r, angle);
      const double expected = k * std::sin(std::fabs(angle) / k * kPi / 180) * moment(shape);
      EXPECT_NEAR(volume(turned(shape, o)), expected, 1e-10) << angle;
      EXPECT_NEAR(volume(turned(*shape.transformed(mirror), o)), expected, 1e-10) << angle;
    }
  }
}

TEST(RotateExtrude, PositionsAndStart) {
  const PolygonMesh mesh = turned(box(1, 0, 2, 1), {90, 0, Facets{4, 12, 2}});
  EXPECT_EQ(mesh.points.size(), 8u);
  for (const glm::dvec3& p : mesh.points) {
    EXPECT_TRUE((p.y == 0 && p.x >= 1) || (p.x == 0 && p.y >= 1));
  }
  EXPECT_NEAR(area(mesh), 1 + 1 + 2 * 1.5 + std::sqrt(2.0) + 2 * std::sqrt(2.0), 1e-12);
}

TEST(RotateExtrude, SurfacesFollowTheProfile) {
  const PolygonMesh tube = turned(box(1, 0, 2, 1), {360, 0, Facets{32, 12, 2}});
  EXPECT_EQ(std::count(tube.surface.begin(), tube.surface.end(), 0u), 64);
  EXPECT_EQ(std::set<uint32_t>(tube.surface.begin(), tube.surface.end()).size(), 3u);
  const Shape2D circle = *make_circle(1, Facets{32, 12, 2});
  Affine move;
  move.m[0][3] = 5;
  const PolygonMesh torus = turned(*circle.transformed(move), {360, 0, Facets{32, 12, 2}});
  EXPECT_EQ(std::count(torus.surface.begin(), torus.surface.end(), 1u), 32 * 32);
}

TEST(RotateExtrude, BadInputIsAnError) {
  auto message = [](const Shape2D& shape, const RotateExtrudeOptions& o) {
    const auto r = rotate_extrude(shape, o);
    return r ? std::string("no error") : r.error().message;
  };
  EXPECT_EQ(
      message(box(-1, 0, 2, 1), {}),
      "rotate_extrude: the shape must lie on one side of the Y axis, its x runs from -1 to 2");
  EXPECT_EQ(message(box(1, 0, 2, 1), {0, 0, {}}), "rotate_extrude: angle must not be 0");
  EXPECT_EQ(message(box(1, 0, 2, 1), {std::nan(""), 0, {}}),
            "rotate_extrude: angle must be finite, got nan");
  EXPECT_EQ(message(Shape2D(), {}), "rotate_extrude: the shape is empty");
}

// (a - b) + (a & b) has corners beside the edges of a, where these cross those of b: none of a's.
TEST(LinearExtrude, NoiseOfBooleansBendsNoWalls) {
  const Shape2D a = *Shape2D::from_outlines({{{1, 0}, {10, 3}, {2, 7}}});
  LinearExtrudeOptions twisted = height(5), uneven = height(5);
  twisted.twist = 90;
  twisted.slices = 4;
  uneven.scale = {2, 0.5};
  size_t noisy = 0;
  for (int i = 0; i < 40; ++i) {
    Affine place;
    const double c = std::cos(0.1 * i), n = std::sin(0.1 * i);
    place.m[0] = {c, -n, 0, 2 + 0.13 * i};
    place.m[1] = {n, c, 0, 1};
    const Shape2D b = *make_square({5, 3})->transformed(place);
    const Shape2D parts[] = {*Shape2D::boolean(BooleanOp::kDifference, {a, b}),
                             *Shape2D::boolean(BooleanOp::kIntersection, {a, b})};
    const Shape2D both = *Shape2D::boolean(BooleanOp::kUnion, {parts[0], parts[1]});
    noisy += both.loops()[0].size() > 3;
    for (const LinearExtrudeOptions& options : {twisted, uneven}) {
      const PolygonMesh mesh = extruded(both, options), truth = extruded(a, options);
      EXPECT_EQ(mesh.face_count(), truth.face_count()) << i;
      EXPECT_NEAR(volume(mesh), volume(truth), 1e-5) << i;
    }
  }
  EXPECT_GT(noisy, 5u);
}

// A corner in which a hole touches an edge stays, also where it is straight.
TEST(LinearExtrude, StraightCornersInWhichOutlinesTouchStay) {
  const Shape2D plate = *make_square({10, 10});
  const Shape2D hole = *Shape2D::from_outlines({{{5, 0}, {7, 3}, {3, 3}}});
  const Shape2D shape = *Shape2D::boolean(BooleanOp::kDifference, {plate, hole});
  LinearExtrudeOptions options = height(2);
  options.twist = 30;
  options.slices = 3;
  const auto mesh = linear_extrude(shape, options);
  ASSERT_TRUE(mesh);
  std::set<std::pair<double, double>> bottom;
  for (const glm::dvec3& p : mesh->points) {
    if (p.z == 0) bottom.emplace(p.x, p.y);
  }
  EXPECT_TRUE(bottom.count({5, 0}));
}

}  // namespace
}  // namespace csgrun::extrude_test
