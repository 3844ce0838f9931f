// Measuring mesh files: volumes against rationals, topology and crossings against known cases.
#include "lua_bindings/measure/mesh_measures.h"
#include "lua_bindings/measure/read_glb.h"
#include "lua_support.h"
#include "tests/support/rationals.h"

namespace csgrun::testing::measure_test {
namespace {

using boost::multiprecision::cpp_rational;

/// A box as twelve triangles, appended with points of its own.
void add_box(TriangleMesh& mesh, const glm::dvec3& low, const glm::dvec3& high) {
  const auto first = static_cast<uint32_t>(mesh.points.size());
  for (int i = 0; i < 8; ++i) {
    mesh.points.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y,
                             i & 4 ? high.z : low.z);
  }
  constexpr uint32_t kFaces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                      {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                      {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const auto& face : kFaces)
    mesh.triangles.push_back({first + face[0], first + face[1], first + face[2]});
}

TriangleMesh boxes(const std::vector<std::array<glm::dvec3, 2>>& corners) {
  TriangleMesh mesh;
  for (const auto& [low, high] : corners) add_box(mesh, low, high);
  weld(mesh);
  return mesh;
}

TEST(Boxes, HaveASizeAndACentre) {
  expect_good(
      "local b = cube(2, 4, 6):translate(1, 1, 1):bbox() assert(b.size == vec(2, 4, 6) and "
      "b.center "
      "== vec(2, 3, 4) and b.min + b.size == b.max) b = square(2, 4):translate(1, 1):bounds() "
      "assert(b.size == vec(2, 4) and b.center == vec(2, 3))");
}

TEST(Measure, ABox) {
  const TriangleMesh mesh = boxes({{glm::dvec3(0.1, 0.2, 0.3), glm::dvec3(1.1, 2.2, 3.3)}});
  const PartMeasures m = measure(mesh);
  EXPECT_TRUE(m.closed);
  EXPECT_EQ(m.triangles, 12u);
  EXPECT_EQ(m.vertices, 8u);
  EXPECT_EQ(m.components, 1);
  EXPECT_EQ(m.genus, 0);
  const cpp_rational volume = (rational(1.1) - rational(0.1)) * (rational(2.2) - rational(0.2)) *
                              (rational(3.3) - rational(0.3));
  EXPECT_TRUE(is_nearest(volume, m.volume));
  EXPECT_DOUBLE_EQ(m.area, 2 * (1.0 * 2 + 2.0 * 3 + 1.0 * 3));
  EXPECT_EQ(m.bbox[1], glm::dvec3(1.1, 2.2, 3.3));
}

TEST(Measure, BoxesThatTouchInAnEdgeOrAVertexAreTwo) {
  for (const glm::dvec3& shift :
       {glm::dvec3(1, 1, 0), glm::dvec3(0, 1, 1), glm::dvec3(1, 1, 1), glm::dvec3(1, -1, 0)}) {
    const PartMeasures m =
        measure(boxes({{glm::dvec3(0), glm::dvec3(1)}, {shift, shift + glm::dvec3(1)}}));
    EXPECT_TRUE(m.closed);
    EXPECT_EQ(m.components, 2);
    EXPECT_EQ(m.vertices, 16u);
    EXPECT_EQ(m.genus, 0);
    EXPECT_EQ(m.volume, 2);
  }
}

TEST(Measure, OpenAndInsideOut) {
  TriangleMesh mesh = boxes({{glm::dvec3(0), glm::dvec3(1)}});
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(measure(mesh).volume, -1);
  mesh.triangles.pop_back();
  EXPECT_FALSE(measure(mesh).closed);
}

TEST(Crossings, OfBoxes) {
  const glm::dvec3 o(0), e(1);
  EXPECT_EQ(count_crossings(boxes({{o, e}})), 0u);
  EXPECT_EQ(count_crossings(boxes({{o, e}, {glm::dvec3(2), glm::dvec3(3)}})), 0u);
  EXPECT_EQ(count_crossings(boxes({{o, e}, {glm::dvec3(0.25), glm::dvec3(0.75)}})), 0u)
      << "one inside the other";
  EXPECT_EQ(count_crossings(boxes({{o, e}, {glm::dvec3(1, 1, 0), glm::dvec3(2, 2, 1)}})), 0u)
      << "an edge that both have";
  EXPECT_EQ(count_crossings(boxes({{o, e}, {glm::dvec3(1), glm::dvec3(2)}})), 0u)
      << "a vertex that both have";
  EXPECT_GT(count_crossings(boxes({{o, e}, {glm::dvec3(0.5), glm::dvec3(1.5)}})), 0u)
      << "through one another";
  EXPECT_GT(
      count_crossings(boxes({{o, e}, {glm::dvec3(1, 0.25, 0.25), glm::dvec3(2, 0.75, 0.75)}})), 0u)
      << "face on face";
  EXPECT_GT(count_crossings(boxes({{o, e}, {glm::dvec3(1, 0, 0), glm::dvec3(2, 1, 1)}})), 0u)
      << "a whole face in common";
  EXPECT_GT(count_crossings(boxes({{o, e}, {glm::dvec3(1, 1, 0.5), glm::dvec3(2, 2, 1.5)}})), 0u)
      << "part of an edge";
  EXPECT_EQ(count_crossings(
                boxes({{o, e}, {glm::dvec3(std::nextafter(1.0, 2), 0, 0), glm::dvec3(2, 1, 1)}})),
            0u)
      << "one bit apart";
}

/// Two triangles with points of their own, welded.
uint64_t crossings_of(const std::array<glm::dvec3, 6>& points) {
  TriangleMesh mesh;
  mesh.points.assign(points.begin(), points.end());
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  weld(mesh);
  return count_crossings(mesh);
}

TEST(Crossings, OfTwoTriangles) {
  const glm::dvec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  EXPECT_EQ(
      crossings_of({a, b, c, glm::dvec3(1, 1, -1), glm::dvec3(1, 1, 1), glm::dvec3(9, 9, 0.5)}), 1u)
      << "pierced";
  EXPECT_EQ(crossings_of({a, b, c, glm::dvec3(1, 1, 0), glm::dvec3(1, 1, 1), glm::dvec3(2, 2, 1)}),
            1u)
      << "touched by a corner";
  EXPECT_EQ(crossings_of({a, b, c, glm::dvec3(3, 3, 0), glm::dvec3(3, 3, 1), glm::dvec3(4, 4, 1)}),
            0u)
      << "beside it";
  EXPECT_EQ(crossings_of({a, b, c, a, b, glm::dvec3(1, 1, 1)}), 0u) << "an edge in common";
  EXPECT_EQ(crossings_of({a, b, c, b, a, glm::dvec3(1, -1, 0)}), 0u) << "the same, flat";
  EXPECT_EQ(crossings_of({a, b, c, a, b, glm::dvec3(1, 1, 0)}), 1u) << "folded upon it";
  EXPECT_EQ(crossings_of({a, b, c, a, glm::dvec3(-1, 0, 0), glm::dvec3(0, -1, 0)}), 0u)
      << "a corner in common, flat";
  EXPECT_EQ(crossings_of({a, b, c, a, glm::dvec3(1, 1, 0), glm::dvec3(2, 1, 0)}), 1u)
      << "a corner in common, inside";
  EXPECT_EQ(crossings_of({a, b, c, a, glm::dvec3(1, 1, 1), glm::dvec3(1, 2, -1)}), 1u)
      << "a corner in common, through";
  EXPECT_EQ(crossings_of({a, b, c, a, glm::dvec3(1, 1, 1), glm::dvec3(1, 2, 1)}), 0u)
      << "a corner in common, above";
  EXPECT_EQ(crossings_of({a, b, c, a, glm::dvec3(2, 0, 0), glm::dvec3(1, 0, 1)}), 1u)
      << "half an edge in common";
  EXPECT_EQ(crossings_of({a, b, c, c, b, a}), 1u) << "back to back";
  EXPECT_EQ(crossings_of({a, b, c, glm::dvec3(9, 0, 0), glm::dvec3(9, 4, 0), glm::dvec3(5, 0, 0)}),
            0u)
      << "one plane, apart";
  EXPECT_EQ(
      crossings_of({a, b, c, glm::dvec3(1, 1, 0), glm::dvec3(1.5, 1, 0), glm::dvec3(1, 1.5, 0)}),
      1u)
      << "one plane, inside";
}

TEST(Triangulation, OfConcavePolygons) {
  PolygonMesh mesh;
  mesh.points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {3, 1, 0}, {1, 1, 0}, {0, 4, 0}};
  mesh.add_face(std::vector<uint32_t>{0, 1, 2, 3, 4, 5});
  const TriangleMesh triangles = triangulated(mesh, false);
  EXPECT_EQ(triangles.triangles.size(), 4u);
  EXPECT_EQ(count_crossings(triangles), 0u);
  EXPECT_DOUBLE_EQ(measure(triangles).area, 16 - (4 + 2) / 2.0 * 3);
  mesh = PolygonMesh();
  mesh.points = {{0, 0, 0}, {0, 4, 0}, {0, 4, 4}, {0, 0, 4}};  // seen along X
  mesh.add_face(std::vector<uint32_t>{0, 1, 2, 3});
  EXPECT_DOUBLE_EQ(measure(triangulated(mesh, false)).area, 16);
}

TEST(Glb, DamageIsAnError) {
  for (const std::string& bytes : {std::string(), std::string("glTF"), std::string(100, 'x'),
                                   std::string("glTF\2\0\0\0\24\0\0\0\377\377\377\177JSON", 20)}) {
    EXPECT_FALSE(parse_glb("x.glb", bytes)) << bytes.size();
  }
}

/// What reading a GLB of this JSON, without data, says; empty when it is read.
std::string message_of_glb(std::string json) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](size_t value) {
    std::string bytes(4, '\0');
    for (size_t i = 0; i < 4; ++i) bytes[i] = static_cast<char>(value >> (8 * i));
    return bytes;
  };
  const auto meshes = parse_glb(
      "x.glb", "glTF" + word(2) + word(20 + json.size()) + word(json.size()) + "JSON" + json);
  return meshes ? "" : meshes.error().message;
}

