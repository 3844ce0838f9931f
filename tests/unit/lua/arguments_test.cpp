// Call forms and the errors of arguments.
#include "lua_bindings/api.h"
#include "lua_support.h"

namespace csgrun::testing::arguments_test {
namespace {

TEST(CallForms, AllMeanTheSameCube) {
  for (const char* call :
       {"cube(10, 20, 30)", "cube{10, 20, 30}", "cube({10, 20, 30})", "cube{size = {10, 20, 30}}",
        "cube{{10, 20, 30}}", "cube({10, 20, 30}, {center = false})", "cube(10, 20, 30, false)",
        "cube{{10, 20, 30}, center = false}", "cube{10, 20, 30, center = false}",
        "cube({10, 20, 30}, false)", "cube(10, 20, 30, {})", "csg.cube(10, 20, 30)"}) {
    EXPECT_EQ(box_of(call), "0 0 0 .. 10 20 30") << call;
  }
  EXPECT_EQ(box_of("cube(10)"), "0 0 0 .. 10 10 10");
  EXPECT_EQ(box_of("cube()"), "0 0 0 .. 1 1 1");
  EXPECT_EQ(box_of("cube{}"), "0 0 0 .. 1 1 1");
  EXPECT_EQ(box_of("cube(10, true)"), "-5 -5 -5 .. 5 5 5");
  EXPECT_EQ(box_of("cube{10, 20, 30, center = {true, false, true}}"), "-5 0 -15 .. 5 20 15");
}

TEST(CallForms, Cylinders) {
  EXPECT_EQ(box_of("cylinder(10, 2, {fn = 4})"), "-2 -2 0 .. 2 2 10");
  EXPECT_EQ(box_of("cylinder{h = 10, d = 4, center = true, fn = 4}"), "-2 -2 -5 .. 2 2 5");
  EXPECT_EQ(box_of("cylinder{height = 10, r = 2, fn = 4}"), "-2 -2 0 .. 2 2 10");
  EXPECT_EQ(box_of("cylinder(10, 1, 3, true, {fn = 4})"), "-3 -3 -5 .. 3 3 5");
  EXPECT_EQ(box_of("cylinder{h = 1, r1 = 0.5, fn = 4}"), "-1 -1 0 .. 1 1 1");
  EXPECT_EQ(box_of("cylinder(10, 2, true, {fn = 4})"), "-2 -2 -5 .. 2 2 5");
  EXPECT_EQ(box_of("cylinder{10, 2, true, fn = 4}"), "-2 -2 -5 .. 2 2 5");
  EXPECT_EQ(box_of("cylinder{10, 1, 3, true, fn = 4}"), "-3 -3 -5 .. 3 3 5");
  expect_good(
      "cube(0.3, {r = 0.1 + 0.05}) cylinder{h = 0.3, r = 1, round = 0.1 + 0.05} "
      "square(0.3, {r = 0.1 + 0.05}) assert(math.abs(norm(3e200, 4e200) / 5e200 - 1) < 1e-15 and "
      "norm(0, 0) == 0) "
      "assert(pow(-2, 3) == -8) assert(square(4):anchor('right').x == 4)");
  EXPECT_EQ(message_of("pow(-8, 1 / 3)"),
            "model.lua:1: pow: a power of -8 needs a whole exponent, got 0.33333333333333");
  EXPECT_EQ(message_of("rands(0, 1, 1e12)"),
            "model.lua:1: rands: option 'n' must be within 1000000000 of 0, got 1000000000000");
  expect_good(
      "assert(cylinder(10, 2, nil, true):volume() == cylinder(10, 2, true):volume()) "
      "assert(cylinder(10, 2, nil, true):bbox().min.z == -5) "
      "local t = {10, 2, true, fn = 4} cylinder(t) assert(#t == 3 and t[3] == true)");
  EXPECT_EQ(box_of("cylinder(10, 2, false, {fn = 4})"), "-2 -2 0 .. 2 2 10");
}

TEST(CallForms, ListPartOfATableOfOptionsIsPositional) {
  EXPECT_EQ(box_of("cylinder{10, 2, fn = 4}"), "-2 -2 0 .. 2 2 10");
  EXPECT_EQ(box_of("cylinder{10, 1, 3, true, fn = 4}"), "-3 -3 -5 .. 3 3 5");
  EXPECT_EQ(box_of("sphere{5, fn = 4}"), box_of("sphere(5, {fn = 4})"));
  for (const char* call : {"circle{5, fn = 4}:linear_extrude(16, {scale = 2})",
                           "linear_extrude(circle{5, fn = 4}, {16, scale = 2})",
                           "linear_extrude{circle{5, fn = 4}, 16, scale = 2}",
                           "circle{5, fn = 4}:linear_extrude{16, scale = 2}"}) {
    EXPECT_EQ(box_of(call), "-10 -10 0 .. 10 10 16") << call;
  }
  for (const char* call :
       {"square(2):rotate_extrude{90, fn = 4}", "rotate_extrude{square(2), 90, fn = 4}",
        "rotate_extrude(square(2), {90, fn = 4})"}) {
    EXPECT_EQ(box_of(call), "0 0 0 .. 2 2 2") << call;
  }
  // The list is the vector where a vector comes first, and a list in it is that vector.
  EXPECT_EQ(box_of("cube{10, 20, 30, center = true}"), "-5 -10 -15 .. 5 10 15");
  EXPECT_EQ(box_of("square{10, 20, center = true}:linear_extrude(1)"), "-5 -10 0 .. 5 10 1");
  EXPECT_EQ(box_of("square{10, 20}:linear_extrude(1)"), "0 0 0 .. 10 20 1");
}

TEST(EmptyShapes, ExtrudeToEmptySolids) {
  for (const char* solid : {"nothing:linear_extrude(5)", "nothing:rotate_extrude()",
                            "nothing:translate(5, 0):rotate_extrude(90)"}) {
    const ScriptRun run(std::string("local nothing = circle(1) - circle(1)\nreturn ") + solid);
    ASSERT_EQ(run.outcome.status, ScriptStatus::kGood) << run.outcome.message;
    EXPECT_EQ(run.session.parts().at(0).solid->kind(), NodeKind::kEmpty) << solid;
  }
  EXPECT_EQ(message_of("return (circle(1) - circle(1)):linear_extrude(0)"),
            "model.lua:1: linear_extrude: option 'height' must be positive, got 0");
}

TEST(CallForms, WhatIsMovedMayStandBehind) {
  EXPECT_EQ(box_of("translate({1, 2, 3}, cube(1))"), "1 2 3 .. 2 3 4");
  EXPECT_EQ(box_of("translate(1, 2, 3, cube(1))"), "1 2 3 .. 2 3 4");
  EXPECT_EQ(box_of("rotate({0, 0, 90}, cube(1, 2, 3))"), "-2 0 0 .. 0 1 3");
  EXPECT_EQ(box_of("scale(2, cube(1))"), "0 0 0 .. 2 2 2");
  EXPECT_EQ(message_of("return translate({1, 2, 3}, cube(1), cube(2))"),
            "model.lua:1: translate: too many arguments: after 'v' only {name = value} may follow, "
            "got solid");
}

TEST(CallForms, Transforms) {
  for (const char* call :
       {"cube(1):translate(1, 2, 3)", "cube(1):translate{1, 2, 3}", "translate(cube(1), 1, 2, 3)",
        "translate(cube(1), {1, 2, 3})", "translate(1, 2, 3) * cube(1)",
        "{{1, 0, 0, 1}, {0, 1, 0, 2}, {0, 0, 1, 3}} * cube(1)", "cube(1):move{x = 1, y = 2, z = 3}",
        "cube(1):up(3):right(1):back(2)",
        "multmatrix{{1, 0, 0, 1}, {0, 1, 0, 2}, {0, 0, 1, 3}} * cube(1)",
        "translate(1, 0, 0) * translate(0, 2, 3) * cube(1)", "cube(1):translate(1, 2):up(3)"}) {
    EXPECT_EQ(box_of(call), "1 2 3 .. 2 3 4") << call;
  }
  EXPECT_EQ(box_of("cube(1):left(1):forward(2):down(3)"), "-1 -2 -3 .. 0 -1 -2");
  EXPECT_EQ(box_of("cube(1):rotate(90)"), "-1 0 0 .. 0 1 1");
  EXPECT_EQ(box_of("cube(1, 2, 3):rotate(90, 0, 90)"), "0 0 0 .. 3 1 2");  // X first, then Z
  EXPECT_EQ(box_of("cube(1, 2, 3):rotate{90, 0, 90}"), "0 0 0 .. 3 1 2");
  EXPECT_EQ(box_of("cube(1, 2, 3):rotate{x = 90, z = 90}"), "0 0 0 .. 3 1 2");
  EXPECT_EQ(box_of("cube(1, 2, 3):rotate(90, {1, 0, 0})"), "0 -3 0 .. 1 0 2");
  EXPECT_EQ(box_of("cube(1, 2, 3):rotate(90, {0, 0, -2})"), "0 -1 0 .. 2 0 3");
  EXPECT_EQ(box_of("cube(1):mirror(1, 0, 0)"), "-1 0 0 .. 0 1 1");
  EXPECT_EQ(box_of("cube(1):scale(2)"), "0 0 0 .. 2 2 2");
  EXPECT_EQ(box_of("cube(1):scale{z = 2}"), "0 0 0 .. 1 1 2");
  EXPECT_EQ(box_of("square(2, 3):translate(1, 1):linear_extrude(4)"), "1 1 0 .. 3 4 4");
}

TEST(CallForms, ThePartMayStandAnywhere) {
  // OpenSCAD's order, for whatever takes one part: box as of the other order.
  for (const auto& [text, same] : {
           std::pair{"linear_extrude(3, square(2))", "square(2):linear_extrude(3)"},
           {"linear_extrude({height = 3, center = true}, square(2))",
            "square(2):linear_extrude{height = 3, center = true}"},
           {"linear_extrude(3, square(2), {center = true})",
            "square(2):linear_extrude(3, {center = true})"},
           {"rotate_extrude({angle = 90}, square(2))", "square(2):rotate_extrude{angle = 90}"},
           {"resize({10, 0, 0}, cube(1), {auto = true})",
            "cube(1):resize({10, 0, 0}, {auto = true})"},
           {"color('red', cube(1))", "cube(1)"},
           {"color({1, 0, 0}, cube(1))", "cube(1)"},
           {"color(1, 0, 0, cube(1))", "cube(1)"},
           {"color('red', 0.5, cube(1))", "cube(1)"},
           {"material('steel', cube(1))", "cube(1)"},
           {"multmatrix(translate(1, 2, 3), cube(1))", "cube(1):translate(1, 2, 3)"},
           {"multmatrix({{1, 0, 0, 5}}, cube(1))", "cube(1):translate(5, 0, 0)"},
           {"linear_extrude(1, offset(2, square(1)))", "square(1):offset(2):linear_extrude(1)"},
           {"sweep({{0, 0, 0}, {0, 0, 9}}, circle(2))", "circle(2):sweep{{0, 0, 0}, {0, 0, 9}}"},
           {"linear_array(3, {2, 0, 0}, cube(1))", "cube(1):linear_array(3, {2, 0, 0})"},
           {"polar_array(3, cube(1))", "cube(1):polar_array(3)"},
           {"trim({0, 0, 1}, 0.5, cube(1))", "cube(1):trim({0, 0, 1}, 0.5)"},
           {"chamfer(0.25, cube(1))", "cube(1):chamfer(0.25)"},
           {"warp(function(x, y, z) return 2 * x, y, z end, cube(1))", "cube(2, 1, 1)"},
       }) {
    EXPECT_EQ(box_of(text), box_of(same)) << text;
  }
  expect_good("assert(color('red', cube(1)) == cube(1):color('red'))");
  // Two parts, or one of the wrong kind, are not put in order.
  EXPECT_EQ(message_of("return color('red', cube(1), cube(2))"),
            "model.lua:1: color: the first argument must be a solid or a shape, got the string "
            "\"red\"; as a method it is called with a colon, part:color(...)");
  EXPECT_EQ(message_of("return linear_extrude(3, cube(2))"),
            "model.lua:1: linear_extrude: the first argument must be a 2D shape, got solid; as a "
            "method it is called with a colon, shape:linear_extrude(...)");
}

TEST(Matrices, MovePointsAndCompareByValue) {
  expect_good(
      "local p = translate(1, 2, 3) * {1, 1, 1} assert(p[1] == 2 and p[2] == 3 and p[3] == 4)");
  expect_good("assert(rotate(90) * rotate(-90) == translate(0, 0, 0))");
  expect_good("assert(rotate(90) ~= rotate(80))");
  expect_good("assert(translate(rotate(90), 1, 0, 0) == translate(1, 0, 0) * rotate(90))");
}

struct BadCall {
  const char* text;
  const char* message;
};

TEST(ArgumentErrors, SayFunctionOptionExpectedAndGot) {
  constexpr BadCall kCalls[] = {
      {"cube{10}",
       "cube: option 'size' must be a number or a list of three numbers, got a list of one value; "
       "write "
       "cube(10) without the list"},
      {"csg:cube(10)", "cube: is called with a dot: csg.cube(...), not csg:cube(...)"},
      {"cube{10, centre = true}", "cube: unknown option 'centre' (did you mean 'center'?)"},
      {"cube{10, r = 1, center = true}",
       "cube: option 'size' must be a number or a list of three numbers, got a list of one value; "
       "write cube(10, {center = true, r = 1})"},
      {"cylinder{20, 5}",
       "cylinder: option 'h' must be a number, got a list of 2 values; write cylinder(20, 5) "
       "without "
       "the list"},
      {"cylinder{20, 5, 5, true, 7, fn = 8}",
       "cylinder: too many arguments: after 'center' only {name = value} may follow, got 7"},
      {"cylinder{20, h = 5}", "cylinder: option 'h' (or 'height') is given twice"},
      {"polyhedron{points = {{0,0,0}}, faces = {{0, 1, 2}}}",
       "polyhedron: face 0: index 1 is out of range, there are 1 points; indices count "
       "from 0"},
      {"circle(5):rotate_extrude()",
       "rotate_extrude: the shape must lie on one side of the Y axis, its x runs from -5 to 5"},
      {"polygon{{0, 0}, {1, 0}}", "polygon: needs at least 3 points, got 2"},
      {"cube{size = 'x'}",
       "cube: option 'size' must be a number or a list of three numbers, got the string \"x\""},
      {"cube('10')",
       "cube: option 'size' must be a number or a list of three numbers, got the string \"10\""},
      {"cube('a\\nb\\1')",
       "cube: option 'size' must be a number or a list of three numbers, got the string "
       "\"a\\nb\\1\""},
      {"cube(('ä'):rep(30))",
       "cube: option 'size' must be a number or a list of three numbers, got the string "
       "\"ääääääääääääääääääää...\""},
      {"cube('a' .. ('ä'):rep(30))",
       "cube: option 'size' must be a number or a list of three numbers, got the string "
       "\"aäääääääääääääääääää...\""},
      {"cube(10, 20)",
       "cube: option 'size' must be a number or a list of three numbers, got 2 numbers"},
      {"cube(0)", "cube: option 'size' must be positive, got 0"},
      {"cube{1, -2, 3}", "cube: option 'size' must be positive, got -2"},
      {"cube(0/0)", "cube: option 'size' must be finite, got nan"},
      {"cube(-1/0)", "cube: option 'size' must be finite, got -inf"},
      {"cube{1, 2, 'a'}",
       "cube: option 'size' must be a number or a list of three numbers, but entry 3 is the string "
       "\"a\""},
      {"cube{centre = true}", "cube: unknown option 'centre' (did you mean 'center'?)"},
      {"sphere{['$fn'] = 5}", "sphere: unknown option '$fn' (did you mean 'fn'?)"},
      {"sphere{q = 5}", "sphere: unknown option 'q' (there are r, d, fn, segments, fa, fs)"},
      {"sphere{segment = 8}", "sphere: unknown option 'segment' (did you mean 'segments'?)"},
      {"cube{10, 20, 30, size = 5}", "cube: option 'size' is given twice"},
      {"cylinder{h = 1, height = 2}", "cylinder: option 'h' (or 'height') is given twice"},
      {"cylinder{h = 1, r = 5, r1 = 3, d2 = 2}",
       "cylinder: give either one radius or those of both ends"},
      {"surface{{1, 2}, {3}}",
       "surface: row 2 of option 'heights' must be a list of 2 numbers, as the first, got a list "
       "of one value"},
      {"cube(1, 2, 3, 4)",
       "cube: option 'size' must be a number or a list of three numbers, got 4 numbers"},
      {"cube(1, true, 5)",
       "cube: too many arguments: after 'center' only {name = value} may follow, got 5"},
      {"cube(10, ({}).w, 5)",
       "cube: option 'size' must be a number or a list of three numbers, but number 2 is nil"},
      {"cube(nil, 2, 3)",
       "cube: option 'size' must be a number or a list of three numbers, but number 1 is nil"},
      {"cube{10, nil, 5}",
       "cube: option 'size' must be a number or a list of three numbers, got a list whose entry 2 "
       "is nil"},
      {"cube{10, nil, 5, center = true}",
       "cube: option 'size' must be a number or a list of three numbers, got a list whose entry 2 "
       "is nil"},
      {"cube(1):translate(1, nil, 3)",
       "translate: option 'v' must be a list of two or three numbers, but number 2 is nil"},
      {"cube(1):translate(1, 'a', 3)",
       "translate: option 'v' must be a list of two or three numbers, but number 2 is the string "
       "\"a\""},
      {"cube(1):translate(1, 2, nil)",
       "translate: option 'v' must be a list of two or three numbers, but number 3 is nil"},
      {"cube(1):translate(1, 2, cube(3))",
       "translate: option 'v' must be a list of two or three numbers, but number 3 is solid"},
      {"cube(1):translate{1, nil, 3}",
       "translate: option 'v' must be a list of two or three numbers, got a list whose entry 2 is "
       "nil"},
      {"polygon{({})[0], {0, 0}, {1, 0}}",
       "polygon: option 'points' must be a list of points {x, y}, got a list whose entry 1 is nil"},
      {"cube(nil)", "cube: option 'size' must be a number or a list of three numbers, got nil"},
      {"sphere{10}",
       "sphere: option 'r' must be a number, got a list of one value; write sphere(10) without the "
       "list"},
      {"sphere{r = 1, d = 2}", "sphere: give either 'r' or 'd', not both"},
      {"cylinder(1, 0, 0)", "cylinder: one of the radii must be positive"},
      {"sphere(1, {fn = 1e9})", "sphere: fn must be from 0 to 100000, got 1e+09"},
      {"cube(1):translate()", "translate: needs how far to move: (x, y, z) or {z = 10}"},
      {"cube(1):scale(0)", "scale: a factor must not be 0"},
      {"cube(1):rotate({1, 2}, {0, 0, 1})",
       "rotate: an axis 'v' goes with one angle, not with a list"},
      {"cube(1).translate(1, 2, 3)", "translate: is called with a colon: part:translate(...)"},
      {"cube(1):linear_extrude(1)",
       "a solid has no method 'linear_extrude', which is one of 2D shapes"},
      {"square(1):volume()", "a shape has no method 'volume', which is one of solids"},
      {"circle(1):loft(circle(2), 5)",
       "a shape has no method 'loft', which is a function: loft(...)"},
      {"cube(1):sphere(2)", "a solid has no method 'sphere', which is a function: sphere(...)"},
      {"loft(circle(3), circle(2), 10)",
       "loft: its outlines are one list, and their heights follow: loft({a, b}, 10)"},
      {"cube(1):color{r = 1, g = 0, b = 0.5}",
       "color: red, green and blue are a list: color{1, 0, 0.5}"},
      {"cube(1):color{r = 1}",
       "color: unknown option 'r' (there are c, alpha, metallic, roughness, name)"},
      {"cube(1):tranlate(1)", "a solid has no method 'tranlate' (did you mean 'translate'?)"},
      {"cube(1) + 5", "'+' needs two solids, or two shapes, got solid and number"},
      {"5 * cube(1)", "'*' needs two solids, or two shapes, got number and solid"},
      {"cube(1) - nil", "'-' needs two solids, or two shapes, got solid and nil"},
      {"union{cube(1), nil, cube(2)}",
       "union: an operand must be a solid or a shape, got a list whose entry 2 is nil"},
      {"union{cube(1), name = cube(2)}",
       "union: takes lists of solids or shapes without holes and names in them, got the key "
       "'name'"},
      {"union{[0] = cube(1), cube(2)}",
       "union: takes lists of solids or shapes without holes and names in them, got the key 0: "
       "they begin at 1"},
      {"cube(1) - {cube(2)}",
       "'-' needs two solids, or two shapes, got solid and table; a list of them is one by "
       "union(list)"},
      {"union(cube(1), 'x')", "union: an operand must be a solid or a shape, got the string \"x\""},
      {"cube(1):color('rod')", "color: there is no colour 'rod' (did you mean 'red'?)"},
      {"cube(1):color{1, 2, 0}", "color: 'c' must be from 0 to 1, got 2"},
      {"linear_extrude(5, 5)",
       "linear_extrude: the first argument must be a 2D shape, got 5; as a method it is called "
       "with a colon, shape:linear_extrude(...)"},
      {"asin(2)", "asin: the ratio must be from -1 to 1, got 2"},
      {"csg.fn == nil and 1 or csg.fm", "csg has no 'fm' (did you mean 'fa'?)"},
      {"polyhedron{points = {{0, 0}}, faces = {}}",
       "polyhedron: point 0 must be a list of three numbers, got a list of 2 values"},
      {"polyhedron{points = {{0, 0, 0}, {0, 0/0, 0}}, faces = {}}",
       "polyhedron: point 1: its y must be finite, got nan"},
      {"polyhedron{points = {{0, 0, 0}, {0, 1, 'a'}}, faces = {}}",
       "polyhedron: point 1 must be a list of three numbers, but its z is the string \"a\""},
      {"polyhedron{points = {{0, 0, 0}, {0, 1, 0}, 7}, faces = {}}",
       "polyhedron: point 2 must be a list of three numbers, got 7"},
      {"polyhedron{points = {{0, 0, 0}}, faces = {{0}, 5}}",
       "polyhedron: face 1 must be a list of indices, got 5"},
      {"polygon{points = {{0, 0}, {1, 0}, {0, 1}}, paths = {{0, 1, 2.5}}}",
       "polygon: path 0: index 2.5 must be a whole number from 0 on"},
      {"polyhedron{points = {{0, 0, 0}}, faces = {{-1}}}",
       "polyhedron: face 0: index -1 must be a whole number from 0 on"},
  };
  for (const BadCall& call : kCalls) {
    EXPECT_EQ(message_of(std::string("\nreturn ") + call.text),
              std::string("model.lua:2: ") + call.message)
        << call.text;
  }
}

// What is proposed for solids and shapes of other programs can be written so.
TEST(Hints, ProposedCallsMakeParts) {
  for (const std::string name :
       {"box", "cuboid", "cone", "frustum", "prism", "cyl", "tube", "roundedCuboid", "ngon",
        "rectangle", "cylinderElliptic", "roundedCylinder", "geodesicSphere", "tetrahedron",
        "ellipse", "triangle"}) {
    const std::string message = message_of("return " + name + "(1)"), before = "(in Lua it is ";
    const size_t at = message.find(before);
    ASSERT_NE(at, std::string::npos) << message;
    std::string call = message.substr(at + before.size());
    call.pop_back();
    const ScriptRun run("return " + call);
    ASSERT_EQ(run.outcome.status, ScriptStatus::kGood) << call << ": " << run.outcome.message;
    EXPECT_EQ(run.session.parts().size(), 1u) << call;
  }
}

TEST(Hints, NamesOfLocalVariables) {
  EXPECT_EQ(message_of("local width = 3\nreturn cube(widht)"),
            "model.lua:2: undefined variable 'widht' (did you mean 'width'?)");
  EXPECT_EQ(message_of("local bolt_radius = 3\nlocal function part() return cube(bolt_radios) end\n"
                       "local used = bolt_radius\nreturn part()"),
            "model.lua:2: undefined variable 'bolt_radios'");
  EXPECT_EQ(message_of("local length = 3\nlocal function part(n)\n  return cube(length * n), "
                       "sphere(lenght)\nend\nreturn part(2)"),
            "model.lua:3: undefined variable 'lenght' (did you mean 'length'?)");
}

TEST(Hints, NamesOfOtherPrograms) {
  EXPECT_EQ(message_of("return cube(1):bevel(1)"),
            "model.lua:1: a solid has no method 'bevel' (did you mean 'chamfer'?)");
  EXPECT_EQ(message_of("return cube(1):round(1)"),
            "model.lua:1: a solid has no method 'round' (did you mean 'fillet'?)");
  for (const std::string name : {"roundedCuboid", "roundedCube", "rounded_cube"}) {
    EXPECT_EQ(
        message_of("return " + name + "{1, 2, 3}"),
        "model.lua:1: undefined variable '" + name + "' (in Lua it is cube{{20, 10, 5}, r = 2})");
  }
  for (const std::string name : {"roundedRectangle", "rounded_rect", "rounded_square"}) {
    EXPECT_EQ(
        message_of("return " + name + "({20, 10}, 2)"),
        "model.lua:1: undefined variable '" + name + "' (in Lua it is rect{{20, 10}, r = 2})");
  }
  for (const std::string name : {"cuboid", "box"}) {
    EXPECT_EQ(message_of("return " + name + "{1, 2, 3}"),
              "model.lua:1: undefined variable '" + name + "' (in Lua it is cube{20, 10, 5})");
  }
  EXPECT_EQ(message_of("return tube{h = 3, od = 4, id = 2}"),
            "model.lua:1: undefined variable 'tube' (in Lua it is cylinder{h = 10, r = 5} - "
            "cylinder{h = 10, r = 4})");
  EXPECT_EQ(message_of("return search(1, {1})"),
            "model.lua:1: undefined variable 'search' (in Lua it is a loop: for i, x in "
            "ipairs(list) do ... end)");
  for (const std::string name : {"let", "assign"}) {
    EXPECT_EQ(message_of("return " + name + "(1)"),
              "model.lua:1: undefined variable '" + name +
                  "' (in Lua it is local a = 1, before what uses it)");
    const std::string line = message_of(name + "(a = 1) cube(a)");
    EXPECT_TRUE(line.ends_with("; a name for a value is: local a = 1")) << line;
  }
  EXPECT_EQ(message_of("return each({1})"),
            "model.lua:1: undefined variable 'each' (in Lua it is table.unpack(list), at the end "
            "of a list)");
}

TEST(Hints, MethodsAndWordsOfOtherPrograms) {
  const std::string written = "what the script returns is written: csgrun model.lua -o part.stl";
  constexpr BadCall kCalls[] = {
      {"cube(1):shell(1)", "a solid has no method 'shell' (a shell is part - part:offset(-2))"},
      {"cube(1):hole(1)",
       "a solid has no method 'hole' (a hole is part - cylinder{h = 10, d = 5})"},
      {"shell(cube(1), 1)",
       "undefined variable 'shell' (in Lua a shell is part - part:offset(-2))"},
      {"square(1):round(1)", "a shape has no method 'round' (did you mean 'offset'?)"},
      {"cube(1):translateX(1)", "a solid has no method 'translateX' (did you mean 'tx'?)"},
      {"circle(1):extrude_linear(1)",
       "a shape has no method 'extrude_linear' (did you mean 'linear_extrude'?)"},
      {"measureVolume(cube(1))", "undefined variable 'measureVolume' (in Lua it is part:volume())"},
      {"param('r', {initial = 5})", "param: unknown option 'initial' (did you mean 'default'?)"},
      {"cube(1):bbox().x",
       "a bounding box has no 'x': it has min, max, size and center, with x, y and z each"},
      {"cube(1):bbox().Max",
       "a bounding box has no 'Max' (did you mean 'max'?): it has min, max, size and center, with "
       "x, y and z each"},
      {"square(1):bbox()[2][1]", "a bounding box has min, max, size and center, and no [2]"},
  };
  for (const BadCall& call : kCalls)
    EXPECT_EQ(message_of(std::string("return ") + call.text),
              "model.lua:1: " + std::string(call.message));
  EXPECT_EQ(message_of("cube(1):export('a.stl')"),
            "model.lua:1: a solid has no method 'export' (" + written + ")");
  EXPECT_EQ(message_of("show_object(cube(1))"),
            "model.lua:1: undefined variable 'show_object' (in Lua " + written + ")");
  EXPECT_EQ(message_of("local lines = 3\nreturn cube(line)"),
            "model.lua:2: undefined variable 'line' (did you mean 'lines'? otherwise, in Lua a "
            "curve is a list of its points, which a loop fills, for polygon or sweep)");
  EXPECT_EQ(message_of("function main() return cube(1) end"),
            "model.lua:1: the script makes no part: 'main' is a function like any other, return "
            "main()");
}

TEST(Arguments, NilAndNumbersAreNamed) {
  constexpr BadCall kCalls[] = {
      {"cube(1):gap(nil)", "gap: option 'other' must not be nil: the other solid"},
      {"loft(nil)",
       "loft: option 'outlines' must not be nil: a list of shapes, from the lowest on"},
      {"translate(nil)", "translate: option 'v' must be a list of two or three numbers, got nil"},
      {"cube(1, 2, '3')",
       "cube: option 'size' must be a number or a list of three numbers, but number 3 is the "
       "string \"3\""},
      {"cube(1):linear_array(4, 10)",
       "linear_array: option 'v' must be a list of two or three numbers, got the number 10"},
      {"param('x', 5, {min = 10, max = 1})",
       "param: option 'min' of 'x' must be at most 'max', got 10 and 1"},
      {"param('x', 0/0)", "param: the default of 'x' must be finite, got nan"},
      {"min(0/0, 1)", "min: takes numbers, but number 1 is not a number (nan)"},
      {"max(1, 0/0)", "max: takes numbers, but number 2 is not a number (nan)"},
  };
  for (const BadCall& call : kCalls)
    EXPECT_EQ(message_of(std::string("return ") + call.text),
              "model.lua:1: " + std::string(call.message));
  expect_good(
      "assert(cube(2):linear_array(4, 10, 0, 0) == cube(2):linear_array(4, {10, 0, 0})) "
      "assert(cube(2):linear_array(4, 10, 5) == cube(2):linear_array(4, {10, 5, 0})) "
      "assert(cube(2):project(1, 1, 1):area() == cube(2):project({1, 1, 1}):area())");
}

TEST(Hints, OpenScadInALineThatIsNoLua) {
  constexpr BadCall kLines[] = {
      {"for (i=[0:3]) cube(i)", "a loop is: for i = 0, 3 do ... end"},
      {"local a = b ? 1 : 2", "a choice between two values is: condition and a or b"},
      {"local a = 1\na += 1", "it is written out: a = a + 1"},
      {"local a = 5 // width of it", "a comment begins with --"},
      {"local a = b && c", "both conditions are: a and b; what solids have in common is a * b"},
      {"return cylinder{r: 3, h: 5}", "options are: cylinder{r = 3, h = 5}"},
      {"return cube(1)\nprint(3)", "return ends a script: nothing may follow it"},
      {"local a = b || c", "one condition or the other is: a or b; solids together are a + b"},
      {"while (true) { cube(1) }\n\n", "a loop is: while a do ... end"},
      {"const x = 5", "a name for a value is: local a = 1"},
      {"var x = 5", "a name for a value is: local a = 1"},
      {"function f(x) = x*2;", "a function is: function f(x) return x * 2 end"},
      {"if (a) { }", "a condition is: if a then ... else ... end"},
      {"%cube(1)", "OpenSCAD's modifiers are not part of Lua"},
      {"!cube(1)", "OpenSCAD's modifiers are not part of Lua"},
      {"local a = 1\nif a = 1 then end", "\"equal\" is =="},
      {"local a = cube(1)\na - cube(2)",
       "a value that is made needs a name, or return: part = part - hole"},
      {"def f(x): return x", "a function is: function f(x) return x * 2 end"},
      {"import math", "other files of Lua are read by require \"name\""},
      {"for i in {1,2,3} do end",
       "the entries of a list are gone through by: for _, x in ipairs(list) do"},
      {"local cube = cube(5) return cube(1)",
       "the variable 'cube' hides the function of this name, which is csg.cube still"},
      {"local m = true return m.x", "a module that ends without return gives true"},
  };
  for (const BadCall& line : kLines)
    EXPECT_NE(message_of(line.text).find(line.message), std::string::npos) << line.text << "\n"
                                                                           << message_of(line.text);
  // Nothing of this in mistakes of another kind.
  EXPECT_EQ(message_of("local t = {} return t()").find(';'), std::string::npos);
}

TEST(Errors, BeginWithTheirPlaceOnce) {
  EXPECT_EQ(message_of("\nerror('x', 0)"), "model.lua:2: x");
  EXPECT_EQ(message_of("\nerror('x')"), "model.lua:2: x");
  EXPECT_EQ(message_of("\nassert(false, 42)"), "model.lua:2: 42");
  EXPECT_EQ(message_of("\nassert(false, 'ratio 3:4: bad')"), "model.lua:2: ratio 3:4: bad");
  EXPECT_EQ(message_of("local f = coroutine.wrap(function()\nerror('x') end)\nf()"),
            "model.lua:2: x");
}

TEST(Parameters, OfOneNameAreOne) {
  expect_good("assert(param('a', 3, {min = 1}) == param('a', 3, {min = 1, doc = 'the same'}))");
  EXPECT_EQ(message_of("param('a', 3) param('a', 'x')"),
            "model.lua:1: param: 'a' is asked for twice, with two types");
  EXPECT_EQ(message_of("param('a', 3) param('a', 4)"),
            "model.lua:1: param: 'a' is asked for twice, with two defaults");
  EXPECT_EQ(message_of("param('a', 3, {min = 1}) param('a', 3)"),
            "model.lua:1: param: 'a' is asked for twice, with two ranges");
  EXPECT_EQ(message_of("param('a', 3, {choices = {3, 4}}) param('a', 3)"),
            "model.lua:1: param: 'a' is asked for twice, with two lists of choices");
}

TEST(Warnings, OfShapesThatWouldLeaveTheirPlane) {
  for (const char* move : {"translate(0, 0, 5)", "up(1)", "rotate(90, 0, 0)"}) {
    const ScriptRun run(std::string("return square(1):") + move);
    ASSERT_EQ(run.session.warnings().size(), 1u) << move;
    EXPECT_NE(run.session.warnings()[0].find("a 2D shape stays in its plane"), std::string::npos);
  }
  const ScriptRun flat("return square(1):translate(1, 2, 0):rotate(30):scale(2):mirror(1, 0, 0)");
  EXPECT_TRUE(flat.session.warnings().empty());
}

TEST(ArgumentErrors, MixingDimensionsNamesTheExtrusions) {
  const std::string message = message_of("return cube(1) + square(1)");
  EXPECT_NE(message.find("linear_extrude"), std::string::npos) << message;
}

TEST(Help, ListsEveryFunctionAndOption) {
  const std::string help = api_help();
  for (const Binding& binding : all_bindings()) {
    EXPECT_NE(help.find(std::string("\n") + binding.spec->name + "("), std::string::npos)
        << binding.spec->name;
    for (const Option& option : binding.spec->options) {
      EXPECT_NE(help.find(std::string("    ") + option.name), std::string::npos) << option.name;
    }
    const std::string doc = binding.spec->doc;
    EXPECT_NE(doc, "") << binding.spec->name;
    EXPECT_EQ(doc.find('\n'), std::string::npos) << binding.spec->name;
  }
  for (const char* text :
       {"emit(part, name)", "render(part, name)", "linear_extrude(shape, height)",
        "Example: render(lid", "solids or shapes, one after another"}) {
    EXPECT_NE(help.find(text), std::string::npos) << text;
  }
}

TEST(Warnings, NameTheFunctionOnce) {
  const ScriptRun run(
      "return polyhedron{points = {{0,0,0},{1,0,0},{0,1,0},{0,0,1}},"
      "faces = {{2,1,0},{1,3,0},{3,2,0},{2,3,1}}}");
  ASSERT_EQ(run.session.warnings().size(), 1u);
  EXPECT_EQ(run.session.warnings()[0],
            "model.lua:1: polyhedron: inside out, its faces were turned over");
}

}  // namespace
}  // namespace csgrun::testing::arguments_test
