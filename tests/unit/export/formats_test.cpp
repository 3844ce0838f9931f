// Bytes of written files, read back; those of glTF are in gltf_test.cpp.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csgrun/export/write.h>

#include "export/rounding.h"
#include "tests/unit/export/hand_made.h"
#include "tests/unit/export/read_back.h"

namespace csgrun::formats_test {
namespace {

using testing::HandMade;

// ---- STL

TEST(Stl, HoldsTheCube) {
  const std::string bytes = encode("stl", {{"", testing::cube(10), {}}});
  EXPECT_NE(bytes.substr(0, 5), "solid");
  const Polygons mesh = read_stl(bytes);
  EXPECT_EQ(mesh.loops.size(), 12u);
  EXPECT_DOUBLE_EQ(volume(mesh), 1000);
}

TEST(Stl, NormalsPointOutwards) {
  const std::string bytes = encode("stl", {{"", testing::cube(2), {}}});
  const Polygons mesh = read_stl(bytes);
  for (size_t t = 0; t < mesh.loops.size(); ++t) {
    float n[3];
    std::memcpy(n, bytes.data() + 84 + 50 * t, sizeof n);
    const glm::dvec3 p = mesh.points[mesh.loops[t][0]] - glm::dvec3(1);
    EXPECT_GT(n[0] * p.x + n[1] * p.y + n[2] * p.z, 0.9);
    EXPECT_FLOAT_EQ(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1);
  }
}

TEST(Stl, RefusesSeveralParts) {
  WriteReport report;
  const auto result =
      encode_model("stl", {{"a", testing::cube(1), {}}, {"b", testing::cube(1), {}}}, report);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
}

TEST(Stl, AdmeshFindsNothingToRepair) {
  if (std::system("command -v admesh >/dev/null") != 0) GTEST_SKIP() << "admesh is not installed";
  const std::map<std::string, SolidPtr> solids = {{"cube", testing::cube(10)},
                                                  {"touching", testing::edge_touching_cubes()},
                                                  {"wheel", hexagon_wheel(48)},
                                                  {"dumbbell", testing::dumbbell(0.25)},
                                                  {"collapsed", testing::dumbbell(1e-9)}};
  for (const auto& [name, solid] : solids) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("csgrun-admesh-" + std::to_string(::getpid()) + "-" + name + ".stl");
    ASSERT_TRUE(write_model(path.string(), {{"", solid, {}}}));
    FILE* pipe = ::popen(("LC_ALL=C admesh '" + path.string() + "' 2>&1").c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::string said;
    for (char buffer[256]; std::fgets(buffer, sizeof buffer, pipe) != nullptr;) said += buffer;
    EXPECT_EQ(::pclose(pipe), 0);
    std::filesystem::remove(path);
    // The report is a table of counts "Label : n" and "Label : before after".
    for (const char* label :
         {"Total disconnected facets", "Edges fixed", "Degenerate facets", "Facets removed",
          "Facets added", "Facets reversed", "Backwards edges", "Normals fixed"}) {
      const size_t at = said.find(label);
      ASSERT_NE(at, std::string::npos) << said;
      const std::string rest = said.substr(at, said.find_first_of("\n", at) - at);
      std::istringstream words(rest.substr(rest.find(':') + 1));
      for (std::string word; words >> word;) {
        if (std::isdigit(static_cast<unsigned char>(word[0]))) {
          EXPECT_EQ(word, "0") << name << ": " << rest;
        } else {
          break;
        }
      }
    }
  }
}

// ---- rounding

TEST(Rounding, SliverWallIsDroppedAndTheRestStaysClosed) {
  WriteReport report;
  const SolidPtr solid = testing::dumbbell(1e-9);
  const Glb glb = read_glb(encode("glb", {{"d", solid, {}}}, &report));
  const Polygons mesh = manifold_of(glb, 0);
  EXPECT_TRUE(is_closed(mesh.loops));
  EXPECT_DOUBLE_EQ(volume(mesh), 2);
  // 8 triangles of the tube and the 4 of each ring that stood on its mouth.
  EXPECT_EQ(solid->triangles.size() - mesh.loops.size(), 16u);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0],
            "16 triangles of part 'd' thinner than the file's precision were dropped");

  WriteReport in_doubles;
  const Polygons kept = read_obj(encode("obj", {{"d", solid, {}}}, &in_doubles));
  EXPECT_TRUE(is_closed(kept.loops));
  EXPECT_TRUE(in_doubles.warnings.empty());
}