TEST(Glb, NamesOfNodesDoNotPileUp) {
  // A chain of nodes: the names from the root down together are far longer than the file.
  const auto chain = [](int count) {
    std::string nodes;
    for (int i = 1; i <= count; ++i)
      nodes += R"({"name":"abcdefghi","children":[)" + std::to_string(i) + "]},";
    return R"({"nodes":[)" + nodes + R"({"name":"last"}]})";
  };
  EXPECT_EQ(message_of_glb(chain(400)), "");
  EXPECT_EQ(message_of_glb(chain(30000)),
            "x.glb: the name of a node and its groups is longer than 4096 bytes");
}

TEST(Glb, TakesWholeNumbersOnly) {
  const std::pair<const char*, const char*> kIndices[] = {{"-1", "the number -1"},
                                                          {"1e300", "the number 1e+300"},
                                                          {"0.5", "the number 0.5"},
                                                          {"\"0\"", "a string"},
                                                          {"null", "null"}};
  for (const auto& [index, kind] : kIndices) {
    EXPECT_EQ(
        message_of_glb(R"({"nodes":[{}],"scenes":[{"nodes":[)" + std::string(index) + "]}]}"),
        std::string("x.glb: scenes[0].nodes[0] must be a whole number from 0 on, it is ") + kind);
  }
}

