// What the style of SVG's elements says: transforms of CSS, the cascade, lengths, what is chosen.
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include <csgrun/primitives/flat_file.h>

#include "tests/unit/primitives/drawing_files.h"

namespace csgrun::svg_style_test {
namespace {

using testing::error;
using testing::ngon;
using testing::page;
using testing::read;
using testing::with_fn;
using Notes = std::vector<std::string>;

FlatFile svg(const std::string& content) { return read("x.svg", page(content), with_fn(32)); }
double area(const std::string& content) { return svg(content).shape.area(); }
Notes notes(const std::string& content) { return svg(content).notes; }

/// Where the corners of a box are in coordinates of the page, that count down.
void expect_box(const std::string& content, double x0, double y0, double x1, double y1) {
  const FlatFile file = svg(content);
  EXPECT_EQ(file.notes, Notes{}) << content;
  const auto box = file.shape.bounds();
  EXPECT_NEAR(box[0].x, x0, 1e-7) << content;
  EXPECT_NEAR(box[0].y, 100 - y1, 1e-7) << content;
  EXPECT_NEAR(box[1].x, x1, 1e-7) << content;
  EXPECT_NEAR(box[1].y, 100 - y0, 1e-7) << content;
}

TEST(SvgStyle, TransformsOfCss) {
  const auto with = [](const std::string& style) {
    return "<rect x='10' y='20' width='4' height='2' style='" + style + "'/>";
  };
  expect_box(with("transform:scale(2)"), 20, 40, 28, 44);
  expect_box(with("Transform: SCALE(2, 50%)"), 20, 10, 28, 11);
  expect_box(with("transform: scaleX(2) scaleY(3)"), 20, 60, 28, 66);
  expect_box(with("transform: translate(2px, 3px)"), 12, 23, 16, 25);
  expect_box(with("transform: translate(2px)"), 12, 20, 16, 22);
  expect_box(with("transform: translate(10%, 50%)"), 20, 70, 24, 72);
  expect_box(with("transform: translateX(1px) translateY(1em)"), 11, 36, 15, 38);
  expect_box(with("transform: translate3d(1px, 2px, 0)"), 11, 22, 15, 24);
  expect_box(with("transform: translate(50px, 0) rotate(90deg)"), 28, 10, 30, 14);
  for (const std::string quarter : {"0.25turn", "100grad", "1.5707963267948966rad", "90"})
    expect_box(with("transform: translate(50px,0) rotate(" + quarter + ")"), 28, 10, 30, 14);
  expect_box(with("transform: skewX(45deg)"), 30, 20, 36, 22);
  expect_box(with("transform: skewY(45deg)"), 10, 30, 14, 36);
  expect_box(with("transform: skew(45deg, -45deg)"), 30, 6, 36, 12);
  expect_box(with("transform: matrix(2, 0, 0, 3, 1, 2)"), 21, 62, 29, 68);
  expect_box(with("transform: none"), 10, 20, 14, 22);
  // translate, rotate and scale, whatever their order, before it.
  expect_box(with("scale: 2; translate: 1px 2px; transform: translate(1px, 1px)"), 23, 44, 31, 48);
  expect_box(with("rotate: 90deg; translate: 50px"), 28, 10, 30, 14);
  // By rules of a sheet; over the attribute.
  expect_box("<style>.a { transform: scale(2) }</style><g class='a'>" + with("") + "</g>", 20, 40,
             28, 44);
  expect_box("<rect transform='scale(9)' style='transform:scale(2)' width='10' height='5'/>", 0, 0,
             20, 10);
  expect_box("<rect transform='none' width='10' height='5'/>", 0, 0, 10, 5);
}

TEST(SvgStyle, OriginsOfTransforms) {
  const auto turned = [](const std::string& origin) {
    return "<rect transform='rotate(90)' x='40' y='40' width='20' height='10' " + origin + "/>";
  };
  // (x, y) goes to (p - (y - q), q + (x - p)) about (p, q).
  expect_box(turned("transform-origin='50 50'"), 50, 40, 60, 60);
  expect_box(turned("style='transform-origin: 50px 50px 3px'"), 50, 40, 60, 60);
  for (const std::string middle : {"center", "50% 50%", "center 50", "50%", "50"})
    expect_box(turned("transform-origin='" + middle + "'"), 50, 40, 60, 60);
  expect_box(turned("transform-origin='bottom right'"), 150, 40, 160, 60);
  expect_box(turned("transform-origin='60 top'"), 10, -20, 20, 0);
  expect_box(
      "<style>g{transform-origin:10px 0}</style><g style='scale:3'>"
      "<rect x='10' width='1' height='1'/></g>",
      10, 0, 13, 3);
  // Of a viewport of its own, whose user units begin in its corner.
  expect_box(
      "<svg x='20' width='40' height='40' viewBox='0 0 40 40'>"
      "<rect x='19' y='19' width='2' height='2' style='transform:scale(2)' "
      "transform-origin='center'/></svg>",
      38, 18, 42, 22);
}

TEST(SvgStyle, TransformsThatAreNotKnownAreSaid) {
  const std::string rect = "\n<rect width='2' height='1' ";
  EXPECT_EQ(notes(rect + "style='transform: rotateX(45deg)'/>"),
            Notes{"x.svg: a transform of <rect> left out (1, in line 2: got \"rotatex(45deg)\", "
                  "expected functions of CSS in the plane, with lengths in known units)"});
  for (const std::string bad : {"translate(2furlongs)", "rotate(1px)", "scale(1,2,3)", "scale(",
                                "matrix(1)", "perspective(9px)", "translate(calc(1px + 1%))"}) {
    EXPECT_EQ(notes(rect + "style='transform: " + bad + "'/>").size(), 1u) << bad;
    EXPECT_NEAR(area(rect + "style='transform: " + bad + "'/>"), 2, 1e-9) << bad;
  }
  EXPECT_EQ(notes(rect + "transform='rotate(9)' transform-origin='1furlong'/>"),
            Notes{"x.svg: a transform-origin of <rect> left out (1, in line 2: got \"1furlong\", "
                  "expected two lengths, of percentages of a page with a size, or words)"});
  EXPECT_EQ(notes(rect + "style='transform: scale(2); transform-box: fill-box'/>"),
            Notes{"x.svg: a transform-box of <rect> left out (1, in line 2: got \"fill-box\", "
                  "taken as view-box)"});
  EXPECT_EQ(notes(rect + "style='transform-box: fill-box; transform-origin: 1furlong'/>"), Notes{});
  EXPECT_EQ(read("x.svg", "<svg transform='scale(2)' width='9' height='9'/>", {}).notes,
            Notes{"x.svg: a transform of the page left out (1, in line 1)"});
  EXPECT_EQ(error("x.svg", page("\n\n<rect transform='wobble(3)' width='1' height='1'/>")),
            "x.svg:3: <rect>: no transform: \"wobble(3)\"");
}

// An open path: a triangle where it is filled, else the area of its stroke.
TEST(SvgStyle, TheAttributeStyleIsCss) {
  const double kFilled = 32, kStroked = 16, kThick = 32, kNone = 0;
  const auto of = [](const std::string& style, const std::string& rules = "",
                     const std::string& attributes = "") {
    return area("<style>" + rules + "</style><path class='a' id='r' d='M10 10h8v8' stroke='red' " +
                attributes + " style='" + style + "'/>");
  };
  ASSERT_NEAR(of(""), kFilled, 1e-9);
  EXPECT_NEAR(of("fill:none !important"), kStroked, 1e-9);
  EXPECT_NEAR(of("fill:none ! IMPORTANT;"), kStroked, 1e-9);
  EXPECT_NEAR(of("/* fill:red; */ fill/**/:/* no */none"), kStroked, 1e-9);
  EXPECT_NEAR(of("FILL: None; Stroke-Width: 2PX"), kThick, 1e-9);
  EXPECT_NEAR(of("fill:red; fill:none"), kStroked, 1e-9);
  EXPECT_NEAR(of("fill:none !important; fill:red"), kStroked, 1e-9);
  EXPECT_NEAR(of("fill:none; fill:"), kStroked, 1e-9);
  EXPECT_NEAR(of("background: url(data:a;fill:red); fill:none"), kStroked, 1e-9);
  EXPECT_NEAR(of("content: \"; fill: red\"; fill:none"), kStroked, 1e-9);
  // Over attributes, which are over nothing.
  EXPECT_NEAR(of("fill:none", "", "fill='red'"), kStroked, 1e-9);
  EXPECT_NEAR(of("display:inline", "", "display='none'"), kFilled, 1e-9);
  EXPECT_NEAR(of("display:NONE", "", "display='inline'"), kNone, 1e-9);
  // Important rules over later, over more specific ones, and over the attribute style.
  EXPECT_NEAR(of("", ".a{fill:none!important} .a{fill:red}"), kStroked, 1e-9);
  EXPECT_NEAR(of("", ".a{fill:none!important} #r{fill:red}"), kStroked, 1e-9);
  EXPECT_NEAR(of("fill:red", ".a{fill:none!important}"), kStroked, 1e-9);
  EXPECT_NEAR(of("fill:none!important", "#r{fill:red!important}"), kStroked, 1e-9);
  EXPECT_NEAR(of("", ".a{fill:red!important} #r{fill:none!important}"), kStroked, 1e-9);
  EXPECT_NEAR(of("", ".a{FILL:none}"), kStroked, 1e-9);
  // Words for all properties.
  EXPECT_NEAR(area("<g fill='none' stroke='red'><path d='M10 10h8v8' style='fill:initial'/></g>"),
              kFilled, 1e-9);
  EXPECT_NEAR(area("<g fill='none' stroke='red'><path d='M10 10h8v8' style='fill:unset'/></g>"),
              kStroked, 1e-9);
  const std::string ring = "<path d='M0 0h9v9h-9z M1 1h2v2h-2z' ";
  EXPECT_NEAR(area(ring + "style='fill-rule:nonzero; fill-rule:EvenOdd'/>"), 77, 1e-9);
  EXPECT_NEAR(area(ring + "fill-rule='evenodd' style='fill-rule:nonzero'/>"), 81, 1e-9);
}

// Sizes of the specification: an inch is 96 px, whatever the page says, and an em 16 px.
TEST(SvgStyle, Units) {
  const auto height = [](const std::string& value, const std::string& attributes = "") {
    return area("<g " + attributes + "><rect width='1' height='" + value + "'/></g>");
  };
  const std::pair<const char*, double> cases[] = {{"1em", 16},
                                                  {"1rem", 16},
                                                  {"2ex", 16},
                                                  {"40Q", 10 * 96 / 25.4},
                                                  {"40q", 10 * 96 / 25.4},
                                                  {"10MM", 960 / 25.4},
                                                  {"3px", 3},
                                                  {"1pc", 16},
                                                  {"3pt", 4},
                                                  {"25%", 25},
                                                  {" 7 ", 7},
                                                  {"1e1", 10}};
  for (const auto& [text, value] : cases) EXPECT_NEAR(height(text), value, 1e-6) << text;
  EXPECT_NEAR(height("2em", "font-size='10'"), 20, 1e-9);
  EXPECT_NEAR(height("2rem", "font-size='10'"), 32, 1e-9);
  EXPECT_NEAR(height("1em", "font-size='10' style='font-size:2em'"), 32, 1e-9);
  EXPECT_NEAR(height("1ex", "style='font-size:50%'"), 4, 1e-9);
  EXPECT_NEAR(height("1em", "style='font-size:small'"), 13, 1e-9);
  EXPECT_EQ(notes("<g style='font: bold 3px serif'><rect width='1em' height='1'/></g>").size(), 1u);
  // Of the page: a fourth of a millimetre a Q, and 16 px an em.
  const auto wide = [](const std::string& width) {
    return read("x.svg",
                "<svg viewBox='0 0 1 1' width='" + width + "'><rect width='1' height='1'/></svg>",
                {})
        .shape.bounds()[1]
        .x;
  };
  EXPECT_NEAR(wide("100Q"), 25, 1e-7);
  EXPECT_NEAR(wide("6em"), 25.4, 1e-6);
  EXPECT_NEAR(wide("auto"), 25.4 / 72, 1e-7);
  EXPECT_EQ(error("x.svg", "<svg\nviewBox='0 0 1 1' width='3furlong'/>"),
            "x.svg:1: <svg>: width must be a positive length, got \"3furlong\", expected a number, "
            "with one of the units px, mm, cm, in, Q, pt, pc, em, rem, ex, %, or none");
}

TEST(SvgStyle, GeometryIsCssToo) {
  EXPECT_NEAR(area("<circle style='r:10px'/>"), ngon(32, 10), 1e-6);
  EXPECT_NEAR(area("<circle r='3' style='r:10px'/>"), ngon(32, 10), 1e-6);
  EXPECT_NEAR(area("<style>circle{r:10px}</style><circle r='3'/>"), ngon(32, 10), 1e-6);
  EXPECT_NEAR(area("<ellipse rx='10'/>"), ngon(32, 10), 1e-6);
  EXPECT_NEAR(area("<ellipse ry='10' rx='auto'/>"), ngon(32, 10), 1e-6);
  EXPECT_NEAR(area("<ellipse rx='10' style='ry:5px'/>"), ngon(32, 10) / 2, 1e-6);
  EXPECT_NEAR(area("<rect width='8' height='8' rx='auto' ry='4'/>"), ngon(32, 4), 1e-6);
  expect_box("<rect style='x:1px; y:2px; width:3px; height:4px'/>", 1, 2, 4, 6);
  expect_box("<ellipse style='cx:10px; cy:20px; rx:3px; ry:4px'/>", 7, 16, 13, 24);
  expect_box("<path style='d: path(\"M1 2h3v4z\")'/>", 1, 2, 4, 6);
  // Where they are none.
  expect_box("<path d='M1 2h3v4z' style='x:9px; width:3px'/>", 1, 2, 4, 6);
  EXPECT_EQ(notes("<line x1='1' style='x1:zz'/>"), Notes{});
}

TEST(SvgStyle, DamagedLengthsAreSaid) {
  const std::string good = "<rect width='1' height='1'/>";
  const std::string units =
      "expected a number, with one of the units px, mm, cm, in, Q, pt, pc, em, rem, ex, %, or none";
  const auto expect_note = [&](const std::string& content, const std::string& what,
                               const std::string& got, const std::string& expected) {
    const FlatFile file = svg(good + "\n\n" + content);
    EXPECT_NEAR(file.shape.area(), 1, 1e-9) << content;
    EXPECT_EQ(file.notes, Notes{"x.svg: a <" + what + " left out (1, in line 3: got \"" + got +
                                "\", " + expected + ")"});
  };
  expect_note("<rect width='9' height='1o'/>", "rect> with a bad height", "1o", units);
  expect_note("<circle r='5,5'/>", "circle> with a bad r", "5,5", units);
  expect_note("<circle r='3' style='r:calc(1px)'/>", "circle> with a bad r", "calc(1px)", units);
  expect_note("<ellipse rx='2' ry='two'/>", "ellipse> with a bad ry", "two", units);
  expect_note("<rect x='1 mm' width='9' height='9'/>", "rect> with a bad x", "1 mm", units);
  expect_note("<rect width='-9' height='9'/>", "rect> with a bad width", "-9",
              "which must not be negative");
  expect_note("<line x1='' x2='9' stroke='red'/>", "line> with a bad x1", "", units);
  expect_note("<use href='#r' x='9km'/><defs><rect id='r' width='3' height='3'/></defs>",
              "use> with a bad x", "9km", units);
  expect_note("<svg width='1o'><rect width='3' height='3'/></svg>", "svg> with a bad width", "1o",
              units);
  EXPECT_EQ(read("x.svg", "<svg><rect width='50%' height='9'/></svg>", {}).notes,
            Notes{"x.svg: a <rect> with a bad width left out (1, in line 1: got \"50%\", but the "
                  "page has no size)"});
  EXPECT_EQ(
      notes("<path d='M0 0h9' stroke='red' stroke-width='1o'/>"),
      Notes{"x.svg: a stroke-width of <path> left out (1, in line 1: got \"1o\", " + units + ")"});
  EXPECT_EQ(read("x.svg", "<svg viewBox='0 0 9 9' style='width:3px'/>", {}).notes,
            Notes{"x.svg: a width that CSS gives to the page left out (1, in line 1: got \"3px\", "
                  "expected it as an attribute)"});
}

TEST(SvgStyle, PointsUpToAMistake) {
  const FlatFile file = svg("<polygon points='0,0 10,0 10,1O 0,10'/>");
  EXPECT_NEAR(file.shape.area(), 5, 1e-9);  // to 10, 1
  EXPECT_EQ(file.notes, Notes{"x.svg: the rest of a damaged <polygon> left out (1, in line 1: from "
                              "\"O 0,10\" on)"});
  EXPECT_NEAR(area("<polyline points='0,0 10,0 10,10 5'/>"), 50, 1e-9);
  EXPECT_EQ(
      notes("<polyline points='0,0 10,0 10,10 5'/>"),
      Notes{"x.svg: the rest of a damaged <polyline> left out (1, in line 1: from \"5\" on)"});
  EXPECT_EQ(notes("<polygon points=' 0 0,10 0 10,10 '/>"), Notes{});
}

TEST(SvgStyle, PrefixesOfNamespaces) {
  const std::string defs = "<defs><rect id='r' width='2' height='1'/></defs>";
  EXPECT_NEAR(area(defs + "<use xmlns:ns1='http://www.w3.org/1999/xlink' ns1:href='#r'/>"), 2,
              1e-9);
  EXPECT_NEAR(area(defs + "<g xmlns:n='http://www.w3.org/1999/xlink'><use n:href='#r'/></g>"), 2,
              1e-9);
  EXPECT_EQ(error("x.svg", page("\n" + defs + "<use xmlns:xlink='urn:other' xlink:href='#r'/>")),
            "x.svg:2: <use> has no href, expected \"#\" and the id of an element");
  FlatFileOptions options;
  options.layer = "cut";
  const std::string layer =
      "<g xmlns:ns0='http://www.inkscape.org/namespaces/inkscape' ns0:groupmode='layer' "
      "ns0:label='cut'><rect width='2' height='2'/></g><rect width='9' height='9'/>";
  EXPECT_NEAR(read("x.svg", page(layer), options).shape.area(), 4, 1e-9);
  options = {};
  options.parts = true;
  EXPECT_EQ(read("x.svg", page(layer), options).parts[0].name, "cut");
}

TEST(SvgStyle, TheFirstOfASwitchThatFits) {
  const std::string rect = "width='2' height='2'/>", large = "<rect width='9' height='9'/>";
  const auto chosen = [&](const std::string& children) {
    return area("<switch>" + children + "</switch>");
  };
  EXPECT_NEAR(chosen("<title>a</title><rect " + rect + large), 4, 1e-9);
  EXPECT_NEAR(chosen("<rect systemLanguage='de' " + rect + large), 81, 1e-9);
  EXPECT_NEAR(chosen("<rect systemLanguage='de, en-GB' " + rect + large), 4, 1e-9);
  EXPECT_NEAR(chosen("<rect systemLanguage='eng' " + rect + large), 81, 1e-9);
  EXPECT_NEAR(chosen("<rect requiredExtensions='urn:x' " + rect + large), 81, 1e-9);
  EXPECT_NEAR(chosen("<foreignObject/>" + large + "<rect " + rect), 81, 1e-9);
  EXPECT_NEAR(chosen("<g/>" + large), 0, 1e-9);
  EXPECT_EQ(notes("<switch><rect systemLanguage='de' " + rect + "<foreignObject/></switch>"),
            Notes{"x.svg: <foreignObject> left out (1, in line 1)"});
  EXPECT_EQ(notes("<rect systemLanguage='de' " + rect),
            Notes{"x.svg: an element for others, by systemLanguage or requiredExtensions, left out "
                  "(1, in line 1)"});
  FlatFileOptions options;
  options.id = "b";
  EXPECT_NEAR(
      read("x.svg", page("<switch>" + large + "<rect id='b' " + rect + "</switch>"), options)
          .shape.area(),
      4, 1e-9);
}

TEST(SvgStyle, CompressedFilesAreSaid) {
  EXPECT_EQ(error("x.svg", "\x1f\x8b\x08"),
            "x.svg: it is compressed by gzip, as .svgz files are: expected the text of an SVG "
            "(gunzip unpacks it)");
}

// Lines are those of the file, also where bytes of the parser are others.
TEST(SvgStyle, LinesOfNotes) {
  const std::string rest = "<svg>\n<!-- \xe9\xe9\xe9\xe9\n -->\n<text/></svg>";
  const auto note = [](const std::string& text) { return read("x.svg", text, {}).notes.at(0); };
  EXPECT_EQ(note("<?xml version='1.0' encoding='ISO-8859-1'?>\n" + rest),
            "x.svg: <text> left out (1, in line 5)");
  EXPECT_EQ(note("\xef\xbb\xbf<svg>\r\n\r\n<g>\n<text/><text/></g></svg>"),
            "x.svg: <text> left out (2, first in line 4)");
  std::string wide = "\xff\xfe";
  for (const char c : std::string("<svg>\n<text/></svg>")) wide += std::string(1, c) + '\0';
  EXPECT_EQ(note(wide), "x.svg: <text> left out (1)");
}

}  // namespace
}  // namespace csgrun::svg_style_test
