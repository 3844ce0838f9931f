// SVG drawings against the areas that they show.
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include <csgrun/primitives/flat_file.h>

#include "tests/unit/primitives/drawing_files.h"

namespace csgrun::svg_file_test {
namespace {

using testing::error;
using testing::kPi;
using testing::ngon;
using testing::page;
using testing::read;
using testing::with_fn;

Shape2D svg(const std::string& content, const FlatFileOptions& options = with_fn(32)) {
  return read("x.svg", page(content), options).shape;
}

TEST(Svg, BasicShapes) {
  const Shape2D rect = svg("<rect x='10' y='20' width='30' height='5'/>");
  EXPECT_NEAR(rect.area(), 150, 1e-9);
  EXPECT_EQ(rect.bounds()[0], glm::dvec2(10, 75));  // Y is turned over, the page stands on 0
  EXPECT_NEAR(svg("<rect width='30' height='10' rx='2'/>").area(), 300 - 4 * 4 + ngon(32, 2), 1e-6);
  EXPECT_NEAR(svg("<rect width='8' height='8' rx='100' ry='4'/>").area(), ngon(32, 4), 1e-6);
  EXPECT_NEAR(svg("<circle cx='5' cy='5' r='4'/>").area(), ngon(32, 4), 1e-6);
  EXPECT_NEAR(svg("<ellipse cx='5' cy='5' rx='4' ry='2'/>").area(), ngon(32, 4) / 2, 1e-6);
  EXPECT_NEAR(svg("<polygon points='0,0 10,0 10,10'/>").area(), 50, 1e-9);
  EXPECT_NEAR(svg("<polyline points='0,0 10,0 10,10'/>").area(), 50, 1e-9);  // filled: closed
  EXPECT_TRUE(svg("<circle r='0'/><rect width='0' height='3'/>").empty());
}

TEST(Svg, Paths) {
  EXPECT_NEAR(svg("<path d='M10 10h20v5H10z'/>").area(), 100, 1e-9);
  EXPECT_NEAR(
      svg("<path d='m10,10 20,0 0,5 -20,0z m1,1 3,0 0,3 -3,0z' fill-rule='evenodd'/>").area(), 91,
      1e-9);
  // Without blanks where none are needed, and with an exponent.
  EXPECT_NEAR(svg("<path d='M1e1.5L20 .5 20-9.5-1-9.5Z'/>").area(), 155, 1e-9);
  // Half circles: arcs with 32 fragments a turn.
  EXPECT_NEAR(svg("<path d='M10 20A5 5 0 0 1 20 20A5 5 0 0110 20z'/>").area(), ngon(32, 5), 1e-6);
  EXPECT_NEAR(svg("<path d='M10 20a10 5 90 1 0 10 0z'/>").area(),
              svg("<path d='M10 20a10 5 90 1 0 10 0z'/>", with_fn(32)).area(), 1e-9);
  // An arc that is too small is enlarged until it fits: half a circle of radius 5.
  EXPECT_NEAR(svg("<path d='M10 20A1 1 0 0 1 20 20z'/>").area(), ngon(32, 5) / 2, 1e-6);
  // A parabola: a third less than its control triangle has, and in steps a little less.
  EXPECT_NEAR(svg("<path d='M0 50Q10 30 20 50z'/>", with_fn(400)).area(), 2.0 / 3 * 200, 0.02);
  EXPECT_NEAR(svg("<path d='M0 50q5 -10 10 -10t10 10z'/>", with_fn(400)).area(),
              svg("<path d='M0 50q5 -10 10 -10q5 0 10 10z'/>", with_fn(400)).area(), 1e-9);
  // The usual circle of four cubics.
  const double k = 0.5522847498 * 10;
  const std::string d = "M20 10C20 " + std::to_string(10 + k) + " " + std::to_string(10 + k) +
                        " 20 10 20S0 " + std::to_string(10 + k) + " 0 10 " +
                        std::to_string(10 - k) + " 0 10 0 20 " + std::to_string(10 - k) + " 20 10z";
  EXPECT_NEAR(svg("<path d='" + d + "'/>", with_fn(400)).area(), kPi * 100, 0.15);
}

TEST(Svg, GroupsUseAndTransforms) {
  const Shape2D moved =
      svg("<g transform='translate(10 20)'><g transform='scale(2,3)'>"
          "<rect width='4' height='5'/></g></g>");
  EXPECT_NEAR(moved.area(), 120, 1e-9);
  EXPECT_EQ(moved.bounds()[0], glm::dvec2(10, 65));
  EXPECT_NEAR(svg("<rect transform='rotate(30 5 5) skewX(20)' width='4' height='5'/>").area(), 20,
              1e-6);
  const Shape2D turned =
      svg("<rect transform='rotate(90, 10, 10)' x='10' y='10' width='4' "
          "height='2'/>");
  EXPECT_EQ(turned.bounds()[0], glm::dvec2(8, 86));
  EXPECT_NEAR(svg("<rect transform='matrix(2 0 0 2 1 1)' width='4' height='5'/>").area(), 80, 1e-9);
  EXPECT_NEAR(svg("<defs><rect id='r' width='2' height='2'/></defs><use href='#r'/>"
                  "<use xlink:href='#r' x='5' y='5'/>")
                  .area(),
              8, 1e-9);
  EXPECT_NEAR(svg("<symbol id='s'><rect width='2' height='2'/></symbol><use href='#s'/>").area(), 4,
              1e-9);
  // Elements unite whatever covers them.
  EXPECT_NEAR(
      svg("<rect width='4' height='4' fill='red'/><rect x='2' width='4' height='4'/>").area(), 24,
      1e-9);
  EXPECT_NEAR(
      svg("<g display='none'><rect width='4' height='4'/></g><rect width='1' height='1'/>").area(),
      1, 1e-9);
}

TEST(Svg, LinesThereAndBackEncloseNothing) {
  // Under the transform their corners are off the line by rounding.
  const std::string there_and_back = "M6 0H1 2 3 4 5 0";
  const auto shape = [](const std::string& d) {
    return read("a.svg",
                "<svg width='40mm' height='40mm' viewBox='0 0 40 40'><path "
                "transform='rotate(10) skewX(3)' d='" +
                    d + "'/></svg>",
                {})
        .shape;
  };
  EXPECT_TRUE(shape(there_and_back).empty());
  EXPECT_EQ(shape(there_and_back + "M20 0h10v10h-10z").loops().size(), 1u);
  EXPECT_EQ(shape(there_and_back + "M-1-1h9v2h-9z").loops().size(), 1u);  // holes neither
  // What is thin is there.
  EXPECT_NEAR(shape("M0 0h10v1e-6h-10z").area(), 1e-5, 1e-6);
}

TEST(Svg, SizesFollowThePage) {
  const std::string rect = "<rect width='10' height='10'/>";
  const auto area = [&](const std::string& attributes, double dpi = 72) {
    FlatFileOptions options;
    options.dpi = dpi;
    return read("x.svg", "<svg " + attributes + ">" + rect + "</svg>", options).shape.area();
  };
  const double unit = 25.4 / 72;
  EXPECT_NEAR(area(""), 100, 1e-9);
  EXPECT_NEAR(area("", 25.4), 100, 1e-9);
  EXPECT_NEAR(area("width='20mm' height='20mm' viewBox='0 0 10 10'"), 400, 1e-9);
  EXPECT_NEAR(area("width='2in' height='2in' viewBox='0 0 10 10'"), 50.8 * 50.8, 1e-6);
  EXPECT_NEAR(area("width='96px' height='96px' viewBox='0 0 10 10'"), 25.4 * 25.4, 1e-6);
  EXPECT_NEAR(area("width='72pt' height='6pc' viewBox='0 0 10 10'"), 25.4 * 25.4, 1e-6);
  EXPECT_NEAR(area("width='3cm' viewBox='0 0 10 10'"), 900, 1e-6);
  EXPECT_NEAR(area("viewBox='0 0 10 10'"), 100 * unit * unit, 1e-6);
  // A page of another shape keeps the proportions, unless told otherwise.
  EXPECT_NEAR(area("width='20mm' height='40mm' viewBox='0 0 10 10'"), 400, 1e-6);
  EXPECT_NEAR(area("width='20mm' height='40mm' viewBox='0 0 10 10' preserveAspectRatio='none'"),
              800, 1e-6);
  EXPECT_NEAR(area("width='100%' height='100%' viewBox='0 0 10 10'", 25.4), 100, 1e-9);
}

// Of a page without a viewBox a user unit is 1 mm, as OpenSCAD has it, and its top is as far above
// the origin as its height says, where a px is 1/96 inch and a number without a unit 1/dpi.
TEST(Svg, PagesWithoutAViewBox) {
  for (const double dpi : {72.0, 96.0, 25.4}) {
    FlatFileOptions options;
    options.dpi = dpi;
    for (const std::string size : {"96px", "96", "10mm", "2in", "3cm", "50pt", "7pc"}) {
      const std::string sides = "width='" + size + "' height='" + size + "'";
      for (const std::string& rect : {sides, std::string("width='100%' height='100%'")}) {
        const auto box =
            read("x.svg", "<svg " + sides + "><rect " + rect + "/></svg>", options).shape.bounds();
        const double mm = size == "10mm"   ? 10
                          : size == "2in"  ? 50.8
                          : size == "3cm"  ? 30
                          : size == "50pt" ? 50 * 25.4 / 72
                          : size == "7pc"  ? 7 * 25.4 / 6
                                           : 96;
        const double top = size == "96px" ? 25.4 : size == "96" ? 96 * 25.4 / dpi : mm;
        EXPECT_NEAR(box[0].x, 0, 1e-7) << size;
        EXPECT_NEAR(box[1].x, mm, 1e-6) << size;
        EXPECT_NEAR(box[0].y, top - mm, 1e-6) << size;
        EXPECT_NEAR(box[1].y, top, 1e-6) << size;
      }
    }
  }
}

// CSS knows an inch as 96 user units, however large the page makes these: below 2 mm each.
TEST(Svg, UnitsAreUserUnits) {
  const auto box = [](const std::string& content, double dpi = 72) {
    FlatFileOptions options = with_fn(4);
    options.dpi = dpi;
    return read("x.svg",
                "<svg width='100mm' height='200mm' viewBox='0 0 50 100'>" + content + "</svg>",
                options)
        .shape.bounds();
  };
  for (const double dpi : {72.0, 300.0}) {
    EXPECT_NEAR(box("<circle r='10mm'/>", dpi)[1].x, 2 * 10 * 96 / 25.4, 1e-6);
    const auto rect = box("<rect width='1in' height='72pt'/>", dpi);
    EXPECT_NEAR(rect[1].x, 2 * 96, 1e-6);
    EXPECT_NEAR(rect[1].y - rect[0].y, 2 * 96, 1e-6);
    EXPECT_NEAR(box("<rect width='3px' height='3'/>", dpi)[1].x, 6, 1e-6);
  }
  // Percentages are of the width, the height, or the diagonal by the square root of 2.
  const auto part = box("<rect x='10%' y='10%' width='20%' height='20%'/>");
  EXPECT_NEAR(part[0].x, 10, 1e-6);
  EXPECT_NEAR(part[1].x, 30, 1e-6);
  EXPECT_NEAR(part[1].y, 180, 1e-6);
  EXPECT_NEAR(part[0].y, 140, 1e-6);
  EXPECT_NEAR(box("<circle r='10%'/>")[1].x, 2 * 0.1 * std::sqrt((50 * 50 + 100 * 100) / 2), 1e-6);
  // A stroke of an inch, 20 mm long.
  EXPECT_NEAR(box("<path d='M0 50H10' fill='none' stroke='red' stroke-width='1in'/>")[1].y,
              200 - 100 + 96, 1e-6);
}

TEST(Svg, ViewportsInThePage) {
  const std::string square = "<rect width='10' height='10'/>";
  const auto bounds = [&](const std::string& attributes) {
    return svg("<svg " + attributes + ">" + square + "</svg>").bounds();
  };
  const auto expect_box = [](const std::array<glm::dvec2, 2>& box, double x0, double y0, double x1,
                             double y1) {
    EXPECT_NEAR(box[0].x, x0, 1e-7);
    EXPECT_NEAR(box[0].y, 100 - y1, 1e-7);  // pages count down
    EXPECT_NEAR(box[1].x, x1, 1e-7);
    EXPECT_NEAR(box[1].y, 100 - y0, 1e-7);
  };
  expect_box(bounds("x='5' y='6'"), 5, 6, 15, 16);
  expect_box(bounds("x='5' y='6' width='20' height='20' viewBox='0 0 10 10'"), 5, 6, 25, 26);
  expect_box(bounds("x='5' y='6' width='20' height='20' viewBox='-10 -10 20 20'"), 15, 16, 25, 26);
  expect_box(bounds("width='20' height='40' viewBox='0 0 10 10'"), 0, 10, 20, 30);
  expect_box(bounds("width='20' height='40' viewBox='0 0 10 10' preserveAspectRatio='none'"), 0, 0,
             20, 40);
  expect_box(
      bounds("width='20' height='40' viewBox='0 0 10 10' preserveAspectRatio='xMidYMax slice'"),
      -10, 0, 30, 40);
  expect_box(bounds("width='50%' height='50%' viewBox='0 0 10 10'"), 0, 0, 50, 50);
  expect_box(bounds("viewBox='0 0 20 20'"), 0, 0, 50, 50);  // as large as the page
  EXPECT_TRUE(svg("<svg width='0' height='9' viewBox='0 0 1 1'>" + square + "</svg>").empty());
  // Percentages in it are of its own units.
  expect_box(svg("<svg width='20' height='20' viewBox='0 0 10 10'><rect width='50%' height='50%'/>"
                 "</svg>")
                 .bounds(),
             0, 0, 10, 10);
  const auto used = [&](const std::string& symbol, const std::string& use) {
    return svg("<symbol id='s' " + symbol + ">" + square + "</symbol><use href='#s' " + use + "/>")
        .bounds();
  };
  expect_box(used("viewBox='0 0 10 10'", "x='5' y='6' width='20' height='20'"), 5, 6, 25, 26);
  expect_box(used("viewBox='0 0 10 10' width='30' height='30'", ""), 0, 0, 30, 30);
  expect_box(used("viewBox='0 0 10 10' width='30' height='30'", "width='20' height='20'"), 0, 0, 20,
             20);
  expect_box(used("viewBox='0 0 10 10'", ""), 0, 0, 100, 100);
  expect_box(used("", "x='5' y='6' width='20' height='20'"), 5, 6, 15, 16);
  EXPECT_NE(error("x.svg", page("<svg viewBox='0 0 0 1'/>")).find("viewBox"), std::string::npos);
  EXPECT_NE(error("x.svg", page("<symbol id='a'><use href='#a'/></symbol><use href='#a'/>"))
                .find("nested deeper"),
            std::string::npos);
}

// What is not heeded and may change the area is said.
TEST(Svg, WhatIsNotHeededIsSaid) {
  const auto notes = [](const std::string& content) {
    return read("x.svg", page(content + "<rect width='4' height='4'/>"), {}).notes;
  };
  using Notes = std::vector<std::string>;
  EXPECT_EQ(notes("<g clip-path='url(#c)'><rect width='1' height='1' mask='url(#m)'/></g>"
                  "<g style='clip-path: url(#c)'/><g clip-path='none'/>"),
            (Notes{"x.svg: clip-path left out (2, first in line 1)",
                   "x.svg: mask left out (1, in line 1)"}));
  EXPECT_EQ(notes("<defs><style>g .a { display : none }</style></defs>"),
            Notes{"x.svg: rules of a <style> left out (1, in line 1)"});
  EXPECT_EQ(notes("<style><![CDATA[a:hover{fill-rule:evenodd}]]></style>"
                  "<style>@media print { .a { fill: none } }</style>"),
            Notes{"x.svg: rules of a <style> left out (2, first in line 1)"});
  EXPECT_EQ(notes("<style>.a { font-size: 3px } @media print { .a { color: red } }</style><style/>"
                  "<style>@import url(x.css); @font-face { src: url(fill:x) }</style>"),
            Notes{});
}

// Rules of CSS, against the areas that they leave of an open path: the triangle that it fills, or
// the area of its stroke.
TEST(Svg, StyleSheets) {
  const auto area = [](const std::string& rules, const std::string& attributes) {
    return svg("<style>" + rules + "</style><path d='M10 10h8v8' " + attributes + "/>").area();
  };
  // Of strokes of the widths 1 and 2; at the corner the mitre makes up for what overlaps.
  const double kFilled = 32, kStroked = 16, kThick = 32;
  ASSERT_NEAR(area("", ""), kFilled, 1e-9);
  ASSERT_NEAR(area("", "fill='none' stroke='red'"), kStroked, 1e-9);
  EXPECT_NEAR(area(".a { display: none }", "class='a'"), 0, 1e-9);
  EXPECT_NEAR(area(".a,.b{fill:none;stroke:#000;stroke-width:2}", "class='x b'"), kThick, 1e-9);
  EXPECT_NEAR(area(".a{display:none}", "class='ab'"), kFilled, 1e-9);
  EXPECT_NEAR(area("<![CDATA[ /* .c { fill: red } */ .a { display: none } ]]>", "class='a'"), 0,
              1e-9);
  EXPECT_NEAR(area("path { display: none !important }", ""), 0, 1e-9);
  EXPECT_NEAR(area("* { display: none }", ""), 0, 1e-9);
  EXPECT_NEAR(area("circle { display: none }", ""), kFilled, 1e-9);
  EXPECT_NEAR(area("#r { display: none }", "id='r'"), 0, 1e-9);
  EXPECT_NEAR(area("path.a.b { visibility: hidden }", "class='b a'"), 0, 1e-9);
  EXPECT_NEAR(area("path.a.b { visibility: hidden }", "class='b'"), kFilled, 1e-9);
  // What is more specific counts, of equal rules the last; a rule more than an attribute, the
  // attribute `style` more than a rule.
  const std::string stroked = " stroke='red'";
  EXPECT_NEAR(area("#r{fill:red} .a{fill:none}", "id='r' class='a'" + stroked), kFilled, 1e-9);
  EXPECT_NEAR(area(".a{fill:none} path{fill:red} *{fill:red}", "class='a'" + stroked), kStroked,
              1e-9);
  EXPECT_NEAR(area(".a{fill:none} .b{fill:red}", "class='b a'" + stroked), kFilled, 1e-9);
  EXPECT_NEAR(area(".b{fill:red} .a{fill:none}", "class='b a'" + stroked), kStroked, 1e-9);
  EXPECT_NEAR(area(".a{fill:none}", "class='a' fill='red'" + stroked), kStroked, 1e-9);
  EXPECT_NEAR(area(".a{fill:none}", "class='a' style='fill:red'" + stroked), kFilled, 1e-9);
  // Behind what it is for, and handed down.
  EXPECT_NEAR(svg("<g class='a'><path d='M10 10h8v8'/></g>"
                  "<style>.a{fill:none;stroke:red}</style>")
                  .area(),
              kStroked, 1e-9);
}

// Icons are drawn with strokes that the root asks for.
TEST(Svg, TheRootHasAStyle) {
  const Shape2D icon =
      read("x.svg",
           "<svg viewBox='0 0 24 24' width='24mm' height='24mm' fill='none' stroke='currentColor' "
           "stroke-width='2'><path d='M5 12h14v5'/></svg>",
           with_fn(32))
          .shape;
  EXPECT_NEAR(icon.area(), 15 * 2 + 4 * 2, 1e-9);
}

TEST(Svg, RulesWithoutEndAreRefused) {
  std::string rules, rects;
  for (int i = 0; i < 20000; ++i) rules += ".a" + std::to_string(i) + "{fill:red}";
  for (int i = 0; i < 20000; ++i) rects += "<rect class='b' width='1' height='1'/>";
  EXPECT_EQ(error("x.svg", page("<style>" + rules + "</style>" + rects)),
            "x.svg: too many rules of a <style> for its elements");
}

TEST(Svg, StrokesOfOpenLines) {
  const std::string none = " fill='none' stroke='black' stroke-width='2' ";
  EXPECT_NEAR(svg("<line x1='10' y1='10' x2='20' y2='10'" + none + "/>").area(), 20, 1e-9);
  EXPECT_NEAR(
      svg("<line x1='10' y1='10' x2='20' y2='10' stroke-linecap='square'" + none + "/>").area(), 24,
      1e-9);
  EXPECT_NEAR(
      svg("<line x1='10' y1='10' x2='20' y2='10' stroke-linecap='round'" + none + "/>").area(),
      20 + ngon(32, 1), 1e-6);
  const std::string corner = "<path d='M10 10h10v10'" + none;
  EXPECT_NEAR(svg(corner + "/>").area(), 40, 1e-9);
  EXPECT_NEAR(svg(corner + "stroke-linejoin='bevel'/>").area(), 39.5, 1e-9);
  EXPECT_NEAR(svg(corner + "stroke-linejoin='round'/>").area(), 39 + ngon(32, 1) / 4, 1e-6);
  EXPECT_TRUE(svg("<path d='M10 10h10v10' fill='none'/>").empty());
  // Closed outlines are areas, filled or not, as OpenSCAD has it, but not if nothing paints them.
  EXPECT_NEAR(svg("<path d='M10 10h10v10z'" + none + "/>").area(), 50, 1e-9);
  EXPECT_NEAR(
      svg("<g style='fill:none; stroke : red ;stroke-width:4'><path d='M0 50H10'/></g>").area(), 40,
      1e-9);
}

TEST(Svg, WhatIsNotPaintedIsNoArea) {
  const std::string icon =
      "<path d='M0 0h24v24H0z' fill='none'/><path id='plus' d='M19 "
      "13h-6v6h-2v-6H5v-2h6V5h2v6h6v2z'/>";
  const FlatFile file = read("i.svg", page(icon), with_fn(32));
  EXPECT_NEAR(file.shape.area(), 2 * 28 - 4, 1e-9);
  EXPECT_EQ(file.notes, std::vector<std::string>{
                            "i.svg: an element without fill and stroke left out (1, in line 1)"});
  const std::string clear = "<rect id='r' class='a' width='3' height='3'/>";
  EXPECT_TRUE(svg("<style>.a{fill:none}</style>" + clear).empty());
  EXPECT_TRUE(svg("<g fill='none'>" + clear + "</g>").empty());
  EXPECT_NEAR(svg("<g fill='none' stroke='red'>" + clear + "</g>").area(), 9, 1e-9);
  EXPECT_NEAR(svg("<g fill='none'><g fill='red'>" + clear + "</g></g>").area(), 9, 1e-9);
  FlatFileOptions wanted = with_fn(32);
  wanted.id = "r";
  EXPECT_NEAR(svg("<g fill='none'>" + clear + "</g>", wanted).area(), 9, 1e-9);
}

TEST(Svg, LayersAndIds) {
  const std::string text =
      "<g inkscape:groupmode='layer' inkscape:label='cut' id='l1'><rect width='2' height='2'/></g>"
      "<g inkscape:groupmode='layer' inkscape:label='engrave' display='none'>"
      "<rect id='b' x='10' width='3' height='3'/></g>";
  FlatFileOptions options;
  options.layer = "cut";
  EXPECT_NEAR(svg(text, options).area(), 4, 1e-9);
  options.layer = "engrave";
  EXPECT_NEAR(svg(text, options).area(), 9, 1e-9);
  options.layer = "";
  options.id = "l1";
  EXPECT_NEAR(svg(text, options).area(), 4, 1e-9);
  options.id = "zz";
  EXPECT_EQ(error("x.svg", page(text), options), "x.svg: there is no element of id \"zz\"");
  options.id = "";
  options.center = true;
  EXPECT_EQ(svg("<rect x='3' y='3' width='2' height='2'/>", options).bounds()[0],
            glm::dvec2(-1, -1));
}

TEST(Svg, Parts) {
  FlatFileOptions options;
  options.parts = true;
  const std::string content =
      "<title>a drawing</title><defs><rect id='r' width='1' height='1'/></defs>"
      "<path id='lid_2' d='M0 0h4v4h-4z'><title>lid 2</title></path>"
      "<g id='g7' inkscape:label='holes'><title> </title><rect width='2' height='2'/>"
      "<rect id='inner' x='1' width='2' height='2'/></g>"
      "<g id='nothing'/><rect id='box' width='3' height='1'/><use href='#r'/>"
      "<circle id='holes' cx='9' cy='9' r='0'/><rect id='holes' y='9' width='1' height='1'/>"
      "<rect width='5' height='1'/>";
  FlatFile file = read("x.svg", page(content), options);
  EXPECT_TRUE(file.shape.empty());
  const std::vector<std::pair<std::string, double>> expected{
      {"lid 2", 16}, {"holes", 6 + 1}, {"box", 3}, {"", 5}};
  ASSERT_EQ(file.parts.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(file.parts[i].name, expected[i].first);
    EXPECT_NEAR(file.parts[i].shape.area(), expected[i].second, 1e-9) << expected[i].first;
  }
  // The middle of all goes to the origin, not that of each.
  options.center = true;
  file = read("x.svg", page(content), options);
  EXPECT_EQ(file.parts[0].shape.bounds()[0], glm::dvec2(-2.5, 1));
  EXPECT_TRUE(read("x.svg", "<svg/>", options).parts.empty());
  EXPECT_TRUE(read("x.svg", "<svg/>", {}).shape.empty());
}

TEST(Svg, HostileAndDamagedFiles) {
  EXPECT_EQ(error("x.svg", "<!DOCTYPE svg [<!ENTITY x SYSTEM 'file:///etc/passwd'>]><svg/>"),
            "x.svg: entities are refused: <!ENTITY> in a drawing is of no good");
  EXPECT_NE(error("x.svg", "<svg><g></svg>").find("x.svg:1"), std::string::npos);
  EXPECT_EQ(error("x.svg", "<html/>"), "x.svg: the root element is not <svg>");
  // In UTF-16 the parser's count of bytes is not that of the file.
  std::string wide;
  for (const char c : std::string("<svg/><")) wide += std::string(1, c) + '\0';
  EXPECT_NE(error("x.svg", wide).find("x.svg:"), std::string::npos);
  EXPECT_NE(error("x.svg", page("<use href='http://example.org/a.svg#x'/>")).find("same file"),
            std::string::npos);
  EXPECT_NE(error("x.svg", page("<rect transform='wobble(3)' width='1' height='1'/>"))
                .find("no transform"),
            std::string::npos);
  EXPECT_NE(error("x.svg", "<svg viewBox='0 0 0 0'/>").find("viewBox"), std::string::npos);
  EXPECT_NE(error("x.svg", page("<g id='a'><use href='#a'/></g>")).find("nested deeper"),
            std::string::npos);
  // Ten uses of ten uses of ten uses ...
  std::string bomb = "<g id='n0'><rect width='1' height='1'/></g>";
  for (int level = 1; level < 12; ++level) {
    bomb += "<g id='n" + std::to_string(level) + "'>";
    for (int i = 0; i < 10; ++i) bomb += "<use href='#n" + std::to_string(level - 1) + "'/>";
    bomb += "</g>";
  }
  EXPECT_EQ(error("x.svg", page(bomb)), "x.svg: unfolds to more than 200000 elements");
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<g>";
  EXPECT_NE(error("x.svg", "<svg>" + deep), "no error");
  const FlatFile partly = read("x.svg", page("<text>a</text><path d='M0 0h9v9zL5'/>"), {});
  EXPECT_NEAR(partly.shape.area(), 40.5, 1e-9);
  EXPECT_EQ(partly.notes,
            (std::vector<std::string>{
                "x.svg: <text> left out (1, in line 1)",
                "x.svg: the rest of a damaged <path> left out (1, in line 1: from \"L5\" on)"}));
}

}  // namespace
}  // namespace csgrun::svg_file_test
