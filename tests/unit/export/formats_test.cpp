// Bytes of written files, read back by small readers that share nothing with the writers.
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

namespace csgrun {
namespace {

using testing::HandMade;
using Loop = std::vector<uint32_t>;

struct Polygons {
  std::vector<glm::dvec3> points;
  std::vector<Loop> loops;
};

double volume(const Polygons& mesh) {
  double six = 0;
  for (const Loop& loop : mesh.loops) {
    for (size_t i = 1; i + 1 < loop.size(); ++i) {
      const glm::dvec3 &a = mesh.points[loop[0]], &b = mesh.points[loop[i]],
                       &c = mesh.points[loop[i + 1]];
      six += a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) +
             a.z * (b.x * c.y - b.y * c.x);
    }
  }
  return six / 6;
}

/// Every directed edge once, and its reverse once.
bool is_closed(const std::vector<Loop>& loops) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const Loop& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) ++edges[{loop[i], loop[(i + 1) % loop.size()]}];
  }
  for (const auto& [edge, count] : edges) {
    const auto reverse = edges.find({edge.second, edge.first});
    if (count != 1 || reverse == edges.end()) return false;
  }
  return !loops.empty();
}

std::string encode(const std::string& format, const std::vector<Part>& parts,
                   WriteReport* report = nullptr) {
  WriteReport unused;
  Result<std::string> bytes = encode_model(format, parts, report ? *report : unused);
  EXPECT_TRUE(bytes) << bytes.error().message;
  return bytes ? *bytes : std::string();
}

Polygons read_stl(const std::string& bytes) {
  Polygons mesh;
  uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);
  EXPECT_EQ(bytes.size(), 84 + 50 * size_t{count});
  for (uint32_t t = 0; t < count; ++t) {
    float f[12];
    std::memcpy(f, bytes.data() + 84 + 50 * size_t{t}, sizeof f);
    Loop loop;
    for (int corner = 1; corner < 4; ++corner) {
      loop.push_back(static_cast<uint32_t>(mesh.points.size()));
      mesh.points.emplace_back(f[3 * corner], f[3 * corner + 1], f[3 * corner + 2]);
    }
    mesh.loops.push_back(loop);
  }
  return mesh;
}

Polygons read_obj(const std::string& text) {
  Polygons mesh;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "v") {
      glm::dvec3 p;
      words >> p.x >> p.y >> p.z;
      mesh.points.push_back(p);
    } else if (key == "f") {
      Loop loop;
      for (uint32_t v; words >> v;) loop.push_back(v - 1);
      mesh.loops.push_back(loop);
    }
  }
  return mesh;
}

struct Glb {
  nlohmann::json json;
  std::string bin;
};

Glb read_glb(const std::string& bytes) {
  Glb glb;
  uint32_t header[5];
  std::memcpy(header, bytes.data(), sizeof header);
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(header[2], bytes.size());
  glb.json = nlohmann::json::parse(bytes.substr(20, header[3]));
  if (bytes.size() > 28 + header[3]) glb.bin = bytes.substr(28 + header[3]);
  return glb;
}

template <class T, size_t n>
std::vector<std::array<T, n>> accessor(const Glb& glb, size_t index) {
  const auto& a = glb.json["accessors"][index];
  const auto& view = glb.json["bufferViews"][a["bufferView"].get<size_t>()];
  std::vector<std::array<T, n>> values(a["count"].get<size_t>());
  std::memcpy(values.data(),
              glb.bin.data() + view.value("byteOffset", 0) + a.value("byteOffset", 0),
              values.size() * sizeof values[0]);
  if (a.contains("sparse")) {
    const auto& s = a["sparse"];
    const auto bytes = [&](const char* part) {
      const auto& v = glb.json["bufferViews"][s[part]["bufferView"].get<size_t>()];
      return glb.bin.data() + v.value("byteOffset", 0) + s[part].value("byteOffset", 0);
    };
    for (size_t i = 0; i < s["count"].get<size_t>(); ++i) {
      uint32_t at = 0;
      std::memcpy(&at, bytes("indices") + 4 * i, 4);
      std::memcpy(&values[at], bytes("values") + sizeof values[0] * i, sizeof values[0]);
    }
  }
  return values;
}

