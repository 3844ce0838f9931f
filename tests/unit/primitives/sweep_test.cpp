// Sweeps and lofts against prisms, tubes and frusta of known volume.
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/sweep.h>
#include <csgrun/primitives/trig.h>

#include "tests/unit/primitives/mesh_measures.h"
#include "tests/unit/primitives/outlines.h"

namespace csgrun::sweep_test {
namespace {

using testing::box;
using testing::euler_number;
using testing::expect_closed;
using testing::outlines;
using testing::volume;

constexpr double kPi = 3.14159265358979323846;

Shape2D disc(double r, int n) { return *make_circle(r, Facets{double(n), 12, 2}); }

PolygonMesh good(const MeshResult& r) {
  EXPECT_TRUE(r) << (r ? "" : r.error().message);
  if (!r) return {};
  expect_closed(*r);
  return *r;
}

PolygonMesh swept(const Shape2D& shape, std::vector<glm::dvec3> path, SweepOptions options = {}) {
  options.path = std::move(path);
  return good(sweep_shape(shape, options));
}

std::string error(const MeshResult& r) { return r ? "no error" : r.error().message; }

std::array<glm::dvec3, 2> bounds(const PolygonMesh& mesh) {
  std::array<glm::dvec3, 2> b{mesh.points[0], mesh.points[0]};
  for (const glm::dvec3& p : mesh.points) {
    for (int k = 0; k < 3; ++k) {
      b[0][k] = std::min(b[0][k], p[k]);
      b[1][k] = std::max(b[1][k], p[k]);
    }
  }
  return b;
}

const Shape2D kSquare = box(-1, -1, 1, 1);

/// A spring about Z: its ribbon's corners are as far from the axis, and as far above and below the
/// path, at its end as at its start.
TEST(Sweep, UprightOnAHelix) {
  constexpr double kRadius = 10, kPitch = 5;
  constexpr int kTurns = 4, kSteps = 64;
  std::vector<glm::dvec3> path;
  for (int i = 0; i <= kTurns * kSteps; ++i) {
    const double turn = double(i) / kSteps;
    path.push_back({kRadius * cos_deg(360 * turn), kRadius * sin_deg(360 * turn), kPitch * turn});
  }
  const Shape2D ribbon = box(-0.25, -1, 0.25, 1);
  const auto reach = [&](const PolygonMesh& mesh) {
    double least = 1e9, most = 0;
    for (const glm::dvec3& p : mesh.points) {
      least = std::min(least, std::hypot(p.x, p.y));
      most = std::max(most, std::hypot(p.x, p.y));
    }
    return most - least;
  };
  const PolygonMesh upright = swept(ribbon, path, {.path = {}, .upright = true});
  EXPECT_NEAR(reach(upright), 0.5, 0.02);
  const auto box = bounds(upright);
  EXPECT_NEAR(box[1].z - box[0].z, kTurns * kPitch + 2, 0.05);
  const double length = kTurns * std::hypot(2 * kPi * kRadius, kPitch);
  // Walls of two triangles bulge: by their height times the roll of a piece / 6, on both sides.
  const double roll = 2 * kPi / kSteps * kPitch / std::hypot(2 * kPi * kRadius, kPitch);
  EXPECT_NEAR(volume(upright), (0.5 + 2 * roll / 6) * 2 * length, 1e-3 * length);
  EXPECT_GT(reach(swept(ribbon, path)), 1.5);  // it leans, and lies flat after some turns
}

TEST(Sweep, UprightIsAsItWasWhereThePathTurnsAboutUp) {
  const std::vector<glm::dvec3> path{{0, 0, 0}, {20, 0, 0}, {20, 10, 0}, {-5, 17, 0}};
  const Shape2D ribbon = box(-0.25, -1, 0.75, 1);
  for (const bool closed : {false, true}) {
    const PolygonMesh plain = swept(ribbon, path, {.path = {}, .closed = closed});
    const PolygonMesh upright =
        swept(ribbon, path, {.path = {}, .closed = closed, .upright = true});
    ASSERT_EQ(plain.points.size(), upright.points.size());
    for (size_t i = 0; i < plain.points.size(); ++i) {
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(plain.points[i][k], upright.points[i][k], 1e-12);
    }
  }
}

/// A ring road that rises and falls: no corner of it may lie higher on one side than on the other.
TEST(Sweep, UprightOnAClosedPath) {
  std::vector<glm::dvec3> path;
  for (int i = 0; i < 120; ++i)
    path.push_back({20 * cos_deg(3 * i), 20 * sin_deg(3 * i), 4 * sin_deg(9 * i)});
  const PolygonMesh mesh =
      swept(box(-2, -0.5, 2, 0.5), path, {.path = {}, .closed = true, .upright = true});
  EXPECT_EQ(euler_number(mesh), 0);
  ASSERT_EQ(mesh.points.size(), 4 * path.size());
  for (size_t i = 0; i < path.size(); ++i) {
    double low = 1e9, high = -1e9;
    for (size_t k = 4 * i; k < 4 * i + 4; ++k) {
      low = std::min(low, mesh.points[k].z);
      high = std::max(high, mesh.points[k].z);
    }
    EXPECT_NEAR((low + high) / 2, path[i].z, 1e-9) << i;
    EXPECT_LT(high - low, 1.8) << i;  // leaning by 45 degrees it is 3.5
  }
}

TEST(Sweep, AlongZIsAnExtrusion) {
  const Shape2D l = outlines({{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}}});
  const PolygonMesh mesh = swept(l, {{0, 0, 0}, {0, 0, 5}});
  EXPECT_NEAR(volume(mesh), 6 * 5, 1e-12);
  EXPECT_EQ(bounds(mesh)[1], glm::dvec3(4, 3, 5));
  LinearExtrudeOptions twisted;
  twisted.height = 5;
  twisted.height_given = true;
  twisted.twist = -70;
  SweepOptions options;
  options.twist = 70;
  const std::vector<glm::dvec3> path{{0, 0, 0}, {0, 0, 5}};
  for (const double fn : {0.0, 12.0, 90.0}) {
    twisted.facets.fn = options.facets.fn = fn;
    // The extrusion scales what is turned, the sweep turns what is scaled: equal if even.
    for (const double scale : {1.0, 0.5}) {
      twisted.scale = options.scale = glm::dvec2(scale);
      const double slices = volume(*linear_extrude(l, twisted));
      EXPECT_NEAR(volume(swept(l, path, options)), slices, 1e-9);
      // All sections are those of no twist: walls bulge less, the finer they are.
      if (fn > 20) {
        EXPECT_NEAR(slices, 6 * 5 * (1 + scale + scale * scale) / 3, 0.05);
      }
    }
  }
}

TEST(Sweep, CornersAreMitred) {
  // The middle of the square runs along the path: every piece is area times length.
  EXPECT_NEAR(volume(swept(kSquare, {{0, 0, 0}, {0, 0, 10}, {20, 0, 10}})), 4 * 30, 1e-9);
  EXPECT_NEAR(volume(swept(kSquare, {{0, 0, 0}, {9, 0, 0}, {14, 5, 0}, {14, 5, 8}})),
              4 * (9 + std::sqrt(50) + 8), 1e-9);
  const PolygonMesh elbow = swept(kSquare, {{0, 0, 0}, {0, 0, 10}, {20, 0, 10}});
  EXPECT_EQ(euler_number(elbow), 2);
  EXPECT_NEAR(bounds(elbow)[0].x, -1, 1e-12);
  EXPECT_NEAR(bounds(elbow)[1].z, 11, 1e-12);
  const Shape2D tube = outlines({kSquare.loops()[0], box(-0.5, -0.5, 0.5, 0.5).loops()[0]});
  EXPECT_EQ(euler_number(swept(tube, {{0, 0, 0}, {0, 0, 10}, {20, 0, 10}})), 0);
  EXPECT_NEAR(volume(swept(tube, {{0, 0, 0}, {0, 0, 10}, {20, 0, 10}})), 3 * 30, 1e-9);
}

TEST(Sweep, ClosedPathsComeHome) {
  SweepOptions closed;
  closed.closed = true;
  const PolygonMesh frame =
      swept(kSquare, {{0, 0, 0}, {20, 0, 0}, {20, 10, 0}, {0, 10, 0}}, closed);
  EXPECT_NEAR(volume(frame), 4 * 60, 1e-9);
  EXPECT_EQ(euler_number(frame), 0);
  closed.twist = 360;
  EXPECT_EQ(euler_number(swept(kSquare, {{0, 0, 0}, {20, 0, 0}, {20, 10, 0}, {0, 10, 0}}, closed)),
            0);
  closed.twist = 0;
  // A saddle: the frame is turned when it comes home, by what the path encloses on the sphere of
  // directions. Fine pieces make the correction smooth, and the volume that of a straight tube.
  std::vector<glm::dvec3> path;
  double length = 0;
  constexpr int kPieces = 360;
  for (int i = 0; i < kPieces; ++i) {
    const double a = 360.0 * i / kPieces;
    path.emplace_back(20 * cos_deg(a), 20 * sin_deg(a), 6 * sin_deg(2 * a) + 3 * sin_deg(3 * a));
    if (i > 0) length += glm::length(path[i] - path[i - 1]);
  }
  length += glm::length(path.back() - path.front());
  const Shape2D round = disc(1.5, 24);
  const PolygonMesh saddle = swept(round, path, closed);
  EXPECT_EQ(euler_number(saddle), 0);
  EXPECT_NEAR(volume(saddle) / (round.area() * length), 1, 1e-4);
}

TEST(Sweep, FramesTurnLeast) {
  // Up, to the side, and forward: the outline's X and Y are carried along without a roll.
  const PolygonMesh mesh = swept(box(0, 0, 2, 1), {{0, 0, 0}, {0, 0, 10}, {10, 0, 10}});
  // Along Z: x is X and y is Y. After the turn to X, x is -Z and y still Y.
  EXPECT_NEAR(bounds(mesh)[0].y, 0, 1e-12);
  EXPECT_NEAR(bounds(mesh)[1].y, 1, 1e-12);
  EXPECT_NEAR(bounds(mesh)[1].z, 10, 1e-12);
  SweepOptions up;
  up.up = glm::dvec3(1, 0, 3);
  const PolygonMesh turned = swept(box(0, 0, 2, 1), {{0, 0, 0}, {0, 0, 10}}, up);
  EXPECT_NEAR(bounds(turned)[1].x, 1, 1e-12);   // y is X
  EXPECT_NEAR(bounds(turned)[0].y, -2, 1e-12);  // x is -Y
  const PolygonMesh level = swept(box(0, 0, 2, 1), {{0, 0, 0}, {0, 5, 0}});
  EXPECT_NEAR(bounds(level)[1].z, 1, 1e-12);
  EXPECT_NEAR(bounds(level)[0].x, -2, 1e-12);
}

TEST(Sweep, HelixHasTheVolumeOfItsLength) {
  std::vector<glm::dvec3> path;
  constexpr int kPieces = 720;
  for (int i = 0; i <= kPieces; ++i) {
    const double a = 3 * 360.0 * i / kPieces;
    path.emplace_back(10 * cos_deg(a), 10 * sin_deg(a), 12.0 * i / kPieces);
  }
  const Shape2D wire = disc(1, 16);
  const double length = std::hypot(3 * 2 * kPi * 10, 12);
  EXPECT_NEAR(volume(swept(wire, path)) / (wire.area() * length), 1, 1e-3);
}

// A pyramid has a third of the prism, holes or not, and one point on top.
TEST(Sweep, MayEndInAPoint) {
  SweepOptions options;
  options.scale = {0, 0};
  const PolygonMesh pyramid = swept(box(-2, -2, 2, 2), {{0, 0, 0}, {0, 0, 9}}, options);
  EXPECT_NEAR(volume(pyramid), 16 * 9 / 3.0, 1e-9);
  EXPECT_EQ(pyramid.points.size(), 5u);
  EXPECT_EQ(pyramid.face_count(), 5u);
  const Shape2D ring = outlines({disc(5, 12).loops()[0], disc(2, 12).loops()[0]});
  EXPECT_NEAR(volume(swept(ring, {{0, 0, 0}, {9, 0, 0}}, options)), ring.area() * 9 / 3, 1e-9);
  // Around a corner: pieces are frusta and a pyramid of a middle along the path.
  EXPECT_EQ(euler_number(swept(kSquare, {{0, 0, 0}, {0, 0, 9}, {9, 0, 18}}, options)), 2);
  options.twist = 90;
  EXPECT_EQ(euler_number(swept(kSquare, {{0, 0, 0}, {0, 0, 9}}, options)), 2);
}

TEST(Sweep, BadInputIsAnError) {
  const auto message = [](std::vector<glm::dvec3> path, bool closed = false, double twist = 0,
                          glm::dvec2 scale = {1, 1}, std::optional<glm::dvec3> up = {}) {
    SweepOptions options;
    options.path = std::move(path);
    options.closed = closed;
    options.twist = twist;
    options.scale = scale;
    options.up = up;
    return error(sweep_shape(kSquare, options));
  };
  EXPECT_EQ(message({{{0, 0, 0}}}), "sweep: the path needs at least 2 different points, got 1");
  EXPECT_EQ(message({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}),
            "sweep: the path needs at least 2 different points, got 1");
  EXPECT_EQ(message({{0, 0, 0}, {0, 0, 1}}, true),
            "sweep: the path needs at least 3 different points, got 2");
  EXPECT_EQ(message({{0, 0, 0}, {0, 0, 5}, {0, 0, 2}}),
            "sweep: the path turns back at its point 1");
  EXPECT_EQ(message({{0, 0, 0}, {0, 0, std::nan("")}}),
            "sweep: point 1 of the path must be finite, got nan");
  EXPECT_EQ(message({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}}, true, 90),
            "sweep: the twist of a closed path must be a multiple of 360, got 90");
  EXPECT_EQ(message({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}}, true, 0, {2, 1}),
            "sweep: a closed path ends as it begins, without a scale");
  EXPECT_EQ(message({{0, 0, 0}, {0, 0, 1}}, false, 0, {0, 1}),
            "sweep: scale must be positive, or 0 both ways, got 0");
  EXPECT_EQ(message({{0, 0, 0}, {0, 0, 1}}, false, 0, {1, 1}, glm::dvec3(0, 0, 2)),
            "sweep: up must not point along the start of the path");
  EXPECT_EQ(
      error(sweep_shape(kSquare, {.path = {{0, 0, 0}, {5, 0, 0}, {5, 0, 7}}, .upright = true})),
      "sweep: an upright shape cannot stand where the path goes along up, at {5, 0, 0}");
  EXPECT_EQ(error(sweep_shape(Shape2D(), SweepOptions())), "sweep: the shape is empty");
}

