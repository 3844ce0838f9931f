// What empty nodes of .csg trees do: they decide between 2D and 3D, empty a difference or an
// intersection, or are nothing. The tables are what OpenSCAD 2021.01 gives for the same trees.
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/csg_file.h>

#include "tests/unit/primitives/csg_trees.h"

namespace csgrun::csg_empty_test {
namespace {

using testing::parse;

const std::string kFlat = "square(size = [4, 3]);\n", kSolid = "cube(size = [4, 3, 2]);\n";
const std::string kNoFlat = "square(size = [0, 1]);\n", kNoSolid = "cube(size = [0, 1, 1]);\n";
const std::string kGroup = "group();\n";

std::string moved(const std::string& children) {
  return "multmatrix([[1, 0, 0, 9], [0, 1, 0, 9], [0, 0, 1, 9], [0, 0, 0, 1]]) {" + children + "}";
}
std::string apart(const std::string& what) { return "intersection() {" + what + moved(what) + "}"; }

/// "2 12", "3 24" or "empty": the dimension, and the area or the volume.
std::string result(const std::string& text) {
  const CsgModel model = parse(text);
  if (model.is_2d) return "2 " + std::to_string(std::lround(model.shape.area()));
  Evaluator evaluator(EvaluateOptions{});
  const auto extent = evaluator.extent(model.solid);
  EXPECT_TRUE(extent);
  const long volume = extent ? std::lround(extent->volume) : -1;
  return volume == 0 ? "empty" : "3 " + std::to_string(volume);
}

/// Which dimension the first child decides on: '2', '3' or '-' for none.
char decides(const std::string& first) {
  const bool takes_flat = result("union() {" + first + kFlat + "}") == "2 12",
             takes_solid = result("union() {" + first + kSolid + "}") == "3 24";
  EXPECT_TRUE(takes_flat || takes_solid) << first;
  return takes_flat && takes_solid ? '-' : takes_flat ? '2' : '3';
}

TEST(CsgEmpty, PrimitivesHaveADimension) {
  for (const char* shape :
       {"square(size = [0, 1]);", "circle($fn = 0, r = 0);", "polygon(points = []);",
        "polygon(points = [[0, 0], [1, 1], [2, 2]]);", "text(text = \"\");", "text(text = \" \");"})
    EXPECT_EQ(decides(shape), '2') << shape;
  for (const char* solid :
       {"cube(size = [0, 1, 1]);", "sphere($fn = 0, r = 0);", "cylinder(h = 0, r1 = 1, r2 = 1);",
        "polyhedron(points = [], faces = []);", "surface(file = \"\");", "import(file = \"\");"})
    EXPECT_EQ(decides(solid), '3') << solid;
  for (const char* nothing : {"group();", "union();", "hull();", "minkowski(convexity = 0);",
                              "linear_extrude(height = 2);", "offset(r = 1);", "projection();",
                              "render(convexity = 1);", "color([1, 0, 0, 1]);"})
    EXPECT_EQ(decides(nothing), '-') << nothing;
  EXPECT_EQ(decides("%" + kFlat), '-');
  EXPECT_EQ(decides("%" + kSolid), '-');
}

TEST(CsgEmpty, ResultsHaveOneToo) {
  const auto node = [](const std::string& name, const std::string& children) {
    return name + " {" + children + "}\n";
  };
  const std::string still = "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])",
                    flat = "multmatrix([[1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])",
                    odd = "multmatrix([[1, 0, 0, nan], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])",
                    sum = "minkowski(convexity = 0)", extrude = "linear_extrude(height = 2)",
                    turn = "rotate_extrude(angle = 360, start = 0)", size = "resize([4, 0, 0])";
  const std::vector<std::pair<std::string, char>> table{
      // Of operands that are not empty.
      {apart(kFlat), '2'},
      {apart(kSolid), '3'},
      {node("difference()", kFlat + kFlat), '2'},
      {node("difference()", kSolid + kSolid), '3'},
      {node("intersection()", kFlat + kSolid), '2'},
      {node("intersection()", kSolid + kFlat), '-'},
      {node("offset(r = -9)", kFlat), '2'},
      {node(sum, kFlat + kSolid), '2'},
      {node(flat, kFlat), '2'},
      {node(flat, kSolid), '3'},
      {node(odd, kFlat), '2'},
      {node(odd, kSolid), '3'},
      {node("linear_extrude(height = 0)", kFlat), '3'},
      {node(turn, "multmatrix([[1, 0, 0, -2]]) {" + kFlat + "}"), '-'},
      {node("projection(cut = true)", moved(kSolid)), '-'},
      // One that is empty: solids hand on, shapes do not.
      {node("group()", kNoFlat), '-'},
      {node("group()", kNoSolid), '3'},
      {node(still, kNoFlat), '-'},
      {node(still, kNoSolid), '3'},
      {node(size, kNoSolid), '3'},
      {node("hull()", kNoFlat), '2'},
      {node("hull()", kNoSolid), '-'},
      {node(sum, kNoFlat), '-'},
      {node(sum, kNoSolid), '3'},
      {node(extrude, kNoFlat), '-'},
      {node(extrude, kNoFlat + kNoFlat), '3'},
      {node("projection()", kNoSolid), '-'},
      // Several of them.
      {node("union()", kNoFlat + kNoSolid), '2'},
      {node("union()", kNoSolid + kNoFlat), '-'},
      {node("union()", kNoFlat + kGroup), '2'},
      {node("union()", kGroup + kNoSolid), '-'},
      {node("difference()", kGroup + kSolid), '-'},
      {node("difference()", kGroup + kFlat), '2'},
      {node("difference()", kNoFlat + kSolid), '2'},
      {node("difference()", kNoSolid + kFlat), '3'},
      {node("difference()", kNoSolid + kSolid), '3'},
      {node("intersection()", kGroup + kSolid), '-'},
      {node("intersection()", kFlat + kGroup), '2'},
      {node("intersection()", kNoSolid + kSolid), '3'},
      {node("intersection()", kSolid + kNoSolid), '-'},
      {node(sum, kNoSolid + kNoSolid), '-'},
      {node(sum, kNoFlat + kFlat), '2'},
  };
  for (const auto& [text, dimension] : table) EXPECT_EQ(decides(text), dimension) << text;
}

TEST(CsgEmpty, TheFirstChildDecides) {
  // By operation and children: the result, where the empty one is first, in the middle, last.
  struct Row {
    std::string operation, one, two;
    std::array<std::string, 3> with_no_flat, with_no_solid, with_group;
  };
  const std::string flats = "square(size = [4, 3]);", solids = "cube(size = [4, 3, 2]);",
                    flat2 = "square(size = [2, 2]);", solid2 = "cube(size = [2, 2, 1]);";
  const std::vector<Row> table{
      {"union()",
       flats,
       flat2,
       {"2 12", "2 12", "2 12"},
       {"empty", "2 12", "2 12"},
       {"2 12", "2 12", "2 12"}},
      {"union()",
       solids,
       solid2,
       {"empty", "3 24", "3 24"},
       {"3 24", "3 24", "3 24"},
       {"3 24", "3 24", "3 24"}},
      {"union()",
       flats,
       solid2,
       {"2 12", "2 12", "2 12"},
       {"3 4", "2 12", "2 12"},
       {"2 12", "2 12", "2 12"}},
      {"union()",
       solids,
       flat2,
       {"2 4", "3 24", "3 24"},
       {"3 24", "3 24", "3 24"},
       {"3 24", "3 24", "3 24"}},
      {"difference()",
       flats,
       flat2,
       {"empty", "2 8", "2 8"},
       {"empty", "2 8", "2 8"},
       {"empty", "2 8", "2 8"}},
      {"difference()",
       solids,
       solid2,
       {"empty", "3 20", "3 20"},
       {"empty", "3 20", "3 20"},
       {"empty", "3 20", "3 20"}},
      {"difference()",
       solids,
       flat2,
       {"empty", "3 24", "3 24"},
       {"empty", "3 24", "3 24"},
       {"empty", "3 24", "3 24"}},
      {"intersection()",
       flats,
       flat2,
       {"empty", "empty", "empty"},
       {"empty", "empty", "empty"},
       {"empty", "empty", "empty"}},
      {"intersection()",
       solids,
       solid2,
       {"empty", "empty", "empty"},
       {"empty", "empty", "empty"},
       {"empty", "empty", "empty"}},
      {"hull()",
       flats,
       flat2,
       {"2 12", "2 12", "2 12"},
       {"empty", "2 12", "2 12"},
       {"2 12", "2 12", "2 12"}},
      {"hull()",
       solids,
       solid2,
       {"empty", "3 24", "3 24"},
       {"3 24", "3 24", "3 24"},
       {"3 24", "3 24", "3 24"}},
      {"hull()",
       flats,
       solid2,
       {"2 12", "2 12", "2 12"},
       {"3 4", "2 12", "2 12"},
       {"2 12", "2 12", "2 12"}},
  };
  for (const Row& row : table) {
    const auto check = [&](const std::string& empty, const std::array<std::string, 3>& expected) {
      const std::array<std::string, 3> children{
          empty + row.one + row.two, row.one + empty + row.two, row.one + row.two + empty};
      for (size_t i = 0; i < 3; ++i) {
        const std::string text = row.operation + " {" + children[i] + "}";
        EXPECT_EQ(result(text), expected[i]) << text;
      }
    };
    check(kNoFlat, row.with_no_flat);
    check(kNoSolid, row.with_no_solid);
    check(kGroup, row.with_group);
  }
}

TEST(CsgEmpty, WhatIsLeftOutIsSaid) {
  EXPECT_EQ(parse(kNoFlat + kSolid).warnings,
            (std::vector<std::string>{"m.csg:1: square: size.x must be positive, got 0",
                                      "m.csg:1: a 3D child among 2D ones was left out"}));
  EXPECT_EQ(parse(kNoSolid + kFlat).warnings,
            (std::vector<std::string>{"m.csg:1: cube: size.x must be positive, got 0",
                                      "m.csg:1: a 2D child among 3D ones was left out"}));
  // Empty ones of the other dimension take nothing with them.
  EXPECT_EQ(parse(kFlat + kNoSolid).warnings,
            (std::vector<std::string>{"m.csg:2: cube: size.x must be positive, got 0"}));
}

}  // namespace
}  // namespace csgrun::csg_empty_test
