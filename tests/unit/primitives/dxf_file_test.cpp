// DXF drawings against the areas that they show.
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <csgrun/primitives/flat_file.h>

#include "tests/unit/primitives/drawing_files.h"
#include "tests/unit/primitives/dxf_text.h"

namespace csgrun::dxf_file_test {
namespace {

using testing::arc_points;
using testing::area_on_grid;
using testing::dxf_line;
using testing::entities;
using testing::error;
using testing::ngon;
using testing::ngon_on_grid;
using testing::pairs;
using testing::read;
using testing::with_fn;

Shape2D dxf(const std::string& content, const FlatFileOptions& options = with_fn(32)) {
  return read("x.dxf", entities(content), options).shape;
}

TEST(Dxf, LinesAreJoined) {
  // In any order and direction, with ends a ten-thousandth apart.
  const std::string square = dxf_line(0, 0, 10, 0) + dxf_line(10, 10, 10, 0.0001) +
                             dxf_line(0, 10, 0, 0) + dxf_line(0, 10, 10, 10);
  EXPECT_NEAR(dxf(square).area(), 100, 1e-2);
  EXPECT_EQ(dxf(square).loops().size(), 1u);
  const FlatFile open = read("x.dxf", entities(square + dxf_line(20, 0, 30, 0)), {});
  EXPECT_NEAR(open.shape.area(), 100, 1e-2);
  EXPECT_EQ(open.notes,
            std::vector<std::string>{
                "x.dxf: 1 line is not closed, its ends were joined; the first begins at (20, 0)"});
  // A quarter of a disc of two lines and an arc.
  const std::string arc =
      pairs({{0, "ARC"}, {10, "0"}, {20, "0"}, {40, "5"}, {50, "0"}, {51, "90"}});
  std::vector<glm::dvec2> quarter = arc_points(32, 0, 8);
  quarter.emplace_back(0, 0);
  EXPECT_NEAR(dxf(dxf_line(0, 0, 5, 0) + dxf_line(0, 0, 0, 5) + arc).area(),
              area_on_grid(quarter, 5), 1e-6);
}

TEST(Dxf, WhereManyLinesMeetTreesFollowOpenScad) {
  FlatFileOptions tree;
  tree.as_openscad = true;
  const auto area = [&](const std::vector<std::array<int, 4>>& lines) {
    std::string text;
    for (const auto& [x0, y0, x1, y1] : lines) text += dxf_line(x0, y0, x1, y1);
    return read("x.dxf", entities(text), tree).shape.area();
  };
  // A tail's free end comes first, whatever stands before it.
  EXPECT_NEAR(area({{0, 0, 10, 0}, {10, 0, 10, 10}, {10, 10, 0, 0}, {0, 0, -5, -5}}), 50, 1e-9);
  // Areas by OpenSCAD, to the digits that it writes: which line goes on where is its choice.
  EXPECT_NEAR(area({{11, 15, 11, 20},
                    {14, 7, 20, 1},
                    {19, 8, 20, 1},
                    {11, 20, 19, 8},
                    {5, 3, 11, 20},
                    {14, 7, 16, 0},
                    {11, 20, 14, 7},
                    {11, 20, 20, 1},
                    {19, 8, 11, 15},
                    {16, 0, 11, 15},
                    {5, 3, 11, 15}}),
              42.0, 2e-4);
  EXPECT_NEAR(area({{20, 13, 19, 11},
                    {4, 11, 11, 7},
                    {4, 11, 20, 13},
                    {9, 10, 20, 9},
                    {9, 10, 12, 12},
                    {11, 7, 20, 13},
                    {9, 10, 20, 13},
                    {9, 10, 11, 7},
                    {12, 12, 20, 13},
                    {20, 9, 19, 11},
                    {11, 7, 12, 12}}),
              33.0, 2e-4);
  EXPECT_NEAR(area({{15, 12, 18, 11},
                    {18, 11, 7, 15},
                    {15, 12, 2, 15},
                    {2, 15, 7, 15},
                    {20, 1, 18, 11},
                    {18, 11, 3, 2},
                    {3, 2, 20, 1},
                    {1, 7, 20, 1},
                    {2, 15, 3, 2},
                    {1, 7, 3, 2},
                    {18, 11, 1, 7}}),
              80.0747, 2e-4);
}

TEST(Dxf, Curves) {
  std::vector<glm::dvec2> ellipse;
  for (const glm::dvec2& p : arc_points(32, 0, 31))
    ellipse.push_back(p.x * glm::dvec2(3, 4) + p.y * glm::dvec2(-2, 1.5));
  EXPECT_NEAR(dxf(pairs({{0, "CIRCLE"}, {10, "3"}, {20, "4"}, {40, "5"}})).area(),
              ngon_on_grid(32, 5), 1e-6);
  EXPECT_NEAR(dxf(pairs({{0, "ELLIPSE"},
                         {10, "0"},
                         {20, "0"},
                         {11, "3"},
                         {21, "4"},
                         {40, "0.5"},
                         {41, "0"},
                         {42, "6.283185307"}}))
                  .area(),
              area_on_grid(ellipse, 1), 1e-6);
  // Two bulges of 1 are a disc; one and a chord are half of it.
  const auto polyline = [](const std::string& first, const std::string& second) {
    return pairs({{0, "LWPOLYLINE"},
                  {90, "2"},
                  {70, "1"},
                  {10, "-5"},
                  {20, "0"},
                  {42, first},
                  {10, "5"},
                  {20, "0"},
                  {42, second}});
  };
  EXPECT_NEAR(dxf(polyline("1", "1")).area(), ngon_on_grid(32, 5), 1e-6);
  EXPECT_NEAR(dxf(polyline("1", "0")).area(), ngon_on_grid(32, 5) / 2, 1e-6);
  EXPECT_EQ(dxf(polyline("1", "0")).bounds()[1].y,
            0);  // counter-clockwise from left to right: below
  EXPECT_EQ(dxf(polyline("-1", "0")).bounds()[0].y, 0);
  EXPECT_NEAR(dxf(testing::dxf_old_triangle("1")).area(), 8, 1e-9);
  // A clamped quadratic B-spline of one span is a parabola.
  const std::string spline = pairs({{0, "SPLINE"},
                                    {71, "2"},
                                    {40, "0"},
                                    {40, "0"},
                                    {40, "0"},
                                    {40, "1"},
                                    {40, "1"},
                                    {40, "1"},
                                    {10, "0"},
                                    {20, "0"},
                                    {10, "10"},
                                    {20, "20"},
                                    {10, "20"},
                                    {20, "0"}});
  EXPECT_NEAR(dxf(spline + dxf_line(0, 0, 20, 0), with_fn(400)).area(), 2.0 / 3 * 200, 0.02);
}

TEST(Dxf, PointsGoToOpenScadsGrid) {
  // 1.2345 is 1264.1 steps of 1/1024.
  const auto triangle = [](double leg, double x) {
    return dxf_line(x, 0, x + leg, 0) + dxf_line(x + leg, 0, x, leg) + dxf_line(x, leg, x, 0);
  };
  const double leg = 1264.0 / 1024;
  EXPECT_EQ(dxf(triangle(1.2345, 0)).area(), leg * leg / 2);
  EXPECT_EQ(dxf(triangle(1.2345, 0)).bounds()[1], glm::dvec2(leg, leg));
  // One that is a step beside a point that is there already, becomes that.
  const Shape2D two = dxf(triangle(1, 0) + triangle(1, 5) + dxf_line(5.0011, 0.0009, 4, 0.5) +
                          dxf_line(4, 0.5, 5, 1));
  EXPECT_EQ(two.bounds()[1].x, 6);
  for (const auto& loop : two.loops()) {
    for (const glm::dvec2& p : loop) EXPECT_EQ(p * 2.0, glm::round(p * 2.0)) << p.x << " " << p.y;
  }
  // In a block before it is placed, and there again.
  const std::string block =
      pairs({{0, "BLOCK"}, {2, "B"}}) + triangle(1.2345, 0) + pairs({{0, "ENDBLK"}});
  const std::string insert = pairs({{0, "INSERT"}, {2, "B"}, {41, "10"}, {42, "10"}});
  const double ten = std::round(leg * 10 * 1024) / 1024;
  EXPECT_EQ(read("x.dxf", entities(insert, block), {}).shape.area(), ten * ten / 2);
}

TEST(Dxf, BlocksLayersAndPlacement) {
  const std::string unit = dxf_line(1, 1, 2, 1) + dxf_line(2, 1, 2, 2) + dxf_line(2, 2, 1, 1);
  const std::string block =
      pairs({{0, "BLOCK"}, {2, "B"}, {10, "1"}, {20, "1"}}) + unit + pairs({{0, "ENDBLK"}});
  const std::string insert = pairs({{0, "INSERT"},
                                    {8, "cut"},
                                    {2, "B"},
                                    {10, "5"},
                                    {20, "0"},
                                    {41, "2"},
                                    {42, "3"},
                                    {50, "90"},
                                    {70, "2"},
                                    {44, "10"}});
  const FlatFile twice = read("x.dxf", entities(insert, block), {});
  EXPECT_NEAR(twice.shape.area(), 2 * 0.5 * 6, 1e-6);
  EXPECT_NEAR(twice.shape.bounds()[0].x, 2, 1e-9);   // from its base point, turned: y goes to -x
  EXPECT_NEAR(twice.shape.bounds()[1].y, 12, 1e-9);  // the second one 10 up
  FlatFileOptions options;
  options.layer = "cut";
  EXPECT_NEAR(read("x.dxf", entities(insert + unit, block), options).shape.area(), 6, 1e-6);
  options.layer = "engrave";
  EXPECT_EQ(error("x.dxf", entities(insert, block), options),
            "x.dxf: there is no layer \"engrave\"");
  options = {};
  options.origin = {1, 1};
  options.scale = 2;
  const Shape2D scaled = dxf(unit, options);
  EXPECT_NEAR(scaled.area(), 2, 1e-9);
  EXPECT_EQ(scaled.bounds()[0], glm::dvec2(0, 0));
}

// What is drawn from behind has its X axis to the left; lines, and the axes of ellipses, are in the
// coordinates of the world.
TEST(Dxf, EntitiesSeenFromBehind) {
  using Groups = std::vector<std::pair<int, std::string>>;
  const auto behind = [](Groups groups) {
    groups.insert(groups.begin() + 1, {{210, "0.0"}, {220, "0.0"}, {230, "-1.0"}});
    return pairs(groups);
  };
  const auto is_closed = [](const std::string& content, const std::string& blocks = "") {
    const FlatFile file = read("x.dxf", entities(content, blocks), with_fn(32));
    EXPECT_EQ(file.notes, std::vector<std::string>{});
    return file.shape;
  };
  std::vector<glm::dvec2> quarter = arc_points(32, 0, 8);
  quarter.emplace_back(0, 0);
  const double area = area_on_grid(quarter, 5);
  // A quarter of a turn about (-10, 2), from its left to its top.
  const Groups arc{{0, "ARC"}, {10, "10"}, {20, "2"}, {40, "5"}, {50, "0"}, {51, "90"}};
  const Shape2D left = is_closed(behind(arc) + dxf_line(-10, 2, -15, 2) + dxf_line(-10, 2, -10, 7));
  EXPECT_NEAR(left.area(), area, 1e-6);
  EXPECT_EQ(left.bounds()[0], glm::dvec2(-15, 2));
  EXPECT_EQ(left.bounds()[1], glm::dvec2(-10, 7));
  // The same of an ellipse about (-10, 2): from its left, over its top.
  const Groups ellipse{{0, "ELLIPSE"}, {10, "-10"}, {20, "2"}, {11, "-5"},
                       {21, "0"},      {40, "1"},   {41, "0"}, {42, "1.5707963"}};
  EXPECT_NEAR(
      is_closed(behind(ellipse) + dxf_line(-10, 2, -15, 2) + dxf_line(-10, 2, -10, 7)).area(), area,
      1e-6);
  const Groups circle{{0, "CIRCLE"}, {10, "3"}, {20, "4"}, {40, "5"}};
  EXPECT_EQ(is_closed(behind(circle)).bounds()[0], glm::dvec2(-8, -1));
  // A half disc over a chord from (5, 1) to (11, 1), below it as it is given: below in the mirror.
  const Groups half{{0, "LWPOLYLINE"}, {90, "2"},  {70, "1"}, {10, "5"}, {20, "1"},
                    {42, "1"},         {10, "11"}, {20, "1"}, {42, "0"}};
  EXPECT_EQ(is_closed(behind(half)).bounds()[0], glm::dvec2(-11, -2));
  EXPECT_EQ(is_closed(behind(half)).bounds()[1], glm::dvec2(-5, 1));
  const auto old = [&](const std::string& flags) {
    return behind({{0, "POLYLINE"}, {70, flags}}) + pairs({{0, "VERTEX"},
                                                           {10, "1"},
                                                           {20, "0"},
                                                           {0, "VERTEX"},
                                                           {10, "5"},
                                                           {20, "0"},
                                                           {0, "VERTEX"},
                                                           {10, "5"},
                                                           {20, "4"},
                                                           {0, "SEQEND"}});
  };
  EXPECT_EQ(is_closed(old("1")).bounds()[0], glm::dvec2(-5, 0));
  EXPECT_EQ(is_closed(old("9")).bounds()[0], glm::dvec2(1, 0));
  // A block is mirrored where it is put; an entity from behind in it is itself again.
  const std::string block = pairs({{0, "BLOCK"}, {2, "B"}, {10, "1"}, {20, "1"}}) +
                            dxf_line(1, 1, 3, 1) + dxf_line(3, 1, 3, 2) + dxf_line(3, 2, 1, 1) +
                            pairs({{0, "ENDBLK"}, {0, "BLOCK"}, {2, "C"}}) + behind(half) +
                            pairs({{0, "ENDBLK"}});
  const Shape2D turned = is_closed(
      behind({{0, "INSERT"}, {2, "B"}, {10, "7"}, {20, "0"}, {50, "90"}, {41, "2"}}), block);
  EXPECT_EQ(turned.bounds()[0], glm::dvec2(-7, 0));  // turned, it would reach from 6 to 7
  EXPECT_EQ(turned.bounds()[1], glm::dvec2(-6, 4));
  EXPECT_EQ(is_closed(behind({{0, "INSERT"}, {2, "C"}}), block).bounds()[0], glm::dvec2(5, -2));
  // What is tilted is said to be.
  const FlatFile tilted =
      read("x.dxf", entities(pairs({{0, "CIRCLE"}, {40, "5"}, {210, "1"}, {230, "0"}})), {});
  EXPECT_EQ(tilted.notes,
            std::vector<std::string>{"x.dxf: 1 entity lies in a plane that is not level (line 12); "
                                     "taken as if in the drawing's"});
}

TEST(Dxf, Parts) {
  FlatFileOptions options;
  options.parts = true;
  const auto triangle = [](double x, const std::string& layer) {
    return dxf_line(x, 0, x + 2, 0, layer) + dxf_line(x + 2, 0, x, 2, layer) +
           dxf_line(x, 2, x, 0, layer);
  };
  // Layers on one another take nothing away; what a block has on layer 0 is on that of its
  // insertion.
  const std::string block = pairs({{0, "BLOCK"}, {2, "B"}}) + triangle(0, "0") + triangle(9, "b") +
                            pairs({{0, "ENDBLK"}});
  const std::string content = triangle(0, "a") + triangle(0, "b") + triangle(4, "a") +
                              pairs({{0, "INSERT"}, {8, "c"}, {2, "B"}, {10, "20"}});
  const FlatFile file = read("x.dxf", entities(content, block), options);
  EXPECT_EQ(file.notes, std::vector<std::string>{});
  EXPECT_TRUE(file.shape.empty());
  ASSERT_EQ(file.parts.size(), 3u);
  const std::vector<std::pair<std::string, double>> expected{{"a", 4}, {"b", 4}, {"c", 2}};
  for (size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(file.parts[i].name, expected[i].first);
    EXPECT_NEAR(file.parts[i].shape.area(), expected[i].second, 1e-9);
  }
  EXPECT_EQ(file.parts[1].shape.bounds()[1], glm::dvec2(31, 2));
}

TEST(Dxf, HostileAndDamagedFiles) {
  EXPECT_EQ(error("x.dxf", "hello\nworld\n"), "x.dxf:1: expected a group code, got \"hello\"");
  EXPECT_EQ(error("x.dxf", "AutoCAD Binary DXF\r\n\x1a"),
            "x.dxf: this is a binary DXF, and only the text form is read");
  EXPECT_EQ(error("x.dxf", "0\nSECTION\n2"), "x.dxf:3: the file ends within a group");
  const std::string loop =
      pairs({{0, "BLOCK"}, {2, "B"}}) + pairs({{0, "INSERT"}, {2, "B"}}) + pairs({{0, "ENDBLK"}});
  EXPECT_NE(error("x.dxf", entities(pairs({{0, "INSERT"}, {2, "B"}}), loop)).find("nested deeper"),
            std::string::npos);
  EXPECT_EQ(
      error("x.dxf", entities(pairs({{0, "INSERT"}, {2, "B"}, {70, "1000000"}, {71, "1000000"}}),
                              pairs({{0, "BLOCK"}, {2, "B"}}) + dxf_line(0, 0, 1, 1) +
                                  pairs({{0, "ENDBLK"}}))),
      "x.dxf: unfolds to more than 200000 entities");
  // With a line before, it is an insertion and not an entity of the block that is one too many.
  for (const std::string& line : {std::string(), dxf_line(0, 0, 1, 1)}) {
    EXPECT_EQ(
        error("x.dxf", entities(dxf_line(0, 0, 1, 1) +
                                    pairs({{0, "INSERT"}, {2, "B"}, {70, "30000"}, {71, "30000"}}),
                                pairs({{0, "BLOCK"}, {2, "B"}}) + line + pairs({{0, "ENDBLK"}}))),
        "x.dxf: unfolds to more than 200000 entities");
  }
  // Angles beyond all measure are angles all the same.
  EXPECT_NEAR(
      dxf(pairs({{0, "ELLIPSE"}, {11, "1"}, {21, "0"}, {40, "1"}, {41, "1e300"}, {42, "1e300"}}))
          .area(),
      ngon(32, 1), 1e-3);
  dxf(pairs({{0, "ARC"}, {40, "1"}, {50, "1e300"}, {51, "-1e300"}}));
  dxf(pairs({{0, "ARC"}, {40, "1"}, {50, "1.7e308"}, {51, "-1.7e308"}}));
  EXPECT_EQ(error("x.dxf", "", with_fn(1e9)), "import: fn must be at most 131072, got 1e+09");
  const FlatFile unknown = read("x.dxf", entities(pairs({{0, "3DSOLID"}, {1, "x"}})), {});
  EXPECT_TRUE(unknown.shape.empty());
  EXPECT_EQ(unknown.notes, std::vector<std::string>{"x.dxf: 3DSOLID left out (1)"});
  EXPECT_EQ(error("x.dxf", "", {}), "x.dxf: the file is empty");
}

}  // namespace
}  // namespace csgrun::dxf_file_test
