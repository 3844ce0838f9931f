// Bytes of written glTF, read back.
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csgrun/export/write.h>

#include "tests/unit/export/hand_made.h"
#include "tests/unit/export/read_back.h"

namespace csgrun::gltf_test {
namespace {

using testing::HandMade;

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

TEST(Gltf, PlacesBeyondItsNumbersAreRefused) {
  for (const double x : {std::nan(""), double{INFINITY}, 1e39}) {
    for (const char* format : {"glb", "gltf", "stl"}) {
      Affine placement;
      placement.m[0][3] = x;
      WriteReport report;
      const auto bytes = encode_model(format, {{"box", testing::cube(10), placement}}, report);
      EXPECT_FALSE(bytes) << format << ' ' << x;
    }
  }
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

}  // namespace
}  // namespace csgrun::gltf_test