TEST(Loft, FrustaByFormula) {
  // (A + B + sqrt(A B)) h / 3 for outlines of one form.
  EXPECT_NEAR(volume(good(loft_shapes({box(-5, -5, 5, 5), box(-2, -2, 2, 2)}, {0, 6}))),
              (100 + 16 + 40) * 6 / 3.0, 1e-9);
  for (const int n : {5, 24}) {
    const double a = disc(6, n).area(), b = disc(2, n).area();
    EXPECT_NEAR(volume(good(loft_shapes({disc(6, n), disc(2, n)}, {-1, 8}))),
                (a + b + std::sqrt(a * b)) * 9 / 3, 1e-6);
  }
  // Of three the middle one counts twice.
  EXPECT_NEAR(volume(good(loft_shapes({kSquare, box(-2, -2, 2, 2), kSquare}, {0, 3, 9}))),
              (4 + 16 + 8) * 9 / 3.0, 1e-9);
  // A rectangle to one that lies across: the middle is 2 by 2 of sides 1 and 3.
  const Shape2D flat = box(-3, -1, 3, 1), tall = box(-1, -3, 1, 3);
  EXPECT_NEAR(volume(good(loft_shapes({flat, tall}, {0, 6}))), 6 / 6.0 * (12 + 4 * 16 + 12), 1e-9);
  // Moved aside: the same.
  EXPECT_NEAR(volume(good(loft_shapes({kSquare, box(49, 7, 51, 9)}, {0, 6}))), 24, 1e-9);
}

