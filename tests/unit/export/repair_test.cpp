// Repair of rounded meshes: nothing is lost that rounding does not explain, nothing in silence.
#include <cmath>

#include <gtest/gtest.h>

#include <csgrun/export/write.h>

#include "export/defects.h"
#include "export/fidelity.h"
#include "tests/unit/export/hand_made.h"

namespace csgrun::testing::repair_test {
namespace {

WriteReport written(const SolidPtr& solid, const std::string& format = "stl") {
  WriteOptions options;
  options.check = true;
  options.threads = 1;
  unsigned rounds = 0;
  size_t first_left = 0;
  options.repairing = [&](unsigned round, size_t left) {
    EXPECT_EQ(round, ++rounds);
    EXPECT_GT(left, 0u);
    if (round == 1) first_left = left;
  };
  WriteReport report;
  const auto files = encode_files("a." + format, {{"p", solid, {}}}, options, report);
  EXPECT_TRUE(files) << files.error().message;
  EXPECT_EQ(report.checks.size(), 1u);
  report.checks.resize(1);
  EXPECT_EQ(rounds, report.checks[0].rounds);
  const MeshDefects& found = report.checks[0].found;
  EXPECT_EQ(first_left, found.crossings + found.degenerate + found.flipped + found.inverted);
  return report;
}

/// 0.008 mm thick where floats have steps of 0.0625 mm: rounding turns it inside out.
constexpr std::array<glm::dvec3, 4> kThin{{{1000009.105408, 1000008.941568, 999991.115776},
                                           {1000003.403776, 999996.162048, 1000002.125824},
                                           {999991.7056, 1000006.713344, 1000004.714496},
                                           {1000001.404928, 1000003.960832, 999999.340544}}};

TEST(Repair, WhatIsThinnerThanThePrecisionIsWrittenEmptyAndSaid) {
  HandMade made;
  made.solid.sources = {{"polyhedron", "m.lua:1"}};
  made.tetrahedron(kThin);
  const WriteReport report = written(made.share());
  const MeshCheck& check = report.checks[0];
  EXPECT_EQ(check.verdict, CheckVerdict::kRepaired);
  EXPECT_LT(check.volume[0], 0);
  EXPECT_EQ(check.found.inverted, 1u);
  EXPECT_TRUE(check.left.none());
  EXPECT_EQ(check.triangles[1], 0u);
  EXPECT_EQ(check.vanished, 1u);
  EXPECT_NEAR(check.thickness, 2 * 1.1785357 / 281.492, 1e-5);
  ASSERT_EQ(check.places.size(), 2u);
  EXPECT_EQ(check.places[0].kind, DefectKind::kInverted);
  EXPECT_EQ(check.places[1].kind, DefectKind::kVanished);
  EXPECT_EQ(check.places[1].sources, (std::vector<std::string>{"polyhedron, m.lua:1"}));
  EXPECT_EQ(report.warnings,
            (std::vector<std::string>{
                "part 'p' is thinner than the file's precision and was written empty"}));
}

TEST(Repair, WhatVanishesBesideOtherThingsIsCounted) {
  HandMade made;
  made.tetrahedron(kThin);
  made.box({0, 0, 0}, {1, 1, 1});
  const MeshCheck check = written(made.share()).checks[0];
  EXPECT_EQ(check.verdict, CheckVerdict::kRepaired);
  EXPECT_EQ(check.vanished, 1u);
  EXPECT_EQ(check.triangles[1], 12u);
  ASSERT_FALSE(check.places.empty());
  EXPECT_EQ(check.places.back().kind, DefectKind::kVanished);
  EXPECT_NEAR(check.places.back().at.x, 1e6, 20);
}

TEST(Repair, RoundingAloneMayLoseSomethingToo) {
  HandMade made;
  made.box({100, 0, 0}, {100 + 1e-9, 1, 1});
  made.box({0, 0, 0}, {1, 1, 1});
  const MeshCheck check = written(made.share()).checks[0];
  EXPECT_EQ(check.verdict, CheckVerdict::kClean);
  EXPECT_EQ(check.vanished, 1u);
  EXPECT_NEAR(check.thickness, 1e-9, 1e-13);
  ASSERT_EQ(check.places.size(), 1u);
  EXPECT_EQ(check.places[0].kind, DefectKind::kVanished);
}

/// The check of a mesh whose repair would be another model.
MeshCheck refused(const HandMade& made, const std::string& format) {
  const SolidPtr solid = made.share();
  const MeshCheck check = written(solid, format).checks[0];
  EXPECT_EQ(check.verdict, CheckVerdict::kFailed);
  EXPECT_FALSE(check.left.none());
  EXPECT_EQ(check.vanished, 0u);
  EXPECT_EQ(check.moved, 0u);
  EXPECT_EQ(check.triangles[0], check.triangles[1]);
  EXPECT_EQ(check.volume[0], check.volume[1]);
  // Lattices end at 2^10 steps of floats (2, 8, 32, 128 and 512 are below), or at one; each is
  // tried from four origins.
  EXPECT_EQ(check.rounds, 21u) << format;
  // The places are those of the mesh as it was rounded.
  const auto mesh = round_part(*solid, {}, Precision::kDouble, false);
  const auto places = places_of(find_defects(*mesh, face_directions(*solid, {})), *mesh, *solid);
  EXPECT_EQ(check.places.size(), places.size());
  for (size_t i = 0; i < places.size(); ++i) EXPECT_EQ(check.places[i].at, places[i].at);
  return check;
}

TEST(Repair, OverlapsThatNoMoveExplainsAreLeft) {
  HandMade made;
  made.box({0, 0, 0}, {2, 2, 2});
  made.box({1, 1, 1}, {3, 3, 3});
  for (const char* format : {"stl", "off"}) {
    const MeshCheck check = refused(made, format);
    EXPECT_GT(check.found.crossings, 0u);
    EXPECT_EQ(check.problem.rfind("the volume would change by -1 mm^3, and moves of at most ", 0),
              0u)
        << check.problem;
  }
}

TEST(Repair, BodiesThatNoMoveExplainsStay) {
  // A body of 1 m^3 in a large one: its volume would drown in what rounding the large one moves.
  HandMade made;
  made.box({0, 0, 0}, {1e6, 1e6, 1e6});
  made.box({5e5, 5e5, 5e5}, {5e5 + 1000, 5e5 + 1000, 5e5 + 1000});
  const MeshCheck check = refused(made, "stl");
  EXPECT_EQ(check.found.inverted, 1u);
  EXPECT_EQ(check.problem, "a connected surface of 6e+06 mm^2 around 1e+09 mm^3 would vanish");
}

TEST(Repair, RoundsThatCannotCountDefectsGoOn) {
  Defects many, fewer, most;
  many.crossings.resize(7);
  fewer.crossings.resize(6);
  most.crossings.resize(kMostCrossings);
  EXPECT_TRUE(fewer.fewer_than(many));
  EXPECT_FALSE(many.fewer_than(many));
  EXPECT_FALSE(many.fewer_than(fewer));
  EXPECT_TRUE(many.fewer_than(most));
  EXPECT_TRUE(most.fewer_than(most));
  EXPECT_FALSE(most.fewer_than(many));
}

TEST(Fidelity, MovesExplainWhatTheySweep) {
  const SolidPtr solid = cube(4);
  for (const double by : {1e-9, 0.01, 1.0, 100.0}) {
    Moves moves;
    moves.add(solid->positions, solid->triangles, by);
    EXPECT_EQ(moves.distance, by);
    const double side = 4 + 2 * by / std::sqrt(3.0);  // each corner moves outwards by that
    EXPECT_GE(moves.volume, (side * side * side - 64) * (1 - 1e-6));
    EXPECT_GE(moves.volume, 96 * by);
  }
  Moves little;
  little.add(solid->positions, solid->triangles, 1e-6);
  EXPECT_LT(little.volume, 96e-6 * (1 + 1e-5));
  Moves none;
  none.add(solid->positions, solid->triangles, 0);
  EXPECT_EQ(none.volume, 0);
}

TEST(Fidelity, UnitsInTheLastPlace) {
  const std::vector<glm::dvec3> points{{1, -3, 2}};
  EXPECT_EQ(unit_of(Precision::kFloat, points), 0x1p-22);
  EXPECT_EQ(unit_of(Precision::kDouble, points), 0x1p-51);
  EXPECT_EQ(std::nextafter(3.0F, 4.0F), 3 + 0x1p-22F);
}

}  // namespace
}  // namespace csgrun::testing::repair_test
