// levelset, refine, smooth, warp: against closed formulas and identities, and their messages.
#include "lua_support.h"

namespace csgrun::testing {
namespace {

const std::string kNear =
    "local function near(a, b, by) assert(math.abs(a - b) <= by, a .. ' is not ' .. b) end ";

// A lattice that the corners lie on gives a box exactly; a ball comes nearer with the square of the
// step.
TEST(LevelSet, GivesKnownSolids) {
  expect_good(
      kNear +
      "local function box(x, y, z) return math.max(math.abs(x) - 2, math.abs(y) - 3, "
      "math.abs(z) - 1) end local s = levelset(box, {min = {-4, -4, -4}, max = {4, 4, 4}}, "
      "0.5) assert((s ~ cube{4, 6, 2, center = true}):is_empty()) "
      "local function ball(x, y, z) return norm{x, y, z} - 5 end local function short(step) "
      "local b = levelset(ball, {{-6, -6, -6}, {6, 6, 6}}, step) assert(b:genus() == 0 and "
      "b:components() == 1) return 4 / 3 * math.pi * 125 - b:volume() end near(short(1) / "
      "short(0.5), 4, 0.5) near(short(0.5), 0, 4) local e = levelset{f = function(x, y, z) "
      "return 5 - norm{x, y, z} end, bounds = {{-6, -6, -6}, {6, 6, 6}}, step = 1, inside = "
      "'positive'} near(e:volume(), levelset(ball, {{-6, -6, -6}, {6, 6, 6}}, 1):volume(), "
      "1e-9)");
}

// What reaches out of the bounds is cut off, in faces that lie on them.
TEST(LevelSet, EndsAtItsBounds) {
  expect_good(
      "local all = levelset(function(x, y, z) return x - 100 end, {{0, 0, 0}, {3, 4, 5}}, 1) "
      "assert((all ~ cube(3, 4, 5)):is_empty()) local g = levelset(function(x, y, z) return sin(90 "
      "* "
      "x) * cos(90 * y) + sin(90 * y) * cos(90 * z) + sin(90 * z) * cos(90 * x) end, {{0, 0, 0}, "
      "{4, "
      "4, 4}}, 0.25) local b = g:bbox() for i = 1, 3 do assert(b.min[i] == 0 and b.max[i] == 4) "
      "end "
      "assert(g:volume() > 28 and g:volume() < 36) "
      "local none = levelset(function(x, y, z) return x end, {{-1, 0, 0}, {1, 1, 1}}, 0.5) "
      "assert((none ~ cube(1, 1, 1):translate(-1, 0, 0)):is_empty())");
}

TEST(LevelSet, Mistakes) {
  const std::string bounds = ", {{-6, -6, -6}, {6, 6, 6}}";
  EXPECT_EQ(message_of("levelset(5" + bounds + ", 1)"),
            "model.lua:1: levelset: option 'f' must be a function of x, y, z, got 5");
  EXPECT_EQ(
      message_of("levelset(function() return 1 end)"),
      "model.lua:1: levelset: option 'bounds' must be {{x, y, z}, {x, y, z}} or {min = {x, y, "
      "z}, max = {x, y, z}}");
  EXPECT_EQ(
      message_of("levelset(function() return 1 end, {{0, 0}, {1, 1, 1}}, 1)"),
      "model.lua:1: levelset: option 'bounds' must be {{x, y, z}, {x, y, z}} or {min = {x, y, "
      "z}, max = {x, y, z}}, got a list of 2 values for a corner");
  EXPECT_EQ(message_of("levelset(function() return 1 end" + bounds + ")"),
            "model.lua:1: levelset: option 'step' is missing: a number");
  EXPECT_EQ(message_of("levelset(function() return 1 end" + bounds + ", 0)"),
            "model.lua:1: levelset: option 'step' must be positive, got 0");
  EXPECT_EQ(message_of("levelset(function() return 1 end" + bounds + ", 1e-3)"),
            "model.lua:1: levelset: the step is too small for these bounds: the lattice would have "
            "more than 268435456 points");
  EXPECT_EQ(message_of("levelset(function() return 1 end" + bounds + ", 1)"),
            "model.lua:1: levelset: the function is nowhere negative within the bounds");
  EXPECT_EQ(
      message_of("levelset(function(x, y, z) return 5 - norm{x, y, z} end, {{-6, -6, -6}, {6, "
                 "6, 6}}, 12)"),
      "model.lua:1: levelset: the function is negative outside and not inside; say inside = "
      "\"positive\"");
  EXPECT_EQ(message_of("levelset(function(x) return nil end" + bounds + ", 1)"),
            "model.lua:1: levelset: the function must give a finite number, but at (-6, -6, -6) it "
            "gave nil");
  EXPECT_EQ(message_of("levelset(function(x) return 1 end, {{1, 0, 0}, {0, 1, 1}}, 1)"),
            "model.lua:1: levelset: the bounds must be a box: the second corner greater than the "
            "first");
  EXPECT_EQ(message_of("levelset(function(x) return 1 end" + bounds + ", {step = 1, insid = 'x'})"),
            "model.lua:1: levelset: unknown option 'insid' (did you mean 'inside'?)");
  EXPECT_EQ(message_of("levelset(function(x) error('no') end" + bounds + ", 1)"),
            "model.lua:1: no");
}

// Where halves of edges lie on the grid, refining changes no point of the surface, and leaves no
// edge longer than asked.
TEST(Reshape, RefineKeepsTheSolid) {
  expect_good(
      "local s = cube(7, 5, 3) - cylinder{h = 3, r = 1, fn = 4}:translate(3, 2, 0) local r = "
      "s:refine(0.6) assert((s ~ r):is_empty()) local m, longest = r:mesh(), 0 for _, f in "
      "ipairs(m.faces) do for k = 1, 3 do local a, b = m.points[f[k] + 1], m.points[f[k % 3 + 1] + "
      "1] longest = math.max(longest, norm{a[1] - b[1], a[2] - b[2], a[3] - b[3]}) end end "
      "assert(longest <= 0.6 and longest > 0.29) assert((cube(1) - cube(1)):refine(1):is_empty())");
}

// A shear keeps the volume, a scaling multiplies it; what is turned over is turned back.
TEST(Reshape, WarpMovesCorners) {
  expect_good(
      kNear +
      "local s = cube(30, 4, 4) near(s:warp(function(x, y, z) return x, y + 3 * sin(x * 12), "
      "z end, {length = 1}):volume(), 480, 1e-6) near(s:warp(function(x, y, z) return {2 * x, "
      "y, z} end):volume(), 960, 1e-6) near(s:warp(function(x, y, z) return -x, y, z "
      "end):volume(), 480, 1e-6) assert((s:warp(function(x, y, z) return x, y, z end) ~ "
      "s):is_empty())");
  EXPECT_EQ(
      message_of("return cube(1):warp(function(x) return x end)"),
      "model.lua:1: warp: the function must give three finite numbers, which it did not at (0, "
      "0, 0)");
  EXPECT_EQ(message_of("return cube(1):warp(3)"),
            "model.lua:1: warp: option 'f' must be a function of x, y, z, got 3");
  EXPECT_EQ(message_of("return warp(3, print)").substr(0, 56),
            "model.lua:1: warp: the first argument must be a solid, g");
}

// Loop's scheme: a regular octahedron's corners (valence 4) move to 1 - 4 w of their place and w
// from each neighbour, w = (5/8 - (3/8 + cos(90) / 4)^2) / 4 = 31/256; the neighbours cancel, so
// one step leaves 33/64 of them.
TEST(Reshape, SmoothIsLoop) {
  expect_good(
      kNear +
      "local o = polyhedron{points = {{1,0,0},{-1,0,0},{0,1,0},{0,-1,0},{0,0,1},{0,0,-1}}, "
      "faces = {{4,2,0},{4,1,2},{4,3,1},{4,0,3},{5,0,2},{5,2,1},{5,1,3},{5,3,0}}} local s = "
      "o:smooth(1) local r = 1 - 4 * 31 / 256 local b = s:bbox() near(b.max[1], r, 1e-6) "
      "assert(#s:mesh().points == 18 and #s:mesh().faces == 32 and s:genus() == 0) "
      "local holed = (cube(10) - cylinder{h = 10, r = 3}:translate(5, 5, 0)):smooth(2, "
      "{length = 3}) assert(holed:genus() == 1 and holed:components() == 1)");
  EXPECT_EQ(message_of("return cube(1):smooth(9)"),
            "model.lua:1: smooth: option 'steps' must be at most 8, got 9");
  EXPECT_EQ(message_of("return cube(1):smooth(1.5)").substr(0, 40),
            "model.lua:1: smooth: option 'steps' must");
}

// The colour of a face stays with its parts.
TEST(Reshape, KeepsColours) {
  const ScriptRun run(
      "return (cube(4):color('red') + cube(2):translate(4, 0, 0):color('lime')):smooth(1, {length "
      "= "
      "1})");
  ASSERT_EQ(run.outcome.status, ScriptStatus::kGood) << run.outcome.message;
  const Node* node = run.session.parts().at(0).solid.get();
  ASSERT_EQ(node->kind(), NodeKind::kLeaf);
  const PolygonMesh& mesh = *node->mesh();
  size_t red = 0, green = 0;
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    const glm::dvec3& p = mesh.points[mesh.corners[mesh.loop_starts[f]]];
    const Appearance& a = mesh.appearances[mesh.appearance_of[f]];
    (a.red > a.green ? red : green) += 1;
    if (p.x < 3) {
      EXPECT_GT(a.red, a.green) << p.x;
    } else if (p.x > 4.6) {
      EXPECT_GT(a.green, a.red) << p.x;
    }
  }
  EXPECT_GT(red, green);
  EXPECT_GT(green, 100u);
}

}  // namespace
}  // namespace csgrun::testing