TEST(Rounding, SheetThatVanishesIsAWarningAndAnEmptyPart) {
  HandMade sheet;
  sheet.box({100, 0, 0}, {100 + 1e-9, 1, 1});
  WriteReport report;
  const Glb glb = read_glb(
      encode("glb", {{"sheet", sheet.share(), {}}, {"cube", testing::cube(1), {}}}, &report));
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0],
            "part 'sheet' is thinner than the file's precision and was written empty");
  EXPECT_EQ(glb.json["meshes"].size(), 1u);
  std::set<std::string> names;
  for (const auto& node : glb.json["nodes"]) names.insert(node.value("name", ""));
  EXPECT_TRUE(names.count("sheet"));

  WriteReport stl_report;
  EXPECT_EQ(read_stl(encode("stl", {{"", sheet.share(), {}}}, &stl_report)).loops.size(), 0u);
  EXPECT_EQ(stl_report.warnings.size(), 1u);
}

TEST(Rounding, BrokenSolidIsNotWritten) {
  HandMade open;
  open.box({0, 0, 0}, {1, 1, 1});
  open.solid.triangles.pop_back();
  open.solid.triangle_face.pop_back();
  WriteReport report;
  for (const char* format : {"glb", "stl", "obj", "off"}) {
    const auto result = encode_model(format, {{"", open.share(), {}}}, report);
    ASSERT_FALSE(result) << format;
    EXPECT_EQ(result.error().code, ErrorCode::kInternal);
  }
}

TEST(Rounding, FlippedTrianglesAreCounted) {
  // A tetrahedron whose apex lies 1e-9 above its base's plane, under a roof: rounding to float lays
  // the apex on the plane; nothing meets, one face has no area, none is turned over.
  HandMade flat;
  const auto a = flat.vertex(0, 0, 8), b = flat.vertex(1, 0, 8), c = flat.vertex(0, 1, 8),
             d = flat.vertex(0.25, 0.25, 8 + 1e-9);
  flat.face({a, c, b});
  flat.face({a, b, d});
  flat.face({b, c, d});
  flat.face({c, a, d});
  WriteReport report;
  encode("stl", {{"", flat.share(), {}}}, &report);
  EXPECT_TRUE(report.warnings.empty());

  // The floats of the solid decide: here they put the apex beside the base, beyond the edge ab.
  flat.solid.positions_f32[d] = {0.25f, -0.5f, 8.0f};
  encode("stl", {{"", flat.share(), {}}}, &report);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0], "1 triangle turned over by rounding");
}

TEST(Rounding, OfManyPartsIsOneLineForEachKind) {
  RoundedMesh turned, gone;
  turned.triangles.resize(4);
  turned.flipped = 2;
  turned.dropped = 1;
  gone.face_normals.resize(6);  // it had faces
  RoundingTotals totals;
  for (const char* part : {"a", "b", "c"}) totals.add(turned, part);
  totals.add(gone, "d");
  totals.add(gone, "e");
  WriteReport report;
  totals.report(report);
  EXPECT_EQ(report.warnings,
            (std::vector<std::string>{
                "2 parts are thinner than the file's precision and were written empty, the first "
                "is 'd'",
                "3 triangles of 3 parts thinner than the file's precision were dropped",
                "6 triangles of 3 parts turned over by rounding"}));
}

// ---- OBJ and OFF

TEST(Obj, KeepsPolygonsAndSaysWhoMadeThem) {
  HandMade made;
  const auto red = made.appearance(colour(1, 0, 0));
  made.source("cube", "model.lua:3");
  made.box({0, 0, 0}, {1, 1, 1}, red);
  const std::string text = encode("obj", {{"case/red box", made.share(), {}}});
  const Polygons mesh = read_obj(text);
  EXPECT_EQ(mesh.loops.size(), 6u);
  EXPECT_TRUE(is_closed(mesh.loops));
  EXPECT_DOUBLE_EQ(volume(mesh), 1);
  EXPECT_NE(text.find("\no case/red_box\ng case red_box\n"), std::string::npos) << text;
  EXPECT_NE(text.find("# faces of cube, model.lua:3\n"), std::string::npos);
}

TEST(Obj, FacesWithHolesBecomeTriangles) {
  const SolidPtr solid = testing::dumbbell(0.25);
  const Polygons mesh = read_obj(encode("obj", {{"", solid, {}}}));
  EXPECT_TRUE(is_closed(mesh.loops));
  EXPECT_NEAR(volume(mesh), 2.0625, 1e-12);
  size_t triangles = 0, quads = 0;
  for (const Loop& loop : mesh.loops) ++(loop.size() == 3 ? triangles : quads);
  EXPECT_EQ(triangles, 16u);
  EXPECT_EQ(quads, 14u);
}

TEST(Obj, PolygonsThatRoundingBrokeBecomeTriangles) {
  // A tube of the last bits of a double, whose mouth vanishes: the quads of the tube go, all is
  // closed.
  const SolidPtr solid = testing::dumbbell(1e-17);
  WriteReport report;
  HandMade distinct;  // as the engine has it: the points differ, their doubles do not
  distinct.solid = *solid;
  for (uint32_t v = 0; v < distinct.solid.point_of.size(); ++v) distinct.solid.point_of[v] = v;
  const Polygons mesh = read_obj(encode("obj", {{"", distinct.share(), {}}}, &report));
  EXPECT_TRUE(is_closed(mesh.loops));
  EXPECT_DOUBLE_EQ(volume(mesh), 2);
  EXPECT_EQ(report.warnings.size(), 1u);
}

