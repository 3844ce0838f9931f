// What scripts see of an evaluated solid: never that of other settings, and its triangles.
#include "lua_support.h"

namespace csgrun::testing::evaluated_test {
namespace {

TEST(Evaluated, IsMeasuredAnewWhenContactsAreSetOtherwise) {
  expect_good(R"(
    local s = cube(10) + cube(10):translate(10, 10, 0)
    assert(s:components() == 2)
    csg.contacts = "join"
    assert(s:components() == 1)
    csg.contacts = "separate"
    assert(s:components() == 2))");
}

TEST(Evaluated, IsMeasuredAndComparedAnewOnAnotherGrid) {
  expect_good(R"(
    local s = cube(10.25)
    csg.grid = "0.25mm"
    assert(s:volume() == 10.25 ^ 3 and s ~= cube(10))
    csg.grid = 1
    assert(s:volume() == 1000 and s == cube(10)))");
}

TEST(Evaluated, TrianglesAreThoseOfAPolyhedron) {
  expect_good(R"(
    local m = cube(10):mesh()
    assert(#m.points == 8 and #m.faces == 12)
    local volume = 0
    for _, f in ipairs(m.faces) do
      local a, b, c = m.points[f[1] + 1], m.points[f[2] + 1], m.points[f[3] + 1]
      volume = volume + a[1] * (b[2] * c[3] - b[3] * c[2]) + a[2] * (b[3] * c[1] - b[1] * c[3])
               + a[3] * (b[1] * c[2] - b[2] * c[1])
    end
    assert(volume == -6000, "clockwise from outside")
    csg.grid = "2^-20mm"
    local s = cube(20) - cylinder{h = 30, r = 4, fn = 7}:translate(10, 10, -5) - cube(5)
              + cube(10):translate(40, 0, 0) + cube(10):translate(50, 10, 0)
    s = s:rotate(0, 90, 0)
    local again = polyhedron(s:mesh())
    assert(again:volume() == s:volume() and again:genus() == s:genus())
    assert((again ~ s):is_empty())
    assert(#(cube(1) - cube(1)):mesh().faces == 0))");
  EXPECT_EQ(message_of("cube(1):mesh(3)").rfind("model.lua:1: mesh: takes no arguments", 0), 0u)
      << message_of("cube(1):mesh(3)");
}

// Triangles alone are made without measures.
TEST(Evaluated, IsMeasuredAfterItsTrianglesWereMade) {
  expect_good(R"(
    local function made() return cube(10) - cube(10):translate(5, 5, 5) end
    local s = made()
    assert(#s:mesh().faces == 24)
    assert(s:area() == 600 and s:volume() == 875 and s:bbox().max.x == 10)
    assert(s:components() == 1 and s:genus() == 0)
    local x = (1000 * 5 - 125 * 7.5) / 875
    assert(math.abs(s:centroid().x - x) < 1e-12)
    local t = made()
    assert(#t:mesh().faces == 24 and t:volume() == 875)
    local u, v = made(), cube(10)
    assert(#u:mesh().faces == 24 and #v:mesh().faces == 12)
    assert(u == made() and u ~= v and v ~= cube(11))
    assert(#u:mesh().faces == 24))");
}

// Nodes of what failed are gone, and others take their places in memory.
TEST(Evaluated, WhatFailedLeavesNothingBehind) {
  expect_good(R"(
    csg.grid = 0.001
    for _ = 1, 300 do
      assert(not pcall(function()
        return hull((cube(0.01) - cube(0.005)):translate(1000, 0, 0)):resize(4, 4, 4):volume()
      end))
      local v = hull(cube(2) - cube(1)):resize(4, 4, 4):volume()
      assert(math.abs(v - (64 - 4 / 3)) < 1e-9, v)
    end)");
  expect_good(R"(
    local bad = outer_hull(cube(1):scale(1e300):scale(1e300))
    for _ = 1, 3 do
      assert(not pcall(bad.volume, bad))
      assert(cube(3):volume() == 27)
    end)");
}

// Every kind of result is the same after every kind of failure.
TEST(Evaluated, FailuresChangeNoLaterResult) {
  expect_good(R"(
    local points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}
    local open = {points = points, faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}}}
    local function endless() return cube(1):scale(1e300):scale(1e300) end
    local bad = {
      function() return endless():volume() end,
      function() return hull(endless(), cube(1)):volume() end,
      function() return minkowski(cube(2) - cube(1), endless()):volume() end,
      function() return outer_hull(endless()):area() end,
      function() return endless():resize(4, 4, 4):volume() end,
      function() return (cube(3) - endless()):centroid() end,
      function() return (cube(3) + hull(cube(1), endless())):slice(1) end,
      function() return (sphere(2) - polyhedron(open)):mesh() end,
      function() return endless():offset(1):volume() end,
      function() return (cube(1) - endless()):contains{0, 0, 0} end,
    }
    local good = {
      function() return (cube(3) - sphere(1.5, {fn = 12})):volume() end,
      function() return hull(cube(2) - cube(1)):resize(4, 4, 4):area() end,
      function() return minkowski(cube(2) - cube(1), octahedron(0.5)):volume() end,
      function() return outer_hull(cube(3) + cube(2):rotate(10, 20, 30)):volume() end,
      function() return (cube(5):rotate(0, 0, 30) - cylinder{h = 9, r = 1, fn = 9}):centroid().y end,
      function() return (cube(4) - cube(2)):offset(0.5, {fn = 8}):volume() end,
      function() return (sphere(3, {fn = 16}) - cube(2)):slice(1):area() end,
      function() return #(cube(1) + cube(1):translate(0.5, 0.5, 0.5)):mesh().faces end,
    }
    local truth = {}
    for i, f in ipairs(good) do truth[i] = f() end
    for round = 1, 3 do
      for b, fail in ipairs(bad) do
        assert(not pcall(fail), b)
        for i, f in ipairs(good) do assert(f() == truth[i], b .. ", " .. i) end
      end
    end)");
}

TEST(Evaluated, NotesAndFiguresOutliveTheirEvaluator) {
  const std::string measured =
      "local v, w = cube(1):translate(1e200, 0, 0):volume(), (cube(2) - cube(1)):volume()";
  const ScriptRun plain(measured);
  const auto notes = plain.session.evaluation_warnings();
  ASSERT_FALSE(notes.empty());
  ASSERT_GT(plain.session.evaluation_stats().nodes_evaluated, 0u);
  for (const std::string& setting : std::initializer_list<std::string>{
           "csg.contacts = 'join'", "csg.grid = '2^-20mm'", "csg.contacts = 'join' " + measured}) {
    const ScriptRun run(measured + " " + setting);
    EXPECT_EQ(run.session.evaluation_warnings(), notes) << setting;
    EXPECT_GE(run.session.evaluation_stats().nodes_evaluated,
              plain.session.evaluation_stats().nodes_evaluated)
        << setting;
  }
}

}  // namespace
}  // namespace csgrun::testing::evaluated_test
