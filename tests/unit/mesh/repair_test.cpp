// Repair against independent truths: meshes damaged in known ways come back with their volume.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/mesh/soup.h"

namespace csgrun::test::repair_test {
namespace {

TEST(Repair, SoundMeshStaysAsItIs) {
  const Soup soup = cube();
  RepairReport report;
  const Result<PolygonMesh> mesh = repair_mesh(soup.mesh(), {}, &report);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(lines(report), Lines{});
  EXPECT_EQ(mesh->corners, soup.mesh().corners);
  EXPECT_EQ(mesh->points, soup.points);
}

TEST(Repair, PointsOfEqualCoordinates) {
  Lines said;
  EXPECT_EQ(repaired_volume(unwelded(cube()), {}, &said), 1);
  EXPECT_EQ(said,
            (Lines{"16 points were welded to another of equal coordinates (first: at (0, 0, 0), "
                   "at (1, 0, 0), at (1, 0, 1))"}));
}

TEST(Repair, PointsThatAreNear) {
  Soup soup = unwelded(cube());
  Random random(1);
  for (glm::dvec3& p : soup.points) {
    for (int i = 0; i < 3; ++i) p[i] += 1e-4 * (random.unit() - 0.5);
  }
  EXPECT_EQ(refusal(soup, {}).substr(0, 25), "not closed: 24 open edges");
  RepairOptions options;
  options.weld = 1e-3;
  Lines said;
  EXPECT_NEAR(repaired_volume(soup, options, &said), 1, 1e-3);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].substr(0, 51), "16 points were welded to another within 0.001 mm (f");
}

TEST(Repair, FacesTurned) {
  Soup soup = cube();
  std::reverse(soup.faces[4].begin(), soup.faces[4].end());
  Lines said;
  EXPECT_EQ(repaired_volume(soup, {}, &said), 1);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].substr(0, 46), "1 face was turned to agree with its neighbours");
  RepairOptions options;
  options.orient = false;
  EXPECT_EQ(refusal(soup, options), "faces disagree at the edge (0, 1, 0) - (1, 1, 0)");
}

TEST(Repair, HoleOfACube) {
  for (size_t missing = 0; missing < 6; ++missing) {
    Soup soup = cube();
    soup.faces.erase(soup.faces.begin() + static_cast<std::ptrdiff_t>(missing));
    EXPECT_EQ(refusal(soup, {}).substr(0, 41), "not closed: 4 open edges in 1 hole of 4 e");
    Lines said;
    EXPECT_EQ(repaired_volume(soup, filling(), &said), 1);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0].substr(0, 42), "1 hole was filled with 2 faces (4 edges at");
  }
  Soup soup = cube();
  soup.faces.pop_back();
  EXPECT_EQ(refusal(soup, {}), "not closed: 4 open edges in 1 hole of 4 edges at (0, 0.5, 0.5)");
}

TEST(Repair, OppositeHolesAndDuplicates) {
  Soup soup = cube();
  soup.faces.erase(soup.faces.begin(), soup.faces.begin() + 2);  // bottom and top
  soup.faces.push_back(soup.faces[0]);
  soup.faces.push_back({soup.faces[1].rbegin(), soup.faces[1].rend()});
  Lines said;
  EXPECT_EQ(repaired_volume(soup, filling(), &said), 1);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(said[0].substr(0, 40), "2 holes were filled with 4 faces (4 edge");
  EXPECT_EQ(said[1].substr(0, 50), "2 faces on the same points as others were dropped ");
}

TEST(Repair, DegenerateFaces) {
  Soup soup = cube();
  soup.faces.push_back({0, 1, 0});
  soup.faces.push_back({2, 2, 3});
  Lines said;
  EXPECT_EQ(repaired_volume(soup, {}, &said), 1);
  EXPECT_EQ(said, Lines{"2 faces without area were dropped (at (0, 0, 0), at (0, 1, 0))"});
}