TEST(Loft, OutlinesOfOtherForms) {
  const PolygonMesh mesh = good(loft_shapes({box(-5, -5, 5, 5), disc(4, 32)}, {0, 10}));
  EXPECT_EQ(mesh.face_count(), 2u + 4 + 32);
  EXPECT_EQ(euler_number(mesh), 2);
  // Symmetric, and between the prisms of the two.
  const auto b = bounds(mesh);
  EXPECT_EQ(b[0], glm::dvec3(-5, -5, 0));
  EXPECT_GT(volume(mesh), 10 * disc(4, 32).area());
  EXPECT_LT(volume(mesh), 10 * 100);
  const Shape2D ring = outlines({disc(5, 12).loops()[0], disc(2, 12).loops()[0]});
  const Shape2D frame = outlines({box(-6, -6, 6, 6).loops()[0], box(-1, -1, 1, 1).loops()[0]});
  EXPECT_EQ(euler_number(good(loft_shapes({ring, frame}, {0, 4}))), 0);
  const Shape2D two = outlines({box(0, 0, 1, 1).loops()[0], box(5, 0, 6, 1).loops()[0]});
  const Shape2D wide = outlines({box(8, 0, 9, 1).loops()[0], box(-3, 0, -2, 1).loops()[0]});
  EXPECT_NEAR(volume(good(loft_shapes({two, wide}, {0, 4}))), 8, 1e-9);
}

