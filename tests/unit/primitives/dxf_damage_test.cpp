// DXF files that are damaged or cut off, and entities that are not to be drawn.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include <csgrun/primitives/flat_file.h>

#include "tests/unit/primitives/drawing_files.h"
#include "tests/unit/primitives/dxf_text.h"

namespace csgrun::dxf_damage_test {
namespace {

using testing::dxf_line;
using testing::entities;
using testing::error;
using testing::ngon_on_grid;
using testing::pairs;
using testing::read;
using testing::with_fn;

using Groups = std::vector<std::pair<int, std::string>>;

/// A square of 10 x 10 from (x, 0) on, with groups of its own before its vertices.
Groups square(int x, const Groups& own = {}, const std::string& count = "4") {
  const std::string low = std::to_string(x), high = std::to_string(x + 10);
  Groups groups{{0, "LWPOLYLINE"}, {8, "0"}};
  groups.insert(groups.end(), own.begin(), own.end());
  for (const auto& group : Groups{{90, count},
                                  {70, "1"},
                                  {10, low},
                                  {20, "0"},
                                  {10, high},
                                  {20, "0"},
                                  {10, high},
                                  {20, "10"},
                                  {10, low},
                                  {20, "10"}})
    groups.push_back(group);
  return groups;
}

FlatFileOptions of_tree() {
  FlatFileOptions options = with_fn(32);
  options.as_openscad = true;
  return options;
}

std::string with_value(Groups groups, int code, const std::string& value) {
  for (auto& [key, old] : groups) {
    if (key == code) {
      old = value;
      break;
    }
  }
  return pairs(groups);
}

// The first entity begins in line 12, each group has two lines.
TEST(DxfDamage, WhatIsNoNumberIsAnError) {
  const Groups line{{0, "LINE"}, {10, "0"}, {20, "0"}, {11, "1"}, {21, "1"}};
  const Groups circle{{0, "CIRCLE"}, {10, "0"}, {20, "0"}, {40, "3"}};
  const Groups arc{{0, "ARC"}, {10, "0"}, {20, "0"}, {40, "3"}, {50, "0"}, {51, "90"}};
  const Groups insert{{0, "INSERT"}, {2, "B"}, {10, "0"}, {41, "1"}, {50, "0"}, {70, "1"}};
  const Groups spline{{0, "SPLINE"}, {71, "1"}, {40, "0"}, {10, "0"}, {20, "0"}};
  const Groups old{{0, "POLYLINE"}, {70, "0"}, {0, "VERTEX"}, {10, "0"}, {20, "0"}, {42, "0"}};
  const std::vector<Groups> all{square(0), line, circle, arc, insert, spline, old};
  for (const Groups& groups : all) {
    for (size_t i = 0; i < groups.size(); ++i) {
      const int code = groups[i].first;
      if (code == 0 || code == 2 || code == 8) continue;
      for (const char* value : {"1O", "10,0", "", "1e999", "nan", "0x1"}) {
        Groups bad = groups;
        bad[i].second = value;
        EXPECT_EQ(error("x.dxf", entities(pairs(bad)), {}),
                  "x.dxf:" + std::to_string(12 + 2 * i) + ": expected a number for group code " +
                      std::to_string(code) + ", got \"" + value + "\"");
      }
    }
  }
  const std::string block = pairs({{0, "BLOCK"}, {2, "B"}, {10, "x"}, {0, "ENDBLK"}});
  EXPECT_EQ(error("x.dxf", entities("", block), {}),
            "x.dxf:10: expected a number for group code 10, got \"x\"");
  // Of no matter: what nothing is drawn by.
  EXPECT_NEAR(read("x.dxf", entities(pairs(square(0, {{39, "x"}, {62, "x"}}))), {}).shape.area(),
              100, 1e-9);
  EXPECT_NEAR(read("x.dxf", entities(with_value(square(0), 10, " +.0E1 ")), {}).shape.area(), 100,
              1e-9);
}

TEST(DxfDamage, VerticesAreCounted) {
  EXPECT_EQ(error("x.dxf", entities(pairs(square(0, {}, "5"))), {}),
            "x.dxf:16: expected an LWPOLYLINE of \"5\" vertices, got one of 4");
  EXPECT_EQ(error("x.dxf", entities(pairs(square(0, {}, "3"))), {}),
            "x.dxf:16: expected an LWPOLYLINE of \"3\" vertices, got one of 4");
  const auto without = [](size_t at) {
    Groups groups = square(0);
    groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(at));
    return entities(pairs(groups));
  };
  EXPECT_NEAR(read("x.dxf", without(2), {}).shape.area(), 100, 1e-9);  // no count at all
  EXPECT_EQ(error("x.dxf", without(5), {}),
            "x.dxf:22: expected group code 20 of a vertex of LWPOLYLINE, got 10");
  EXPECT_EQ(error("x.dxf", without(6), {}),
            "x.dxf:24: expected group code 10 of a vertex of LWPOLYLINE, got 20");
  EXPECT_EQ(error("x.dxf", without(11), {}),
            "x.dxf:32: expected group code 20 of a vertex of LWPOLYLINE, got its end");
}

TEST(DxfDamage, WhatIsCutOffIsAnError) {
  const std::string whole = entities(pairs(square(0)) + pairs(square(20)));
  ASSERT_NEAR(read("x.dxf", whole, {}).shape.area(), 200, 1e-9);
  // Wherever it is cut, something says so: all but what ends after the sections is an error.
  const size_t complete = whole.rfind("ENDSEC") + 6;
  for (size_t end = 0; end < whole.size(); ++end) {
    const auto file = parse_flat("x.dxf", whole.substr(0, end), {});
    const size_t last = whole.rfind("EOF") + 3;
    if (end >= last) {
      EXPECT_TRUE(file && file->notes.empty()) << end;
    } else if (file) {
      EXPECT_EQ(file->notes.size(), 1u) << end;
      // Before the first entity there are the end of the empty section of blocks, and nothing.
      EXPECT_TRUE(end >= complete || end <= whole.find("ENTITIES")) << end;
    }
  }
  const auto until = [&](const std::string& word) { return whole.substr(0, whole.rfind(word)); };
  EXPECT_EQ(error("x.dxf", until("  0\r\nENDSEC"), {}),
            "x.dxf:58: the file ends within section \"ENTITIES\", which begins at line 8; expected "
            "ENDSEC");
  EXPECT_EQ(read("x.dxf", until("  0\r\nEOF"), {}).notes,
            std::vector<std::string>{"x.dxf:60: the file has no EOF at its end"});
  // Without a mark of its end a section is whole all the same if another follows, or the EOF.
  const std::string unmarked = until("  0\r\nENDSEC") + pairs({{0, "EOF"}});
  const FlatFile file = read("x.dxf", unmarked, {});
  EXPECT_NEAR(file.shape.area(), 200, 1e-9);
  EXPECT_EQ(file.notes, std::vector<std::string>{"x.dxf:8: section \"ENTITIES\" has no ENDSEC"});
  EXPECT_NEAR(read("x.dxf", whole + "\r\n\r\n", {}).shape.area(), 200, 1e-9);
}

TEST(DxfDamage, LinesOfOldMacs) {
  std::string text = entities(pairs(square(0)));
  std::erase(text, '\n');
  EXPECT_NEAR(read("x.dxf", text, {}).shape.area(), 100, 1e-9);
  text.replace(text.find("10\r"), 3, "1O\r");
  EXPECT_EQ(error("x.dxf", text, {}).substr(0, 9), "x.dxf:19:");
  const FlatFile tree = read("x.dxf", text, of_tree());
  EXPECT_TRUE(tree.shape.empty());
  EXPECT_EQ(tree.notes, std::vector<std::string>{
                            "x.dxf: its lines end in no line feed, so OpenSCAD reads nothing"});
  EXPECT_NEAR(read("x.dxf", "\xef\xbb\xbf" + entities(pairs(square(0))), {}).shape.area(), 100,
              1e-9);
}

// Areas by OpenSCAD 2021.01.
TEST(DxfDamage, TreesReadWhatOpenScadReads) {
  const auto area = [](const std::string& text) {
    const FlatFile file = read("x.dxf", text, of_tree());
    EXPECT_FALSE(file.notes.empty());
    return file.shape.area();
  };
  const std::string second = pairs(square(20));
  // What an entity lacks it takes from what follows, so all that follows is lost here.
  EXPECT_EQ(area(entities(with_value(square(0), 10, "1O") + second)), 0);
  EXPECT_EQ(area(entities(with_value(square(0), 20, "1,0"))), 0);
  const Groups disc{{0, "CIRCLE"}, {10, "3"}, {20, "0"}, {40, "3"}};
  EXPECT_EQ(area(entities(with_value(disc, 40, "3,0"))), 0);
  EXPECT_NEAR(area(entities(with_value(disc, 40, "3,0") + second)), 100, 1e-9);
  // The circle takes the first X of the square; it is its only other coordinate, but Y is its own.
  EXPECT_NEAR(area(entities(with_value(disc, 10, "x") + second)), ngon_on_grid(32, 3), 1e-6);
  EXPECT_NEAR(area(entities(dxf_line(0, 0, 10, 0) +
                            pairs({{0, "LINE"}, {10, "1O"}, {20, "0"}, {11, "10"}, {21, "10"}}) +
                            dxf_line(10, 10, 0, 10) + dxf_line(0, 10, 0, 0))),
              100, 1e-9);
  EXPECT_NEAR(area(entities(with_value(square(0), 70, "x"))), 100, 1e-9);
  const Groups ellipse{{0, "ELLIPSE"}, {10, "0"}, {20, "0"}, {11, "3"},
                       {21, "0"},      {40, "1"}, {41, "0"}, {42, "6.2831853"}};
  EXPECT_EQ(area(entities(with_value(ellipse, 40, "0,5"))), 0);
  EXPECT_EQ(area(entities(with_value(ellipse, 42, "x"))), 0);
  // The last entity ends where the next begins, or not at all.
  const std::string start = pairs({{0, "SECTION"}, {2, "ENTITIES"}});
  EXPECT_EQ(area(start + pairs(square(0))), 0);
  EXPECT_NEAR(area(start + pairs(square(0)) + second), 100, 1e-9);
  EXPECT_NEAR(area(start + pairs(square(0)) + second.substr(0, second.size() - 4)), 100, 1e-9);
  EXPECT_NEAR(area(start + pairs(square(0)) + pairs({{0, "ENDSEC"}}) + "x\ny\n"), 100, 1e-9);
  // A count is not looked at.
  EXPECT_NEAR(read("x.dxf", entities(pairs(square(0, {}, "7"))), of_tree()).shape.area(), 100,
              1e-9);
}

TEST(DxfDamage, SplineFitPolylines) {
  // Sixteen points of a circle of radius 3, within the frame of their control points.
  constexpr int kPoints = 16;
  const auto vertex = [](double r, int i, const char* flags) {
    const double angle = 2 * std::acos(-1.0) * i / kPoints;
    return pairs({{0, "VERTEX"},
                  {10, std::to_string(r * std::cos(angle))},
                  {20, std::to_string(r * std::sin(angle))},
                  {70, flags}});
  };
  std::string frame, curve, fitted;
  for (int i = 0; i < kPoints; ++i) {
    if (i % 4 == 0) frame += vertex(5, i, "16");
    curve += vertex(3, i, "8");
    fitted += vertex(3, i, i % 2 == 0 ? "0" : "1");  // every other one by the fit of arcs
  }
  const std::string end = pairs({{0, "SEQEND"}});
  const auto area = [&](const char* flags, const std::string& vertices) {
    const std::string start = pairs({{0, "POLYLINE"}, {70, flags}});
    return read("x.dxf", entities(start + vertices + end), {}).shape.area();
  };
  EXPECT_NEAR(area("5", frame + curve), ngon_on_grid(kPoints, 3), 1e-3);
  EXPECT_NEAR(area("5", frame + curve), 27.553, 1e-2);
  EXPECT_NEAR(area("3", fitted), ngon_on_grid(kPoints, 3), 1e-3);
  const FlatFile alone =
      read("x.dxf", entities(pairs({{0, "POLYLINE"}, {70, "5"}}) + frame + end), {});
  EXPECT_TRUE(alone.shape.empty());
  EXPECT_EQ(alone.notes,
            std::vector<std::string>{"x.dxf: POLYLINE of control points only left out (1)"});
}

TEST(DxfDamage, MeshesAreNoOutlines) {
  const auto polyline = testing::dxf_old_triangle;
  for (const FlatFileOptions& options : {FlatFileOptions(), of_tree()}) {
    const FlatFile file =
        read("x.dxf", entities(polyline("1") + polyline("64") + polyline("17") + polyline("16")),
             options);
    EXPECT_NEAR(file.shape.area(), 8, 1e-9);
    EXPECT_EQ(file.notes,
              (std::vector<std::string>{"x.dxf: POLYLINE of a mesh left out (2)",
                                        "x.dxf: POLYLINE of a polyface mesh left out (1)"}));
  }
}

TEST(DxfDamage, HiddenEntitiesAreLeftOut) {
  const std::string old = pairs({{0, "POLYLINE"},
                                 {60, "1"},
                                 {70, "1"},
                                 {0, "VERTEX"},
                                 {10, "50"},
                                 {0, "VERTEX"},
                                 {10, "54"},
                                 {0, "VERTEX"},
                                 {10, "54"},
                                 {20, "4"},
                                 {0, "SEQEND"}});
  const std::string block = pairs({{0, "BLOCK"}, {2, "B"}}) + pairs(square(100, {{67, "1"}})) +
                            pairs(square(120, {{60, "1"}})) + pairs({{0, "ENDBLK"}});
  const std::string content =
      pairs(square(0)) + pairs(square(20, {{60, "1"}})) + pairs(square(40, {{67, "1"}})) +
      pairs(square(60, {{60, "0"}, {67, "0"}})) + old +
      pairs({{0, "VIEWPORT"}, {67, "1"}, {0, "INSERT"}, {2, "B"}, {67, "1"}, {10, "0"}, {20, "0"}});
  const FlatFile file = read("x.dxf", entities(content, block), {});
  EXPECT_NEAR(file.shape.area(), 200, 1e-9);
  EXPECT_EQ(file.notes, (std::vector<std::string>{"x.dxf: entities in paper space left out (2)",
                                                  "x.dxf: invisible entities left out (2)"}));
  // In a block the space is that of its insertion.
  const std::string insert = pairs({{0, "INSERT"}, {2, "B"}, {10, "0"}, {20, "0"}});
  EXPECT_NEAR(read("x.dxf", entities(insert, block), {}).shape.area(), 100, 1e-9);
  // OpenSCAD 2021.01 draws them all.
  EXPECT_NEAR(
      read("x.dxf", entities(pairs(square(20, {{60, "1"}})) + pairs(square(40, {{67, "1"}}))),
           of_tree())
          .shape.area(),
      200, 1e-9);
}

}  // namespace
}  // namespace csgrun::dxf_damage_test
