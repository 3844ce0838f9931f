// What scripts written for LuaCAD rely on: its shapes, vectors, modifiers, names and materials.
#include <cmath>

#include "lua_support.h"

namespace csgrun::testing::luacad_test {
namespace {

/// The volume of the only part.
double volume_of(const std::string& expression) {
  ScriptRun run("return " + expression);
  EXPECT_EQ(run.outcome.status, ScriptStatus::kGood) << expression << run.outcome.message;
  if (run.session.parts().size() != 1) return -1;
  SolidValue value(run.session.parts()[0].solid);
  return run.session.evaluated(value, Measuring::kAll).measures.volume;
}

std::string names_of(const std::string& script) {
  const ScriptRun run(script);
  if (run.outcome.status != ScriptStatus::kGood)
    return run.outcome.message.substr(0, run.outcome.message.find('\n'));
  std::string names;
  for (const ScriptPart& part : run.session.parts())
    names += (names.empty() ? "" : " ") + part.name;
  return names;
}

/// The appearances of the faces of the only part, as "RRGGBB metallic roughness name, ...".
std::string looks_of(const std::string& expression) {
  ScriptRun run("return " + expression);
  if (run.outcome.status != ScriptStatus::kGood) return run.outcome.message;
  SolidValue value(run.session.parts().at(0).solid);
  std::string text;
  for (const Appearance& a : run.session.evaluated(value).appearances) {
    char line[100];
    std::snprintf(
        line, sizeof line, "%02x%02x%02x %g %g", static_cast<int>(std::lround(a.red * 255)),
        static_cast<int>(std::lround(a.green * 255)), static_cast<int>(std::lround(a.blue * 255)),
        static_cast<double>(a.metallic), static_cast<double>(a.roughness));
    text += (text.empty() ? "" : ", ") + std::string(a.is_default ? "none" : line) +
            (a.name.empty() ? "" : " " + a.name);
  }
  return text;
}

TEST(Shapes, HaveTheVolumesOfTheirFormulas) {
  EXPECT_NEAR(volume_of("octahedron(3)"), 4.0 / 3 * 27, 1e-9);
  EXPECT_NEAR(volume_of("octahedron{r = 3}"), 36, 1e-9);
  EXPECT_NEAR(volume_of("octahedron{radius = 3}"), 36, 1e-9);
  // An icosahedron of edge a has the volume 5 (3 + sqrt 5) a^3 / 12, and a = r / sin 72.
  const double edge = 6 / std::sin(2 * std::acos(-1.0) / 5) / 2;
  EXPECT_NEAR(volume_of("icosahedron(3)"), 5 * (3 + std::sqrt(5.0)) / 12 * edge * edge * edge,
              1e-4);
  EXPECT_NEAR(volume_of("pyramid(1, 2, 3, 10, 6)"), 200, 1e-9);
  // A regular n-gon turned in m steps about an axis at R: its moment times the m-gon's area rule.
  const double pi = std::acos(-1.0);
  const auto gon = [&](double n, double r) { return n / 2 * r * r * std::sin(2 * pi / n); };
  const auto ring = [&](double steps, double n) {
    return gon(n, 5) * 20 * steps * std::sin(2 * pi / steps);
  };
  EXPECT_NEAR(volume_of("torus{R = 20, r = 5, fn = 32}"), ring(32, 32), 0.01);
  EXPECT_NEAR(volume_of("torus(20, 5, {fn = 100, segments_minor = 20})"), ring(100, 20), 0.01);
  EXPECT_NEAR(volume_of("torus{major = 20, minor = 5, segments = 32}"),
              volume_of("torus{R = 20, r = 5, fn = 32}"), 0);
  EXPECT_NEAR(volume_of("ellipsoid(3, 2, 1, {fn = 32})"), 6 * volume_of("sphere(1, {fn = 32})"),
              1e-4);
  EXPECT_NEAR(volume_of("ellipsoid{rx = 3, ry = 2, rz = 1, segments = 32}"),
              volume_of("ellipsoid{{3, 2, 1}, fn = 32}"), 0);
  EXPECT_NEAR(volume_of("rect{4, 3, center = true}:linear_extrude(2)"), 24, 0);
  EXPECT_EQ(box_of("pyramid(1, 2, 3, 10, 6)"), "1 2 3 .. 11 12 9");
  EXPECT_EQ(box_of("torus{R = 20, r = 5, fn = 4}"), "-25 -25 -5 .. 25 25 5");
}

TEST(Shapes, Mistakes) {
  const std::pair<const char*, const char*> cases[] = {
      {"torus{R = 2, r = 3}",
       "torus: 'r', the radius of the tube, must not be larger than 'R', that of the ring"},
      {"torus{R = 2, q = 3}",
       "torus: unknown option 'q' (there are R, major, r, minor, segments_minor, fn, segments, fa, "
       "fs)"},
      {"torus{R = 'x'}", "torus: option 'R' must be a number, got the string \"x\""},
      {"torus(0, 1)", "torus: option 'R' must be positive, got 0"},
      {"octahedron(0)", "octahedron: option 'r' must be positive, got 0"},
      {"octahedron{radious = 1}", "octahedron: unknown option 'radious' (did you mean 'radius'?)"},
      {"icosahedron(0/0)", "icosahedron: option 'r' must be finite, got nan"},
      {"icosahedron{r = {}}", "icosahedron: option 'r' must be a number, got a list of 0 values"},
      {"pyramid(0, 0, 0, -1, 2)", "pyramid: option 'length' must be positive, got -1"},
      {"pyramid{hieght = 2}", "pyramid: unknown option 'hieght' (did you mean 'height'?)"},
      {"ellipsoid(1, 0, 1)", "ellipsoid: option 'r' must be positive, got 0"},
      {"ellipsoid{1, 2, 3, rx = 1}", "ellipsoid: give either 'r' or rx, ry and rz, not both"},
      {"ellipsoid{xr = 1}", "ellipsoid: unknown option 'xr' (did you mean 'r'?)"},
      {"rect(0, 1)", "rect: option 'size' must be positive, got 0"},
  };
  for (const auto& [script, message] : cases)
    EXPECT_EQ(message_of(script), std::string("model.lua:1: ") + message);
}

TEST(Vectors, AreListsWithOperators) {
  expect_good(
      "local v = vec(1, 2, 3) assert(v.x == 1 and v[2] == 2 and v:getz() == 3 and #v == 3)");
  expect_good("assert(vec(1, 2) == vec(1, 2, 0) and vec{1, 2, 3} == vector(1, 2, 3))");
  expect_good(
      "assert(vec(1, 2, 3) + {1, 1, 1} == vec(2, 3, 4) and {1, 1} - vec(1, 0) == vec(0, 1))");
  expect_good("assert(vec(1, 2, 3) * 2 == vec(2, 4, 6) and 2 * vec(1, 2, 3) == vec(2, 4, 6))");
  expect_good("assert(vec(1, 2, 3) * vec(4, 5, 6) == 32 and vec(1, 2, 3):scalar{4, 5, 6} == 32)");
  expect_good("assert(-vec(1, -2, 0) == vec(-1, 2, 0) and vec(2, 4, 6) / 2 == vec(1, 2, 3))");
  expect_good("assert(norm(vec(3, 4, 0)) == 5 and norm{3, 4} == 5 and vec(3, 4):len() == 5)");
  expect_good("assert(cross(vec(1, 0, 0), {0, 1, 0}) == vec(0, 0, 1))");
  expect_good("assert(vec(0, 3, 4):unit() == vec(0, 0.6, 0.8) and vec(0, 0):unit() == vec(0, 0))");
  expect_good(
      "assert(vec(1, 0):rot(90) == vec(0, 1) and vec(0, 1, 0):rot(90, 'x') == vec(0, 0, 1))");
  expect_good(
      "assert(vec(0, 0, 1):rot(90, 'y') == vec(1, 0, 0) and vec(1, 2):normal() == vec(-2, 1))");
  expect_good("local v = vec(1, 2, 3) v.x = 5 v[2] = 6 assert(v == vec(5, 6, 3))");
  expect_good("local s = 0 for _, x in ipairs(vec(1, 2, 3)) do s = s + x end assert(s == 6)");
  expect_good("assert(tostring(vec(1, 2.5)) == 'vec(1, 2.5, 0)')");
  EXPECT_EQ(box_of("cube(1):translate(vec(1, 2, 3))"), "1 2 3 .. 2 3 4");
  EXPECT_EQ(box_of("cube(vec(1, 2, 3))"), "0 0 0 .. 1 2 3");
}

TEST(Vectors, Mistakes) {
  const std::pair<const char*, const char*> cases[] = {
      {"vec(1)", "vec: option 'v' must be a list of two or three numbers, got the number 1"},
      {"vec()", "vec: needs two or three numbers"},
      {"vec(1, 'x')",
       "vec: option 'v' must be a list of two or three numbers, but number 2 is the string \"x\""},
      {"cross({1, 0, 0})", "cross: needs two vectors"},
      {"norm(5)", "norm: option 'v' must be a list of two or three numbers, got the number 5"},
      {"return vec(1, 2) + 1", "'+': a vector is a list of two or three numbers, got 1"},
      {"return vec(1, 2) / 0", "'/': a vector is divided by a number other than 0, got 0"},
      {"return vec(1, 2):leng()", "a vector has no 'leng' (did you mean 'len'?)"},
      {"vec(1, 2).w = 3", "a vector has three numbers, and nothing else can be set in it"},
      {"vec(1, 2):rot()", "vector:rot: wants an angle in degrees, got nothing"},
      {"vec(1, 2):rot(90, {0, 0, 1})",
       "vector:rot: the axis must be \"x\", \"y\" or \"z\", got a list of 3 values"},
      {"vec(1, 2):rot(5, 'w')", "vector:rot: the axis must be \"x\", \"y\" or \"z\", got \"w\""},
  };
  for (const auto& [script, message] : cases)
    EXPECT_EQ(message_of(script), std::string("model.lua:1: ") + message);
}

TEST(Numbers, HaveBareNames) {
  expect_good("assert(abs(-3) == 3 and math.type(abs(-3)) == 'integer' and abs(-2.5) == 2.5)");
  expect_good(
      "assert(floor(-2.5) == -3 and ceil(2.1) == 3 and round(2.5) == 3 and round(-2.5) == -3)");
  expect_good("assert(math.type(floor(2.5)) == 'integer' and floor(1e300) == 1e300)");
  expect_good("assert(sqrt(9) == 3 and pow(2, 10) == 1024 and sign(-2) == -1 and sign(0) == 0)");
  expect_good("assert(min(3, 1, 2) == 1 and max{3, 5, 2} == 5 and min(2) == 2)");
  expect_good("assert(PI == math.pi and csg.PI == math.pi and ln(1) == 0 and exp(0) == 1)");
  expect_good("assert(sin(30) == 0.5 and cos(60) == 0.5 and atan2(1, 1) == 45 and acos(0) == 90)");
  expect_good(
      "local t = {{10, 100}, {0, 0}, {20, 0}}"
      "assert(lookup(5, t) == 50 and lookup(-1, t) == 0 and lookup(10, t) == 100 and "
      "lookup(99, t) == 0 and lookup(15, t) == 50)");
  EXPECT_EQ(message_of("sqrt(-1)"), "model.lua:1: sqrt: the number must not be negative, got -1");
  EXPECT_EQ(message_of("ln(0)"), "model.lua:1: ln: the number must be positive, got 0");
  EXPECT_EQ(message_of("floor()"), "model.lua:1: floor: needs a number");
  EXPECT_EQ(message_of("floor('x')"),
            "model.lua:1: floor: option 'x' must be a number, got the string \"x\"");
  EXPECT_EQ(message_of("max()"), "model.lua:1: max: needs a number");
  EXPECT_EQ(message_of("max(1, 'x')"),
            "model.lua:1: max: takes numbers or a list of numbers, got the string \"x\"");
  EXPECT_EQ(message_of("lookup(1, {5})"),
            "model.lua:1: lookup: point 0 must be a list of two numbers, got 5");
}

TEST(Numbers, RandomOnesAreTheSameOnEveryRun) {
  const char* twice =
      "local a, b = rands(0, 10, 5), rands(0, 10, 5) emit(cube(a[1] + 1)) emit(cube(b[1] + 1))";
  const ScriptRun first(twice), second(twice);
  const auto size = [](const ScriptRun& run, size_t part) {
    return run.session.parts().at(part).solid->mesh()->points.back();
  };
  EXPECT_EQ(size(first, 0), size(second, 0));
  EXPECT_NE(size(first, 0), size(first, 1));  // they go on
  expect_good(
      "local a, b = rands(-1, 1, 1000, 7), rands(-1, 1, 1000, 7) local sum = 0\n"
      "for i = 1, 1000 do assert(a[i] == b[i] and a[i] >= -1 and a[i] < 1) sum = sum + a[i] end\n"
      "assert(abs(sum) < 60 and #a == 1000 and a[1] ~= a[2] and #rands(0, 1, 0) == 0)");
  EXPECT_EQ(message_of("rands(0, 1)"), "model.lua:1: rands: needs min, max and how many");
  EXPECT_EQ(message_of("rands(0, 1, -1)"),
            "model.lua:1: rands: option 'n' must not be negative, got -1");
  EXPECT_EQ(message_of("rands(0, 1, 1e9)"),
            "model.lua:1: rands: 'n' must be at most 10000000, got 1000000000");
}

TEST(Names, RenderTakesSeveralParts) {
  const auto names = [](const std::string& script) {
    std::string all;
    const ScriptRun run(script);
    EXPECT_EQ(run.outcome.status, ScriptStatus::kGood) << run.outcome.message;
    for (const ScriptPart& part : run.session.parts()) all += part.name + " ";
    return all;
  };
  EXPECT_EQ(names("render(cube(1), cube(2):name('lid'), cube(3)) render(cube(4))"),
            "part1 lid part2 part3 ");
  EXPECT_EQ(names("render(cube(1), cube(2), {name = 'pair'})"), "pair/part1 pair/part2 ");
  EXPECT_EQ(names("emit(square(1), circle(2))"), "part1 part2 ");
  EXPECT_EQ(message_of("render(cube(1), 5)").substr(0, 21), "model.lua:1: render: ");
  EXPECT_EQ(message_of("render(5, cube(1))").substr(0, 21), "model.lua:1: render: ");
}

TEST(Names, StayWithTheirPart) {
  EXPECT_EQ(names_of("render(cube(1):name('a'):translate(1, 0, 0):color('red'):rotate(5)) "
                     "render(sphere(1):name('b') - cube(1)) render(cube(2))"),
            "a b part1");
  EXPECT_EQ(names_of("return {lid = cube(1):name('x'), cube(2):name('y')}"), "y lid");
  EXPECT_EQ(names_of("emit(cube(1):name('x'), {name = 'z'})"), "z");
  EXPECT_EQ(names_of("local c = cube(1) c:name('x') return c"), "part1");  // values never change
  EXPECT_EQ(names_of("return cube(1):name('x'):clone():copy()"), "x");
  EXPECT_EQ(names_of("render(cube(1):name('x')) render(cube(2):name('x'))"),
            "model.lua:1: render: there are two parts named 'x'");
  EXPECT_EQ(message_of("cube(1):name()"), "model.lua:1: name: needs a name");
  EXPECT_EQ(message_of("cube(1):name(5)"),
            "model.lua:1: name: option 'name' must be a string, got the number 5");
  EXPECT_EQ(message_of("cube(1):clone(2)"), "model.lua:1: clone: takes no arguments");
}

TEST(Modifiers, SkippedValuesAreNeitherPartsNorOperands) {
  for (const char* skip : {"s(X)", "X:skip()", "t(X)", "X:transparent()"}) {
    const auto with = [&](std::string script) {
      std::string call = skip;
      call.replace(call.find('X'), 1, "cube(10)");
      for (size_t at; (at = script.find('?')) != std::string::npos;) script.replace(at, 1, call);
      return script;
    };
    EXPECT_EQ(volume_of(with("cube(2) - ?")), 8) << skip;
    EXPECT_EQ(volume_of(with("cube(2) + ?:translate(1, 0, 0)")), 8) << skip;
    EXPECT_EQ(volume_of(with("cube(2) * ?")), 8) << skip;
    EXPECT_EQ(volume_of(with("difference(?, cube(2), cube(1))")), 7) << skip;  // as OpenSCAD has it
    EXPECT_EQ(names_of(with("render(?) render(cube(1))")), "part1") << skip;
    EXPECT_EQ(names_of(with("render(?)")),
              "model.lua:1: the script makes no part: all that it gave are skipped");
  }
  EXPECT_EQ(volume_of("(square(3) - s(square(2))):linear_extrude(1)"), 9);
  EXPECT_EQ(volume_of("cube(3) - d(cube(1)) - cube(1):translate(2, 2, 2):debug()"), 25);
}

TEST(Modifiers, OnlyLeavesNothingElse) {
  EXPECT_EQ(names_of("render(cube(1)) render((cube(2) - o(cube(1)):translate(5, 0, 0)):name('x'))"),
            "x");
  EXPECT_EQ(volume_of("(cube(5) - cube(2):only() + o(cube(1):translate(9, 0, 0))):scale(2)"), 72);
  EXPECT_EQ(looks_of("(cube(5):color('red') - cube(2):only()):color('#0000ff')"), "0000ff 0 0.6");
  EXPECT_EQ(names_of("local unused = o(cube(1)) render(cube(2):name('y'))"), "y");
  EXPECT_EQ(names_of("render(square(1)) render(o(square(2)):name('s'))"), "s");
  // Of shapes that Booleans and extrusions make something of, too.
  EXPECT_EQ(volume_of("(square(9) - o(square(2)):translate(1, 1)):linear_extrude(3)"), 12);
  EXPECT_EQ(volume_of("cube(9) - (square(4) + (square(5) - o(square(2)))):linear_extrude(3)"), 12);
  EXPECT_EQ(volume_of("cube(9) + o(square(2)):linear_extrude(3):translate(20, 0, 0)"), 12);
  // Shared 60 times over, and still found at once.
  EXPECT_EQ(
      volume_of("(function() local x = o(cube(1)) for i = 1, 60 do x = x + x end return x end)()"),
      1);
}

TEST(Modifiers, OnlyHoldsWhereASolidIsEvaluated) {
  const std::string part = "(cube(6) - cube(2):only())";
  for (const char* made : {":refine(1)", ":warp(function(x, y, z) return x, y, z end)",
                           ":projection():linear_extrude(2)", ":project():linear_extrude(2)",
                           ":slice(1):linear_extrude(2)"}) {
    EXPECT_EQ(volume_of(part + made), 8) << made;
    EXPECT_EQ(volume_of("cube(9):translate(20, 0, 0) - " + part + made), 8) << made;
    EXPECT_EQ(names_of("render(cube(9)) render((" + part + made + "):name('x'))"), "x") << made;
  }
  EXPECT_EQ(names_of("render(cube(9)) render(" + part + ":smooth(1):name('x'))"), "x");
  for (const char* both : {"hull(o(square(2)), square(9))", "minkowski(square(9), o(square(2)))",
                           "translate(1, 2, 0) * o(square(2))"})
    EXPECT_EQ(volume_of("cube(9) + linear_extrude(" + std::string(both) + ", 2)"), 8) << both;
}

TEST(Names, StayWithWhatIsMadeOfOneThing) {
  const std::string a = "cube(2):name('a')";
  for (const std::string& made : std::vector<std::string>{
           "translate(1, 2, 3) * " + a, "outer_hull(" + a + ")", a + ":projection()",
           a + ":projection{cut = true}", a + ":project()", a + ":project{1, 0, 0}",
           "translate(1, 2, 0) * square(2):name('a')", "cube(1):name('b'):skip() + " + a,
           "hull(cube(1):name('b'):skip(), " + a + ")", a + " - cube(1):name('b')"})
    EXPECT_EQ(names_of("render(" + made + ")"), "a") << made;
  EXPECT_EQ(names_of("for z = 0, 1 do render(" + a + ":slice(z)) end"), "part1 part2");
  for (const char* skipped :
       {"translate(1, 2, 3) * s(cube(1))", "outer_hull(s(cube(1)))", "s(cube(1)):projection()",
        "s(cube(1)):slice(0)", "translate(1, 2, 0) * s(square(1))"})
    EXPECT_EQ(names_of("render(" + std::string(skipped) + ")"),
              "model.lua:1: the script makes no part: all that it gave are skipped")
        << skipped;
}

TEST(Materials, LeaveColoursAlone) {
  EXPECT_EQ(looks_of("cube(1):color('red'):material('rubber')"), "ff0000 0 0.7 rubber");
  for (const char* red : {"cube(1):color{'red'}", "color{'red', cube(1)}", "color{cube(1), 'red'}",
                          "cube(1):color{{1, 0, 0}}", "cube(1):color{'red', 1}"})
    EXPECT_EQ(looks_of(red), "ff0000 0 0.6") << red;
  EXPECT_EQ(looks_of("cube(1):material('rubber'):color('red')"), "ff0000 0 0.7 rubber");
  EXPECT_EQ(looks_of("cube(1):material('gold')"), "ffd66b 1 0.25 gold");
  EXPECT_EQ(looks_of("cube(1):material{kind = 'metal', roughness = 0.5}"), "none metal");
  EXPECT_EQ(
      looks_of("cube(1):setcolor(0, 1, 0):material('metal', {roughness = 0.5, metallic = 0.75})"),
      "00ff00 0.75 0.5 metal");
  // Below a Boolean: each face keeps its colour.
  EXPECT_EQ(
      looks_of(
          "(cube(3):color('red') + cube(1):color('blue'):translate(9, 0, 0)):material('matte')"),
      "ff0000 0 1 matte, 0000ff 0 1 matte");
  EXPECT_EQ(looks_of("(cube(3):material('metal') + cube(1):material('matte'):translate(9, 0, "
                     "0)):color('red')"),
            "ff0000 1 0.25 metal, ff0000 0 1 matte");
  EXPECT_EQ(looks_of("square(3):color('red'):material('wood'):linear_extrude(1)"),
            "ff0000 0 0.5 wood");
  EXPECT_EQ(
      message_of("cube(1):material('rubbr')"),
      "model.lua:1: material: there is no material 'rubbr' (did you mean 'rubber'?); there are "
      "matte, plastic, metal, glass, emissive, steel, chrome, gold, copper, brass, rubber, wood, "
      "ivory");
  EXPECT_EQ(message_of("cube(1):material()"),
            "model.lua:1: material: needs the name of a material, or options");
  EXPECT_EQ(message_of("cube(1):material{roughness = 2}"),
            "model.lua:1: material: 'roughness' must be from 0 to 1, got 2");
  EXPECT_EQ(message_of("cube(1):material{rougness = 1}"),
            "model.lua:1: material: unknown option 'rougness' (did you mean 'roughness'?)");
  const ScriptRun run("return cube(1):material('glass', {ior = 1.5})");
  EXPECT_EQ(
      run.session.warnings(),
      std::vector<std::string>{"model.lua:1: material: 'ior' is in no file that csgrun writes"});
}

TEST(CutFaces, HaveTheToolsColourOrTheBodys) {
  const std::string body = "cube(3):color('red')", tool = "cube(1):color('blue')";
  EXPECT_EQ(looks_of(body + " - " + tool), "ff0000 0 0.6, 0000ff 0 0.6");
  EXPECT_EQ(looks_of("difference{" + body + ", " + tool + ", cut = 'body'}"), "ff0000 0 0.6");
  EXPECT_EQ(looks_of(body + ":difference(" + tool + ", {cut = 'body'})"), "ff0000 0 0.6");
  EXPECT_EQ(looks_of(body + ":sub(" + tool + ", {cut = 'tool'})"), "ff0000 0 0.6, 0000ff 0 0.6");
  EXPECT_EQ(looks_of("cube(3):difference(" + tool + ", {cut = 'body'})"), "none");
  EXPECT_EQ(message_of("cube(1):difference(cube(2), {cut = 'bdy'})"),
            "model.lua:1: difference: option 'cut' must be \"tool\" or \"body\", got \"bdy\"");
  EXPECT_EQ(message_of("cube(1):difference(cube(2), {cutt = 'body'})"),
            "model.lua:1: difference: unknown option 'cutt' (did you mean 'cut'?)");
  EXPECT_EQ(message_of("cube(1):difference(cube(2), {cut = 5})"),
            "model.lua:1: difference: option 'cut' must be \"tool\" or \"body\", got 5");
}

TEST(Booleans, LuaCadsNames) {
  EXPECT_EQ(volume_of("cube(2):intersect(cube(1), cube(3))"), 1);
  EXPECT_EQ(volume_of("cube(2):add(cube(1):translate(5, 0, 0))"), 9);
  EXPECT_EQ(volume_of("cube(2):sub(cube(1))"), 7);
  EXPECT_EQ(volume_of("cube(2):subtract(cube(1))"), 7);
  EXPECT_EQ(message_of("cube(1):intersect(5)"),
            "model.lua:1: intersect: an operand must be a solid or a shape, got 5");
}

}  // namespace
}  // namespace csgrun::testing::luacad_test