/// The manifold of one mesh of a GLB, as EXT_mesh_manifold describes it.
Polygons manifold_of(const Glb& glb, size_t mesh_index) {
  const auto& extension = glb.json["meshes"][mesh_index]["extensions"]["EXT_mesh_manifold"];
  const auto& primitive = extension["manifoldPrimitive"];
  Polygons mesh;
  for (const auto& p : accessor<float, 3>(glb, primitive["attributes"]["POSITION"])) {
    mesh.points.emplace_back(p[0], p[1], p[2]);
  }
  Loop indices;
  for (const auto& i : accessor<uint32_t, 1>(glb, primitive["indices"])) indices.push_back(i[0]);
  for (size_t i = 0; i < indices.size(); i += 3) {
    mesh.loops.push_back({indices[i], indices[i + 1], indices[i + 2]});
  }
  return mesh;
}

Appearance colour(float r, float g, float b, float alpha = 1) {
  Appearance a;
  a.red = r;
  a.green = g;
  a.blue = b;
  a.alpha = alpha;
  a.is_default = false;
  return a;
}

SolidPtr hexagon_wheel(int corners) {
  std::vector<std::pair<double, double>> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / corners;
    outline.emplace_back(std::cos(angle), std::sin(angle));
  }
  HandMade made;
  made.prism(outline, 1, 1);
  return made.share();
}

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

// ---- glTF

TEST(Gltf, CubeHasFlatNormalsAndAManifold) {
  const Glb glb = read_glb(encode("glb", {{"box", testing::cube(10), {}}}));
  const auto& primitive = glb.json["meshes"][0]["primitives"][0];
  const auto positions = accessor<float, 3>(glb, primitive["attributes"]["POSITION"]);
  const auto normals = accessor<float, 3>(glb, primitive["attributes"]["NORMAL"]);
  EXPECT_EQ(positions.size(), 24u);
  for (const auto& n : normals) {
    EXPECT_EQ(std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]), 1);
  }
  const Polygons mesh = manifold_of(glb, 0);
  EXPECT_TRUE(is_closed(mesh.loops));
  EXPECT_DOUBLE_EQ(volume(mesh), 1000);
  EXPECT_EQ(glb.json["accessors"][primitive["attributes"]["POSITION"].get<size_t>()]["max"],
            (std::vector<double>{10, 10, 10}));
  const auto& root = glb.json["nodes"][glb.json["scenes"][0]["nodes"][0].get<size_t>()];
  EXPECT_EQ(root["scale"], (std::vector<double>{0.001, 0.001, 0.001}));
  EXPECT_EQ(glb.json["asset"]["generator"].get<std::string>().substr(0, 7), "csgrun ");
}

TEST(Gltf, CurvedSurfaceIsSmoothAndItsRimSharp) {
  const SolidPtr wheel = hexagon_wheel(24);
  const Glb glb = read_glb(encode("glb", {{"wheel", wheel, {}}}));
  const auto& primitive = glb.json["meshes"][0]["primitives"][0];
  const auto positions = accessor<float, 3>(glb, primitive["attributes"]["POSITION"]);
  const auto normals = accessor<float, 3>(glb, primitive["attributes"]["NORMAL"]);
  EXPECT_EQ(positions.size(), 4 * 24u);  // each corner once for the side, once for the cap
  for (size_t v = 0; v < positions.size(); ++v) {
    if (std::abs(normals[v][2]) > 0.5f) continue;
    // On the side the normal is the radius, as that of a true cylinder.
    EXPECT_NEAR(normals[v][0], positions[v][0], 1e-6);
    EXPECT_NEAR(normals[v][1], positions[v][1], 1e-6);
  }
  // Facets of a hexagon meet at 60 degrees: six flat sides.
  const Glb hexagon = read_glb(encode("glb", {{"nut", hexagon_wheel(6), {}}}));
  EXPECT_EQ(hexagon.json["accessors"][0]["count"], 6 * 6);
}