TEST(Loft, MayBeginAndEndInPoints) {
  const Shape2D square = box(-2, -2, 2, 2);
  const auto point = [](double x, double y) { return LoftOutline(glm::dvec2(x, y)); };
  const PolygonMesh pyramid = good(loft_shapes({square, point(7, -3)}, {1, 7}));
  EXPECT_NEAR(volume(pyramid), 16 * 6 / 3.0, 1e-9);
  EXPECT_EQ(pyramid.points.size(), 5u);
  EXPECT_NEAR(volume(good(loft_shapes({point(1, 1), square, point(0, 0)}, {-3, 0, 6}))),
              16 * 9 / 3.0, 1e-9);
  // A hole comes to the same point, and so do two pieces.
  const Shape2D ring = outlines({disc(5, 12).loops()[0], disc(2, 12).loops()[0]});
  EXPECT_NEAR(volume(good(loft_shapes({point(0, 0), ring}, {0, 6}))), ring.area() * 2, 1e-9);
  const Shape2D two = outlines({box(0, 0, 1, 1).loops()[0], box(5, 0, 6, 1).loops()[0]});
  EXPECT_NEAR(volume(good(loft_shapes({two, point(3, 0)}, {0, 6}))), 4, 1e-9);
  EXPECT_EQ(error(loft_shapes({point(0, 0), point(1, 0)}, {0, 6})),
            "loft: needs an outline between two points");
  EXPECT_EQ(error(loft_shapes({square, point(0, 0), square}, {0, 6, 9})),
            "loft: only the first or the last outline may be a point, not number 2");
  EXPECT_EQ(error(loft_shapes({square, point(std::nan(""), 0)}, {0, 6})),
            "loft: a point must be finite, got nan");
}

