// What functions of whole solids say when they are called wrongly.
#include "lua_support.h"

namespace csgrun::testing::constructions_test {
namespace {

TEST(Constructions, Mistakes) {
  EXPECT_EQ(message_of("return hull()"), "model.lua:1: hull: needs a solid or a shape");
  EXPECT_EQ(message_of("return hull{}"), "model.lua:1: hull: needs a solid or a shape");
  EXPECT_EQ(message_of("return hull(cube(1), 3)"),
            "model.lua:1: hull: an operand must be a solid or a shape, got 3");
  EXPECT_EQ(message_of("return cube(1):minkowski{a = cube(1)}"),
            "model.lua:1: minkowski: takes lists of solids or shapes without holes and names in "
            "them, got the key 'a'");
  EXPECT_EQ(message_of("return minkowski(cube(1), square(1))"),
            "model.lua:1: minkowski: a solid and a 2D shape cannot be combined; make a solid of "
            "the shape first, with linear_extrude or rotate_extrude");
  EXPECT_EQ(message_of("return cube(1):resize()"),
            "model.lua:1: resize: needs the new lengths: (20, 10), or 0 where nothing changes");
  EXPECT_EQ(message_of("return cube(1):resize({1, 1, 1}, {auto = 1})"),
            "model.lua:1: resize: option 'auto' must be true, false or a list of two or three of "
            "them, got the number 1");
  EXPECT_EQ(message_of("return cube(1):resize(1/0, 1, 1)"),
            "model.lua:1: resize: option 'newsize' must be finite, got inf");
  EXPECT_EQ(message_of("return cube(1):resize(1, -1, 1)"),
            "model.lua:1: resize: option 'newsize' must not be negative, got -1");
  EXPECT_EQ(message_of("return resize(7)").substr(0, 71),
            "model.lua:1: resize: the first argument must be a solid or a shape, got");
}

TEST(Sections, Mistakes) {
  EXPECT_EQ(message_of("return cube(1):projection{cutt = true}"),
            "model.lua:1: projection: unknown option 'cutt' (did you mean 'cut'?)");
  EXPECT_EQ(message_of("return cube(1):projection{cut = 1}"),
            "model.lua:1: projection: option 'cut' must be true or false, got the number 1");
  EXPECT_EQ(message_of("return cube(1):project(1)"),
            "model.lua:1: project: wants a direction {x, y, z}, got 1; slice(z) cuts");
  EXPECT_EQ(message_of("return cube(1):slice('a')"),
            "model.lua:1: slice: option 'z' must be a number, got the string \"a\"");
  EXPECT_EQ(message_of("return cube(1):slice(0/0)"),
            "model.lua:1: slice: option 'z' must be finite, got nan");
  EXPECT_EQ(message_of("return cube(1):trim({0, 0, 0})"),
            "model.lua:1: trim: the normal must be finite and not 0");
  EXPECT_EQ(message_of("return cube(1):split{normel = {0, 0, 1}}"),
            "model.lua:1: split: unknown option 'normel' (did you mean 'normal'?)");
  EXPECT_EQ(message_of("return cube(1):split({0, 0, 1}, 1, {point = {0, 0, 1}})"),
            "model.lua:1: split: give either 'offset' or 'point', not both");
  EXPECT_EQ(message_of("return cube(1):split({0, 0})"),
            "model.lua:1: split: option 'normal' must be a list of three numbers, got a list of 2 "
            "values");
  EXPECT_EQ(message_of("return cube(1):decompose(1)"),
            "model.lua:1: decompose: takes no arguments");
}

// Planes laid flat by hand, by a rotation that does the same.
TEST(Sections, AtAnyPlane) {
  const std::string part =
      "local part = (cube(10) - cylinder{h = 30, r = 2, fn = 24}:translate(4, 9, 0)):rotate(0, 0, "
      "30):translate(3, 4, 5) local box = cube(10, 20, 30) local function near(a, b) "
      "assert(math.abs(a - b) <= 1e-6 * math.max(1, math.abs(b)), a .. ' ' .. b) end ";
  expect_good(
      part +
      "assert(part:slice(7) == part:slice{normal = {0, 0, 2}, offset = 7} and part:slice(7) "
      "== part:slice({0, 0, 1}, 7) and part:slice(7) == part:slice{normal = {0, 0, 1}, "
      "point = {9, 9, 7}})");
  // Seen against the normal, upwards is Y; X is to the right.
  expect_good(
      part +
      "local b = box:slice({1, 0, 0}, 4):bbox() assert(b.min == vec(0, 0) and b.max == "
      "vec(20, 30)) b = box:slice({0, -1, 0}, -4):bbox() assert(b.min == vec(0, 0) and "
      "b.max == vec(10, 30)) b = box:slice({0, 1, 0}, 4):bbox() assert(b.min == vec(-10, 0) "
      "and b.max == vec(0, 30)) b = box:slice({0, 0, -1}, -3):bbox() assert(b.min == "
      "vec(-10, 0) and b.max == vec(0, 20))");
  expect_good(part +
              "near(box:slice({1, 1, 0}, 5 * sqrt(2)):area(), 300 * sqrt(2)) local six = cube(10, "
              "true):slice{1, 1, 1} near(six:area(), 75 * sqrt(3)) assert(#six:points() == 6)");
  // What is cut, laid back into its plane, lies in both halves: prism by prism.
  expect_good(part +
              "local cut = part:slice({1, 0, 0}, 2) local prism = "
              "cut:linear_extrude(1):multmatrix{{0, 0, 1, 2}, {1, 0, 0}, {0, 1, 0}} "
              "near((prism * part:trim({1, 0, 0}, 2)):volume() > 0 and 1 or 0, 1)");
  expect_good(
      part +
      "assert(box:project() == square(10, 20) and box:project({0, -1, 0}) == square(10, 30) "
      "and box:project{normal = {1, 0, 0}} == square(20, 30)) near(cube(10, "
      "true):project{1, 1, 1}:area(), 100 * sqrt(3))");
  EXPECT_EQ(message_of("return cube(1):slice{z = 1, normal = {1, 0, 0}}"),
            "model.lua:1: slice: give either the height 'z' or a plane, not both");
  EXPECT_EQ(message_of("return cube(1):slice{normal = {0, 0, 0}}"),
            "model.lua:1: slice: the normal must be finite and not 0");
  EXPECT_EQ(message_of("return cube(1):slice({1, 0, 0}, 1, 2)"),
            "model.lua:1: slice: too many arguments: after 'offset' only {name = value} may "
            "follow, got 2");
  EXPECT_EQ(message_of("return cube(1):project(5)"),
            "model.lua:1: project: wants a direction {x, y, z}, got 5; slice(z) cuts");
}

TEST(Extrusions, TakeAVectorForTheHeight) {
  expect_good(
      "local v = square(2):linear_extrude{v = {1, 2, 3}} for _, same in "
      "ipairs{square(2):linear_extrude({1, 2, 3}), square(2):linear_extrude{1, 2, 3}, "
      "square(2):linear_extrude{{1, 2, 3}}, square(2):linear_extrude{height = {1, 2, 3}}, "
      "linear_extrude(square(2), {1, 2, 3}), linear_extrude{square(2), h = {1, 2, 3}}, "
      "square(2):linear_extrude(vec(1, 2, 3), {twist = 0})} do assert(same == v) end "
      "assert(square(2):linear_extrude({1, 2, 3}, {center = true}) == v:translate(-0.5, -1, "
      "-1.5))");
  EXPECT_EQ(message_of("return square(2):linear_extrude({1, 2, 3}, {v = {1, 1, 1}})"),
            "model.lua:1: linear_extrude: a vector as the height is option 'v', given as well");
  EXPECT_EQ(message_of("return square(2):linear_extrude{1, 2, -3}"),
            "model.lua:1: linear_extrude: option 'v' must point upwards (z positive)");
  EXPECT_EQ(message_of("return square(2):linear_extrude{1, 2}").substr(0, 28),
            "model.lua:1: linear_extrude:");
  EXPECT_EQ(
      message_of("return square(2):linear_extrude{height = {1, 2}}"),
      "model.lua:1: linear_extrude: option 'height' must be a number, got a list of 2 values");
}

TEST(Apexes, OfSweepsAndLofts) {
  expect_good(
      "assert(square(4, true):sweep({{0, 0, 0}, {0, 0, 6}}, {scale = 0}):volume() == 32) "
      "assert(loft({square(4, true), {0, 0}}, {0, 6}):volume() == 32) assert(loft({{5, 5}, "
      "square(4, true) - square(2, true), {0, 0}}, {-6, 0, 6}):volume() == 48)");
  EXPECT_EQ(message_of("return loft({square(1), {1, 'x'}}, 5)"),
            "model.lua:1: loft: outline 2 must be a 2D shape or a point {x, y}, got a list of 2 "
            "values");
  const ScriptRun run("return square(1):sweep{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 0, 0}}");
  EXPECT_EQ(run.session.warnings(),
            std::vector<std::string>{"model.lua:1: sweep: the path ends where it begins; closed = "
                                     "true joins the ends"});
}

// A list with a name beside it is the list that the function is about.
TEST(ListsBesideNames, OfSurfacesAndLofts) {
  expect_good(
      "local s = surface{heights = {{0, 1, 2}, {1, 2, 3}}} "
      "assert(surface{{0, 1, 2}, {1, 2, 3}} == s) assert(surface({{0, 1, 2}, {1, 2, 3}}) == s) "
      "assert(surface({{0, 1, 2}, {1, 2, 3}}, true) == surface{{0, 1, 2}, {1, 2, 3}, center = "
      "true}) "
      "assert(surface{{0, 1, 2}, {1, 2, 3}, center = true}:bbox().min.x == -1)");
  expect_good(
      "local l = loft({square(4), square(2), square(1)}, {0, 2, 6}) "
      "assert(loft{square(4), square(2), square(1), heights = {0, 2, 6}} == l) "
      "assert(loft{outlines = {square(4), square(2), square(1)}, heights = {0, 2, 6}} == l) "
      "assert(loft{square(4), {0, 0}, height = 6}:volume() == 32)");
  EXPECT_EQ(message_of("return loft{square(1), cube(1), heights = 2}"),
            "model.lua:1: loft: outline 2 must be a 2D shape or a point {x, y}, got solid");
}

// function(p) gets a vector, function(x, y, z) three numbers.
TEST(Freeform, FunctionsOfOneVector) {
  expect_good(
      "local bar = cube{6, 2, 2}:refine(2) "
      "local bent = bar:warp(function(x, y, z) return x, y, z + x * x end) "
      "assert(bar:warp(function(p) return {p.x, p[2], p.z + p.x * p.x} end) == bent) "
      "assert(bar:warp(function(p) p.z = p.z + p.x ^ 2 return p end) == bent) "
      "assert(bar:warp(function(...) local x, y, z = ... return x, y, z + x * x end) == bent)");
  expect_good(
      "local box = {{-3, -3, -3}, {3, 3, 3}} "
      "local ball = levelset(function(x, y, z) return norm{x, y, z} - 2 end, box, 1) "
      "assert(levelset(function(p) return norm(p) - 2 end, box, 1) == ball)");
}

TEST(Hull, OfPoints) {
  expect_good(
      "assert(hull{{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}, {1, 1, 1}}:volume() == 36) "
      "assert(hull(cube(3):mesh().points) == cube(3)) assert(hull{{0, 0}, {4, 0}, {4, 3}, {2, 1}, "
      "{0, 0}}:area() == 6) assert(hull{vec(0, 0, 0), vec(6, 0, 0), vec(0, 6, 0), vec(0, 0, "
      "6)}:volume() == 36)");
  EXPECT_EQ(message_of("return hull{{0, 0, 0}, {1, 0}}"),
            "model.lua:1: hull: point 2 must be three finite numbers as the first, got a list of 2 "
            "values");
  EXPECT_EQ(message_of("return hull{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}"),
            "model.lua:1: hull: the points lie in one plane");
  EXPECT_EQ(message_of("return hull{{0, 0}, {1, 1}, {2, 2}}"),
            "model.lua:1: hull: the points lie on one line");
  EXPECT_EQ(message_of("return hull{{0, 0, 0/0}}"),
            "model.lua:1: hull: point 1 must be three finite numbers, got a list of 3 values");
}

TEST(Split, ByPlanesFarAwayAndWhereItIsCalled) {
  expect_good(R"(
    for k = 1, 9 do
      local front, back = cube(10):split({0, 1, 1}, -10 ^ k)
      assert(front:volume() == 1000 and #front:faces() == 6 and back:is_empty(), k)
      local none, all = cube(10):split({0, 1, 1}, 10 ^ (k + 1))
      assert(none:is_empty() and all:volume() == 1000)
    end)");
  const ScriptRun run("local c = cube(10)\nlocal d = c:split({0, 0, 1}, 5)\nreturn d");
  ASSERT_EQ(run.outcome.status, ScriptStatus::kGood) << run.outcome.message;
  const Node& half = *run.session.parts().at(0).solid;
  ASSERT_EQ(half.children().size(), 2u);
  EXPECT_EQ(half.children()[1]->where().line, 2);
}

TEST(Offset, InwardsByMoreThanThereIsLeavesNothing) {
  expect_good(R"(
    for _, d in ipairs{5, 6, 100, 1e4, 1e6} do
      assert(cube(10, 20, 30):offset(-d, {fn = 8}):is_empty())
      assert(cube(10, 20, 30):offset{delta = -d}:is_empty())
    end
    assert(cube(10, 20, 30):offset{delta = -4}:volume() == 2 * 12 * 22)
    assert(cube(10, 20, 30):offset{delta = -4.999}:volume() > 0)
    local nothing = cube(1) - cube(2)
    for _, d in ipairs{0.5, -0.5} do
      assert(nothing:offset(d):is_empty() and nothing:offset{delta = d}:is_empty())
    end)");
}

TEST(Edges, Mistakes) {
  EXPECT_EQ(message_of("return cube(1):chamfer()"), "model.lua:1: chamfer: needs a distance");
  EXPECT_EQ(message_of("return cube(1):fillet()"), "model.lua:1: fillet: needs a radius");
  EXPECT_EQ(message_of("return cube(1):chamfer(0)"),
            "model.lua:1: chamfer: option 'distance' must be positive, got 0");
  EXPECT_EQ(message_of("return cube(1):fillet(-1)"),
            "model.lua:1: fillet: option 'r' must be positive, got -1");
  EXPECT_EQ(message_of("return cube(1):chamfer(1/0)"),
            "model.lua:1: chamfer: option 'distance' must be finite, got inf");
  EXPECT_EQ(message_of("return cube(1):fillet('a')"),
            "model.lua:1: fillet: option 'r' must be a number, got the string \"a\"");
  EXPECT_EQ(message_of("return cube(1):fillet{r = 0.1, edge = 'z'}"),
            "model.lua:1: fillet: unknown option 'edge' (did you mean 'edges'?)");
  EXPECT_EQ(message_of("return cube(1):chamfer(0.1, 'up')"),
            "model.lua:1: chamfer: option 'edges' must be \"all\", \"x\", \"y\", \"z\", \"top\", "
            "\"bottom\", \"left\", \"right\", \"front\" or \"back\", got \"up\"");
  EXPECT_EQ(message_of("return cube(1):chamfer(0.1, 7)"),
            "model.lua:1: chamfer: option 'edges' must be a name, a table, a list or a function, "
            "got 7");
  EXPECT_EQ(message_of("return cube(1):chamfer(0.1, {edges = {alon = 'z'}})"),
            "model.lua:1: chamfer: unknown option 'alon' (did you mean 'along'?)");
  EXPECT_EQ(message_of("return cube(1):edges{along = 'q'}"),
            "model.lua:1: edges: option 'along' must be \"x\", \"y\", \"z\" or a list of three "
            "numbers, got \"q\"");
  EXPECT_EQ(message_of("return cube(1):edges{on = {1, 2}}"),
            "model.lua:1: edges: option 'on' must be \"top\", \"bottom\", \"left\", \"right\", "
            "\"front\", \"back\" or a list of three numbers, got a list of 2 values");
  const std::string sides[][2] = {{">X", "right"}, {"<X", "left"}, {">Y", "back"},
                                  {"<Y", "front"}, {">Z", "top"},  {"<Z", "bottom"}};
  for (const auto& [theirs, ours] : sides) {
    const std::string hint = ", got \"" + theirs + "\"; it is \"" + ours + "\" here";
    for (const std::string& call :
         {"chamfer(0.1, '" + theirs + "')", "edges{on = '" + theirs + "'}"}) {
      const std::string message = message_of("return cube(1):" + call);
      EXPECT_TRUE(message.ends_with(hint)) << message;
    }
  }
  EXPECT_EQ(message_of("return cube(1):edges{normal = {0, 0, 0}}"),
            "model.lua:1: edges: option 'normal' must not be 0");
  EXPECT_EQ(message_of("return cube(1):edges{turn = -1}"),
            "model.lua:1: edges: option 'turn' must not be negative, got -1");
  EXPECT_EQ(message_of("return cube(1):edges{through = 1}"),
            "model.lua:1: edges: option 'through' must be a list of three numbers, got the number "
            "1");
  EXPECT_EQ(message_of("return cube(10):chamfer(6)"),
            "model.lua:1: chamfer: 6 is too much for the edge from {0, 0, 0} to {0, 0, 10}: 5 "
            "fits");
  EXPECT_EQ(
      message_of("return cube(10):chamfer(1e17)"),
      "model.lua:1: chamfer: 1e+17 is too much for the edge from {0, 0, 0} to {0, 0, 10}, which "
      "is 10 long: 5 fits");
  EXPECT_EQ(message_of("return cube(20, 20, 3):fillet(4, 'top')"),
            "model.lua:1: fillet: 4 is too much for the edge from {0, 0, 3} to {0, 20, 3}: 3 "
            "fits");
  // Beyond a hole.
  EXPECT_EQ(message_of("return (cube(20, 20, 9) - cube(8, 8, 30):translate(2, 6, -1)):chamfer(3, "
                       "{edges = {near = {0, 10, 9}}})"),
            "model.lua:1: chamfer: 3 is too much for the edge from {0, 0, 9} to {0, 20, 9}: 2 "
            "fits");
  const std::string steps = "local s = cube(20, 20, 5) + cube(8, 20, 15) return s:";
  EXPECT_EQ(message_of(steps + "chamfer(1, {edges = {near = {8, 10, 5}}})"),
            "model.lua:1: chamfer: the edge from {8, 0, 5} to {8, 20, 5} is concave; only convex "
            "edges can be cut");
  EXPECT_EQ(message_of(steps + "fillet(1, {edges = s:edges{near = {8, 10, 5}}})"),
            "model.lua:1: fillet: the edge from {8, 0, 5} to {8, 20, 5} is concave; only convex "
            "edges can be cut");
  EXPECT_EQ(message_of(steps + "fillet(1, {edges = function(e) return not e.convex end})"),
            "model.lua:1: fillet: no convex edge of it is meant, but 1 concave");
  EXPECT_EQ(message_of(steps + "fillet(1, {edges = {turn = 91}})"),
            "model.lua:1: fillet: no edge of it is meant");
  EXPECT_EQ(message_of("return cube(1):fillet(0.1, {edges = cube(2):edges()})"),
            "model.lua:1: fillet: it has no edge from {0, 0, 0} to {0, 0, 2}");
  EXPECT_EQ(message_of("return union{}:fillet(1)"), "model.lua:1: fillet: there is nothing in it");
  EXPECT_EQ(message_of("return square(1):fillet(1)").substr(0, 11), "model.lua:1");
  EXPECT_EQ(message_of("return cube(1):chamfer(0.1, {edges = function(e) error('no') end})"),
            "model.lua:1: no");
}

TEST(Freeform, Mistakes) {
  EXPECT_EQ(message_of("return cube(1):refine()"),
            "model.lua:1: refine: needs the length of the longest edge");
  EXPECT_EQ(message_of("return cube(1):refine(0)"),
            "model.lua:1: refine: option 'length' must be positive, got 0");
  EXPECT_EQ(message_of("return cube(1):smooth{round = 2}"),
            "model.lua:1: smooth: unknown option 'round' (did you mean 'rounds'?)");
  EXPECT_EQ(message_of("return cube(1):smooth(1.5)"),
            "model.lua:1: smooth: option 'rounds' must be a whole number, got the number 1.5");
  EXPECT_EQ(message_of("return cube(1):warp(3)"),
            "model.lua:1: warp: option 'f' must be a function, got 3");
  EXPECT_EQ(message_of("return cube(1):warp()"), "model.lua:1: warp: needs a function");
  EXPECT_EQ(message_of("return cube(1):warp(function() return 1, 2 end)"),
            "model.lua:1: warp: the function must give three numbers, got 2 values");
  EXPECT_EQ(message_of("return cube(1):warp(function(x, y) return x end)"),
            "model.lua:1: warp: the function must give three numbers, got one value, the number 0");
  EXPECT_EQ(
      message_of("return cube(1):warp(function(x, y) return {x, y, 'z'} end)"),
      "model.lua:1: warp: the function must give three numbers, but number 3 is the string \"z\"");
  EXPECT_EQ(message_of("return cube(1):warp(function(x, y) return x, y, 0 end)"),
            "model.lua:1: warp: the moved points enclose no volume");
  EXPECT_EQ(message_of("return cube(1):warp(function(x, y, z) return x, y, x + y / 3 end)"),
            "model.lua:1: warp: the moved points enclose no volume");
  EXPECT_EQ(message_of("return cube(1):warp(function(x, y, z) return x, y, 1/0 end)"),
            "model.lua:1: warp: a moved point must be finite, got inf");
  EXPECT_EQ(message_of("return levelset(function() return 0 end)"),
            "model.lua:1: levelset: needs bounds: {min = {x, y, z}, max = {x, y, z}}");
  EXPECT_EQ(message_of("return levelset(function() end, {{0, 0, 0}, {1, 1, 1}})"),
            "model.lua:1: levelset: the function must give a number, got 0 values");
  EXPECT_EQ(message_of("return levelset(function() return 0 end, {{0, 0, 0}, {1, 0, 1}})"),
            "model.lua:1: levelset: the bounds must be finite and increase along each axis");
  EXPECT_EQ(message_of("return surface()"), "model.lua:1: surface: needs a file, or 'heights'");
  EXPECT_EQ(message_of("return surface(5)"),
            "model.lua:1: surface: option 'file' must be a string, or a list of rows of heights, "
            "got 5");
  EXPECT_EQ(message_of("return surface{heights = {{1, 2}, {3}}}"),
            "model.lua:1: surface: row 2 of option 'heights' must be a list of 2 numbers, as the "
            "first, got a list of one value");
  EXPECT_EQ(message_of("return cube{4, 4, 4, r = 3}"),
            "model.lua:1: cube: r must be at most half of the shortest side, 2, got 3");
  EXPECT_EQ(message_of("return cylinder{h = 4, r1 = 1, r2 = 2, round = 1}"),
            "model.lua:1: cylinder: 'round' needs both radii to be the same");
  EXPECT_EQ(message_of("return cube(1):offset{delta = 1, chamfer = true}"),
            "model.lua:1: offset: option 'chamfer' is for shapes");
}

}  // namespace
}  // namespace csgrun::testing::constructions_test
