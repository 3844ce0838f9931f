// SVG in trees, against closed forms with OpenSCAD's numbers of pieces.
#include <cmath>
#include <string>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include <csgrun/primitives/csg_file.h>

#include "tests/unit/primitives/drawing_files.h"

namespace csgrun::svg_openscad_test {
namespace {

using testing::kPi;
using testing::ngon;

/// The model of `import(file = "a.svg", ARGUMENTS)`.
CsgModel model_of(const std::string& svg, const std::string& arguments = "$fn = 0") {
  CsgEnvironment environment;
  environment.read = [&](const std::string&) -> Result<std::string> { return svg; };
  const auto model =
      parse_csg("m.csg", "import(file = \"a.svg\", " + arguments + ");", environment);
  EXPECT_TRUE(model) << (model ? "" : model.error().message);
  return model ? *model : CsgModel();
}

/// A page of 100 mm where a user unit is one millimetre.
CsgModel drawing(const std::string& content, const std::string& arguments = "$fn = 0") {
  return model_of("<svg width='100mm' height='100mm' viewBox='0 0 100 100'>" + content + "</svg>",
                  arguments);
}

double area(const std::string& content, const std::string& arguments = "$fn = 0") {
  return drawing(content, arguments).shape.area();
}

TEST(SvgOfTrees, CirclesHaveFortyPiecesAndBeginOnY) {
  EXPECT_NEAR(area("<circle cx='50' cy='50' r='9'/>"), ngon(40, 9), 1e-6);
  EXPECT_NEAR(area("<circle cx='50' cy='50' r='9'/>", "$fn = 8"), ngon(40, 9), 1e-6);
  EXPECT_NEAR(area("<ellipse cx='50' cy='50' rx='9' ry='3'/>"), ngon(40, 9) / 3, 1e-6);
  const Shape2D circle = drawing("<circle cx='50' cy='50' r='9'/>", "$fn = 42").shape;
  EXPECT_NEAR(circle.area(), ngon(42, 9), 1e-6);
  EXPECT_NEAR(circle.bounds()[1].y, 59, 1e-7);
  EXPECT_NEAR(circle.bounds()[1].x, 50 + 9 * std::cos(kPi / 42), 1e-7);
  // By user units, however large they are on the page: 2 pi 9 / 2 < 40.
  const std::string large =
      "<svg width='1000mm' height='1000mm' viewBox='0 0 100 100'><circle r='9'/></svg>";
  EXPECT_NEAR(model_of(large).shape.area(), 100 * ngon(40, 9), 1e-4);
}

TEST(SvgOfTrees, ArcsAndCurvesHaveTheirFloors) {
  // A quarter: 90 / 18 + 4 pieces, or what the facets say.
  const std::string quarter = "<path d='M0 0 H9 A9 9 0 0 1 0 9 z'/>";
  const auto sector = [](int n) { return n / 2.0 * 81 * std::sin(kPi / 2 / n); };
  EXPECT_NEAR(area(quarter), sector(9), 1e-6);
  EXPECT_NEAR(area(quarter, "$fn = 100"), sector(25), 1e-6);
  EXPECT_NEAR(area("<rect width='30' height='20' rx='2'/>"), 600 - 16 + 4 * sector(9) * 4 / 81,
              1e-6);
  // n chords of a parabola leave 1 / n^2 of the area between it and its chord.
  const std::string parabola = "<path d='M0 0 Q 10 30 20 0 z'/>";
  const double whole = 2.0 / 3 * 300;
  EXPECT_NEAR(area(parabola), whole * (1 - 1.0 / 400), 1e-6);
  EXPECT_NEAR(area(parabola, "$fn = 3"), whole * (1 - 1.0 / 400), 1e-6);
  EXPECT_NEAR(area(parabola, "$fn = 30.9"), whole * (1 - 1.0 / 900), 1e-6);
  // The same curve as a cubic.
  EXPECT_NEAR(area("<path d='M0 0 C 6.666666666666667 20 13.333333333333333 20 20 0 z'/>"),
              whole * (1 - 1.0 / 400), 1e-6);
}

TEST(SvgOfTrees, WhatIsOpenIsAStroke) {
  EXPECT_NEAR(area("<polyline points='10,10 30,10' stroke-width='3'/>"), 60, 1e-6);
  EXPECT_NEAR(area("<line x1='10' y1='10' x2='30' y2='10' style='stroke-width: 3'/>"), 60, 1e-6);
  EXPECT_NEAR(area("<path d='M10 10h20v20' fill='red' stroke='none' stroke-width='2'/>"), 80, 1e-6);
  // Nothing is inherited; what is thinner than 0.01 or has a unit is 1 wide.
  EXPECT_NEAR(area("<g stroke-width='9'><path d='M10 10h20'/></g>"), 20, 1e-6);
  EXPECT_NEAR(area("<path d='M10 10h20' stroke-width='0'/>"), 20, 1e-6);
  EXPECT_NEAR(area("<path d='M10 10h20' stroke-width='3px'/>"), 20, 1e-6);
  EXPECT_NEAR(area("<path d='M10 10h20' stroke-width='2' stroke-linecap='square'/>"), 44, 1e-6);
  // Almost closed, and the last of a path that was closed before.
  EXPECT_NEAR(area("<path d='M10 10h20v20h-20v-19.95'/>"), 400, 1e-6);
  EXPECT_NEAR(area("<path d='M10 10h20v20h-20z m50 0 h10 v10'/>"), 450, 1e-6);
  // A mitre of 90 degrees is whole; cut square at the distance 1, it loses the triangle beyond.
  const double beyond = std::sqrt(2.0) - 1;
  const std::string corner = "<path d='M10 10h20v20' stroke-width='2' ";
  EXPECT_NEAR(area(corner + "/>"), 80, 1e-6);
  EXPECT_NEAR(area(corner + "stroke-linejoin='bevel'/>"), 80 - beyond * beyond, 1e-6);
  // Sharper than 60 degrees: where a mitre would be longer than 2, it is cut square, too. At half
  // the angle a the mitre ends 1 / sin(a) from the corner, and 1 is left of that.
  const double leg = std::sqrt(36.0 + 400), sine = 6 / leg, cosine = 20 / leg;
  const double tip = 1 / sine - 1;
  EXPECT_NEAR(area("<path d='M14 20 L20 40 L26 20' stroke-width='2'/>"),
              2 * 2 * leg - tip * tip * sine / cosine, 1e-6);
}

TEST(SvgOfTrees, FillingIsEvenOddAndUnitsAreNoNumbers) {
  const std::string twice = "<path d='M0 0h20v20h-20z M5 5h10v10h-10z'/>";
  EXPECT_NEAR(area(twice), 300, 1e-9);  // both run the same way
  EXPECT_NEAR(area("<rect width='8' height='5mm'/><rect x='1cm' width='2' height='2'/>"), 4, 1e-9);
  EXPECT_NEAR(area("<a transform='scale(3)'><rect width='2' height='2'/></a>"), 4, 1e-9);
  EXPECT_NEAR(area("<clipPath id='c'><rect width='2' height='3'/></clipPath>"), 6, 1e-9);
}

TEST(SvgOfTrees, WhatIsHiddenAndWhatIsWanted) {
  const std::string content =
      "<defs><rect id='d' width='5' height='1'/></defs><g id='g' inkscape:groupmode='layer' "
      "inkscape:label='L'><rect id='a' width='2' height='1'/><rect id='b' style='display: none' "
      "x='10' width='3' height='1'/></g><g display='none'><rect id='c' x='20' width='7' "
      "height='1'/><use id='u' href='#d' y='30'/></g><use href='#d' y='50'/>";
  const auto wanted = [&](const std::string& what) { return area(content, what); };
  EXPECT_NEAR(wanted("$fn = 0"), 2 + 5, 1e-9);
  EXPECT_NEAR(wanted("id = \"g\""), 2, 1e-9);
  EXPECT_NEAR(wanted("id = \"b\""), 3, 1e-9);
  EXPECT_NEAR(wanted("id = \"c\""), 7, 1e-9);
  EXPECT_NEAR(wanted("id = \"u\""), 5, 1e-9);
  EXPECT_NEAR(wanted("id = \"d\""), 10, 1e-9);  // wherever it is used
  EXPECT_NEAR(wanted("layer = \"L\""), 2, 1e-9);
  EXPECT_NEAR(wanted("layer = \"L\", id = \"a\""), 2, 1e-9);
  EXPECT_NEAR(wanted("layer = \"\""), 7, 1e-9);  // as OpenSCAD 2021.01 writes it: no wish
  for (const auto& [what, said] :
       {std::pair{"id = \"x\"", "element of id \"x\""},
        {"id = \"\"", "element of id \"\""},
        {"layer = \"x\"", "layer \"x\""},
        {"id = \"c\", layer = \"L\"", "element of id \"c\" in a layer \"L\""}}) {
    const CsgModel none = drawing(content, what);
    EXPECT_TRUE(none.shape.empty()) << what;
    ASSERT_EQ(none.warnings.size(), 1u) << what;
    EXPECT_EQ(none.warnings[0], std::string("m.csg:1: import: a.svg: there is no ") + said);
  }
}

TEST(SvgOfTrees, TheMiddleIsLessTheCornerOfTheViewBox) {
  const std::string text =
      "<svg width='200mm' height='200mm' viewBox='10 30 100 100'><rect x='20' y='40' width='5' "
      "height='6'/></svg>";
  const Shape2D centred = model_of(text, "center = true").shape;
  EXPECT_EQ(centred.bounds()[0], glm::dvec2(-5 - 20, -6 - 60));
  EXPECT_EQ(centred.bounds()[1], glm::dvec2(5 - 20, 6 - 60));
  // Not centred: OpenSCAD takes the top of the viewBox off downwards, where SVG adds it.
  EXPECT_EQ(model_of(text, "center = false").shape.bounds()[0],
            glm::dvec2(20, 200 - 2 * (46 + 30)));
}

TEST(SvgOfTrees, LimitsHoldHereToo) {
  CsgEnvironment environment;
  std::string svg;
  environment.read = [&](const std::string&) -> Result<std::string> { return svg; };
  const auto error = [&]() {
    const auto model = parse_csg("m.csg", "import(file = \"a.svg\");", environment);
    return model ? "no error" : model.error().message;
  };
  svg = "<svg>";
  for (int i = 0; i < 300; ++i) svg += "<g>";
  for (int i = 0; i < 300; ++i) svg += "</g>";
  svg += "</svg>";
  EXPECT_EQ(error(), "import: a.svg: elements are nested deeper than 200");
  svg = "<svg><defs><g id='g0'><rect width='1' height='1'/></g>";
  for (int i = 1; i < 30; ++i) {
    const std::string last = "<use href='#g" + std::to_string(i - 1) + "'/>";
    svg += "<g id='g" + std::to_string(i) + "'>" + last + last + "</g>";
  }
  svg += "</defs><use href='#g29'/></svg>";
  EXPECT_EQ(error(), "import: a.svg: unfolds to more than 200000 elements");
  svg = "<!DOCTYPE svg [<!ENTITY a 'b'>]><svg/>";
  EXPECT_EQ(error(), "import: a.svg: entities are refused: <!ENTITY> in a drawing is of no good");
}

}  // namespace
}  // namespace csgrun::svg_openscad_test
