// Edges chosen by what scripts give: each form means the edges it names, and none ends the program.
#include "lua_support.h"

namespace csgrun::testing::edges_test {
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

TEST(EdgeChoice, PolesOfRoundBodiesHaveNoEdges) {
  expect_good(R"(
    for _, fn in ipairs{10, 12, 16, 24, 32, 48, 100} do
      local ball = sphere{5, fn = fn}
      assert(#ball:edges() == 0)
      assert(#ellipsoid{5, 4, 3, fn = fn}:edges() == 0)
      -- A rim of fn edges, and both ends of a hole through the poles.
      assert(#(ball * cube(20):translate(-10, -10, 0)):edges() == fn)
      assert(#(ball - cube{1, 1, 20, center = true}):edges() >= 12)
    end
    assert(#sphere{5, fn = 6}:edges() > 0))");
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
    local function left(edges) return two:chamfer(1, {edges = edges}):volume() end
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

TEST(EdgeCuts, LeaveWhatTouchesTheEdge) {
  // One of two cubes that touch: the cut is that of a cube alone, and there are no scraps of it.
  expect_good(kTouching + R"(
    local one = cube(10)
    local top = {near = {5, 10, 10}}
    assert(two:chamfer(2, {edges = top}):volume() == 1980)
    assert(#two:chamfer(2, {edges = top}):faces() == 13)
    local round = {edges = top, fn = 32}
    assert(math.abs(two:fillet(2, round):volume() - 1000 - one:fillet(2, round):volume()) < 1e-5)
    for how, count in pairs{chamfer = 52, fillet = 2 * #one:fillet(1, {fn = 16}):faces()} do
      local all = two[how](two, 1, {fn = how == "fillet" and 16 or nil})
      assert(#all:faces() == count and all:components() == 2)
      local alone = one[how](one, 1, {fn = how == "fillet" and 16 or nil})
      assert(all == alone + alone:translate(10, 10, 0))
    end)");
  // A corner on an edge's end, and one on the middle of a face beside it.
  expect_good(R"(
    local block, peg = cube(20, 20, 5), cube(3)
    local both = block + peg:translate(20, 20, 5)
    assert(both:chamfer(1) == block:chamfer(1) + peg:chamfer(1):translate(20, 20, 5)))");
}

TEST(EdgeCuts, LeaveWhatIsNearToTheEdge) {
  // A micrometre away, upright and turned; and the far side of a narrow slot.
  expect_good(R"(
    local pair = cube(10) + cube(10):translate(10.001, 0, 0)
    assert(pair:chamfer(2, {edges = {near = {10, 5, 10}}}):volume() == 1980)
    local turned = pair:rotate(20, 30, 40):chamfer(2)
    assert(turned:components() == 2 and #turned:faces() == 52)
    assert(math.abs(turned:volume() - 2 * cube(10):chamfer(2):volume()) < 1e-4)
    local slot = cube(20, 10, 10) - cube(0.0015, 12, 5):translate(10, -1, 5.5)
    for _, s in ipairs{slot, slot:rotate(20, 30, 40)} do
      local found = 0
      for _, e in ipairs(s:edges()) do
        if e.convex and math.abs(e.length - 10) < 1e-6 then
          local cut = s:chamfer(1, {edges = e})
          found = found + 1
          assert(math.abs(s:volume() - cut:volume() - 5) < 1e-6 and #cut:faces() == #s:faces() + 1)
        end
      end
      assert(found == 12)
    end)");
}

TEST(EdgeCuts, SayWhereTheyCannotLeaveWhatTouches) {
  const std::string said = message_of(kTouching + "two:rotate(20, 30, 40):fillet(1)");
  EXPECT_EQ(said.rfind("model.lua:2: fillet: the solid touches the edge from {", 0), 0u) << said;
  EXPECT_NE(said.find("before it is turned"), std::string::npos) << said;
}

TEST(EdgeCuts, AreTheSameFarFromTheOrigin) {
  // On coarser grids, which a scene beyond 134 mm has, as many points as beside the origin: a
  // rounded cube's, and three at each corner of a chamfered one.
  expect_good(R"(
    for _, x in ipairs{0, 20.5, 200, 351.5, 1000} do
      for _, r in ipairs{0.25, 0.5, 1, 1.5, 2.5} do
        local moved = translate(x, 0, 0)
        assert(#(moved * cube(10):chamfer(r)):mesh().points == 24, x .. " " .. r)
        local rounded = cube{10, 10, 10, r = r, fn = 16}
        assert(#(moved * cube(10):fillet(r, {fn = 16})):mesh().points == #rounded:mesh().points,
               x .. " " .. r)
      end
    end)");
}

// Where two balls leave less between them than the halves of an edge's prism reach into one
// another.
TEST(EdgeCuts, AreTheRoundedBoxUpToHalfOfASide) {
  expect_good(R"(
    for _, r in ipairs{4, 4.99, 4.995, 4.999, 4.9999, 5} do
      for _, size in ipairs{{10, 20, 30}, {10, 10, 10}} do
        local cut = cube(size):fillet(r, {fn = 16})
        local rounded = cube{size[1], size[2], size[3], r = r, fn = 16}
        assert((rounded - cut):volume() == 0 and (cut - rounded):volume() == 0, r)
      end
    end)");
}

// Not the size that fits the edge that is named: another one may have less room.
TEST(EdgeCuts, SayWhatFitsAllOfThem) {
  const std::string part =
      "local l = polygon{{0, 0}, {20, 0}, {20, 6}, {8, 6}, {8, 14}, {0, 14}}:linear_extrude(8)\n";
  for (const char* size : {"3.1", "4.0001", "50"}) {
    const std::string said = message_of(part + "return l:chamfer(" + size + ", {edges = 'top'})");
    EXPECT_EQ(said.substr(said.rfind(':')), ": 3 fits") << said;
  }
  expect_good(part + "assert(math.abs(l:chamfer(3, {edges = 'top'}):volume() - 1202) < 1e-6)");
}

TEST(EdgeCuts, HaveNoMorePointsThanASolidMay) {
  EXPECT_EQ(message_of("cube(10):fillet(1, {fn = 20000})"),
            "model.lua:1: fillet: 20000 fragments make 200120000 points, the limit is 16777216");
}

TEST(EdgeCuts, AreMadeWhereTheyAreCalled) {
  const ScriptRun run("local c = cube(10)\nlocal d = c:chamfer(1, 'z')\nreturn d");
  ASSERT_EQ(run.outcome.status, ScriptStatus::kGood) << run.outcome.message;
  const Node& cut = *run.session.parts().at(0).solid;
  EXPECT_EQ(cut.where().line, 2);
  ASSERT_EQ(cut.children().size(), 5u);
  EXPECT_EQ(cut.children()[0]->where().line, 1);
  EXPECT_EQ(cut.children()[1]->where().line, 2);
}

TEST(EdgeCuts, SmallOnesAreOfSeveralGridSteps) {
  expect_good(R"(
    local big = cube(1000):rotate(20, 30, 40)
    assert(big:chamfer(0.01):components() == 1 and #big:chamfer(0.01):faces() == 26)
    assert(math.abs(1e9 - big:chamfer(0.01):volume() - 0.6) < 1e-3)
    assert(big:fillet(0.01, {fn = 8}):components() == 1)
    assert(#cube(1000):chamfer(0.0001):faces() == 26))");
  const std::string said = message_of("cube(1000):rotate(20, 30, 40):chamfer(0.001)");
  EXPECT_EQ(said.rfind("model.lua:1: chamfer: that is too little for the edge from {", 0), 0u)
      << said;
}

}  // namespace
}  // namespace csgrun::testing::edges_test
