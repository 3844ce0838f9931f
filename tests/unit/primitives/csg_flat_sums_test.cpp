// Minkowski sums in .csg trees with operands that enclose nothing: what a matrix flattens, hulls
// and polyhedra in one plane. The truth is sums of 2D shapes, which are made another way.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/csg_file.h>

#include "tests/unit/primitives/csg_trees.h"

namespace csgrun::csg_flat_sums_test {
namespace {

using testing::parse;

struct Sum {
  double volume;
  std::vector<std::string> warnings;
};

Sum sum_of(const std::string& operands) {
  const CsgModel model = parse("minkowski(convexity = 0) {" + operands + "}");
  Evaluator evaluator(EvaluateOptions{});
  const auto extent = evaluator.extent(model.solid);
  EXPECT_TRUE(extent) << (extent ? "" : extent.error().message);
  std::vector<std::string> warnings = model.warnings;
  for (const std::string& line : evaluator.warnings()) warnings.push_back(line);
  return {extent ? extent->volume : -1, std::move(warnings)};
}

void expect_volume(const std::string& operands, double volume) {
  const Sum sum = sum_of(operands);
  EXPECT_NEAR(sum.volume, volume, 1e-6 * volume) << operands;
  EXPECT_EQ(sum.warnings, std::vector<std::string>{}) << operands;
}

std::string under(const std::string& rows, const std::string& children) {
  return "multmatrix([" + rows + ", [0, 0, 0, 1]]) {" + children + "}\n";
}
std::string flattened(const std::string& children) {
  return under("[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 4]", children);
}
std::string extruded(const std::string& children, const std::string& height) {
  return "linear_extrude(height = " + height + ") {" + children + "}\n";
}
/// A turn by angles with rational sines and cosines, about two axes.
std::string turned(const std::string& children) {
  return under("[0.6, -0.64, 0.48, 0], [0.8, 0.48, -0.36, 0], [0, 0.6, 0.8, 0]", children);
}

const std::string kBox = "cube(size = [10, 10, 10], center = false);\n";
const std::string kCorner =
    "polygon(points = [[0, 0], [9, 0], [9, 2], [3, 2], [3, 7], [0, 7]], paths = undef);\n";
const std::string kFrame =
    "difference() { square(size = [8, 6]); multmatrix([[1, 0, 0, 2], [0, 1, 0, 2], [0, 0, 1, 0], "
    "[0, 0, 0, 1]]) { square(size = [4, 2]); } }\n";
const std::string kDisc = "circle($fn = 12, $fa = 12, $fs = 2, r = 1);\n";
const std::string kCup =
    "polygon(points = [[0, 0], [5, 0], [5, 5], [4, 5], [4, 1], [1, 1], [1, 5], [0, 5]]);\n";

TEST(CsgFlatSums, WhatAMatrixFlattens) {
  const std::string cube = "cube(size = [4, 4, 4], center = false);\n";
  // To a square, a segment, a point; before the solid and after it.
  expect_volume(kBox + flattened(cube), 14 * 14 * 10);
  expect_volume(flattened(cube) + kBox, 14 * 14 * 10);
  expect_volume(kBox + under("[1, 0, 0, 3], [0, 0, 0, 0], [0, 0, 0, 0]", cube), 1400);
  expect_volume(kBox + under("[0, 0, 0, 3], [0, 0, 0, 0], [0, 0, 0, 0]", cube), 1000);
  // A diagonal of the box: 1000 and 4 under each of three faces.
  expect_volume(kBox + under("[1, 0, 0, 0], [1, 0, 0, 0], [1, 0, 0, 0]", cube), 1000 + 3 * 400);
  // Through colours, groups and unions, under a turn, and of a flat and a solid part.
  expect_volume(kBox + "color([1, 0, 0, 1]) { group() { union() {" + flattened(cube) + "}}}",
                14 * 14 * 10);
  expect_volume(turned(kBox) + turned(flattened(cube)), 14 * 14 * 10);
  expect_volume(kBox + "group() {" + flattened(cube) + "cube(size = [1, 1, 9]);}",
                14 * 14 * 10 + 11 * 11 * (19 - 10));
}

TEST(CsgFlatSums, TwoFlatOnesMakeABody) {
  const std::string upright = under("[0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]", kBox);
  const std::string lying = flattened("cube(size = [4, 4, 4]);");
  expect_volume(lying + upright, 4 * 14 * 10);
  // Two in one plane and a third across it; a segment for each axis.
  expect_volume(lying + flattened(kBox) + upright, 14 * 24 * 10);
  const std::string edge = "cube(size = [2, 3, 5]);";
  expect_volume(under("[1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]", edge) +
                    under("[0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0]", edge) +
                    under("[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 1, 0]", edge),
                30);
  // A flat sum as an operand.
  expect_volume("minkowski(convexity = 0) {" + lying + flattened(kBox) + "}" + upright,
                14 * 24 * 10);
}

TEST(CsgFlatSums, OfAnyOutlineAreSumsOfShapes) {
  const std::vector<std::string> shapes{kCorner, kFrame, kDisc, kCup};
  for (const std::string& solid : shapes) {
    for (const std::string& flat : shapes) {
      const double area = parse("minkowski(convexity = 0) {" + solid + flat + "}").shape.area();
      expect_volume(extruded(solid, "3") + flattened(extruded(flat, "5")), 3 * area);
      expect_volume(flattened(extruded(solid, "5")) + extruded(flat, "3"), 3 * area);
    }
  }
}

TEST(CsgFlatSums, WhatIsThinnerThanTheGrid) {
  // A leaf itself, convex or not, is its faces.
  for (const std::string& flat : {kDisc, kCorner, kFrame}) {
    const double area = parse("minkowski(convexity = 0) {" + kCup + flat + "}").shape.area();
    expect_volume(extruded(kCup, "3") + extruded(flat, "1e-9"), 3 * area);
  }
  expect_volume(kBox + "cube(size = [4, 4, 1e-9]);", 14 * 14 * 10);
}

TEST(CsgFlatSums, HullsAndPolyhedraInOnePlane) {
  // The sum of a square and a triangle is 10^2 + 8 + 10 * 4 + 10 * 4.
  const std::string points = "points = [[0, 0, 0], [4, 0, 0], [0, 4, 0]], ";
  const std::string both_sides = "polyhedron(" + points + "faces = [[0, 1, 2], [2, 1, 0]]);";
  expect_volume(kBox + both_sides, 1880);
  expect_volume(kBox + "hull() { polyhedron(" + points + "faces = [[0, 1, 2]]); }", 1880);
  expect_volume(kBox + "hull() {" + flattened("cube(size = [4, 4, 4]);") + "}", 1960);
  expect_volume(turned(kBox) + turned(both_sides), 1880);
}

TEST(CsgFlatSums, WhatIsEmptyIsLeftOut) {
  // As OpenSCAD has it: sizes of 0 make nothing at all, and not something flat.
  for (const char* nothing :
       {"cube(size = [0, 4, 4]);", "linear_extrude(height = 0) { square(size = [2, 2]); }"}) {
    const Sum sum = sum_of(kBox + nothing);
    EXPECT_EQ(sum.volume, 1000);
    EXPECT_EQ(sum.warnings.size(), 1u);
  }
  const Sum empty = sum_of(kBox + "intersection() {" + kBox +
                           under("[1,0,0,11], [0,1,0,0], [0,0,1,0]", kBox) + "}");
  EXPECT_EQ(empty.volume, 1000);
  EXPECT_TRUE(empty.warnings.empty());
  // Where nothing else is summed, what is flat is left out as everywhere, with a note.
  const Sum flat = sum_of(flattened(kBox));
  EXPECT_EQ(flat.volume, 0);
  EXPECT_EQ(flat.warnings,
            std::vector<std::string>{
                "m.csg:1: 'multmatrix' encloses no volume on the grid and is left out"});
  EXPECT_EQ(sum_of(kBox + "square(size = [4, 4]);").warnings,
            std::vector<std::string>{"m.csg:1: a 2D child among 3D ones was left out"});
}

}  // namespace
}  // namespace csgrun::csg_flat_sums_test