TEST(Gltf, OnePrimitivePerMaterialOverSharedAccessors) {
  HandMade made;
  const auto red = made.appearance(colour(1, 0, 0)),
             glass = made.appearance(colour(0.5f, 0.5f, 0.5f, 0.25f));
  made.box({0, 0, 0}, {1, 1, 1}, red);
  made.box({2, 0, 0}, {3, 1, 1}, glass);
  made.box({4, 0, 0}, {5, 1, 1}, red);
  const Glb glb = read_glb(encode("glb", {{"p", made.share(), {}}}));
  const auto& primitives = glb.json["meshes"][0]["primitives"];
  ASSERT_EQ(primitives.size(), 2u);
  EXPECT_EQ(primitives[0]["attributes"], primitives[1]["attributes"]);
  const auto view = [&](size_t p) {
    return glb.json["accessors"][primitives[p]["indices"].get<size_t>()]["bufferView"];
  };
  EXPECT_EQ(view(0), view(1));
  const auto& materials = glb.json["materials"];
  ASSERT_EQ(materials.size(), 2u);
  EXPECT_EQ(materials[0]["pbrMetallicRoughness"]["baseColorFactor"],
            (std::vector<double>{1, 0, 0, 1}));
  // sRGB 0.5 is linear 0.214041 (IEC 61966-2-1).
  EXPECT_EQ(materials[1]["pbrMetallicRoughness"]["baseColorFactor"],
            (std::vector<double>{0.214041, 0.214041, 0.214041, 0.25}));
  EXPECT_EQ(materials[1]["alphaMode"], "BLEND");
  EXPECT_EQ(materials[0].value("alphaMode", "OPAQUE"), "OPAQUE");
  EXPECT_TRUE(is_closed(manifold_of(glb, 0).loops));
  EXPECT_DOUBLE_EQ(volume(manifold_of(glb, 0)), 3);
}

TEST(Gltf, InstancesShareAMeshAndGroupsNest) {
  const SolidPtr shared = testing::cube(1);
  Affine moved, turned, sheared;
  moved.m[0][3] = 5;
  turned.m = {{{0, -1, 0, 1}, {1, 0, 0, 2}, {0, 0, 1, 3}}};
  sheared.m[0][1] = 0.5;
  const Glb glb = read_glb(encode("glb", {{"case/lid", shared, {}},
                                          {"case/inner/box", shared, moved},
                                          {"plate", shared, turned},
                                          {"slant", shared, sheared}}));
  const auto& nodes = glb.json["nodes"];
  std::map<std::string, nlohmann::json> by_name;
  for (const auto& node : nodes) by_name[node["name"]] = node;
  EXPECT_EQ(glb.json["meshes"].size(), 2u);
  EXPECT_EQ(by_name["lid"]["mesh"], by_name["box"]["mesh"]);
  EXPECT_EQ(by_name["lid"]["mesh"], by_name["plate"]["mesh"]);
  EXPECT_NE(by_name["lid"]["mesh"], by_name["slant"]["mesh"]);
  EXPECT_EQ(by_name["box"]["translation"], (std::vector<double>{5, 0, 0}));
  EXPECT_EQ(by_name["plate"]["matrix"],
            (std::vector<double>{0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}));
  const auto child_names = [&](const std::string& name) {
    std::vector<std::string> names;
    for (const auto& child : by_name[name]["children"])
      names.push_back(nodes[child.get<size_t>()]["name"]);
    return names;
  };
  EXPECT_EQ(child_names("model"), (std::vector<std::string>{"case", "plate", "slant"}));
  EXPECT_EQ(child_names("case"), (std::vector<std::string>{"lid", "inner"}));
  EXPECT_EQ(child_names("inner"), (std::vector<std::string>{"box"}));
  const size_t slant = by_name["slant"]["mesh"];
  double highest = 0;
  for (const auto& p : manifold_of(glb, slant).points) highest = std::max(highest, p.x);
  EXPECT_EQ(highest, 1.5);
}

