// Faces by direction and plane, rays, gaps: against boxes and balls, where the answers are known.
#include "lua_support.h"

namespace csgrun::testing::selecting_test {
namespace {

TEST(Faces, ByDirectionAndPlane) {
  expect_good("local f = cube(2, 3, 4):faces() assert(#f == 6)");
  expect_good(
      "local f = cube(2, 3, 4):faces({0, 0, 5}) assert(#f == 1 and f[1].area == 6 and "
      "f[1].normal[3] == 1)\n"
      "assert(f[1].center[1] == 1 and f[1].center[2] == 1.5 and f[1].center[3] == 4)\n"
      "assert(#f[1].loops == 1 and #f[1].loops[1] == 4 and f[1].loops[1][1][3] == 4)");
  // What is flat across an axis has its centre there, to the last bit.
  expect_good(
      "local f = cube(10):faces({0, 0, 1})[1].center assert(f.x == 5 and f.z == 10)\n"
      "for _, f in ipairs(cube(0.1, 0.2, 0.3):translate(0.7, 0.7, 0.7):faces()) do\n"
      "  local n, p = f.normal, f.loops[1][1]\n"
      "  for i = 1, 3 do assert(n[i] == 0 or f.center[i] == p[i]) end\nend");
  // A step: two faces look up, one of them through a point.
  expect_good(
      "local s, up = cube(4) - cube(2, 4, 2):up(2), {0, 0, 1}\n"
      "assert(#s:faces(up) == 2 and #s:faces(up, {through = {9, 9, 2}}) == 1)\n"
      "assert(s:faces(up, {through = {0, 0, 4}})[1].area == 8)\n"
      "assert(#s:faces(up, {through = {0, 0, 3}}) == 0 and #s:faces{through = {0, 0, 3}} == 2)");
  // A hole is a second loop, clockwise.
  expect_good(
      "local f = (cube(10) - cube(2, 2, 10):translate(4, 4, 0)):faces({0, 0, -1})\n"
      "assert(#f == 1 and f[1].area == 96 and #f[1].loops == 2)\n"
      "local function area(l) local s = 0 for i = 1, #l do local p, q = l[i], l[i % #l + 1]\n"
      "s = s + p[1] * q[2] - p[2] * q[1] end return s / 2 end\n"
      "assert(area(f[1].loops[1]) == -100 and area(f[1].loops[2]) == 4)");
  expect_good("assert(#cylinder(5, 2, {fn = 36}):faces({1, 0, 0}, {angle = 6}) == 2)");
  EXPECT_EQ(message_of("cube(1):faces({0, 0, 0})"),
            "model.lua:1: faces: option 'normal' must not be 0");
  EXPECT_EQ(message_of("cube(1):faces{nromal = {0, 0, 1}}"),
            "model.lua:1: faces: unknown option 'nromal' (did you mean 'normal'?)");
  EXPECT_EQ(
      message_of("cube(1):faces(5)"),
      "model.lua:1: faces: option 'normal' must be a list of three numbers, got the number 5");
}

TEST(Rays, EnterAndLeave) {
  expect_good(
      "local h = cube(10):ray({-5, 5, 5}, {2, 0, 0})\n"
      "assert(#h == 2 and h[1].distance == 5 and h[2].distance == 15 and h[1].entering and not "
      "h[2].entering)\n"
      "assert(h[1].point[1] == 0 and h[1].normal[1] == -1 and h[2].normal[1] == 1)");
  expect_good(
      "assert(#cube(10):ray({5, 5, 5}, {0, 0, 1}) == 1 and #cube(10):ray({-5, 5, 5}, {-1, 0, 0}) "
      "== 0)");
  // Through the diagonals of faces, along edges' planes and through corners: hits are not doubled.
  expect_good(
      "assert(#cube(10):ray({5, 5, -1}, {0, 0, 1}) == 2 and #cube(10):ray({-1, -1, -1}, {1, 1, 1}) "
      "== 2)");
  expect_good(
      "local s = cube(10) - cube(4, 10, 10):translate(3, 0, 0) assert(#s:ray({-1, 5, 5}, {1, 0, "
      "0}) == 4)");
  // From the surface on, outwards and inwards.
  expect_good(
      "local out, inwards = cube(10):ray({10, 5, 5}, {1, 0, 0}), cube(10):ray({0, 5, 5}, {1, 0, 0})"
      "assert(#out == 1 and not out[1].entering and out[1].distance == 0)\n"
      "assert(#inwards == 2 and inwards[1].entering and inwards[2].distance == 10)");
  EXPECT_EQ(message_of("cube(1):ray({0, 0, 0})"),
            "model.lua:1: ray: needs where it starts and where it goes");
  EXPECT_EQ(message_of("cube(1):ray({0, 0, 0}, {0, 0, 0})"),
            "model.lua:1: ray: option 'direction' must not be 0");
}

// Rays from outside through points of edges and corners: they pass, or they only touch.
TEST(Rays, EnterAndLeaveByTurns) {
  expect_good(R"(
    for _, A in ipairs{octahedron(5), cube(10), cube({1000, 0.01, 3}):rotate(11, 12, 13),
                       sphere(10, {fn = 16}), cube(6) - cube(2, 2, 9):translate(2, 2, -1)} do
      local m, far, passed = A:mesh(), norm(A:bbox().size) * 2, 0
      local r = rands(0, 1, 6 * 400, 7)
      for t = 0, 399 do
        local function R(i, n) return math.min(n, 1 + math.floor(r[6 * t + i] * n)) end
        local f, k = m.faces[R(1, #m.faces)], R(2, 3)
        local p, q, s = m.points[f[k] + 1], m.points[f[k % 3 + 1] + 1], ({0, 0.5, 0.25})[R(3, 3)]
        local d = {R(4, 19) - 10, R(5, 19) - 10, R(6, 19) - 10}
        if norm(d) > 0 then
          local o, inside = {}, false
          for i = 1, 3 do o[i] = p[i] + (q[i] - p[i]) * s - d[i] / norm(d) * far end
          for _, hit in ipairs(A:ray(o, d)) do
            assert(hit.entering ~= inside)
            inside = hit.entering
            passed = passed + 1
          end
          assert(not inside)
        end
      end
      assert(passed > 100, passed)
    end
    -- Beside an edge of a tetrahedron, which it touches.
    local A = polyhedron{points = {{0, 0, 0}, {6, 0, 0}, {0, 5, 0}, {1, 2, 9}},
                         faces = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}}
    assert(#A:ray({21.8779296875, 16.048828125, 8.2197265625}, {-4, -4, -2}) == 0))");
}

TEST(Gaps, OfSolids) {
  expect_good("assert(cube(10):gap(cube(10):translate(13, 0, 0)) == 3)");
  expect_good("assert(cube(10):gap(cube(10):translate(13, 14, 0)) == 5)");  // edge to edge
  expect_good(
      "assert(abs(cube(10):gap(cube(1):translate(12, 12, 11)) - 3) < 1e-12)");  // corner to corner
  expect_good("assert(cube(10):gap(cube(10):translate(10, 0, 0)) == 0)");       // touching
  expect_good(
      "assert(cube(10):gap(cube(2):translate(4, 4, 4)) == 0 and cube(2):gap(cube(10)) == 0)");
  expect_good(
      "local shell = cube(10) - cube(8):translate(1, 1, 1) assert(shell:gap(cube(2):translate(4, "
      "4, 4)) == 3)");
  // Crossed edges, nearest in their middles.
  expect_good(
      "local g = cube(10, 1, 1):rx(45):gap(cube(10, 1, 1):rx(45):rz(90):translate(5, -5, 5))\n"
      "assert(abs(g - (5 - math.sqrt(2))) < 1e-5)");
  expect_good(
      "local a, b = sphere(5, {fn = 48}), sphere(5, {fn = 48}):translate(20, 3, 1)\n"
      "local g = a:gap(b) assert(abs(g - b:gap(a)) < 1e-12 and g > 10.2 and g < 10.4)");
  // Turned, so that corners are rounded.
  expect_good(R"(
    for i = 1, 50 do
      local function turned(s) return s:rotate(0.37 * i, 0.91 * i, 1.7 * i) end
      local hollow = turned(cube(10, true) - cube(8, true))
      assert(hollow:gap(turned(cube(2, true):translate(3, 0.5, 0))) == 0)
      local g = hollow:gap(turned(cube(2, true):translate(2.875, 0.5, 0)))
      assert(math.abs(g - 0.125) < 1e-5, g)
    end)");
  EXPECT_EQ(message_of("cube(1):gap()"), "model.lua:1: gap: needs the other solid");
  EXPECT_EQ(message_of("cube(1):gap(5)"),
            "model.lua:1: gap: option 'other' must be a solid, got 5");
  EXPECT_EQ(message_of("cube(1):gap(cube(1) - cube(2))"),
            "model.lua:1: gap: there is nothing in one of them");
}

}  // namespace
}  // namespace csgrun::testing::selecting_test
