// Statements that make a solid and drop it.
#include "lua_bindings/dropped_values.h"

#include <gtest/gtest.h>

#include "tests/unit/lua/lua_support.h"

namespace csgrun {
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

}  // namespace
}  // namespace csgrun