TEST(Glb, NestingIsCountedOutsideOfStrings) {
  const auto nested = [](const std::string& text, size_t depth) {
    std::string all;
    for (size_t level = 1; level < depth; ++level) all += "[" + text + ",";
    all += "0";
    return R"({"extras":)" + all + std::string(depth - 1, ']') + "}";
  };
  for (const char* text : {"1", R"("[[[[{{{{")", R"("\\")", R"("\"[{")", R"({"]}":[]},[])"}) {
    const auto fits = parse_glb("x.gltf", nested(text, 500));
    EXPECT_TRUE(fits) << text << ": " << fits.error().message;
    const auto deep = parse_glb("x.gltf", nested(text, 513));
    ASSERT_FALSE(deep);
    EXPECT_EQ(deep.error().message, "x.gltf: its JSON is nested more than 512 deep") << text;
  }
}

TEST(Glb, SaysWhatIsWrongAndWhere) {
  const std::pair<const char*, const char*> kDocuments[] = {
      {R"({"buffers":[{"uri":5}]})", "buffers[0].uri must be a string, it is the number 5"},
      {R"({"buffers":[5]})", "buffers[0] must be an object, it is the number 5"},
      {R"({"buffers":{}})", "buffers must be a list, it is an object"},
      {R"({"nodes":[{"mesh":2}],"meshes":[{}]})",
       "meshes has 1 entries, none of number 2 (from 0)"},
      {R"({"nodes":[{"mesh":0}],"meshes":[{}]})", "meshes[0] has no \"primitives\""},
      {R"({"nodes":[{"mesh":0,"matrix":[1]}]})",
       "nodes[0].matrix must be a list of 16 numbers, it is another one"},
      {R"({"nodes":[1})", "its JSON is malformed at byte 12"},
      {"[]",
       "it is neither a GLB, which begins with \"glTF\", nor glTF as JSON, which is an "
       "object and begins with \"{\""},
      {"gl", "the file ends after 2 bytes, in a number at 4"},
      {"", "the file ends after 0 bytes, in a number at 4"}};
  for (const auto& [text, said] : kDocuments) {
    const auto meshes = parse_glb("x.gltf", text);
    ASSERT_FALSE(meshes) << text;
    EXPECT_EQ(meshes.error().message, std::string("x.gltf: ") + said);
  }
}

}  // namespace
}  // namespace csgrun::testing::measure_test