TEST(Repair, FaceOnALineHoldsNeighboursTogether) {
  // The edge from 0 to 1 of the bottom meets two edges of the front, across a triangle on a line.
  Soup soup = cube();
  soup.points.push_back({0.5, 0, 0});
  soup.faces[2] = {0, 8, 1, 5, 4};
  soup.faces.push_back({0, 1, 8});
  EXPECT_TRUE(is_balanced(soup.mesh()));
  Lines said;
  EXPECT_EQ(repaired_volume(soup, {}, &said), 1);
  EXPECT_EQ(said, Lines{"1 face without area was dropped (at (0, 0, 0))"});
}

TEST(Repair, TJunction) {
  Soup soup = cube();
  soup.points.push_back({0.25, 0, 0});
  soup.points.push_back({0.75, 0, 0});
  soup.faces[2] = {0, 8, 9, 1, 5, 4};
  Lines said;
  EXPECT_EQ(repaired_volume(soup, {}, &said), 1);
  EXPECT_EQ(said, Lines{"1 open edge was split at points on it ((0, 0, 0) - (1, 0, 0))"});
}

TEST(Repair, FinAndInnerWall) {
  Soup soup = cube();
  soup.points.push_back({2, 0, 0.5});
  soup.faces.push_back({1, 5, 8});  // a fin on the edge from 1 to 5
  EXPECT_EQ(repaired_volume(soup, filling()), 1);

  // Two rooms with a wall between them: edges of three faces.
  Soup rooms = cube();
  rooms.points.insert(rooms.points.end(), {{2, 0, 0}, {2, 1, 0}, {2, 0, 1}, {2, 1, 1}});
  rooms.faces.insert(rooms.faces.end(),
                     {{1, 3, 9, 8}, {5, 10, 11, 7}, {1, 8, 10, 5}, {9, 3, 7, 11}, {8, 9, 11, 10}});
  EXPECT_EQ(refusal(rooms, {}).substr(0, 11), "not closed:");
  EXPECT_EQ(repaired_volume(rooms, filling()), 2);
}

TEST(Repair, SurfacesInsideOut) {
  Soup soup = box({0, 0, 0}, {4, 4, 4});
  Soup inner = box({1, 1, 1}, {2, 2, 2});
  inner.turn();
  soup.add(inner);                        // a void
  soup.add(box({10, 0, 0}, {11, 1, 1}));  // a body beside it
  Lines said;
  EXPECT_EQ(repaired_volume(soup, {}, &said), 64);
  EXPECT_EQ(said, Lines{});

  Soup all = soup;
  all.turn();
  EXPECT_EQ(repaired_volume(all, {}, &said), 64);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0],
            "3 surfaces that were inside out were turned over (at (4, 0, 0), at (1, 1, 1), "
            "at (11, 0, 0))");

  Soup beside = box({0, 0, 0}, {4, 4, 4});
  Soup inverted = box({5, 0, 0}, {6, 1, 1});
  inverted.turn();
  beside.add(inverted);
  EXPECT_EQ(repaired_volume(beside, {}, &said), 65);
}

TEST(Repair, VoidThatTouchesItsShell) {
  // All 27 cells but the middle one, and one of the corners: the void touches the outside there.
  Soup soup;
  for (int cell = 1; cell < 27; ++cell) {
    if (cell == 13) continue;
    const glm::dvec3 lo(cell % 3, cell / 3 % 3, cell / 9);
    soup.add(box(lo, lo + 1.0));
  }
  RepairOptions options;
  Lines said;
  // Inner walls are there twice, back to back.
  EXPECT_EQ(repaired_volume(soup, options, &said), 25);
  soup.turn();
  EXPECT_EQ(repaired_volume(soup, options, &said), 25);
}

TEST(Repair, TwoSidedSurface) {
  Soup soup = cube();
  Soup back = soup;
  back.turn();
  soup.add(back);
  EXPECT_EQ(repaired_volume(soup, {}), 1);
}

TEST(Repair, MoebiusStripIsRefused) {
  Soup soup;
  for (int i = 0; i < 6; ++i) {
    const double angle = i * 1.0471975511965976, half = angle / 2;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(half);
      soup.points.push_back({r * std::cos(angle), r * std::sin(angle), side * std::sin(half)});
    }
  }
  for (uint32_t i = 0; i < 5; ++i) soup.faces.push_back({2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2});
  soup.faces.push_back({10, 11, 0, 1});
  EXPECT_EQ(refusal(soup, filling()).substr(0, 77),
            "the surface has one side only, like a Moebius strip, and no orientation: arou");
}