TEST(Gltf, MirroredBakedPartStaysOutsideOut) {
  Affine mirror;
  mirror.m[0][0] = -1;
  mirror.m[0][1] = 0.25;
  const Glb glb = read_glb(encode("glb", {{"m", testing::cube(2), mirror}}));
  const Polygons mesh = manifold_of(glb, 0);
  EXPECT_TRUE(is_closed(mesh.loops));
  EXPECT_DOUBLE_EQ(volume(mesh), 8);
  const Polygons obj = read_obj(encode("obj", {{"m", testing::cube(2), mirror}}));
  EXPECT_TRUE(is_closed(obj.loops));
  EXPECT_EQ(obj.loops.size(), 6u);
  EXPECT_DOUBLE_EQ(volume(obj), 8);
  EXPECT_DOUBLE_EQ(volume(read_stl(encode("stl", {{"m", testing::cube(2), mirror}}))), 8);
}

TEST(Gltf, NamesOfAnyBytesAreValidText) {
  const std::string name = "caf\xC3\xA9 \xFF\xC0\xAF\xED\xA0\x80";
  const Glb glb = read_glb(encode("glb", {{name, testing::cube(1), {}}}));
  const std::string bad = "\xEF\xBF\xBD";
  EXPECT_EQ(glb.json["nodes"][1]["name"].get<std::string>(),
            "caf\xC3\xA9 " + bad + bad + bad + bad + bad + bad);
}

TEST(Gltf, TextHoldsTheSameModel) {
  const std::vector<Part> parts = {{"box", testing::cube(3), {}}};
  const Glb glb = read_glb(encode("glb", parts));
  auto text = nlohmann::json::parse(encode("gltf", parts));
  EXPECT_EQ(text["buffers"][0]["uri"].get<std::string>().substr(0, 37),
            "data:application/octet-stream;base64,");
  auto binary = glb.json;
  text.erase("buffers");
  binary.erase("buffers");
  EXPECT_EQ(text, binary);
}

TEST(Gltf, NormalsOfDegenerateTrianglesAreThoseOfTheExactFace) {
  // The apex lies on the base after rounding to float, and on an edge: a triangle without area.
  HandMade flat;
  const auto a = flat.vertex(0, 0, 0), b = flat.vertex(1, 0, 0), c = flat.vertex(0, 1, 0),
             d = flat.vertex(0.5, 1e-60, -1e-60), e = flat.vertex(0.2, 0.2, 1);
  flat.face({a, c, d});
  flat.face({c, b, d});
  flat.face({b, a, d});
  flat.face({a, b, e});
  flat.face({b, c, e});
  flat.face({c, a, e});
  const Glb glb = read_glb(encode("glb", {{"f", flat.share(), {}}}));
  const auto normals =
      accessor<float, 3>(glb, glb.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"]);
  for (const auto& n : normals) {
    EXPECT_NEAR(std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), 1, 1e-6);
  }
  EXPECT_TRUE(is_closed(manifold_of(glb, 0).loops));
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
  EXPECT_EQ(model_format_of("out.3mf"), "");
  EXPECT_EQ(model_format_of("a.stl/out"), "");
  EXPECT_EQ(model_format_of("stl"), "");
  EXPECT_TRUE(keeps_parts("glb") && keeps_parts("obj") && keeps_parts("gltf"));
  EXPECT_FALSE(keeps_parts("stl") || keeps_parts("off"));
}

}  // namespace
}  // namespace csgrun
