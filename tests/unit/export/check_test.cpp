// The check of rounded meshes: known defects are found, where they are; repairs keep what they
// should.
#include <cmath>

#include <gtest/gtest.h>

#include <csgrun/export/write.h>

#include "export/defects.h"
#include "export/edge_flips.h"
#include "tests/unit/export/hand_made.h"

namespace csgrun::testing::check_test {
namespace {

MeshCheck check_of(const SolidPtr& solid, const std::string& format = "stl",
                   const Affine& placement = {}) {
  WriteOptions options;
  options.check = true;
  options.threads = 1;
  WriteReport report;
  const auto files = encode_files("a." + format, {{"p", solid, placement}}, options, report);
  EXPECT_TRUE(files) << files.error().message;
  EXPECT_EQ(report.checks.size(), 1u);
  return report.checks.empty() ? MeshCheck() : report.checks[0];
}

RoundedMesh rounded(const SolidPtr& solid) {
  auto mesh = round_part(*solid, {}, Precision::kFloat, false);
  EXPECT_TRUE(mesh);
  return *std::move(mesh);
}

Defects defects_of(const SolidPtr& solid) {
  return find_defects(rounded(solid), face_directions(*solid, {}));
}

/// A box whose top is cut along a diagonal of many points: `heights` of the middle points over the
/// diagonal from (0, 0, 1) to (4, 4, 1), in the plane of the top, before rounding and after.
SolidPtr box_with_bent_diagonal(double exact, float written) {
  HandMade made;
  const auto b0 = made.vertex(0, 0, 0), b1 = made.vertex(4, 0, 0), b2 = made.vertex(4, 4, 0),
             b3 = made.vertex(0, 4, 0);
  const auto t0 = made.vertex(0, 0, 1), t1 = made.vertex(4, 0, 1), t2 = made.vertex(4, 4, 1),
             t3 = made.vertex(0, 4, 1);
  const auto m = made.vertex(2 - exact, 2 + exact, 1);
  made.face({b3, b2, b1, b0});
  made.face({b0, b1, t1, t0});
  made.face({b1, b2, t2, t1});
  made.face({b2, b3, t3, t2});
  made.face({b3, b0, t0, t3});
  // The cap t0 t2 m between the two halves of the top.
  made.face({{t0, t1, t2, t3}}, {{t0, t1, t2}, {t0, t2, m}, {t2, t3, m}, {t3, t0, m}});
  made.solid.positions_f32[m] = {2 - written, 2 + written, 1};
  return made.share();
}

TEST(Check, FindsNothingWhereNothingIs) {
  for (const char* format : {"stl", "glb", "gltf", "off", "obj"}) {
    const MeshCheck check = check_of(edge_touching_cubes(), format);
    EXPECT_EQ(check.verdict, CheckVerdict::kClean) << format;
    EXPECT_TRUE(check.found.none());
    EXPECT_EQ(check.rounds, 0u);
    EXPECT_EQ(check.volume[1], 2);
    EXPECT_EQ(check.triangles[1], 24u);
    EXPECT_EQ(check.part, "p");
  }
  EXPECT_EQ(check_of(box_with_bent_diagonal(0.5, 0.5F)).verdict, CheckVerdict::kClean);
}

TEST(Check, MirroredAndTurnedPlacementsAreNotTurnedOver) {
  Affine mirrored;
  mirrored.m = {{{0, 2, 0, 5}, {1, 0.5, 0, 0}, {0, 0, 3, -1}}};
  for (const char* format : {"stl", "off", "glb"}) {
    const MeshCheck check = check_of(cube(1), format, mirrored);
    EXPECT_EQ(check.verdict, CheckVerdict::kClean) << format;
    EXPECT_NEAR(check.volume[1], 6, 1e-5) << format;
  }
  // The directions from exact planes go the same way as those from corners.
  Solid solid = *cube(1);
  solid.face_normals = place_solid(solid, {}).face_normals;
  const std::vector<glm::dvec3> from_planes = face_directions(solid, mirrored);
  solid.face_normals.clear();
  const std::vector<glm::dvec3> from_corners = face_directions(solid, mirrored);
  for (size_t f = 0; f < from_planes.size(); ++f) {
    const glm::dvec3 &a = from_planes[f], &b = from_corners[f];
    const double length = std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
    EXPECT_NEAR((a.x * b.x + a.y * b.y + a.z * b.z) / length, 1, 1e-12);
  }
}

TEST(Check, FindsTrianglesTurnedOver) {
  const SolidPtr solid = box_with_bent_diagonal(0x1p-30, -0x1p-20F);
  const Defects defects = defects_of(solid);
  EXPECT_EQ(defects.flipped.size(), 1u);
  EXPECT_TRUE(defects.degenerate.empty());
  // In one plane: the neighbour below overlaps it, and those above overlap the one below.
  EXPECT_FALSE(defects.crossings.empty());
  const auto places = places_of(defects, rounded(solid), *solid);
  EXPECT_EQ(places.back().kind, DefectKind::kFlipped);
  EXPECT_NEAR(places.back().at.z, 1, 1e-6);
}

TEST(Check, FindsTrianglesWithoutArea) {
  const Defects defects = defects_of(box_with_bent_diagonal(0x1p-30, 0.0F));
  EXPECT_EQ(defects.degenerate.size(), 1u);
  EXPECT_TRUE(defects.flipped.empty());
}

TEST(Check, FindsCrossingsWithPlacesAndSources) {
  HandMade made;
  made.solid.sources = {{"cube", "m.lua:3"}};
  made.box({0, 0, 0}, {2, 2, 2});
  made.box({1, 1, 1}, {3, 3, 3});
  const SolidPtr solid = made.share();
  const Defects defects = defects_of(solid);
  EXPECT_FALSE(defects.crossings.empty());
  EXPECT_TRUE(defects.flipped.empty() && defects.degenerate.empty());
  for (const DefectPlace& place : places_of(defects, rounded(solid), *solid)) {
    EXPECT_EQ(place.kind, DefectKind::kCrossing);
    EXPECT_EQ(place.sources, (std::vector<std::string>{"cube, m.lua:3", "cube, m.lua:3"}));
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(place.at[k], 1);
      EXPECT_LE(place.at[k], 2);
    }
  }
}

TEST(Check, SurfacesThatLieUponOneAnotherCross) {
  HandMade made;
  made.box({0, 0, 0}, {1, 1, 1});
  made.box({1, 0, 0}, {2, 1, 1});  // two sides in one square, with or without equal diagonals
  EXPECT_FALSE(defects_of(made.share()).crossings.empty());
}

TEST(Check, ThinTrianglesGoByTurningAnEdge) {
  for (const float written : {0.0F, -0x1p-20F}) {
    const SolidPtr solid = box_with_bent_diagonal(0x1p-30, written);
    const MeshCheck check = check_of(solid);
    EXPECT_EQ(check.verdict, CheckVerdict::kRepaired);
    EXPECT_TRUE(check.left.none());
    EXPECT_EQ(check.rounds, 1u);
    EXPECT_EQ(check.unions, 0u);
    EXPECT_EQ(check.moved, 0u);
    EXPECT_EQ(check.triangles[0], check.triangles[1]);
    EXPECT_EQ(check.volume[1], 16);

    RoundedMesh mesh = rounded(solid);
    const auto directions = face_directions(*solid, {});
    const std::vector<uint32_t> all = [&] {
      const Defects d = find_defects(mesh, directions);
      return d.flipped.empty() ? d.degenerate : d.flipped;
    }();
    EXPECT_EQ(turn_longest_edges(mesh, all, directions), 1u);
    EXPECT_EQ(turn_longest_edges(mesh, all, directions), 0u);  // nothing is wrong any more
    const auto twins = manifold_twins(mesh.triangles, mesh.positions.size());
    ASSERT_TRUE(twins);
    EXPECT_EQ(*twins, mesh.twins);
  }
}

TEST(Check, MovedVerticesAreCollapsed) {
  RoundedMesh mesh = rounded(dumbbell(0.25));
  const double volume = exact_volume({mesh.positions, mesh.triangles});
  EXPECT_EQ(volume, 2.0625);
  std::vector<glm::dvec3> positions = mesh.positions;
  for (glm::dvec3& p : positions) {
    if (p.y == 0.75) p.y = 0.5;  // presses the tube flat
  }
  ASSERT_TRUE(move_vertices(mesh, positions));
  EXPECT_GT(mesh.cancelled + mesh.dropped, 0u);
  EXPECT_EQ(exact_volume({mesh.positions, mesh.triangles}), 2);
}

TEST(Check, WithoutItNothingIsSaid) {
  WriteReport report;
  HandMade made;
  made.box({0, 0, 0}, {2, 2, 2});
  made.box({1, 1, 1}, {3, 3, 3});
  EXPECT_TRUE(encode_files("a.stl", {{"", made.share(), {}}}, {}, report));
  EXPECT_TRUE(report.checks.empty());
  EXPECT_TRUE(report.warnings.empty());
}

TEST(Check, BentPolygonsAreWrittenAsTriangles) {
  HandMade made;
  made.box({0, 0, 0}, {1, 1, 1});
  made.solid.positions[7] = {1, 1, 1 + 0x1p-40};  // bends the top only
  const auto polygons = [&](bool check) {
    WriteOptions options;
    options.check = check;
    WriteReport report;
    const auto files = encode_files("a.off", {{"", made.share(), {}}}, options, report);
    EXPECT_TRUE(files);
    const std::string& bytes = files->front().bytes;
    return std::stoi(bytes.substr(bytes.find(' ')));
  };
  EXPECT_EQ(polygons(false), 6);
  EXPECT_EQ(polygons(true), 7);
}

}  // namespace
}  // namespace csgrun::testing::check_test
