// Surfaces of .csg trees that are open or flat: hulls have their points, shadows their faces.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/csg_file.h>

namespace csgrun::csg_sheets_test {
namespace {

CsgModel parse(const std::string& text, const CsgEnvironment& environment = {}) {
  auto model = parse_csg("m.csg", text, environment);
  EXPECT_TRUE(model) << (model ? "" : model.error().where.text() + model.error().message);
  return model ? *model : CsgModel{Node::empty(), {}, false, {}};
}

double volume(const std::string& text) {
  const CsgModel model = parse(text);
  EXPECT_EQ(model.warnings, std::vector<std::string>{}) << text;
  Evaluator evaluator(EvaluateOptions{});
  const auto extent = evaluator.extent(model.solid);
  EXPECT_TRUE(extent) << (extent ? "" : extent.error().message);
  return extent ? extent->volume : -1;
}

std::string error(const std::string& text) {
  const auto model = parse_csg("m.csg", text);
  return model ? "no error" : model.error().where.text() + ": " + model.error().message;
}

std::string matrix(const std::string& rows, const std::string& children) {
  return "multmatrix([" + rows + ", [0, 0, 0, 1]]) {" + children + "}\n";
}
std::string moved(const std::string& by, const std::string& children) {
  return matrix("[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, " + by + "]", children);
}
std::string flattened(const std::string& children) {
  return matrix("[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0]", children);
}
std::string sheet(const std::string& points, const std::string& faces) {
  return "polyhedron(points = [" + points + "], faces = [" + faces + "], convexity = 1);\n";
}

const std::string kCorner = "[0, 0, 0], [6, 0, 0], [0, 6, 0], [0, 0, 6]";
const std::string kBox = "cube(size = [4, 4, 9], center = false);\n";

TEST(CsgSheets, HullsOfOpenPolyhedra) {
  // Four points: in one face that is not flat, in one triangle and a point of another, and each
  // point twice or three times in faces that are nothing.
  EXPECT_DOUBLE_EQ(volume("hull() {" + sheet(kCorner, "[0, 1, 2, 3]") + "}"), 36);
  EXPECT_DOUBLE_EQ(volume("hull() {" + sheet(kCorner, "[0, 1, 2], [0, 1, 3]") + "}"), 36);
  EXPECT_DOUBLE_EQ(volume("hull() {" + sheet(kCorner, "[0, 0, 1], [2, 2, 2], [3, 1, 1]") + "}"),
                   36);
  // Points without a face are none.
  EXPECT_DOUBLE_EQ(
      volume("hull() {" + sheet(kCorner + ", [99, 99, 99]", "[0, 1, 2], [0, 1, 3]") + "}"), 36);
  // With what is closed, and under all that a hull looks through.
  const std::string floor = sheet("[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]", "[0, 1, 2, 3]");
  EXPECT_DOUBLE_EQ(volume("hull() {" + floor +
                          moved("6",
                                "color([1, 0, 0, 1]) { group() { render(convexity = 1) { "
                                "union() {" +
                                    floor + "}}}}") +
                          "}"),
                   96);
  EXPECT_DOUBLE_EQ(volume("hull() { group() {" + floor +
                          moved("6", "cube(size = [4, 4, 1], center = false);") + "}}"),
                   112);
  // As an operand of something else, too.
  EXPECT_DOUBLE_EQ(volume("difference() { hull() {" + sheet(kCorner, "[0, 1, 2, 3]") + "}" +
                          moved("3", "cube(size = [9, 9, 9], center = false);") + "}"),
                   36 - 36 / 8.0);
}

TEST(CsgSheets, WhatNeedsSolidsRefusesOpenPolyhedra) {
  const std::string open = sheet(kCorner, "[0, 1, 2], [0, 1, 3]");
  const std::string refused = "m.csg:1: polyhedron: not closed: ";
  for (const std::string& text :
       {open, "union() {" + open + "}", "hull() { difference() {" + open + kBox + "}}",
        "hull() { minkowski(convexity = 0) {" + open + kBox + "}}",
        "minkowski(convexity = 0) {" + open + kBox + "}",
        "projection(cut = true, convexity = 0) {" + open + "}"}) {
    EXPECT_EQ(error(text).substr(0, refused.size()), refused) << text;
  }
}

TEST(CsgSheets, HullsOfWhatAMatrixFlattens) {
  const std::string point =
      matrix("[0, 0, 0, 2], [0, 0, 0, 2], [0, 0, 0, 6]", "sphere($fn = 5, r = 1);");
  // A pyramid, and a box of two squares.
  EXPECT_DOUBLE_EQ(volume("hull() {" + flattened(kBox) + point + "}"), 32);
  EXPECT_DOUBLE_EQ(volume("hull() {" + flattened(kBox) + moved("6", flattened(kBox)) + "}"), 96);
  EXPECT_DOUBLE_EQ(volume("hull() {" + flattened(moved("1", flattened(kBox))) + point + "}"), 32);
  // What was cut away has no corners: half the square is left.
  const std::string half =
      "difference() {" + kBox +
      matrix("[1, 0, 0, -1], [0, 1, 0, -1], [0, 0, 1, -1]", "cube(size = [3, 9, 11]);") + "}";
  EXPECT_DOUBLE_EQ(volume("hull() {" + flattened(half) + point + "}"), 16);
  EXPECT_DOUBLE_EQ(
      volume("hull() {" + flattened(sheet(kCorner, "[0, 1, 2, 3]")) + moved("5", point) + "}"),
      36 / 6.0 * 11);
  // Elsewhere they are nothing, as before.
  const CsgModel nothing = parse("union() {" + flattened(kBox) + "}");
  EXPECT_EQ(nothing.solid->kind(), NodeKind::kEmpty);
  EXPECT_EQ(nothing.warnings,
            std::vector<std::string>{
                "m.csg:1: multmatrix: the matrix flattens its children, they were left out"});
}

TEST(CsgSheets, Shadows) {
  const auto area = [](const std::string& children) {
    const CsgModel model = parse("projection(cut = false, convexity = 0) {" + children + "}");
    EXPECT_EQ(model.warnings, std::vector<std::string>{});
    EXPECT_TRUE(model.is_2d);
    return model.shape.area();
  };
  // Faces that look up, down, and to the side; over one another they count once.
  const std::string faces = sheet("[0, 0, 1], [4, 0, 1], [4, 4, 1], [0, 4, 1], [4, 0, 9]",
                                  "[0, 1, 2], [0, 3, 2], [1, 2, 4], [0, 1, 2]");
  EXPECT_DOUBLE_EQ(area(faces), 16);
  EXPECT_DOUBLE_EQ(area(flattened(kBox)), 16);
  // A flat one beside a solid, and one that stands upright.
  const std::string aside = matrix("[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 0, 7]", kBox);
  EXPECT_DOUBLE_EQ(area("group() {" + kBox + "color([1, 0, 0, 1]) {" + aside + "}}"), 24);
  EXPECT_DOUBLE_EQ(
      area(kBox + matrix("[1, 0, 0, 9], [0, 0, -1, 0], [0, 1, 0, 0]", flattened(kBox))), 16);
  EXPECT_EQ(parse("projection(cut = false) { color([1, 0, 0, 1]) {" + faces + "}}").appearance->red,
            1);
  // The middle one of three rings is the equator.
  EXPECT_NEAR(area(flattened("sphere($fn = 6, r = 10);")), 6 * 0.5 * 100 * std::sqrt(0.75), 1e-5);
  // A cut through what is flat meets nothing.
  EXPECT_EQ(parse("projection(cut = true) {" + flattened(kBox) + "}").warnings.size(), 1u);
}

TEST(CsgSheets, FilesThatAreOpen) {
  CsgEnvironment environment;
  environment.read = [](const std::string&) -> Result<std::string> {
    return std::string("OFF\n4 2 0\n0 0 0\n6 0 0\n0 6 0\n0 0 6\n3 0 1 2\n3 0 1 3\n");
  };
  const CsgModel hull = parse("hull() { import(file = \"a.off\"); }", environment);
  Evaluator evaluator(EvaluateOptions{});
  EXPECT_DOUBLE_EQ(evaluator.extent(hull.solid)->volume, 36);
  EXPECT_DOUBLE_EQ(parse("projection() { import(file = \"a.off\"); }", environment).shape.area(),
                   18);
  EXPECT_FALSE(parse_csg("m.csg", "import(file = \"a.off\");", environment));
}

}  // namespace
}  // namespace csgrun::csg_sheets_test