TEST(Repair, NothingToWorkOn) {
  EXPECT_EQ(refusal({}, filling()), "nothing is left: no face bounds a solid");
  Soup flat;
  flat.points = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  flat.faces = {{0, 1, 2}, {0, 0, 0}};
  EXPECT_EQ(refusal(flat, filling()), "nothing is left: no face bounds a solid");
  Soup one = cube();
  one.faces.resize(1);  // a sheet, closed by its own back
  RepairOptions options = filling();
  options.drop_duplicates = false;
  EXPECT_EQ(refusal(one, options), "nothing is enclosed: every face lies on others' backs");
}

TEST(Repair, SheetsEncloseNothing) {
  Soup bent;  // two quadrilaterals at an angle; the least area that closes them is their own
  bent.points = {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {1, 1, 1}, {1, 0, 1}};
  bent.faces = {{0, 1, 2, 3}, {3, 2, 4, 5}};
  EXPECT_EQ(refusal(bent, filling()), "nothing is enclosed: every face lies on others' backs");
  EXPECT_FALSE(suggest_repair(bent.mesh()));
  // One face more, and there is a wedge.
  bent.faces.push_back({0, 3, 5});
  EXPECT_GT(std::fabs(repaired_volume(bent, filling())), 0.1);
}

/// A prism over a bow-tie: its two halves have 125 mm^3 each, one of them is inverted.
Soup bow_tie() {
  Soup soup;
  soup.points = {{0, 0, 0}, {10, 10, 0}, {10, 0, 0}, {0, 10, 0},
                 {0, 0, 5}, {10, 10, 5}, {10, 0, 5}, {0, 10, 5}};
  soup.faces = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  return soup;
}

TEST(Repair, FacesThatCrossThemselvesStay) {
  RepairReport report;
  const Result<PolygonMesh> mesh = repair_mesh(bow_tie().mesh(), {}, &report);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(lines(report), Lines{});
  EXPECT_EQ(mesh->corners, bow_tie().mesh().corners);
}

TEST(Repair, DropDegenerateDecidesAboutFacesOnALine) {
  Soup soup = cube();
  soup.points.push_back({0.5, 0, 0});
  soup.faces[2] = {0, 8, 1, 5, 4};
  soup.faces.push_back({0, 1, 8});
  soup.faces.push_back({0, 1, 0});  // two points: it is no face in any case
  RepairOptions options;
  options.drop_degenerate = false;
  const Result<PolygonMesh> mesh = repair_mesh(soup.mesh(), options, nullptr);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->face_count(), 7u);
}

/// Triangles that have nothing in common but one vertex, which is the first or the last.
Soup fan_of_lone_triangles(uint32_t count, bool hub_first) {
  Soup soup;
  if (hub_first) soup.points.push_back({0, 0, 0});
  for (uint32_t i = 0; i < count; ++i) {
    const double a = 6.28 * i / count, b = 6.28 * (i + 0.4) / count;
    const auto first = static_cast<uint32_t>(soup.points.size());
    soup.points.push_back({std::cos(a), std::sin(a), 1});
    soup.points.push_back({std::cos(b), std::sin(b), 1});
    soup.faces.push_back({hub_first ? 0 : 2 * count, first, first + 1});
  }
  if (!hub_first) soup.points.push_back({0, 0, 0});
  return soup;
}

TEST(Repair, ManyHolesAtOneVertex) {
  // If each hole looked at all others, this would take minutes.
  for (const bool hub_first : {true, false}) {
    EXPECT_EQ(refusal(fan_of_lone_triangles(50000, hub_first), {}).substr(0, 71),
              "not closed: 150000 open edges in 50000 holes, the largest of 3 edges at");
  }
}

