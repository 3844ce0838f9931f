// Strokes of SVG: under transforms of all kinds, in dashes, of no width.
#include <cmath>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include <csgrun/primitives/flat_file.h>

#include "tests/unit/primitives/drawing_files.h"

namespace csgrun::svg_stroke_test {
namespace {

using testing::error;
using testing::kPi;
using testing::ngon;
using testing::page;
using testing::read;
using testing::with_fn;

Shape2D svg(const std::string& content, const FlatFileOptions& options = with_fn(32)) {
  const FlatFile file = read("x.svg", page(content), options);
  EXPECT_EQ(file.notes, std::vector<std::string>{});
  return file.shape;
}

std::string line(const std::string& d, const std::string& attributes) {
  return "<path fill='none' stroke='red' d='" + d + "' " + attributes + "/>";
}

// A map multiplies the area of every stroke by its determinant.
TEST(SvgStroke, UnderTransforms) {
  EXPECT_NEAR(
      svg("<g transform='scale(1,5)'>" + line("M0 5H10", "stroke-width='2'") + "</g>").area(), 100,
      1e-9);
  EXPECT_NEAR(svg(line("M0 0V10", "transform='skewX(60)' stroke-width='2'")).area(), 20, 1e-6);
  struct Map {
    const char* transform;
    double determinant;
  };
  for (const Map& map : {Map{"matrix(1 2 3 4 5 6)", 2}, Map{"scale(3,-1)", 3},
                         Map{"rotate(30) scale(2,7) rotate(20)", 14}, Map{"rotate(33) scale(2)", 4},
                         Map{"scale(-2,2)", 4}, Map{"scale(1e-3,1)", 1e-3}}) {
    for (const char* pen : {"stroke-linejoin='bevel'", "stroke-linejoin='round'", "",
                            "stroke-linecap='square'", "stroke-linecap='round'"}) {
      const std::string with = std::string(pen) + " stroke-width='2' ";
      const double plain = svg(line("M1 1h20v9l-5 3", with)).area();
      const std::string transform = std::string("transform='") + map.transform + "'";
      EXPECT_NEAR(svg(line("M1 1h20v9l-5 3", with + transform)).area(), plain * map.determinant,
                  1e-5)
          << map.transform << pen;
    }
  }
  // The stroke of a horizontal line is as high as its width says; caps are ellipses.
  const auto box =
      svg(line("M10 10H20", "stroke-linecap='round' stroke-width='2' transform='scale(3,1)'"))
          .bounds();
  EXPECT_NEAR(box[0].x, 27, 1e-6);
  EXPECT_NEAR(box[1].x, 63, 1e-6);
  EXPECT_NEAR(box[1].y - box[0].y, 2, 1e-6);
}

// Caps have as many sides as the circle has that they become, not that which is drawn.
TEST(SvgStroke, FacetsAreThoseOfTheResult) {
  FlatFileOptions fine;
  fine.facets.fa = 1;
  fine.facets.fs = 0.1;
  // Of the radius 10 and of 0.1 by 10 mm: 2 pi 10 / 0.1 sides are more than 360.
  const auto caps = [&](const char* transform) {
    const Shape2D shape = svg(line("M2 2H4", std::string("stroke-linecap='round' stroke-width='2' "
                                                         "transform='") +
                                                 transform + "'"),
                              fine);
    return shape.loops().at(0).size();
  };
  EXPECT_NEAR(static_cast<double>(caps("scale(10)")), 360, 4);
  EXPECT_NEAR(static_cast<double>(caps("scale(10,0.1)")), 360, 4);
}

TEST(SvgStroke, OfNoWidthIsNone) {
  const std::string rect = "<rect width='1' height='1'/>";
  EXPECT_NEAR(svg("<path d='M0 5H9' style='stroke:red;stroke-width:0'/>" + rect).area(), 1, 1e-9);
  EXPECT_NEAR(svg("<g transform='scale(1,0)'>" + line("M0 5h9v9", "") +
                  "<rect width='9' height='9'/></g>" + rect)
                  .area(),
              1, 1e-9);
  EXPECT_NEAR(svg(line("M0 5h9v9", "transform='rotate(30) scale(0,1)'") + rect).area(), 1, 1e-9);
  EXPECT_NEAR(svg("<path d='M0 0h9v9' style='stroke:red;stroke-width:0'/>").area(), 40.5, 1e-9);
  const FlatFile file = read(
      "x.svg",
      page(rect + line("M0 5H9", "stroke-width='0'") + "\n" + line("M0 8H9", "stroke-width='-2'")),
      {});
  EXPECT_NEAR(file.shape.area(), 1 + 9, 1e-9);  // what must not be is as if it were not there
  EXPECT_EQ(
      file.notes,
      (std::vector<std::string>{
          "x.svg: a stroke-width of <path> left out (1, in line 2: got \"-2\", which must not "
          "be negative)",
          "x.svg: an element without fill and stroke left out (1, in line 1)"}));
}

TEST(SvgStroke, Dashes) {
  const auto area = [](const std::string& d, const std::string& attributes) {
    return svg(line(d, attributes)).area();
  };
  EXPECT_NEAR(area("M0 5h10", "stroke-dasharray='1'"), 5, 1e-7);
  EXPECT_NEAR(area("M0 5h10", "stroke-dasharray='2,1'"), 7, 1e-7);
  EXPECT_NEAR(area("M0 5h10", "stroke-dasharray='1 2 3'"), 6, 1e-7);  // 1, 3 and 2 of 1 2 3 1 2 3
  EXPECT_NEAR(area("M0 5h10", "stroke-dasharray='2 1' stroke-dashoffset='1'"), 7, 1e-7);
  EXPECT_NEAR(area("M0 5h10", "stroke-dasharray='2 1' stroke-dashoffset='-1'"), 6, 1e-7);
  EXPECT_NEAR(area("M0 5h10", "stroke-dasharray='2 1' stroke-dashoffset='302'"), 6, 1e-7);
  EXPECT_NEAR(area("M0 5h10", "style='stroke-dasharray: 20px'"), 10, 1e-7);
  EXPECT_NEAR(area("M0 5h10", "stroke-dasharray='none'"), 10, 1e-7);
  EXPECT_NEAR(area("M0 5h10", "stroke-dasharray='0 0'"), 10, 1e-7);
  EXPECT_NEAR(area("M0 5h10", "stroke-dasharray='3 0'"), 10, 1e-7);
  EXPECT_NEAR(area("M0 5h100", "stroke-dasharray='1% 1%'"), 50, 1e-6);
  // Each subpath begins anew.
  EXPECT_NEAR(area("M0 5h3M0 9h3", "stroke-dasharray='2 9'"), 4, 1e-7);
  // Caps of 1/2 more at both ends.
  EXPECT_NEAR(area("M5 5h10", "stroke-dasharray='2 3' stroke-linecap='square'"), 6, 1e-7);
  EXPECT_NEAR(area("M5 5h10", "stroke-dasharray='2 3' stroke-linecap='round'"),
              4 + 2 * ngon(32, 0.5), 1e-6);
  // Around a corner, with its mitre; ending in it, without.
  EXPECT_NEAR(area("M5 5h10v10", "stroke-dasharray='20' stroke-dashoffset='10'"), 10, 1e-7);
  EXPECT_NEAR(area("M5 5h10v10", "stroke-dasharray='4' stroke-dashoffset='0'"), 12, 1e-7);
  EXPECT_NEAR(area("M5 5h10v10", "stroke-dasharray='5' "), 5 + 5, 1e-7);
  const auto box = svg(line("M5 5h10v10", "stroke-dasharray='10 10'")).bounds();
  EXPECT_NEAR(box[0].y, 94.5, 1e-7);
  EXPECT_NEAR(box[1].x, 15, 1e-7);
  // Steps of 0.1 that come to nearly 10: no crumb at its end.
  EXPECT_EQ(svg(line("M0 5h10", "stroke-dasharray='0.1' stroke-linecap='butt'")).loops().size(),
            50u);
  // In the measure of the author: the path is said to be 100 long.
  EXPECT_NEAR(area("M0 5h10", "stroke-dasharray='30 20' pathLength='100'"), 6, 1e-7);
  // Under a map; handed down; by rules.
  EXPECT_NEAR(svg("<g stroke-dasharray='1' transform='skewX(30) scale(1,5)'>" +
                  line("M0 5h10", "") + "</g>")
                  .area(),
              25, 1e-6);
  EXPECT_NEAR(svg("<style>path{stroke-dasharray:1 4}</style>" + line("M0 5h10", "")).area(), 2,
              1e-7);
  // Closed outlines are areas, whatever their strokes.
  EXPECT_NEAR(area("M0 0h10v10z", "stroke-dasharray='1'"), 50, 1e-9);
  EXPECT_EQ(
      read("x.svg", page(line("M0 5h10", "stroke-dasharray='1 -1'")), {}).notes,
      std::vector<std::string>{"x.svg: a stroke-dasharray of <path> left out (1, in line 1: "
                               "got \"1 -1\", expected up to 1000 lengths that are not negative)"});
  EXPECT_EQ(error("x.svg", page(line("M0 5h10", "stroke-dasharray='1e-9'"))),
            "x.svg: a stroke-dasharray makes more than 1048576 dashes");
  EXPECT_EQ(error("x.svg", page(line("M0 5h10", "stroke-dasharray='1e-300 1e-300'"))),
            "x.svg: a stroke-dasharray makes more than 1048576 dashes");
}

TEST(SvgStroke, Dots) {
  const auto area = [](const std::string& d, const std::string& attributes) {
    return svg(line(d, attributes)).area();
  };
  const std::string round = "stroke-linecap='round' ", square = "stroke-linecap='square' ";
  EXPECT_NEAR(area("M5 5h10", round + "stroke-dasharray='0 2.4'"), 5 * ngon(32, 0.5), 1e-6);
  EXPECT_NEAR(area("M5 5h10", round + "stroke-dasharray='0 5'"), 2 * ngon(32, 0.5), 1e-6);
  EXPECT_NEAR(area("M5 5h10", square + "stroke-dasharray='0 2.4'"), 5, 1e-6);
  EXPECT_NEAR(area("M5 5l6 8", square + "stroke-dasharray='0 3'"), 4, 1e-6);
  EXPECT_TRUE(svg(line("M5 5h10", "stroke-dasharray='0 2.4'")).empty());
  // Lines of no length.
  EXPECT_NEAR(area("M5 5h0", round), ngon(32, 0.5), 1e-6);
  EXPECT_NEAR(area("M5 5L5 5", square + "transform='scale(2,3)'"), 6, 1e-6);
  EXPECT_NEAR(area("M5 5h0", ""), 0, 1e-9);
  EXPECT_NEAR(area("M5 5", round), 0, 1e-9);
}

// A px of the pen is one of the page: 96 an inch where its size is in millimetres.
TEST(SvgStroke, OfAFixedWidth) {
  const double px = 25.4 / 96;
  const std::string fixed = "vector-effect='non-scaling-stroke' stroke-width='2' ";
  EXPECT_NEAR(svg(line("M0 5h10", fixed)).area(), 10 * 2 * px, 1e-6);
  EXPECT_NEAR(svg(line("M0 5h10", fixed + "transform='scale(3,7)'")).area(), 30 * 2 * px, 1e-6);
  EXPECT_NEAR(svg(line("M0 0v10", fixed + "transform='skewX(60)'")).area(), 20 * 2 * px, 1e-6);
  EXPECT_NEAR(svg(line("M0 5h1", fixed + "stroke-dasharray='1 1' transform='scale(" +
                                     std::to_string(8 * px) + ",1)'"))
                  .area(),
              4 * 2 * px * px, 1e-5);
  EXPECT_NEAR(
      svg(line("M0 5h10", "style='vector-effect:non-scaling-stroke; stroke-width:1mm'")).area(), 10,
      1e-6);
  // A page without a viewBox has units of 1 mm.
  EXPECT_NEAR(read("x.svg", "<svg width='99' height='99'>" + line("M0 5h10", fixed) + "</svg>", {})
                  .shape.area(),
              20, 1e-6);
  EXPECT_EQ(read("x.svg", page(line("M0 5h10", "vector-effect='fixed-position'")), {}).notes,
            std::vector<std::string>{"x.svg: a vector-effect left out (1, in line 1: got "
                                     "\"fixed-position\", expected non-scaling-stroke or none)"});
}

TEST(SvgStroke, MarkersAreSaid) {
  const auto notes = [](const std::string& content) {
    return read("x.svg", page(content), {}).notes;
  };
  using Notes = std::vector<std::string>;
  EXPECT_EQ(notes(line("M0 5h10", "marker-end='url(#a)'")),
            Notes{"x.svg: marker-end left out (1, in line 1)"});
  EXPECT_EQ(
      notes("<g style='marker:url(#a)'>" + line("M0 5h10", "style='marker-mid:none'") + "</g>"),
      (Notes{"x.svg: marker-end left out (1, in line 1)",
             "x.svg: marker-start left out (1, in line 1)"}));
  EXPECT_EQ(notes("<g marker-end='url(#a)'><rect width='1' height='1'/>" +
                  line("M0 5h10", "marker-end='none'") + "</g>"),
            Notes{});
}

}  // namespace
}  // namespace csgrun::svg_stroke_test
