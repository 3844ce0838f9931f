// The library that the program carries: csg.gears, csg.layout, csg.options, csg.threads. Against
// formulas, against one another (what meshes must not collide), and their messages.
#include "lua_bindings/shipped_modules.h"
#include "lua_support.h"

namespace csgrun::testing::library_test {
namespace {

const std::string kGears = "local gears = require 'csg.gears' ";
const std::string kLayout = "local layout = require 'csg.layout' ";
const std::string kThreads = "local threads = require 'csg.threads' ";
const std::string kNear =
    "local function near(a, b, by) assert(math.abs(a - b) <= (by or 1e-6), a .. ' is not ' .. b) "
    "end ";

TEST(Library, ModulesAreFoundByNameOnly) {
  for (const ShippedModule& module : shipped_modules()) {
    expect_good("assert(require '" + std::string(module.name) + "' == require '" +
                std::string(module.name) + "')");
  }
  const std::string message = ScriptRun("require 'csg.gear'").outcome.message;
  EXPECT_EQ(
      message.rfind("model.lua:1: require: module 'csg.gear' not found:\n\tnot in the library "
                    "of csgrun (did you mean 'csg.gears'?)\n\tno file",
                    0),
      0u)
      << message;
}

/// What a model has among its globals is the model's own affair.
TEST(Library, KeepsItsOwnGlobals) {
  const std::string measures =
      "return threads.nut{size = 'M4'}:volume() + threads.bolt{size = 'M4', length = 6}:volume() + "
      "gears.spur{module = 1, teeth = 12, width = 3}:volume() ";
  const std::string replaced =
      "sin, cos, tan = math.sin, math.cos, math.tan cylinder, anchor, down = 1, 2, 3 ";
  expect_good(kThreads + kGears + "local function all() " + measures + "end local before = all() " +
              replaced + "assert(all() == before)");
  expect_good("local before = (function() " + kThreads + kGears + measures + "end)() " + kThreads +
              "assert(before > 0) " + replaced + "assert(sin(math.pi) < 1e-9)");
  expect_good(replaced + kThreads + kGears + "local all = (function() " + measures +
              "end)() assert(all > 100)");
}

TEST(Library, NamesThatAreNotThere) {
  for (const std::string name : {"threads", "thread", "csg.thread"}) {
    const std::string message = ScriptRun("require '" + name + "'").outcome.message;
    EXPECT_NE(message.find("\n\tnot in the library of csgrun (did you mean 'csg.threads'?)\n"),
              std::string::npos)
        << message;
  }
  const std::string other = ScriptRun("require 'wheel'").outcome.message;
  EXPECT_EQ(other.find("library"), std::string::npos) << other;
  EXPECT_EQ(message_of(kThreads + "threads.bold{size = 'M8', length = 9}"),
            "model.lua:1: csg.threads has no 'bold' (did you mean 'bolt'?)");
  EXPECT_EQ(message_of(kGears + "return gears.crown"), "model.lua:1: csg.gears has no 'crown'");
  expect_good(kLayout +
              "local n = 0 for name in pairs(layout) do n = n + 1 end assert(n > 5) "
              "assert(#layout == 0 and layout[1] == nil and not getmetatable(layout))"
              "layout.own = 3 assert(layout.own == 3)");
}

TEST(Library, OptionsAreChecked) {
  const std::string wheel =
      "local options = require 'csg.options' local function wheel(given) local o = "
      "options('wheel', "
      "given, {spokes = {5, min = 3, max = 9, whole = true}, radius = {type = 'number', above = 0},"
      " name = {type = 'string', optional = true}, finish = {'plain', choices = {'plain', "
      "'worn'}}})"
      " return o end ";
  expect_good(
      wheel +
      "local o = wheel{radius = 2} assert(o.spokes == 5 and o.radius == 2 and o.name == nil "
      "and o.finish == 'plain') assert(wheel{radius = 1, spokes = 3, name = 'x', finish = "
      "'worn'}.finish == 'worn')");
  const auto message = [&](const std::string& call) { return message_of(wheel + call); };
  EXPECT_EQ(message("wheel{radius = 1, spoke = 4}"),
            "model.lua:1: wheel: unknown option 'spoke' (did you mean 'spokes'?)");
  EXPECT_EQ(message("wheel{radius = 1, zzz = 4}"),
            "model.lua:1: wheel: unknown option 'zzz'; it has finish, name, radius, spokes");
  EXPECT_EQ(message("wheel{}"), "model.lua:1: wheel: option 'radius' is missing");
  EXPECT_EQ(message("wheel{radius = '1'}"),
            "model.lua:1: wheel: option 'radius' must be a number, got \"1\"");
  EXPECT_EQ(message("wheel{radius = 0}"),
            "model.lua:1: wheel: option 'radius' must be greater than 0, got 0");
  EXPECT_EQ(message("wheel{radius = 0/0}").substr(0, 61),
            "model.lua:1: wheel: option 'radius' must be a finite number, ");
  EXPECT_EQ(message("wheel{radius = 1, spokes = 2}"),
            "model.lua:1: wheel: option 'spokes' must be at least 3, got 2");
  EXPECT_EQ(message("wheel{radius = 1, spokes = 10}"),
            "model.lua:1: wheel: option 'spokes' must be at most 9, got 10");
  EXPECT_EQ(message("wheel{radius = 1, spokes = 3.5}"),
            "model.lua:1: wheel: option 'spokes' must be a whole number, got 3.5");
  EXPECT_EQ(message("wheel{radius = 1, finish = 'new'}"),
            "model.lua:1: wheel: option 'finish' must be one of \"plain\", \"worn\", got \"new\"");
  EXPECT_EQ(message("wheel(5)"), "model.lua:1: wheel: wants a table of options, got 5");
  EXPECT_EQ(message("wheel{radius = 1, 7}"),
            "model.lua:1: wheel: its options are named, got 7 without a name");
}

// A call that a model makes last leaves its line, though Lua gives up the frame of one that does
// so.
TEST(Library, MistakesAreNamedInTheModel) {
  const auto first_lines = [](const std::string& text) {
    const std::string message = ScriptRun(text).outcome.message;
    return message.substr(0, message.find('\n'));
  };
  const auto expect_place = [&](const std::string& text, const std::string& place) {
    const std::string message = first_lines(text);
    EXPECT_EQ(message.substr(0, place.size()), place) << text << "\n" << message;
  };
  for (const std::string call : {
           "spur{teeths = 20, module = 1, width = 3}",
           "spur{teeth = 20, module = 1, width = 3, bore = 99}",
           "spur{teeth = 4, module = 1, width = 3, pressure = 45}",
           "outline{teeth = 20}",
           "ring{teeth = 20, module = 1, width = -1}",
           "rack{teeth = 20, module = 1, width = 3, pressure = 45, clearance = 1}",
           "distance(20.5, 10, {module = 1})",
           "meshed(cube(1), 20, 10, {})",
       }) {
    expect_place(kGears + "\n\nreturn gears." + call, "model.lua:3: gears.");
    expect_place(kGears + "\nlocal g = gears." + call + "\nreturn g", "model.lua:2: gears.");
    expect_place(kGears + "\nlocal function f()\nreturn gears." + call + "\nend\nreturn f()",
                 "model.lua:3: gears.");
    expect_place(kGears + "\nlocal ok, message = pcall(function()\nreturn gears." + call +
                     " end)\nerror(message, 0)",
                 "model.lua:3: gears.");
    expect_place(kGears + "\nlocal make = coroutine.wrap(function()\nreturn gears." + call +
                     " end)\nreturn make()",
                 "model.lua:3: gears.");
  }
  for (const std::string call :
       {"row{cube(1), cube(1):skip()}", "row(5)", "row({cube(1)}, {gaps = 1})", "row{1}",
        "stack({cube(1)}, {align = 'top'})", "line(cube(1), 0, {})", "line(cube(1), 2, {})",
        "line(1, 2, {step = {1}})", "ring(cube(1), 'x')", "at(cube(1), 5)", "at(cube(1), {5})",
        "place(cube(1), 'top')"}) {
    expect_place(kLayout + "\n\nreturn layout." + call, "model.lua:3: layout.");
  }
  for (const std::string call : {"size('M99')", "bolt{size = 'M8', lenght = 3}", "nut{}"})
    expect_place(kThreads + "\n\nreturn threads." + call, "model.lua:3: threads.");
  // Whoever uses csg.options may return what it gives.
  expect_place(
      "local options = require 'csg.options'\nlocal function wheel(given)\nreturn "
      "options('wheel', given, {spokes = {5}})\nend\nlocal o = wheel{spoke = 4}",
      "model.lua:5: wheel: unknown option");
  // A rule that is none is told where the rules are.
  for (const std::string rules : {"5", "{spokes = 5}", "{'spokes'}", "{spokes = {min = 3}}"}) {
    expect_place(
        "local options = require 'csg.options'\nlocal function wheel(given)\nlocal o = "
        "options('wheel', given, " +
            rules + ")\nreturn o\nend\nlocal o = wheel{spokes = 4}",
        "model.lua:3: csg.options: ");
  }
  // What Lua says inside of the library, and what built-in functions say there.
  expect_place(kLayout + "\n\nreturn layout.at(cube(1), {{'x'}})", "model.lua:3: translate: ");
  expect_place(kLayout +
                   "\nlocal odd = setmetatable({}, {__index = function() return -true end})"
                   "\nreturn layout.place(cube(1), 'top', odd)",
               "model.lua:2: attempt to perform arithmetic");
  for (const std::string point : {"{x = 1, y = 2}", "{1}", "{1, nil, 3}", "{'a', 2, 3}"}) {
    expect_place(kLayout + "\n\nreturn layout.place(cube(1), 'top', " + point + ")",
                 "model.lua:3: layout.place: wants a point {x, y, z}, but entry ");
  }
}

TEST(Library, ErrorHasItsLevelsInModels) {
  const std::string at =
      "local function f(level) error('x', level) end\nlocal function g(level) f(level) end\n";
  const auto message = [&](const std::string& level) {
    return message_of(at + "local ok, m = pcall(function()\ng(" + level +
                      ")\nend)\nerror(m == 'x' and 'bare' or m, 0)");
  };
  EXPECT_EQ(message("1"), "model.lua:1: x");
  EXPECT_EQ(message("2"), "model.lua:2: x");
  EXPECT_EQ(message("3"), "model.lua:4: x");
  EXPECT_EQ(message("0").substr(message("0").size() - 4), "bare");
  expect_good("local ok, m = pcall(error, 'x') assert(not ok and m == 'x')");
  expect_good("local t = {} local ok, m = pcall(error, t, 2) assert(m == t)");
  expect_good("local ok, m = pcall(error) assert(not ok and m == nil)");
}

// The nodes that it makes stand where the model called it, and its callbacks may yield.
TEST(Library, PartsStandInTheModel) {
  const ScriptRun run(kLayout + "\n\nreturn layout.row{cube(1), cube(2)}");
  ASSERT_EQ(run.outcome.status, ScriptStatus::kGood) << run.outcome.message;
  for (const ScriptPart& part : run.session.parts())
    EXPECT_EQ(part.solid->where().text(), "model.lua:3") << part.name;
}

// Teeth in mesh leave each other alone, whatever the pair; without backlash and half a pitch off
// they collide.
TEST(Gears, Mesh) {
  const char* const kPairs[] = {
      "gears.spur{teeth = 24, module = 2, width = 3, backlash = 0.02}, 24, 17, {module = 2, at = "
      "33}",
      "gears.spur{teeth = 31, module = 2, width = 3, backlash = 0.02, helix = 15}, 31, 17, {module "
      "= "
      "2, at = -70}",
      "gears.spur{teeth = 20, module = 2, width = 3, backlash = 0.02, helix = 25, herringbone = "
      "true}, 20, 17, {module = 2}",
  };
  for (const std::string pair : kPairs) {
    const bool is_helical = pair.find("helix") != std::string::npos;
    const std::string helix = !is_helical ? ""
                              : pair.find("herring") != std::string::npos
                                  ? ", helix = -25, herringbone = true"
                                  : ", helix = -15";
    expect_good(kGears +
                "local function at(turn, first, n, m, o) local second = gears.spur{teeth = "
                "17, module = 2, width = 3, backlash = 0.02" +
                helix +
                "} return first * gears.meshed(second:rotate(turn), n, m, o) end "
                "assert(at(0, " +
                pair + "):is_empty()) assert(at(360 / 34, " + pair + "):volume() > 1)");
  }
  expect_good(
      kGears +
      "local ring = gears.ring{teeth = 60, module = 1, width = 2, backlash = 0.02} local "
      "planet = gears.spur{teeth = 18, module = 1, width = 2, backlash = 0.02} for _, at in "
      "ipairs{0, 41, 190} do assert((ring * gears.meshed(planet, 60, 18, {module = 1, "
      "internal = true, at = at})):is_empty()) assert((ring * "
      "gears.meshed(planet:rotate(10), 60, 18, {module = 1, internal = true, at = "
      "at})):volume() > 0.1) end assert(gears.distance(60, 18, {module = 1, internal = true})"
      " == 21)");
  expect_good(
      kGears +
      "local rack = gears.rack{teeth = 7, module = 2, width = 3, backlash = 0.02} local gear "
      "= gears.spur{teeth = 20, module = 2, width = 3, backlash = 0.02}:rotate(-90 + 9):"
      "translate(3 * math.pi * 2, 20, 0) assert((rack * gear):is_empty()) assert((rack * "
      "gear:translate(math.pi, 0, 0)):volume() > 1)");
}

TEST(Gears, Measures) {
  // The bore is a prism of 4 x teeth sides. Corners are on a grid of a nanometre.
  expect_good(
      kGears + kNear +
      "local o = {teeth = 40, module = 1, width = 2} local r = gears.radii{teeth = 40, module = 1} "
      "near(r.pitch, "
      "20) near(r.tip, 21) near(r.root, 18.75) near(r.base, 20 * cos(20)) local whole = "
      "gears.spur(o):volume() o.bore = 10 near(whole - gears.spur(o):volume(), 2 * 160 / 2 * "
      "25 * sin(360 / 160), 1e-4) o.herringbone, o.helix, o.bore = true, 20, nil local v = "
      "gears.spur(o) assert(v:components() == 1 and v:genus() == 0) near(v:volume() / whole, "
      "1, 0.01) near(gears.outline{teeth = 40, module = 1}:area() * 2, whole, 1e-4)");
  // The tooth is half a pitch wide at the pitch circle, less the backlash.
  expect_good(
      kGears + kNear +
      "local rack = gears.rack{teeth = 3, module = 2, width = 1, backlash = 0.5, height = 1} "
      "local p = math.pi * 2 local strip = cube(3 * p, 1e-3, 1):translate(-p / 2, -5e-4, 0) "
      "near((rack * strip):volume() / 1e-3, 3 * (p / 2 - 0.5), 1e-4)");
}

TEST(Gears, Mistakes) {
  const auto message = [](const std::string& call) { return message_of(kGears + call); };
  EXPECT_EQ(
      message("gears.spur{teeth = 24, module = 2, width = 8, bore = 80}"),
      "model.lua:1: gears.spur: option 'bore' must be less than 43.0, the diameter at the roots "
      "of the teeth, got 80");
  EXPECT_EQ(message("gears.spur{teeth = 6, module = 2, width = 8, shift = 1}"),
            "model.lua:1: gears.spur: the teeth come to a point below their tips: take less shift, "
            "less backlash or a smaller pressure angle");
  EXPECT_EQ(message("gears.ring{teeth = 40, module = 2, width = 8, rims = 3}"),
            "model.lua:1: gears.ring: unknown option 'rims' (did you mean 'rim'?)");
  EXPECT_EQ(message("gears.rack{teeth = 40, module = 2, width = 8, pressure = 44}"),
            "model.lua:1: gears.rack: the teeth come to a point below their tips");
  EXPECT_EQ(message("gears.meshed(cube(1), 2.5, 3, {module = 2})"),
            "model.lua:1: gears.meshed: wants two numbers of teeth, whole ones, got 2.5 and 3");
}

// 40 / 2 is 20.0 in Lua.
TEST(Library, WholeNumbersMayBeFloats) {
  expect_good(kGears + kLayout +
              "assert(gears.distance(40 / 2, 30, {module = 1}) == 25) "
              "local g = gears.spur{teeth = 10, module = 1, width = 1} "
              "assert(g == gears.spur{teeth = 20 / 2, module = 1, width = 1}) "
              "assert(gears.meshed(g, 40 / 2, 20 / 2, {module = 1}) == "
              "gears.meshed(g, 20, 10, {module = 1})) "
              "assert(#layout.ring(cube(1), 12 / 2) == 6) "
              "assert(layout.line(cube(1), 6 / 2, {to = {8, 0, 0}})[2]:bbox().min.x == 4) "
              "local options = require 'csg.options' "
              "local o = options('f', {n = 8 / 2}, {n = {1, whole = true}, x = {4 / 2}}) "
              "assert(math.type(o.n) == 'integer' and o.n == 4 and math.type(o.x) == 'float')");
  EXPECT_EQ(message_of(kLayout + "return layout.ring(cube(1), 6.5)"),
            "model.lua:1: layout.ring: wants how many, a whole number from 1, got 6.5");
  EXPECT_EQ(message_of(kLayout + "return layout.ring(cube(1), '6')"),
            "model.lua:1: layout.ring: wants how many, a whole number from 1, got 6");
}

// What stands behind a nil is not lost.
TEST(Library, ListsHaveNoHoles) {
  const auto message = [](const std::string& call) { return message_of(kLayout + call); };
  for (const std::string function : {"row", "stack", "grid"}) {
    const std::string place = "model.lua:1: layout." + function + ": ";
    EXPECT_EQ(message("layout." + function + "{cube(1), nil, cube(2)}"),
              place + "part 2 must be a solid, got nil");
    EXPECT_EQ(message("layout." + function + "{nil, cube(2)}"),
              place + "part 1 must be a solid, got nil");
    EXPECT_EQ(message("layout." + function + "{cube(1), cube(2), gap = 3}"),
              place + "what it places must be a list without names, got the key 'gap'");
  }
  EXPECT_EQ(message("layout.at(cube(1), {{0, 0}, nil, {5, 5}})"),
            "model.lua:1: layout.at: point 2 must be {x, y, z}, got nil");
  EXPECT_EQ(message("layout.at(cube(1), {{0, 0}, {nil, 5}})"),
            "model.lua:1: layout.at: point 2 must be {x, y, z}, but entry 1 is nil");
  EXPECT_EQ(message("layout.at(cube(1), {{x = 1, y = 2}})").substr(0, 63),
            "model.lua:1: layout.at: point 1 must be a list without names, g");
  EXPECT_EQ(message("layout.line(cube(1), 3, {to = {9, nil, 5}})"),
            "model.lua:1: layout.line: option 'to' must be {x, y, z}, but entry 2 is nil");
  EXPECT_EQ(
      message_of("require('csg.options')('f', {a = 'c'}, {a = {'a', choices = {'a', nil, 'b'}}})"),
      "model.lua:1: f: option 'a' must be one of \"a\", \"b\", got \"c\"");
  expect_good(kLayout +
              "local parts = {cube(1), cube(2), nil} assert(#layout.row(parts) == 2) "
              "assert(#layout.at(cube(1), {vec(1, 2), vec{1, 2, 3}}) == 2)");
}

TEST(Threads, BoltAndNutFit) {
  expect_good(
      kThreads +
      "local bolt = threads.bolt{size = 'M8', length = 16, threaded = 12, facets = 24} local "
      "nut = threads.nut{size = 'M8', clearance = 0.1, facets = 24}:up(5.3 + 4 + 2.5) "
      "assert((bolt * nut):is_empty()) assert((bolt * nut:up(0.625)):volume() > 0.5) "
      "assert(bolt:components() == 1 and bolt:genus() == 0 and nut:genus() == 1)");
  // A left-handed one is the mirror image.
  expect_good(
      kThreads + kNear +
      "local o = {d = 12, pitch = 3, length = 9, profile = 'trapezoidal', starts = 2, facets "
      "= 24} local right = threads.thread(o) o.left = true local left = threads.thread(o) "
      "assert((right:mirror(0, 1, 0) ~ left):is_empty()) assert((right ~ left):volume() > "
      "1) o.chamfer = true assert((threads.thread(o) - left):is_empty())");
}

// The section at any height is the outline: the volume is its area times the length, less what the
// facets of the helix cut off: one of them turns by three degrees.
TEST(Threads, FnIsAnotherNameOfFacets) {
  expect_good(
      "local threads = require 'csg.threads' local bolt = {size = 'M8', length = 10} "
      "local function with(key) return threads.bolt{size = 'M8', length = 10, [key] = 12} end "
      "assert(with('fn') == with('facets') and with('fn') ~= threads.bolt(bolt))");
  EXPECT_EQ(message_of("require('csg.threads').hole{size = 'M8', depth = 5, fn = 8, facets = 8}"),
            "model.lua:1: threads.hole: option 'facets' (or 'fn') is given twice");
}

TEST(Threads, Volume) {
  expect_good(
      kThreads + kNear +
      "local h, n = 0.625 * math.sqrt(3) / 2 * 1.5, 240 local sum = 0 local function r(i) "
      "local t = math.abs(i / n % 1 - 0.5) * 2 return 5 - h * math.max(0, math.min(1, (t - "
      "1 / 8) / 0.625)) end for i = 0, n - 1 do sum = sum + r(i) * r(i + 1) * sin(360 / n) / "
      "2 end local v = threads.thread{size = 'M10', length = 6, facets = n}:volume() "
      "assert(v < sum * 6 and v > sum * 6 * cos(1.5) ^ 2)");
  expect_good(
      kThreads +
      "local t = threads.hole{size = 'M5', depth = 8, head = 'socket'} local box = t:bbox() "
      "assert(box.max[3] == 0 and box.min[3] == -8 and box.max[1] == 4.5) assert(threads"
      ".washer{size = 'M5'}:genus() == 1)");
}

TEST(Threads, SizesAreCopies) {
  expect_good(kThreads +
              "local s = threads.size('M8') assert(s.d == 8 and #s.holes == 3 and #s.socket == 3) "
              "s.d, s.holes[1] = 99, 1 "
              "assert(threads.size('M8').d == 8 and threads.size('M8').holes[1] == 8.4)");
}

TEST(Threads, Mistakes) {
  const auto message = [](const std::string& call) { return message_of(kThreads + call); };
  EXPECT_EQ(message("threads.thread{length = 3}"),
            "model.lua:1: threads.thread: wants a size such as \"M8\", or d and pitch");
  EXPECT_EQ(
      message("threads.thread{length = 3, d = 1, pitch = 1}"),
      "model.lua:1: threads.thread: a thread of pitch 1 is deeper than a diameter of 1 has room "
      "for");
  EXPECT_EQ(message("threads.bolt{size = 'M8', lenght = 3}"),
            "model.lua:1: threads.bolt: unknown option 'lenght' (did you mean 'length'?)");
  EXPECT_EQ(message("threads.size('M7')").substr(0, 55),
            "model.lua:1: threads.size: there is no size 'M7'; there");
  EXPECT_EQ(message("threads.washer{size = 'M8', d = 8}"),
            "model.lua:1: threads.washer: option 'd' must be greater than 8.4, got 8");
}

TEST(Layout, Places) {
  const std::string at =
      "local function at(part, x, y, z) local b = part:bbox().min assert(b[1] == x and b[2] == y "
      "and b[3] == z, b[1] .. ' ' .. b[2] .. ' ' .. b[3]) end ";
  expect_good(
      kLayout + at +
      "local a, b = cube(10, 20, 30), cube(2, 4, 6) local row = layout.row({a, b, b}, {gap = "
      "3}) at(row[1], 0, 0, 0) at(row[2], 13, 0, 0) at(row[3], 18, 0, 0) row = layout.row("
      "{a, b}, {axis = 'y', gap = 1, align = 'max'}) at(row[2], 8, 21, 24) local tower = "
      "layout.stack{a, b} at(tower[2], 4, 8, 30) local grid = layout.grid({b, b, a}, "
      "{columns = 2, gap = 1}) at(grid[1], 0, 0, 0) at(grid[2], 11, 0, 0) at(grid[3], -4, "
      "-29, 0)");
  expect_good(
      kLayout + at +
      "local a, b = cube(10, 20, 30), cube(2, 4, 6) at(layout.attach(b, a, 'top'), 4, 8, 30) "
      "at(layout.attach(b, a, 'right back top', {gap = 1}), "
      "11, 21, 31) at(layout.place(b, 'left top', {0, 0, 0}), 0, -2, -6) local p = "
      "layout.anchor(a, 'right') assert(p[1] == 10 and p[2] == 10 and p[3] == 15)");
  expect_good(
      kLayout + at +
      "local c = cube(1) local line = layout.line(c, 3, {step = {2, 0, 0}}) at(line[3], 4, 0, "
      "0) line = layout.line(c, 5, {to = {0, 0, 8}}) at(line[2], 0, 0, 2) local ring = "
      "layout.ring(c, 4, {radius = 10}) at(ring[2], -1, 10, 0) ring = layout.ring(c, 3, "
      "{radius = 10, angle = 180, turn = false}) at(ring[2], 0, 10, 0) at(ring[3], -10, 0, 0)"
      " at(layout.at(c, {{0, 0}, {5, 6, 7}})[2], 5, 6, 7)");
}

TEST(Layout, Mistakes) {
  const auto message = [](const std::string& call) { return message_of(kLayout + call); };
  EXPECT_EQ(
      message("layout.anchor(cube(1), 'topp')"),
      "model.lua:1: anchor: option 'at': there is no side 'topp' (did you mean 'top'?); sides are "
      "left, right, front, back, bottom, top, center, as in \"top-left\"");
  EXPECT_EQ(message("layout.anchor(cube(1), 'top bottom')"),
            "model.lua:1: anchor: option 'at': 'top bottom' has opposite sides");
  EXPECT_EQ(message("layout.row(5)"), "model.lua:1: layout.row: wants a list of solids, got 5");
  EXPECT_EQ(message("layout.row{cube(1) - cube(1)}"), "model.lua:1: layout.row: part 1 is empty");
  EXPECT_EQ(message("layout.stack{cube(1), square(1)}"),
            "model.lua:1: layout.stack: part 2 must be a solid, got a shape, which has no z");
  EXPECT_EQ(message("layout.row({square(1)}, {axis = 'z'})"),
            "model.lua:1: layout.row: part 1 must be a solid, got a shape, which has no z");
  expect_good(kLayout + R"(
    local row = layout.row({square(4, 2), circle(3), square(1, 9)}, {align = "center", gap = 1})
    for i, low in ipairs{0, 5, 12} do
      local box = row[i]:bbox()
      assert(box.min[1] == low and box.min[2] + box.max[2] == 2)
    end)");
  EXPECT_EQ(message("layout.ring(cube(1), 0)"),
            "model.lua:1: layout.ring: wants how many, a whole number from 1, got 0");
  EXPECT_EQ(message("layout.line(cube(1), 3, {})"),
            "model.lua:1: layout.line: wants either step = {x, y, z} or to = {x, y, z}");
  // What a built-in function says of a call inside the library stands at the model's line.
  EXPECT_EQ(
      message("layout.line(cube(1), 3, {step = {1, 2, 'z'}})"),
      "model.lua:1: linear_array: option 'v' must be a list of two or three numbers, but entry 3 "
      "is the string \"z\"");
  EXPECT_EQ(message("layout.at(cube(1), {3})"),
            "model.lua:1: layout.at: point 1 must be {x, y, z}, got 3");
}

}  // namespace
}  // namespace csgrun::testing::library_test
