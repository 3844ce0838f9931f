#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <csgrun/primitives/solids.h>

#include "tests/unit/primitives/mesh_measures.h"

namespace csgrun::solids_test {
namespace {

using testing::area;
using testing::euler_number;
using testing::expect_closed;
using testing::volume;

constexpr double kPi = 3.14159265358979323846;
const double kInf = std::numeric_limits<double>::infinity();

Facets fn(double n) { return Facets{n, 12, 2}; }

/// Area of the regular n-gon inscribed in a circle.
double ngon(int n, double r) { return 0.5 * n * r * r * std::sin(2 * kPi / n); }

TEST(Facets, FollowOpenScad) {
  EXPECT_EQ(Facets{}.fragments(1), 5);
  EXPECT_EQ(Facets{}.fragments(5), 16);
  EXPECT_EQ(Facets{}.fragments(100), 30);
  EXPECT_EQ(fn(4.2).fragments(1), 5);
  EXPECT_EQ(fn(1).fragments(1), 3);
  EXPECT_EQ(fn(100).fragments(1), 100);
  EXPECT_EQ(fn(100).fragments(1, 90), 25);
  EXPECT_EQ(fn(10).fragments(1, -45), 2);
  EXPECT_EQ(fn(-3).fragments(1), 5);
  EXPECT_EQ(fn(kInf).fragments(1), 3);
  EXPECT_EQ(fn(100).fragments(0x1p-21), 3);
  EXPECT_EQ((Facets{0, 0, 0.5}.fragments(10)), 126);
  EXPECT_EQ((Facets{0, 0.001, 0.001}.fragments(1e6)), 36000);
}

// OpenSCAD's $fe: as few sides as stay so near to the circle.
TEST(Facets, ByError) {
  const auto with = [](double fe) { return Facets{0, 12, 2, fe}; };
  for (const double r : {0.7, 5.0, 100.0}) {
    for (const double fe : {0.001, 0.01, 0.1}) {
      const auto error = [&](int n) { return r * (1 - std::cos(kPi / n)); };
      const int n = with(fe).fragments(r);
      EXPECT_LE(error(n), fe) << r << ' ' << fe;
      EXPECT_TRUE(n == 5 || error(n - 1) > fe) << r << ' ' << fe;
    }
  }
  EXPECT_EQ(with(0.01).fragments(5), 50);
  EXPECT_EQ(with(0.01).fragments(5, 90), 13);
  EXPECT_EQ(with(0.01).fragments(5, 36), 5);
  EXPECT_EQ(with(1).fragments(1), 5);
  EXPECT_EQ(with(3).fragments(1, 144), 2);
  EXPECT_EQ(with(1e-6).fragments(100), 22215);
  EXPECT_EQ(with(1e-6).fragments(1000), 36000);  // what the least $fa gives
  EXPECT_EQ(with(1e-7).fragments(5), 16);        // too little to count
  EXPECT_EQ(with(-1).fragments(5), 16);
  EXPECT_EQ(with(kInf).fragments(5), 3);
  EXPECT_EQ((Facets{7, 12, 2, 0.01}.fragments(5)), 7);
}

TEST(Cube, HasItsCornersAndOutwardFaces) {
  const auto cube = make_cube({1, 2, 3});
  ASSERT_TRUE(cube);
  expect_closed(*cube);
  EXPECT_EQ(cube->points.size(), 8u);
  EXPECT_EQ(cube->face_count(), 6u);
  EXPECT_EQ(volume(*cube), 6);
  EXPECT_EQ(area(*cube), 22);
  const auto centred = make_cube({1, 2, 3}, {true, false, true});
  ASSERT_TRUE(centred);
  for (const glm::dvec3& p : centred->points) {
    EXPECT_EQ(std::fabs(p.x), 0.5);
    EXPECT_TRUE(p.y == 0 || p.y == 2);
    EXPECT_EQ(std::fabs(p.z), 1.5);
  }
}

TEST(Sphere, IsAStackOfRings) {
  for (int n = 3; n <= 40; ++n) {
    const auto sphere = make_sphere(2, fn(n));
    ASSERT_TRUE(sphere);
    expect_closed(*sphere);
    EXPECT_EQ(euler_number(*sphere), 2);
    const int rings = (n + 1) / 2;
    ASSERT_EQ(sphere->points.size(), static_cast<size_t>(n * rings));
    // Frusta between similar rings: h/3 (A1 + A2 + sqrt(A1 A2)).
    double expected = 0;
    for (int i = 0; i + 1 < rings; ++i) {
      const double a = kPi * (i + 0.5) / rings, b = kPi * (i + 1.5) / rings;
      const double r1 = 2 * std::sin(a), r2 = 2 * std::sin(b);
      expected += 2 * (std::cos(a) - std::cos(b)) / 3 *
                  (ngon(n, r1) + ngon(n, r2) + std::sqrt(ngon(n, r1) * ngon(n, r2)));
    }
    EXPECT_NEAR(volume(*sphere), expected, 1e-12 * expected);
  }
  const auto four = make_sphere(1, fn(4));
  ASSERT_TRUE(four);
  EXPECT_EQ(four->points[0], glm::dvec3(std::sqrt(0.5), 0, std::sqrt(0.5)));
  EXPECT_EQ(four->points[5], glm::dvec3(0, std::sqrt(0.5), -std::sqrt(0.5)));
}

TEST(Cylinder, ConesCollapseAndFrustaDoNot) {
  const auto cylinder = make_cylinder(3, 2, 2, true, fn(8));
  ASSERT_TRUE(cylinder);
  expect_closed(*cylinder);
  EXPECT_EQ(euler_number(*cylinder), 2);
  EXPECT_NEAR(volume(*cylinder), 3 * ngon(8, 2), 1e-12);
  EXPECT_EQ(cylinder->points[2], glm::dvec3(0, 2, -1.5));
  EXPECT_EQ(cylinder->face_count(), 10u);
  for (const auto& [r1, r2] : {std::pair{2.0, 0.0}, std::pair{0.0, 2.0}}) {
    const auto cone = make_cylinder(3, r1, r2, false, fn(8));
    ASSERT_TRUE(cone);
    expect_closed(*cone);
    EXPECT_EQ(cone->points.size(), 9u);
    EXPECT_NEAR(volume(*cone), ngon(8, 2), 1e-12);
  }
  const auto frustum = make_cylinder(3, 1, 2, false, fn(8));
  ASSERT_TRUE(frustum);
  expect_closed(*frustum);
  EXPECT_NEAR(volume(*frustum), ngon(8, 1) + ngon(8, 2) + std::sqrt(ngon(8, 1) * ngon(8, 2)),
              1e-12);
}

TEST(Cylinder, OnlyManyFacetsAreShadedRound) {
  const auto nut = make_cylinder(1, 1, 1, false, fn(6));
  const auto rod = make_cylinder(1, 1, 1, false, fn(32));
  ASSERT_TRUE(nut && rod);
  EXPECT_EQ(std::count(nut->surface.begin(), nut->surface.end(), 0u), 8);
  EXPECT_EQ(std::count(rod->surface.begin(), rod->surface.end(), 1u), 32);
}

TEST(Solids, BadSizesAreErrorsThatNameTheArgument) {
  const double nan = std::nan("");
  auto message = [](const MeshResult& r) {
    return r ? std::string("no error") : r.error().message;
  };
  EXPECT_EQ(message(make_cube({1, 0, 1})), "cube: size.y must be positive, got 0");
  EXPECT_EQ(message(make_cube({nan, 1, 1})), "cube: size.x must be finite, got nan");
  EXPECT_EQ(message(make_cube({1, 1, -kInf})), "cube: size.z must be finite, got -inf");
  EXPECT_EQ(message(make_sphere(-1.5, {})), "sphere: r must be positive, got -1.5");
  EXPECT_EQ(message(make_cylinder(-1, 1, 1, false, {})), "cylinder: h must be positive, got -1");
  EXPECT_EQ(message(make_cylinder(1, -1, 1, false, {})),
            "cylinder: r1 must not be negative, got -1");
  EXPECT_EQ(message(make_cylinder(1, 0, 0, false, {})), "cylinder: r1 and r2 must not both be 0");
  EXPECT_EQ(message(make_sphere(1, fn(nan))), "sphere: fn must be finite, got nan");
  const auto huge = make_sphere(1, fn(1e6));
  ASSERT_FALSE(huge);
  EXPECT_EQ(huge.error().code, ErrorCode::kLimit);
}

const std::vector<glm::dvec3> kTetraPoints{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
// Clockwise from outside.
const std::vector<std::vector<uint32_t>> kTetraFaces{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};

TEST(Polyhedron, IsReversedWeldedAndTurned) {
  std::string note;
  const auto tetra = make_polyhedron(kTetraPoints, kTetraFaces, &note);
  ASSERT_TRUE(tetra) << tetra.error().message;
  expect_closed(*tetra);
  EXPECT_NEAR(volume(*tetra), 1.0 / 6, 1e-15);
  EXPECT_EQ(note, "");

  auto flipped = kTetraFaces;
  for (auto& face : flipped) std::reverse(face.begin(), face.end());
  const auto turned = make_polyhedron(kTetraPoints, flipped, &note);
  ASSERT_TRUE(turned);
  EXPECT_NEAR(volume(*turned), 1.0 / 6, 1e-15);
  EXPECT_EQ(note, "polyhedron: inside out, its faces were turned over");

  std::vector<glm::dvec3> soup;
  std::vector<std::vector<uint32_t>> soup_faces;
  for (const auto& face : kTetraFaces) {
    soup_faces.emplace_back();
    for (const uint32_t i : face) {
      soup_faces.back().push_back(static_cast<uint32_t>(soup.size()));
      soup.push_back(kTetraPoints[i]);
    }
  }
  const auto welded = make_polyhedron(soup, soup_faces, &note);
  ASSERT_TRUE(welded) << welded.error().message;
  EXPECT_EQ(welded->points.size(), 4u);
  expect_closed(*welded);
}

TEST(Polyhedron, ErrorsSayWhatIsWrong) {
  std::string note;
  auto message = [&](const std::vector<glm::dvec3>& points,
                     const std::vector<std::vector<uint32_t>>& faces) {
    const auto r = make_polyhedron(points, faces, &note);
    return r ? std::string("no error") : r.error().message;
  };
  auto faces = kTetraFaces;
  faces[1][2] = 4;
  EXPECT_EQ(
      message(kTetraPoints, faces),
      "polyhedron: face 1: index 4 is out of range, there are 4 points; indices count from 0");
  faces[1] = {0, 1, 1};
  EXPECT_EQ(message(kTetraPoints, faces),
            "polyhedron: face 1 is degenerate: it has 2 distinct points");
  faces = kTetraFaces;
  faces.pop_back();
  EXPECT_EQ(message(kTetraPoints, faces).substr(0, 40), "polyhedron: not closed: 3 open edges (fi");
  faces = kTetraFaces;
  std::reverse(faces[3].begin(), faces[3].end());
  EXPECT_EQ(message(kTetraPoints, faces).substr(0, 39), "polyhedron: not consistently oriented: ");
  EXPECT_EQ(message(kTetraPoints, {}), "polyhedron: has no faces");

  const auto ends_with = [&](const std::string& text, const std::string& end) {
    EXPECT_TRUE(text.ends_with(end)) << text;
  };
  ends_with(message(kTetraPoints, faces), "; to mend it, reverse 1 face (at (1, 0, 0))");
  faces.pop_back();
  ends_with(message(kTetraPoints, faces),
            "; to mend it, add the faces that close 1 hole (3 edges at (0.5, 0.5, 0.5))");
  // A corner in the middle of an edge, in one of the two faces there.
  auto more = kTetraPoints;
  more.push_back({0.5, 0, 0});
  faces = kTetraFaces;
  for (auto& face : faces) {
    const auto one = std::find(face.begin(), face.end(), 1u);
    if (one == face.end() || face[(one - face.begin() + 1) % 3] != 0) continue;
    face.insert(one + 1, 4u);
    break;
  }
  ends_with(message(more, faces),
            "; to mend it, put the points that lie on 1 open edge into the faces there, as corners "
            "((0, 0, 0) - (1, 0, 0))");
  auto points = kTetraPoints;
  points[2].y = kInf;
  EXPECT_EQ(message(points, kTetraFaces), "polyhedron: point 2 must be finite, got inf");
}

}  // namespace
}  // namespace csgrun::solids_test
