// Edges chosen by what scripts give: each form means the edges it names, and none ends the program.
#include "lua_support.h"

namespace csgrun::testing {
namespace {

const std::string kTouching = "local two = cube(10) + cube(10):translate(10, 10, 0)\n";

TEST(EdgeChoice, ListsThatHoldThemselvesAreRefused) {
  const std::string deep = "model.lua:1: chamfer: the lists in option 'edges' are nested too deep";
  EXPECT_EQ(message_of("local t = {} t[1] = t return cube(10):chamfer(1, {edges = t})"), deep);
  EXPECT_EQ(message_of("local t = {'z'} for i = 1, 3000 do t = {t} end "
                       "return cube(10):chamfer(1, {edges = t})"),
            deep);
  EXPECT_EQ(
      message_of("local a, b = {}, {} a[1], b[1] = b, a return cube(10):fillet(1, {edges = a})"),
      "model.lua:1: fillet: the lists in option 'edges' are nested too deep");
  expect_good(
      "local t = {'z'} for i = 1, 90 do t = {t} end\n"
      "assert(cube(10):chamfer(1, {edges = t}) == cube(10):chamfer(1, 'z'))");
}

TEST(EdgeChoice, AFunctionMayMeasureTheSolidWithOtherSettings) {
  expect_good(R"(
    local c = cube(10) - sphere(3)
    for _, how in ipairs{"chamfer", "fillet"} do
      local grid = 0.25
      c[how](c, 1, {edges = function(e)
        csg.grid, grid = grid, 0.375 - grid
        return #c:edges() > 0 and e.length == 10 and e.from[1] == 10 and e.to[1] == 10
      end})
    end)");
}

TEST(EdgeChoice, AnEdgesTableMeansThatEdgeWhereSolidsTouch) {
  // Two of four edges between the same points are convex for each cube.
  expect_good(kTouching + R"(
    local upright = two:edges{along = "z", near = {10, 10, 5}}
    assert(#upright == 2)
    local function left(edges) return math.floor(two:chamfer(1, {edges = edges}):volume() + 0.5) end
    for _, e in ipairs(upright) do assert(left{e} == 1995) end
    assert(left(upright) == 1990)
    local e = upright[1]
    e.normals[1], e.normals[2] = e.normals[2], e.normals[1]
    e.from, e.to = e.to, e.from
    assert(left(e) == 1995)
    e.normals = nil -- then all that are between these points
    assert(left(e) == 1990))");
  EXPECT_EQ(message_of("cube(10):chamfer(1, {edges = {from = {0, 0, 0}, to = {10, 0, 0}, normals = "
                       "{{0, 0, 1}, {0, 1, 0}}}})"),
            "model.lua:1: chamfer: it has no edge from {0, 0, 0} to {10, 0, 0} with these normals");
}

TEST(EdgeChoice, AnEdgesTableIsOfFiniteNumbers) {
  for (const char* from : {"{0, 0, 0 / 0}", "{0, 0, 1 / 0}", "{0, 0}", "{'0', 0, 0}", "{}"}) {
    EXPECT_EQ(message_of(std::string("cube(10):chamfer(1, {edges = {from = ") + from +
                         ", to = {10, 0, 0}}})"),
              "model.lua:1: chamfer: 'from' of an edge must be a list of three finite numbers");
  }
  for (const char* normals : {"1", "{}", "{{0, 0, 1}}", "{{0, 0, 1}, {0, 0, 0}}"}) {
    EXPECT_EQ(message_of(std::string("cube(10):fillet(1, {edges = {from = {0, 0, 0}, to = {10, 0, "
                                     "0}, normals = ") +
                         normals + "}})"),
              "model.lua:1: fillet: 'normals' of an edge must be two lists of three numbers");
  }
}

}  // namespace
}  // namespace csgrun::testing