TEST(Repair, SurfacesInsideOutSideBySide) {
  Soup soup;
  for (int i = 0; i < 30000; ++i) {
    const double x = 2.0 * (i % 200), y = 2.0 * (i / 200);
    soup.add(box({x, y, 0}, {x + 1, y + 1, 1}));
  }
  soup.turn();
  EXPECT_EQ(repaired_volume(soup, {}), 30000);
}

TEST(Repair, SuggestsWhatIsSwitchedOff) {
  Soup soup = cube();
  soup.faces.push_back(soup.faces[1]);
  RepairOptions options;
  options.drop_duplicates = false;
  EXPECT_EQ(refusal(soup, options).substr(0, 11), "not closed:");
  const Result<RepairOptions> found = suggest_repair(soup.mesh(), options);
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, RepairOptions{});
  options.orient = false;  // stays, as it is not needed
  const Result<RepairOptions> other = suggest_repair(soup.mesh(), options);
  ASSERT_TRUE(other);
  EXPECT_FALSE(other->orient);
  EXPECT_TRUE(other->drop_duplicates);
}

TEST(Repair, AdviceForFacesWrittenByHand) {
  Soup soup = cube();
  soup.faces.pop_back();
  std::reverse(soup.faces[4].begin(), soup.faces[4].end());
  RepairReport report;
  ASSERT_TRUE(suggest_repair(soup.mesh(), {}, &report));
  Lines said;
  for (const RepairStep& step : report.steps) said.push_back(step.advice());
  EXPECT_EQ(said, (Lines{"reverse 1 face (at (1, 1, 1))",
                         "add the faces that close 1 hole (4 edges at (0, 0.5, 0.5))"}));
}

TEST(Repair, HostileNumbers) {
  Soup soup = cube();
  soup.faces[0][0] = 77;
  EXPECT_EQ(refusal(soup, filling()), "cannot be repaired: 1 bad index (77 of 8 points)");
  soup = cube();
  soup.points[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(soup, filling()),
            "cannot be repaired: 1 point that is not finite (3 (1, nan, 0))");
  soup = cube();
  soup.points[3].y = 1e200;
  EXPECT_EQ(refusal(soup, filling()),
            "cannot be repaired: coordinates beyond 1e100 mm at (1, 1e+200, 0)");
  RepairOptions options;
  options.weld = -1;
  EXPECT_FALSE(repair_mesh(cube().mesh(), options, nullptr));
  options.weld = 1e9;  // all points become one
  EXPECT_EQ(repaired_volume(cube(), options), 1) << "nothing is open, so nothing is welded";
}

TEST(Repair, HolesThatMeetInAVertex) {
  // Two corners of a cube's top are cut off as triangles that share a point: two loops of three.
  Soup soup = cube();
  soup.points.push_back({0.5, 0.5, 1});
  soup.faces[1] = {4, 5, 8};
  soup.faces.push_back({7, 6, 8});  // left open: 5 7 8 and 6 4 8
  Lines said;
  EXPECT_EQ(repaired_volume(soup, filling(), &said), 1);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(
      said[0],
      "2 holes were filled with 2 faces (3 edges at (0.25, 0.5, 1), 3 edges at (0.75, 0.5, 1))");
}

TEST(Repair, LongHolesArePlanarPolygons) {
  // A drum of 600 sides without its top and bottom.
  Soup soup;
  const uint32_t n = 600;
  double area = 0;
  for (uint32_t i = 0; i < n; ++i) {
    const double angle = i * (6.283185307179586 / n);
    for (const double z : {0.0, 1.0}) soup.points.push_back({std::cos(angle), std::sin(angle), z});
    const uint32_t j = (i + 1) % n;
    soup.faces.push_back({2 * i, 2 * j, 2 * j + 1, 2 * i + 1});
  }
  for (uint32_t i = 0; i < n; ++i) {
    const glm::dvec3 &p = soup.points[2 * i], &q = soup.points[2 * ((i + 1) % n)];
    area += (p.x * q.y - p.y * q.x) / 2;
  }
  Lines said;
  EXPECT_NEAR(repaired_volume(soup, filling(), &said), area, 1e-12);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].substr(0, 33), "2 holes were filled with 2 faces ");
}

}  // namespace
}  // namespace csgrun::test::repair_test
