// Trees of .csg files: their nodes, arguments, warnings and errors.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <csgrun/primitives/csg_file.h>

#include "tests/support/source_folder.h"
#include "tests/unit/primitives/csg_trees.h"
#include "tests/unit/primitives/mesh_measures.h"

namespace csgrun::csg_file_test {
namespace {

using testing::error;
using testing::kCube;
using testing::kMove;
using testing::kNothing;
using testing::kSphere;
using testing::kSquare;
using testing::parse;
using testing::sketch;

TEST(CsgFile, ShapesHaveColours) {
  const std::string red = "color([1, 0, 0, 0.5]) { square(size = [2, 1], center = false); }";
  const std::string blue = "color([0, 0, 1, 1]) { circle($fn = 8, $fa = 12, $fs = 2, r = 3); }";
  const CsgModel flat = parse(red);
  ASSERT_TRUE(flat.appearance);
  EXPECT_EQ(flat.appearance->red, 1);
  EXPECT_EQ(flat.appearance->alpha, 0.5f);
  EXPECT_FALSE(parse("square(size = [1, 1]);").appearance);
  // Transforms and operations on one shape keep it, and the outermost colour counts.
  EXPECT_TRUE(
      parse("offset(r = 1, $fn = 8, $fa = 12, $fs = 2) { fill() { " + red + " } }").appearance);
  EXPECT_TRUE(parse("resize(newsize = [9, 0, 0], auto = [0, 0, 0]) { " + red + " }").appearance);
  EXPECT_EQ(parse("color([0, 1, 0, 1]) { " + red + " }").appearance->green, 1);
  EXPECT_EQ(
      sketch(parse("linear_extrude(height = 3, $fn = 0, $fa = 12, $fs = 2) { " + red + " }").solid),
      "C(linear_extrude)");
  // Of several the first; what is taken away was never seen.
  const CsgModel both = parse(red + blue);
  EXPECT_EQ(both.appearance, flat.appearance);
  ASSERT_EQ(both.warnings.size(), 1u);
  EXPECT_EQ(both.warnings[0],
            "m.csg:1: union: of 2D shapes of several colours the first's is kept");
  EXPECT_TRUE(parse("difference() { " + blue + red + " }").warnings.empty());
}

TEST(CsgFile, TreesAreImplicitUnions) {
  EXPECT_EQ(sketch(parse("\n").solid), "empty");
  EXPECT_EQ(sketch(parse(kCube).solid), "cube");
  EXPECT_EQ(sketch(parse(kCube + kSphere).solid), "U(cube sphere)");
  EXPECT_EQ(sketch(parse("group() {\n" + kCube + kSphere + "}\n" + kCube).solid),
            "U(U(cube sphere) cube)");
  EXPECT_EQ(sketch(parse("render(convexity = 1){" + kMove + "{" + kCube + kSphere + "}}").solid),
            "T(U(cube sphere))");
  EXPECT_EQ(sketch(parse("color([1, 0, 0, 1]) { " + kCube + "}").solid), "C(cube)");
  EXPECT_EQ(sketch(parse("color([-1, -1, -1, -1]) { " + kCube + "}").solid), "cube");
  EXPECT_EQ(parse(kCube + kSphere).solid->children()[1]->where().text(), "m.csg:2");
}

TEST(CsgFile, EmptyNodesAreOperands) {
  EXPECT_EQ(sketch(parse("difference() {" + kNothing + kCube + "}").solid), "empty");
  EXPECT_EQ(sketch(parse("difference() {" + kCube + kNothing + kSphere + "}").solid),
            "D(cube sphere)");
  EXPECT_EQ(sketch(parse("difference() {" + kCube + kNothing + "}").solid), "cube");
  EXPECT_EQ(sketch(parse("intersection() {" + kCube + kNothing + "}").solid), "empty");
  EXPECT_EQ(sketch(parse("intersection() {" + kCube + kSphere + "}").solid), "I(cube sphere)");
  EXPECT_EQ(sketch(parse("union() {" + kNothing + kCube + "}").solid), "cube");
}

TEST(CsgFile, BackgroundIsNoOperandAndHighlightIsNothing) {
  EXPECT_EQ(sketch(parse("difference() {\n%\t" + kSphere + kCube + kSphere + "}").solid),
            "D(cube sphere)");
  EXPECT_EQ(sketch(parse("#\t" + kCube + "%#\t" + kSphere).solid), "cube");
  EXPECT_EQ(sketch(parse("intersection() {%group() {" + kSphere + "}" + kCube + "}").solid),
            "cube");
  // Nodes that are not built do no harm in the background, nor does an unescaped text.
  EXPECT_EQ(sketch(parse("%hull() {" + kCube + "}" + kCube).solid), "cube");
  EXPECT_EQ(sketch(parse("%group(){text(text = \"a\"b) {\", size = 10);}" + kCube).solid), "cube");
}

/// OpenSCAD writes neither, people do.
TEST(CsgFile, CommentsAndModifiersOfSources) {
  EXPECT_EQ(
      sketch(parse("difference() {\n*\t" + kSphere + kCube + "*%" + kCube + kSphere + "}").solid),
      "D(cube sphere)");
  EXPECT_EQ(sketch(parse("// one\n" + kCube + "//").solid), "cube");
  EXPECT_EQ(sketch(parse("/* " + kSphere + "*/" + kCube + "/**/ // " + kSphere).solid), "cube");
  EXPECT_EQ(sketch(parse(kCube + "/* " + kSphere).solid), "cube");
  EXPECT_EQ(sketch(parse(kSphere + "difference() {" + kSphere + "!" + kCube + "}").solid), "cube");
  EXPECT_EQ(sketch(parse("!" + kCube + "!" + kSphere).solid), "cube");
  EXPECT_EQ(sketch(parse("%!" + kSphere + kCube).solid), "cube");
  EXPECT_EQ(error("/* 1\n2\n*/ // 3\n\nnone();"), "m.csg:5: unknown node none()");
  EXPECT_EQ(error("cube(2\n);\nnone();"), "m.csg:3: unknown node none()");
  EXPECT_EQ(error("cube(true\n\n, size = 1);\nnone();"), "m.csg:4: unknown node none()");
  EXPECT_EQ(
      error("cube(size = 1)/;"),
      "m.csg:1: expected \";\" or \"{\", got \"/\"; a tree has calls and values only: openscad "
      "in.scad -o out.csg makes one of a source");
}

TEST(CsgFile, FirstChildThatIsNotEmptyDecidesTheDimension) {
  CsgModel model = parse(kNothing + kCube + kSquare);
  EXPECT_EQ(sketch(model.solid), "cube");
  EXPECT_EQ(model.warnings,
            std::vector<std::string>{"m.csg:1: a 2D child among 3D ones was left out"});
  model = parse("\n" + kMove + "{" + kSquare + kCube + "}");
  EXPECT_TRUE(model.is_2d);
  EXPECT_EQ(model.shape.bounds()[0], glm::dvec2(4, -0.5));
  EXPECT_EQ(sketch(parse("intersection() {" + kCube + kSquare + "}").solid), "empty");
  EXPECT_EQ(sketch(parse("linear_extrude(height = 2) {" + kCube + kSquare + "}").solid),
            "linear_extrude");
}

TEST(CsgFile, ImpossiblePrimitivesAreEmptyWithAWarning) {
  const CsgModel model = parse(
      "cube(size = [inf, 1, 1], center = false);\n"
      "sphere($fn = 0, $fa = 12, $fs = 2, r = -nan);\n"
      "cylinder($fn = 0, $fa = 12, $fs = 2, h = 0, r1 = 1, r2 = 1, center = false);\n"
      "polygon(points = [[0, 0], [1, 1], [2, 2]], paths = undef, convexity = 1);\n"
      "multmatrix([[nan, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n" +
      kCube +
      "}\n"
      "multmatrix([[0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n" +
      kCube +
      "}\n"
      "linear_extrude(height = -1) {\n" +
      kSquare +
      "}\n"
      "rotate_extrude(angle = 90) {\n" +
      kSquare +
      "}\n"
      "linear_extrude(height = 1, slices = nan) {\n" +
      kSquare +
      "}\n"
      "linear_extrude(height = 1, segments = -nan) {\n" +
      kSquare +
      "}\n"
      "linear_extrude(height = 1) { offset(r = nan) {\n" +
      kSquare +
      "}}\n"
      "linear_extrude(height = 1) { offset(delta = -inf) {\n" +
      kSquare +
      "}}\n"
      "resize(newsize = [inf, 0, 0], auto = [0, 0, 0]) {\n" +
      kCube +
      "}\n"
      "resize(newsize = [0, -nan, 0], auto = [0, 0, 0]) {\n" +
      kCube + "}\n");
  EXPECT_EQ(sketch(model.solid), "empty");
  const std::vector<std::string> expected{
      "m.csg:1: cube: size.x must be finite, got inf",
      "m.csg:2: sphere: r must be finite, got nan",
      "m.csg:3: cylinder: h must be positive, got 0",
      "m.csg:4: polygon: encloses no area",
      "m.csg:5: multmatrix: the matrix is not finite, its children were left out",
      "m.csg:8: multmatrix: the matrix flattens its children, they were left out",
      "m.csg:11: linear_extrude: height must be positive, got -1",
      "m.csg:14: rotate_extrude: the shape must lie on one side of the Y axis, its x runs from -1 "
      "to 1",
      "m.csg:17: linear_extrude: slices must be finite, got nan",
      "m.csg:20: linear_extrude: segments must be finite, got nan",
      "m.csg:23: offset: distance must be finite, got nan",
      "m.csg:26: offset: distance must be finite, got -inf",
      "m.csg:29: resize: newsize must be finite, got inf",
      "m.csg:32: resize: newsize must be finite, got nan"};
  EXPECT_EQ(model.warnings, expected);
}

TEST(CsgFile, ArgumentsGoByNameAndHaveDefaults) {
  const CsgModel model =
      parse("cylinder(r2 = 0, center = true, h = 4, timestamp = -12, r1 = 2, $fn = inf);");
  ASSERT_EQ(sketch(model.solid), "cone");
  EXPECT_EQ(model.solid->mesh()->points.size(), 4u);
  EXPECT_NEAR(testing::volume(*model.solid->mesh()), 4.0 / 3 * 3 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(testing::volume(*parse("cube();").solid->mesh()), 1, 1e-15);
  // Old files: no start, other order. A full turn starts on the negative side.
  const std::string profile =
      "{multmatrix([[1, 0, 0, 3], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]){" + kSquare + "}}";
  auto lowest_x = [&](const std::string& call) {
    double x = 0;
    const CsgModel turned = parse(call + profile);
    for (const glm::dvec3& p : turned.solid->mesh()->points) x = std::min(x, p.x);
    return x;
  };
  EXPECT_EQ(lowest_x("rotate_extrude(convexity = 2, $fn = 5)"), -4);
  EXPECT_GT(lowest_x("rotate_extrude(convexity = 2, start = 0, $fn = 5)"), -4);
  EXPECT_EQ(lowest_x("rotate_extrude(angle = 90, convexity = 2, $fn = 4)"), 0);
  EXPECT_EQ(lowest_x("rotate_extrude(angle = 90, start = 90, $fn = 4)"), -4);
  // The whole matrix is divided by its last entry.
  const CsgModel scaled =
      parse("multmatrix([[1,0,0,4],[0,1,0,0],[0,0,1,0],[0,0,0,2]]) {" + kCube + "}");
  EXPECT_EQ(scaled.solid->transform().m[0][0], 0.5);
  EXPECT_EQ(scaled.solid->transform().m[0][3], 2);
}

/// The lengths of the box of a leaf.
glm::dvec3 lengths(const std::string& text) {
  const CsgModel model = parse(text);
  EXPECT_EQ(model.warnings, std::vector<std::string>{}) << text;
  const auto& points = model.solid->mesh()->points;
  glm::dvec3 low = points[0], high = points[0];
  for (const glm::dvec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return high - low;
}

// Entries that a matrix lacks are the identity's, as in OpenSCAD.
TEST(CsgFile, MatricesMayBeIncomplete) {
  const auto matrix = [](const std::string& rows) {
    return parse("multmatrix([" + rows + "]) {" + kCube + "}").solid->transform().m;
  };
  const auto whole = matrix("[2, 0, 0, 5], [0, 3, 0, 6], [0, 0, 1, 0], [0, 0, 0, 1]");
  EXPECT_EQ(matrix("[2, 0, 0, 5], [0, 3, 0, 6], [0, 0, 1, 0]"), whole);
  EXPECT_EQ(matrix("[2, 0, 0, 5], [0, 3, 0, 6]"), whole);
  EXPECT_EQ(matrix("[2, 0, 0, 5], [0, 3, 0, 6], []"), whole);
  EXPECT_EQ(matrix("[2], [0, 3]")[1][1], 3);
  EXPECT_EQ(matrix("[2], [0, 3]")[1][3], 0);
}

// OpenSCAD never writes them so, but people do.
TEST(CsgFile, ArgumentsWithoutANameGoByOrder) {
  EXPECT_EQ(lengths("cube([1, 2, 3], true);"), glm::dvec3(1, 2, 3));
  EXPECT_EQ(parse("cube([1, 2, 3], true);").solid->mesh()->points[0].z, -1.5);
  EXPECT_EQ(lengths("cube(4);"), glm::dvec3(4));
  EXPECT_EQ(lengths("cylinder(7, 3, 2, $fn = 4);"), glm::dvec3(6, 6, 7));
  EXPECT_EQ(lengths("cylinder(7, d1 = 2, 5, $fn = 4);"), glm::dvec3(2, 2, 7));
  EXPECT_EQ(lengths("cylinder(h = 7, 3, 2, true, $fn = 4);"), glm::dvec3(6, 6, 7));
  EXPECT_EQ(lengths("cylinder(h = 7, d = 4, $fn = 4);"), glm::dvec3(4, 4, 7));
  EXPECT_EQ(lengths("sphere($fn = 4, d = 8);"), lengths("sphere($fn = 4, 4);"));
  EXPECT_EQ(parse("square([3, 2]);").shape.area(), 6);
  EXPECT_EQ(parse("circle(3, $fn = 4);").shape.area(), 18);
  EXPECT_EQ(parse("polygon([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1, 2]]);").shape.area(), 8);
  const std::string points = "[[0, 0, 0], [6, 0, 0], [0, 6, 0], [0, 0, 6]]";
  const std::string faces = "[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]";
  EXPECT_EQ(lengths("polyhedron(" + points + ", " + faces + ");"), glm::dvec3(6));
  EXPECT_EQ(lengths("polyhedron(points = " + points + ", triangles = " + faces + ");"),
            glm::dvec3(6));
  EXPECT_EQ(lengths("linear_extrude(5) { square(2); }"), glm::dvec3(2, 2, 5));
  EXPECT_EQ(parse("projection(true) { cube([2, 3, 4], true); }").shape.area(), 6);
}

TEST(CsgFile, ArgumentsThatAreNotThereAreSaidSo) {
  const auto warnings = [](const std::string& text) { return parse(text).warnings; };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(warnings("\ncube(siez = [1, 2, 3]);"),
            Lines{"m.csg:2: cube: there is no argument \"siez\", it was left out"});
  EXPECT_EQ(warnings("cube([1, 2, 3], true, 5);"),
            Lines{"m.csg:1: cube: 1 value without a name is too many and left out"});
  EXPECT_EQ(warnings("cube(size = [1, 1, 1], size = [2, 2, 2]);"),
            Lines{"m.csg:1: cube: size is given twice, the last one counts"});
  EXPECT_EQ(parse("cube(size = [1, 1, 1], size = [2, 2, 2]);").solid->mesh()->points[6].z, 2);
  EXPECT_EQ(warnings("group() {\nhull(convex = true) {" + kCube + "}}"),
            Lines{"m.csg:2: hull: there is no argument \"convex\", it was left out"});
  EXPECT_EQ(warnings("%cube(siez = 1);" + kCube), Lines{});
  EXPECT_EQ(warnings("cube(size = [1, 1, 1], $fn = 3, $preview = true);"), Lines{});
}

TEST(CsgFile, LeavesTakeNoChildren) {
  for (const char* const leaf : {"cube(2)", "square(2)"}) {
    const CsgModel model = parse(std::string(leaf) + " { sphere(r = 50); }");
    ASSERT_EQ(model.warnings.size(), 1u);
    EXPECT_NE(model.warnings[0].find(": takes no children, they were left out"), std::string::npos);
  }
  EXPECT_TRUE(parse("cube(2) { }").warnings.empty());
}

// Without a height, a direction has it.
TEST(CsgFile, HeightsOfDirections) {
  const auto volume = [](const std::string& arguments) {
    return testing::volume(
        *parse("linear_extrude(" + arguments + ") { square(2); }").solid->mesh());
  };
  EXPECT_NEAR(volume("v = [0, 0, 5]"), 20, 1e-9);
  EXPECT_NEAR(volume("v = [3, 0, 4]"), 16, 1e-9);
  EXPECT_NEAR(volume("height = 10, v = [3, 0, 4]"), 32, 1e-9);
  EXPECT_NEAR(volume("convexity = 2"), 400, 1e-9);
}

TEST(CsgFile, ErrorsHaveTheirLine) {
  EXPECT_EQ(error("group() {\n" + kCube + "\troof(method = 1) {\n" + kSquare + "}\n}"),
            "m.csg:3: roof: method must be a string");
  EXPECT_EQ(error("\nsurface(file = \"x.png\", center = false);"),
            "m.csg:2: surface: there are no files here");
  EXPECT_EQ(sketch(parse("hull();\nminkowski(convexity = 0);\n").solid), "empty");
  EXPECT_EQ(error("cuboid(size = 1);"), "m.csg:1: unknown node cuboid()");
  EXPECT_EQ(error("cube(size = [1, 2], center = false);"),
            "m.csg:1: cube: size must be a list of 3 numbers");
  EXPECT_EQ(error("sphere(r = \"big\");"), "m.csg:1: sphere: r must be a number");
  EXPECT_EQ(error("multmatrix() {}"),
            "m.csg:1: multmatrix: its argument must be a matrix of 4 x 4 numbers, or of fewer");
  EXPECT_EQ(error("multmatrix([[1, 0, 0, 0, 0]]) {}"),
            "m.csg:1: multmatrix: its argument must be a matrix of 4 x 4 numbers, or of fewer");
  EXPECT_EQ(error("multmatrix([[1, true]]) {}"),
            "m.csg:1: multmatrix: its argument must be a matrix of 4 x 4 numbers, or of fewer");
  EXPECT_EQ(error("group() {\n" + kCube), "m.csg:3: the file ends within group() of line 1");
  EXPECT_EQ(error(kCube + "}"), "m.csg:2: \"}\" without \"{\"");
  EXPECT_EQ(error("cube(size = [1, 2"), "m.csg:1: the file ends where \",\" or \"]\" should be");
  const std::string hint =
      "; a tree has calls and values only: openscad in.scad -o out.csg makes one of a source";
  EXPECT_EQ(error("cube(size = wide);"), "m.csg:1: expected a value, got \"wide\"" + hint);
  EXPECT_EQ(error("cube() + 1"), "m.csg:1: expected \";\" or \"{\", got \"+\"" + hint);
  EXPECT_EQ(error("?cube();"), "m.csg:1: expected a node, got \"?\"" + hint);
  EXPECT_EQ(error("cube(size = [2*3, 1, 1]);"),
            "m.csg:1: expected \",\" or \"]\", got \"*\"" + hint);
  EXPECT_EQ(error("translate([1, 2, 3]) { " + kCube + " }"),
            "m.csg:1: unknown node translate()" + hint);
  EXPECT_EQ(error("c\xe9();"), "m.csg:1: expected \"(\" after \"c\", got \"\\xe9\"");
  EXPECT_EQ(error(std::string("\xff\xfe\x63\x00", 4)),
            "m.csg:1: the file is in UTF-16; save it in UTF-8");
  EXPECT_EQ(error("cube(size = " + std::string(10000, '[')),
            "m.csg:1: lists are nested too deeply");
  EXPECT_EQ(error("difference"),
            "m.csg:1: the file ends where \"(\" after \"difference\" should be");
}

TEST(CsgFile, WhatIsWrittenByHand) {
  const std::string plain = sketch(parse("group() { " + kCube + " }").solid);
  EXPECT_EQ(sketch(parse(";group() { cube(size = [1, 1, 1,], center = false,);; };").solid), plain);
  const std::string digits = "0." + std::string(400, '0') + "1";
  for (const std::string& small : {std::string("1E-400"), std::string("1e-400"), digits}) {
    EXPECT_EQ(sketch(parse("sphere(r = " + small + ");").solid),
              sketch(parse("sphere(r = 0);").solid))
        << small;
  }
}

TEST(CsgFile, DepthCostsNoStack) {
  constexpr int kDepth = 200000;
  std::string text;
  for (int i = 0; i < kDepth; ++i) text += kMove + " {\n";
  text += kCube;
  for (int i = 0; i < kDepth; ++i) text += "}";
  EXPECT_EQ(parse(text).solid->kind(), NodeKind::kTransform);
}

/// The volume of a tree of leaves that do not overlap; NaN where another Boolean occurs.
double sum_of_leaves(const NodePtr& node) {
  if (node->kind() == NodeKind::kEmpty) return 0;
  if (node->kind() == NodeKind::kLeaf) return testing::volume(*node->mesh());
  if (node->kind() == NodeKind::kBoolean && node->op() != BooleanOp::kUnion) return std::nan("");
  double sum = 0;
  for (const NodePtr& child : node->children()) sum += sum_of_leaves(child);
  if (node->kind() != NodeKind::kTransform) return sum;
  const auto& m = node->transform().m;
  const glm::dvec3 x(m[0][0], m[1][0], m[2][0]), y(m[0][1], m[1][1], m[2][1]),
      z(m[0][2], m[1][2], m[2][2]);
  return sum * std::fabs(glm::dot(glm::cross(x, y), z));
}

/// Scenes of the corpus whose leaves stand apart: their volumes are those that OpenSCAD gave.
TEST(CsgFile, ConstructionsOfSolids) {
  EXPECT_EQ(sketch(parse("hull() {" + kCube + kNothing + kSphere + "}").solid), "H(cube sphere)");
  EXPECT_EQ(sketch(parse("hull() {" + kCube + kSquare + "}").solid), "H(cube)");
  EXPECT_EQ(sketch(parse("minkowski(convexity = 0) {" + kCube + kSphere + "}").solid),
            "M(cube sphere)");
  // One that is alone comes through as it is.
  EXPECT_EQ(sketch(parse("minkowski(convexity = 0) {" + kNothing + kCube + "}").solid), "cube");
  EXPECT_EQ(
      sketch(
          parse("resize(newsize = [5,0,0], auto = [0,1,0], convexity = 0) {" + kCube + "}").solid),
      "R(cube)");
}

TEST(CsgFile, Projections) {
  const CsgModel shadow = parse("projection(cut = false, convexity = 0) {" + kCube + "}");
  ASSERT_TRUE(shadow.is_2d);
  EXPECT_EQ(shadow.shape.area(), 2);
  // A cut through the bottom face takes what is above it.
  EXPECT_EQ(parse("projection(cut = true, convexity = 0) {" + kCube + "}").shape.area(), 2);
  EXPECT_EQ(sketch(parse("projection(cut = true) { multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, "
                         "1, -3], [0, 0, 0, 1]]) {" +
                         kCube + "}}")
                       .solid),
            "empty");
  EXPECT_EQ(error("projection(cut = 1) {" + kCube + "}"),
            "m.csg:1: projection: cut must be true or false");
}

TEST(CsgFile, CorpusVolumesOfSeparateLeaves) {
  const auto folder = test::shared_folder() / "csg_corpus";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no folder " << folder;
  std::map<std::string, double> expected;
  std::ifstream table(folder / "expected.csv");
  for (std::string line; std::getline(table, line);) {
    std::istringstream fields(line);
    std::string file, volume;
    std::getline(fields, file, ',');
    std::getline(fields, volume, ',');
    if (file != "file") expected[file] = std::stod(volume);
  }
  ASSERT_GT(expected.size(), 40u);
  for (const char* file : {"2d-3d.csg",
                           "assign-tests.csg",
                           "child-background.csg",
                           "child-child-test.csg",
                           "color-tests.csg",
                           "cube-tests.csg",
                           "cylinder-diameter-tests.csg",
                           "cylinder-tests.csg",
                           "disable-modifier.csg",
                           "ifelse-tests.csg",
                           "linear_extrude-tests.csg",
                           "mirror-tests.csg",
                           "modulevariables.csg",
                           "polyhedron-concave-test.csg",
                           "polyhedron-cube.csg",
                           "polyhedron-nonplanar-tests.csg",
                           "polyhedron-soup.csg",
                           "root-modifier.csg",
                           "rotate_extrude-touch-edge.csg",
                           "rotate_extrude-touch-vertex.csg",
                           "scale-mirror2D-3D-tests.csg",
                           "scale3D-tests.csg",
                           "sphere-tests.csg",
                           "transform-tests.csg"}) {
    const auto model = read_csg_file(folder / file);
    ASSERT_TRUE(model) << file << ": " << model.error().message;
    EXPECT_NEAR(sum_of_leaves(model->solid) / expected[file], 1, 1e-6) << file;
  }
}

}  // namespace
}  // namespace csgrun::csg_file_test
