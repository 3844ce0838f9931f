// Along which diagonal OpenSCAD cuts a face of four corners that is bent.
#include "primitives/solids/bent_quads.h"

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/csg_file.h>
#include <csgrun/primitives/mesh_file.h>

#include "tests/unit/primitives/csg_trees.h"
#include "tests/unit/primitives/mesh_measures.h"

namespace csgrun::bent_quads_test {
namespace {

struct Case {
  std::array<std::array<int, 3>, 4> corners;
  uint32_t end;  ///< of the diagonal: this corner and the next but one
};

// What the tessellator of OpenSCAD (libtess2, constrained Delaunay triangles, the rule for odd
// windings) makes of them. Where the shadow is a square both diagonals are Delaunay's.
constexpr Case kCases[] = {
    {{{{0, 0, 0}, {1, 1, 1}, {0, 1, 0}, {1, 0, 0}}}, 1},
    {{{{1, 0, 1}, {1, 0, 0}, {0, 0, 0}, {1, 1, 1}}}, 1},
    {{{{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 0}}}, 0},
    {{{{1, 1, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 1}}}, 1},
    {{{{0, 1, 0}, {1, 1, 1}, {1, 0, 0}, {0, 0, 0}}}, 1},
    {{{{1, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}}, 1},
    {{{{0, 1, 1}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}, 0},
    {{{{1, 1, 1}, {0, 1, 0}, {0, 0, 0}, {0, 1, 1}}}, 1},
    {{{{0, 0, 0}, {0, 1, 1}, {0, 0, 1}, {1, 1, 1}}}, 3},
    {{{{0, 1, 0}, {0, 1, 1}, {1, 0, 1}, {0, 0, 1}}}, 0},
    {{{{1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {1, 1, 1}}}, 1},
    {{{{1, 0, 1}, {0, 0, 1}, {1, 0, 0}, {1, 1, 1}}}, 1},
    {{{{1, 0, 1}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 1},
    {{{{0, 1, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 1}}}, 0},
    {{{{1, 1, 1}, {0, 1, 1}, {1, 1, 0}, {1, 0, 1}}}, 1},
    {{{{0, 1, 0}, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}}}, 1},
    {{{{1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 0, 0}}}, 1},
    {{{{0, 1, 0}, {1, 1, 1}, {1, 0, 0}, {1, 1, 0}}}, 1},
    {{{{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 0}}}, 0},
    {{{{0, 1, 0}, {1, 1, 1}, {1, 0, 1}, {0, 1, 1}}}, 1},
    {{{{1, 1, 1}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}}}, 1},
    {{{{0, 1, 0}, {1, 1, 1}, {0, 0, 1}, {1, 0, 0}}}, 0},
    {{{{1, 1, 1}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, 0},
    {{{{0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 1, 0}}}, 1},
    {{{{1, 1, 1}, {1, 1, 0}, {0, 0, 0}, {1, 0, 1}}}, 0},
    {{{{1, 1, 1}, {0, 0, 1}, {0, 0, 0}, {0, 1, 0}}}, 1},
    {{{{-1, 1, 1}, {0, 1, 0}, {-1, 0, 0}, {-1, 0, 1}}}, 0},
    {{{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {1, 1, 1}}}, 1},
    {{{{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 0, 0}}}, 1},
    {{{{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}}}, 1},
    {{{{-1, 1, -1}, {0, 0, -1}, {-1, 0, 0}, {-1, 1, 0}}}, 1},
    {{{{0, 0, -1}, {0, 0, 0}, {1, -1, 0}, {0, -1, -1}}}, 0},
    {{{{0, 1, 1}, {0, 1, 0}, {1, 1, 0}, {1, 0, 1}}}, 1},
    {{{{1, 1, 1}, {1, 1, 0}, {0, 0, 0}, {1, 0, 1}}}, 0},
    {{{{0, -1, -1}, {0, -1, 0}, {0, 0, 0}, {1, 0, -1}}}, 0},
    {{{{1, 0, 1}, {1, 1, 0}, {0, 1, 0}, {0, 1, 1}}}, 1},
    {{{{0, 0, 0}, {0, 0, 1}, {-1, -1, 1}, {0, -1, 0}}}, 0},
    {{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 1, 1}}}, 0},
    {{{{5, 0, 5}, {0, 0, 3}, {6, 3, 0}, {5, 1, 6}}}, 0},
    {{{{1, 2, 0}, {0, 2, 2}, {2, 1, 2}, {2, 1, 1}}}, 1},
    {{{{5, 2, 2}, {2, 3, 2}, {2, 0, 0}, {1, 6, 3}}}, 1},
    {{{{2, 4, 0}, {2, 2, 3}, {3, 2, 2}, {5, 0, 5}}}, 0},
    {{{{2, 2, 2}, {2, 2, 0}, {1, 2, 0}, {0, 1, 2}}}, 0},
    {{{{4, 4, 3}, {4, 1, 3}, {4, 0, 2}, {1, 6, 3}}}, 1},
    {{{{1, 3, 0}, {1, 0, 2}, {0, 2, 2}, {2, 3, 3}}}, 0},
    {{{{1, 1, 0}, {0, 0, 0}, {3, 2, 2}, {3, 2, 1}}}, 0},
    {{{{2, 6, 4}, {6, 2, 4}, {4, 2, 2}, {1, 6, 0}}}, 0},
    {{{{0, 1, 0}, {1, 0, 1}, {2, 2, 1}, {1, 2, 1}}}, 1},
    {{{{1, 1, 1}, {3, 0, 0}, {2, 0, 3}, {2, 3, 3}}}, 0},
    {{{{3, 2, 6}, {2, 2, 4}, {0, 1, 2}, {4, 0, 3}}}, 1},
    {{{{1, 5, 2}, {3, 0, 4}, {0, 1, 4}, {4, 4, 5}}}, 0},
    {{{{2, 2, 2}, {6, 3, 0}, {2, 5, 6}, {4, 1, 5}}}, 0},
    {{{{5, 3, 5}, {6, 0, 6}, {4, 2, 1}, {2, 0, 4}}}, 0},
    {{{{1, 2, 0}, {2, 0, 2}, {0, 0, 0}, {2, 1, 0}}}, 1},
    {{{{6, 0, 3}, {4, 6, 4}, {5, 1, 3}, {1, 4, 5}}}, 0},
    {{{{4, 5, 5}, {0, 4, 1}, {2, 5, 5}, {2, 3, 6}}}, 0},
};

TEST(BentQuads, AreCutAsOpenScadCutsThem) {
  for (const Case& c : kCases) {
    for (const double scale : {1.0, 1024.0}) {
      PolygonMesh mesh;
      for (const auto& p : c.corners) mesh.points.emplace_back(p[0], p[1], p[2]);
      // Exact, so every tie stays one.
      for (glm::dvec3& p : mesh.points) p *= scale;
      mesh.add_face(std::array<uint32_t, 4>{0, 1, 2, 3}, 5);
      mesh.appearance_of = {2};
      cut_bent_quads(mesh);
      ASSERT_EQ(mesh.face_count(), 2u);
      EXPECT_EQ(mesh.surface, (std::vector<uint32_t>{5, 5}));
      EXPECT_EQ(mesh.appearance_of, (std::vector<uint32_t>{2, 2}));
      const uint32_t a = mesh.corners[0], b = mesh.corners[2];
      EXPECT_EQ(a % 2, c.end % 2) << ::testing::PrintToString(c.corners);
      EXPECT_EQ((a + 2) % 4, b);
      EXPECT_EQ(mesh.corners[3], a);
      EXPECT_EQ(mesh.corners[4], b);
    }
  }
}

TEST(BentQuads, FlatOnesAndOthersStay) {
  PolygonMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 1e-9}, {0, 1, 0},
                 {2, 0, 1}, {2, 1, 0}, {3, 3, 3},    {1, 1, 0}};
  mesh.add_face(std::array<uint32_t, 4>{0, 1, 2, 3});
  mesh.add_face(std::array<uint32_t, 3>{0, 1, 4});
  mesh.add_face(std::array<uint32_t, 5>{0, 1, 4, 5, 6});
  const PolygonMesh before = mesh;
  cut_bent_quads(mesh);
  EXPECT_EQ(mesh.corners, before.corners);
  mesh.add_face(std::array<uint32_t, 4>{1, 4, 5, 7});  // bent
  cut_bent_quads(mesh);
  EXPECT_EQ(mesh.face_count(), 5u);
}

/// A unit cube whose top has one corner pulled up by 1: the volume tells the diagonal.
TEST(BentQuads, GiveTheVolumesOfOpenScad) {
  const std::string start =
      "polyhedron(points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, ";
  const std::string faces =
      "faces = [[0, 1, 2, 3], [4, 5, 1, 0], [7, 6, 5, 4], [5, 6, 2, 1], [6, 7, 3, 2], [7, 4, 0, "
      "3]], "
      "convexity = 1);";
  const auto volume = [&](const std::string& heights) {
    const auto model = parse_csg("m.csg", start + heights + "]], " + faces);
    EXPECT_TRUE(model) << (model ? "" : model.error().message);
    return model ? testing::volume(*model->solid->mesh()) : 0;
  };
  // One corner of the top is pulled up. It is seen along X, where two of its corners are one.
  EXPECT_DOUBLE_EQ(volume("2], [1, 0, 1], [1, 1, 1], [0, 1, 1"), 1 + 1.0 / 3);
  EXPECT_DOUBLE_EQ(volume("1], [1, 0, 2], [1, 1, 1], [0, 1, 1"), 1 + 1.0 / 3);
  EXPECT_DOUBLE_EQ(volume("1], [1, 0, 1], [1, 1, 2], [0, 1, 1"), 1 + 1.0 / 6);
  EXPECT_DOUBLE_EQ(volume("1], [1, 0, 1], [1, 1, 1], [0, 1, 2"), 1 + 1.0 / 3);
}

TEST(BentQuads, OfMeshFilesAreCutAlike) {
  const std::string off =
      "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 2\n1 1 1\n0 1 1\n4 3 2 1 0\n4 0 1 5 4\n"
      "4 4 5 6 7\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  auto mesh = parse_mesh("a.off", off);
  ASSERT_TRUE(mesh);
  auto solid = make_solid_mesh(*mesh, nullptr);
  ASSERT_TRUE(solid);
  EXPECT_DOUBLE_EQ(testing::volume(*solid), 1 + 1.0 / 3);
  std::vector<std::string> notes;
  auto repaired = repair_solid_mesh(*mesh, {}, &notes);
  ASSERT_TRUE(repaired);
  EXPECT_DOUBLE_EQ(testing::volume(*repaired), 1 + 1.0 / 3);
}

// A block with one corner of the top pulled down: 263.0833 where it is made, 285.5417 where the
// other diagonal is taken.
const std::string kPoints =
    "[[0, 0, 0], [7, 0, 0], [7, 5.5, 0], [0, 5.5, 0], [0, 0, 8], [7, 0, 4.5], [7, 5.5, 8], [0, "
    "5.5, "
    "8]]";
const std::string kBent = "polyhedron(points = " + kPoints +
                          ", faces = [[0, 1, 2, 3], [7, 6, 5, 4], [0, 4, 5, 1], [1, 5, 6, 2], [2, "
                          "6, 7, 3], [3, 7, 4, 0]], convexity = 1);\n";
const std::string kInsideOut =
    "polyhedron(points = " + kPoints +
    ", faces = [[3, 2, 1, 0], [4, 5, 6, 7], [1, 5, 4, 0], [2, 6, 5, 1], [3, 7, 6, 2], [0, 4, 7, "
    "3]], convexity = 1);\n";
const std::string kMirror = "multmatrix([[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])";
constexpr double kAsMade = 263.083333, kOther = 285.541667;

double volume_of(const NodePtr& solid) {
  Evaluator evaluator{EvaluateOptions{}};
  const auto result = evaluator.evaluate(solid);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? (*result)->measures.volume : 0;
}

double volume_of(const std::string& text) { return volume_of(testing::parse(text).solid); }

struct Tree {
  std::string text;
  double volume;
};

// The volumes of OpenSCAD 2025.01, which are also those of 2021.01.
TEST(BentQuads, AreCutWhereTheNodesThatHandThemOnPutThem) {
  const std::string turned =
      "multmatrix([[0.866025, -0.5, 0, 0], [0.5, 0.866025, 0, 0], [0, 0, 1, "
      "0], [0, 0, 0, 1]])";
  const std::string quarter =
      "multmatrix([[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])";
  const std::string quarter_of_y =
      "multmatrix([[0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])";
  const std::string same = "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])";
  const std::string red = "color([1, 0, 0, 1])", empty_cube = "cube(size = [0, 0, 0]);";
  const std::string far =
      "multmatrix([[1, 0, 0, 50], [0, 1, 0, 50], [0, 0, 1, 50], [0, 0, 0, 1]]) "
      "{ cube(size = [1, 1, 1]); }";
  const std::string around =
      "multmatrix([[1, 0, 0, -50], [0, 1, 0, -50], [0, 0, 1, -50], [0, 0, 0, "
      "1]]) { cube(size = [100, 100, 100]); }";
  const auto mirrored = [&](const std::string& node, const std::string& others = "") {
    return kMirror + " { " + node + " { " + kBent + others + " } }";
  };
  const std::vector<Tree> trees = {
      {kBent, kAsMade},
      {kMirror + " { " + kBent + " }", kOther},
      {kMirror + " { " + kMirror + " { " + kBent + " } }", kAsMade},
      {turned + " { " + kBent + " }", 285.541382},
      {quarter + " { " + kBent + " }", kOther},
      {quarter_of_y + " { " + kBent + " }", kOther},
      {mirrored(same), kOther},
      {kMirror + " { " + kInsideOut + " }", kAsMade},
      // Nodes with one child that is something hand it on.
      {mirrored("group()"), kOther},
      {mirrored("render(convexity = 1)"), kOther},
      {mirrored(red), kOther},
      {mirrored("union()"), kOther},
      {mirrored("union()", "group();"), kOther},
      {mirrored("union()", empty_cube), kOther},
      {mirrored("union()", "square(size = [1, 1]);"), kOther},
      {mirrored("difference()"), kOther},
      {mirrored("intersection()"), kOther},
      {mirrored("minkowski(convexity = 0)"), kOther},
      {mirrored("minkowski(convexity = 0)", "group();"), kOther},
      {mirrored("resize(newsize = [0, 0, 0], auto = [0, 0, 0], convexity = 0)"), kOther},
      {mirrored("resize(newsize = [0, 30, 0], auto = [0, 0, 0], convexity = 0)"), 1557.5},
      {"resize(newsize = [0, 30, 0], auto = [0, 0, 0], convexity = 0) { " + kBent + " }", 1435},
      {"resize(newsize = [1, 0, 0], auto = [0, 0, 0], convexity = 0) { " + kBent + " }", 40.791667},
      // Booleans of several do not.
      {mirrored("union()", far), kAsMade + 1},
      {mirrored("difference()", "group();"), kAsMade},
      {mirrored("difference()", empty_cube), kAsMade},
      {mirrored("difference()", "square(size = [1, 1]);"), kAsMade},
      {mirrored("difference()", far), kAsMade},
      {mirrored("intersection()", around), kAsMade},
  };
  for (const Tree& tree : trees) EXPECT_NEAR(volume_of(tree.text), tree.volume, 3e-4) << tree.text;
}

TEST(BentQuads, OfTreesKeepTheirNodes) {
  const std::string colour = "color([1, 0, 0, 1]) { " + kMirror + " { " + kBent + " } }";
  EXPECT_EQ(testing::sketch(testing::parse(colour).solid), "C(T(polyhedron))");
  const std::string root = kMirror + " { ! " + kMirror + " { " + kBent + " } }";
  EXPECT_NEAR(volume_of(root), kOther, 1e-4);  // what is around it does not move it
  const auto leaf = [](const std::string& text) {
    NodePtr node = testing::parse(text).solid;
    while (node->kind() != NodeKind::kLeaf) node = NodePtr(node->children()[0]);
    return node->mesh()->points;
  };
  EXPECT_EQ(leaf(colour), leaf(kBent));  // in its own coordinates
}

TEST(BentQuads, OfImportsInTreesAreCutWhereTheyCome) {
  const std::string off =
      "OFF\n8 6 0\n0 0 0\n7 0 0\n7 5.5 0\n0 5.5 0\n0 0 8\n7 0 4.5\n7 5.5 8\n0 5.5 8\n"
      "4 3 2 1 0\n4 4 5 6 7\n4 1 5 4 0\n4 2 6 5 1\n4 3 7 6 2\n4 0 4 7 3\n";
  const std::string obj =
      "v 0 0 0\nv 7 0 0\nv 7 5.5 0\nv 0 5.5 0\nv 0 0 8\nv 7 0 4.5\nv 7 5.5 8\nv 0 5.5 8\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 2 6 5 1\nf 3 7 6 2\nf 4 8 7 3\nf 1 5 8 4\n";
  CsgEnvironment environment;
  environment.read = [&](const std::string& path) -> Result<std::string> {
    return path == "a.off" ? off : obj;
  };
  for (const std::string file : {"a.off", "a.obj"}) {
    const std::string call = "import(file = \"" + file + "\", origin = [0, 0], scale = 1);";
    for (const bool mirrors : {false, true}) {
      const auto model =
          parse_csg("m.csg", mirrors ? kMirror + " { " + call + " }" : call, environment);
      ASSERT_TRUE(model) << model.error().message;
      EXPECT_NEAR(volume_of(model->solid), mirrors ? kOther : kAsMade, 1e-4) << file;
    }
  }
}

}  // namespace
}  // namespace csgrun::bent_quads_test