// Rings across a piece would cross the one that lies aslant at its end.
TEST(Sweep, ATwistAroundABendLeavesNoCrumbs) {
  SweepOptions twisted;
  for (const double fn : {30, 90, 200}) {
    for (const double twist : {360, -720}) {
      twisted.twist = twist;
      twisted.facets = {fn, 12, 2};
      for (const Shape2D& shape : {disc(2, 24), outlines({box(-2, -1, 2, 1).loops()[0]})}) {
        const PolygonMesh mesh = swept(shape, {{0, 0, 0}, {0, 0, 20}, {20, 0, 20}}, twisted);
        EXPECT_NEAR(volume(mesh), 40 * shape.area(), 0.004 * 40 * shape.area());
        Evaluator evaluator{EvaluateOptions{}};
        const auto solid =
            evaluator.evaluate(Node::leaf(std::make_shared<PolygonMesh>(mesh), SourceRef{}));
        ASSERT_TRUE(solid);
        EXPECT_EQ((*solid)->measures.components, 1) << fn << ' ' << twist;
        EXPECT_TRUE(evaluator.warnings().empty()) << evaluator.warnings()[0];
      }
    }
  }
}

TEST(Loft, BadInputIsAnError) {
  EXPECT_EQ(error(loft_shapes({kSquare}, {0})), "loft: needs at least two outlines");
  EXPECT_EQ(error(loft_shapes({kSquare, kSquare}, {0})),
            "loft: 2 outlines need as many heights, got 1");
  EXPECT_EQ(error(loft_shapes({kSquare, kSquare}, {3, 3})),
            "loft: heights must increase, got 3 after 3");
  EXPECT_EQ(error(loft_shapes({kSquare, Shape2D()}, {0, 3})), "loft: outline 2 is empty");
  const Shape2D two = outlines({box(0, 0, 1, 1).loops()[0], box(5, 0, 6, 1).loops()[0]});
  EXPECT_EQ(error(loft_shapes({kSquare, two}, {0, 3})),
            "loft: outlines 1 and 2 have not the same numbers of pieces and of holes");
}

}  // namespace
}  // namespace csgrun::sweep_test
