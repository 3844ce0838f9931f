// Statements that make a solid and drop it.
#include "lua_bindings/dropped_values.h"

#include <gtest/gtest.h>

#include "tests/unit/lua/lua_support.h"

namespace csgrun::dropped_values_test {
namespace {

/// The lines of what is found.
std::vector<size_t> lines(std::string_view text) {
  std::vector<size_t> found;
  for (const DroppedValue& value : find_dropped_values(text)) found.push_back(value.line);
  return found;
}
using Lines = std::vector<size_t>;

TEST(DroppedValues, OfTransformsInFrontAndOfMethods) {
  const auto found = find_dropped_values(
      "translate({0, 0, 5})\n  cube(10)\nlocal c = cube(1)\n"
      "c:translate(1, 2, 3)\nreturn c");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].message,
            "what translate(...) gives is dropped: it stands behind what it is made of, as in "
            "cube(10):translate(0, 0, 5)");
  EXPECT_EQ(found[1].line, 2u);
  EXPECT_EQ(found[1].message, "what cube(...) gives is dropped: return it, or give it a name");
  EXPECT_EQ(found[2].line, 4u);
  EXPECT_EQ(found[2].message,
            "what translate(...) gives is dropped: a solid does not change, write c = "
            "c:translate(...)");
}

TEST(DroppedValues, AreWholeStatements) {
  EXPECT_EQ(lines("a = 1 cube(1)"), Lines{1});
  EXPECT_EQ(lines("f(1) cube{1, 2, (3)}; g()"), Lines{1});
  EXPECT_EQ(lines("function f(x)\n  x:rotate(1, 2, 3):scale(2)\nend"), Lines{2});
  EXPECT_EQ(lines("if a then\ncube(1)\nelse\nsphere(1)\nend"), (Lines{2, 4}));
  EXPECT_EQ(lines("x = '\\''\ncolor\"red\" f()"), Lines{2});
  EXPECT_EQ(lines("x = 0x1p-3 cube(1)\nx = 1e+5 cube(1)"), (Lines{1, 2}));
  for (const char* const used :
       {"return cube(1)", "local a = cube(1)", "local a =\n  translate(1, 2, 3, b)\nlocal c = 1",
        "emit(cube(1))", "render(cube(1))", "a = {cube(1), cube(2)}", "a = {\n  cube(1)\n}",
        "a = b + cube(1)", "a = not cube(1)", "a = b and cube(1) or c", "a = b .. cube(1)",
        "cube(1):emit()", "a[cube(1)] = 1", "cube.x = 1", "x = f or cube(1)",
        "while cube(1) do end", "for _, x in cube(1) do end", "f(a, cube(1))",
        "a:union(b):emit()"}) {
    EXPECT_EQ(lines(used), Lines{}) << used;
  }
}

TEST(DroppedValues, AreNoEntriesOfLists) {
  EXPECT_EQ(lines("a = union{cube(1); sphere(1); cube(2)}\nf(cube(1), {b; cube(1);})"), Lines{});
  EXPECT_EQ(lines("a = {b; function() x = 1; cube(1) end;\nsphere(2);}\nsphere(3)"), (Lines{1, 3}));
}

TEST(DroppedValues, KnowTheirStatementAndFunction) {
  const auto found = find_dropped_values(
      "cube(1)\nfunction f()\n  if a then for i = 1, 2 do\n    cube(1)\n  :translate(1)\n"
      "  end end\n  repeat cube(1) until a\nend\nlocal g = function() return 1 end cube{\n1}");
  ASSERT_EQ(found.size(), 4u);
  const size_t expected[][3] = {{1, 1, 0}, {4, 5, 2}, {7, 7, 2}, {9, 10, 0}};
  for (size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].line, expected[i][0]);
    EXPECT_EQ(found[i].last_line, expected[i][1]);
    EXPECT_EQ(found[i].function_line, expected[i][2]);
  }
}

TEST(DroppedValues, StandInNoStringOrComment) {
  for (const char* const text :
       {"-- cube(1)", "--[[\ncube(1)\n]]", "--[==[ ]] cube(1)\n]==]", "a = [[\ncube(1) ]]",
        "a = 'x' .. \"\\\" cube(1)\"", "#!/usr/bin/csgrun cube(1)\n"}) {
    EXPECT_EQ(lines(text), Lines{}) << text;
  }
  EXPECT_EQ(lines("a = [==[\n]]\n]==]\n--[[\n]] cube(1)"), Lines{5});
}

TEST(DroppedValues, OfFunctionsOfTheScriptsOwnAreNot) {
  EXPECT_EQ(lines("local function cube(x) emit(x) end\ncube(1)"), Lines{});
  EXPECT_EQ(lines("function color(c) emit(c) end\ncolor(1)\nsphere(2)"), Lines{3});
  EXPECT_EQ(lines("local cube = f\ncube(1)"), Lines{});
  EXPECT_EQ(lines("scale = f\nscale(1)"), Lines{});
}

TEST(DroppedValues, AreWarnedOf) {
  const testing::ScriptRun run("translate({0, 0, 5}) sphere(1)\nreturn cube(1)");
  ASSERT_EQ(run.session.warnings().size(), 2u);
  EXPECT_EQ(run.session.warnings()[0].substr(0, 40), "model.lua:1: what translate(...) gives i");
}

/// The lines that a script which fails is warned of.
std::vector<std::string> warned_lines(const std::string& text) {
  const testing::ScriptRun run(text);
  EXPECT_NE(run.outcome.status, ScriptStatus::kGood) << text;
  std::vector<std::string> found;
  for (const std::string& warning : run.session.warnings()) {
    EXPECT_NE(warning.find("gives is dropped: "), std::string::npos) << warning;
    found.push_back(warning.substr(0, warning.find(": ")));
  }
  return found;
}
using Places = std::vector<std::string>;

TEST(DroppedValues, AreWarnedOfWhenTheScriptFails) {
  const std::string part = "local function part() cube(10) end ";
  for (const std::string text : {"return cube(1) + part()", "return part()", "return part():up(3)",
                                 "local a = part() return a.x", "error('x')"}) {
    EXPECT_EQ(warned_lines(part + text), Places{"model.lua:1"}) << text;
  }
  EXPECT_EQ(warned_lines("cube(10)"), Places{"model.lua:1"});
  EXPECT_EQ(warned_lines("\ncube(10)\n  :up(1)\n  :translate(1, 2, 3)"), Places{"model.lua:2"});
  EXPECT_EQ(warned_lines("cube(1)\nlocal a = nil + 1\nsphere(1)"),
            (Places{"model.lua:1", "model.lua:3"}));
}

TEST(DroppedValues, OfStatementsInWhichTheScriptStoppedAreNot) {
  for (const char* const text :
       {"cube('x')", "cube(10):translate('x')", "cube(10)\n:translate(\n'x')",
        "local function size() error('no size') end\ncube(\nsize())",
        "local function part()\ncube('x')\nend\nreturn part()",
        "local function part() return cube(1):warp(function() error('x') end) "
        "end\npart():rotate(1)",
        // Held by locals, or made in passing.
        "local a = cube(1)\nlocal b = a + nil", "local a = cube(1) + cube('x')",
        "local a = cube(1) local t = {cube(2); a; sphere(1);}\nerror('x')", "return cube(1, 'x')",
        // No text that Lua takes.
        "cube(1)\nreturn return"}) {
    EXPECT_EQ(warned_lines(text), Places{}) << text;
  }
}

}  // namespace
}  // namespace csgrun::dropped_values_test