TEST(Obj, NumbersReadBackAsTheSameDoubles) {
  const double x = 0.1 + 0.2, y = 1.0 / 3;
  HandMade made;
  made.box({0, 0, 0}, {x, y, 1e-7});
  const Polygons mesh = read_obj(encode("obj", {{"", made.share(), {}}}));
  EXPECT_EQ(mesh.points, made.solid.positions);
}

TEST(Off, KeepsPolygonsAndColours) {
  HandMade made;
  const auto red = made.appearance(colour(1, 0.5f, 0));
  made.box({0, 0, 0}, {1, 1, 1}, red);
  made.box({2, 0, 0}, {3, 1, 1});
  std::istringstream text(encode("off", {{"", made.share(), {}}}));
  std::string magic;
  size_t points = 0, faces = 0, edges = 0;
  text >> magic >> points >> faces >> edges;
  EXPECT_EQ(magic, "OFF");
  EXPECT_EQ(points, 16u);
  EXPECT_EQ(faces, 12u);
  Polygons mesh;
  mesh.points.resize(points);
  for (auto& p : mesh.points) text >> p.x >> p.y >> p.z;
  text >> std::ws;
  size_t coloured = 0;
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    size_t corners = 0;
    words >> corners;
    Loop loop(corners);
    for (auto& v : loop) words >> v;
    mesh.loops.push_back(loop);
    int r = 0, g = 0, b = 0;
    if (words >> r >> g >> b) {
      ++coloured;
      EXPECT_EQ(r, 255);
      EXPECT_EQ(g, 128);
      EXPECT_EQ(b, 0);
    }
  }
  EXPECT_EQ(coloured, 6u);
  EXPECT_TRUE(is_closed(mesh.loops));
  EXPECT_DOUBLE_EQ(volume(mesh), 2);
}

// ---- all

TEST(Formats, SameBytesTwice) {
  const SolidPtr wheel = hexagon_wheel(24);
  for (const char* format : {"glb", "gltf", "stl", "obj", "off"}) {
    const std::string first = encode(format, {{"w", wheel, {}}});
    EXPECT_EQ(first, encode(format, {{"w", std::make_shared<Solid>(*wheel), {}}})) << format;
    EXPECT_FALSE(first.empty());
  }
}

TEST(Formats, NegativeZeroIsWrittenAsZero) {
  HandMade made;
  made.box({-0.0, -1, -1}, {1, -0.0, 1});
  EXPECT_EQ(encode("obj", {{"", made.share(), {}}}).find("-0 "), std::string::npos);
  HandMade plain;
  plain.box({0.0, -1, -1}, {1, 0.0, 1});
  EXPECT_EQ(encode("stl", {{"", made.share(), {}}}), encode("stl", {{"", plain.share(), {}}}));
}

TEST(Formats, AreKnownByTheirEnding) {
  EXPECT_EQ(model_format_of("a/b.c/out.GLB"), "glb");
  EXPECT_EQ(model_format_of("out.gltf"), "gltf");
  EXPECT_EQ(model_format_of("out.3mf"), "3mf");
  EXPECT_EQ(model_format_of("out.step"), "");
  EXPECT_EQ(model_format_of("a.stl/out"), "");
  EXPECT_EQ(model_format_of("stl"), "");
  EXPECT_TRUE(keeps_parts("glb") && keeps_parts("obj") && keeps_parts("gltf"));
  EXPECT_FALSE(keeps_parts("stl") || keeps_parts("off"));
}

TEST(Formats, PartsThatCannotBeWrittenAreTheCallersFault) {
  const auto error_of = [](const char* format, const Part& part) {
    WriteReport report;
    const auto result = encode_model(format, {part}, report);
    EXPECT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
    return result.error().message;
  };
  EXPECT_EQ(error_of("glb", {"lid", nullptr, {}}), "part 'lid' has no solid");
  EXPECT_EQ(error_of("exact.json", {"lid", testing::cube(1), {}}),
            "part 'lid' was evaluated without EvaluateOptions::exact_points");
  auto exact = std::make_shared<Solid>(*testing::cube(1));
  exact->exact_points.assign(8, {"0", "1/3", "1"});
  Part part{"lid", exact, {}};
  WriteReport report;
  EXPECT_TRUE(encode_model("exact.json", {part}, report));
  part.placement.m[0][3] = 1;
  EXPECT_NE(error_of("exact.json", part).find("part 'lid' has a placement"), std::string::npos);
}

}  // namespace
}  // namespace csgrun::formats_test
