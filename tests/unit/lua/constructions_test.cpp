// What functions of whole solids say when they are called wrongly.
#include "lua_support.h"

namespace csgrun::testing {
namespace {

TEST(Constructions, Mistakes) {
  EXPECT_EQ(message_of("return hull()"), "model.lua:1: hull: needs a solid or a shape");
  EXPECT_EQ(message_of("return hull{}"), "model.lua:1: hull: needs a solid or a shape");
  EXPECT_EQ(message_of("return hull(cube(1), 3)"),
            "model.lua:1: hull: an operand must be a solid or a shape, got 3");
  EXPECT_EQ(message_of("return cube(1):minkowski{a = cube(1)}"),
            "model.lua:1: minkowski: takes lists of solids or shapes without holes and names in "
            "them");
  EXPECT_EQ(message_of("return minkowski(cube(1), square(1))"),
            "model.lua:1: minkowski: a solid and a 2D shape cannot be combined; make a solid of "
            "the shape first, with linear_extrude or rotate_extrude");
  EXPECT_EQ(message_of("return cube(1):resize()"),
            "model.lua:1: resize: needs the new lengths: (20, 10), or 0 where nothing changes");
  EXPECT_EQ(message_of("return cube(1):resize({1, 1, 1}, {auto = 1})"),
            "model.lua:1: resize: option 'auto' must be true, false or a list of two or three of "
            "them, got 1");
  EXPECT_EQ(message_of("return cube(1):resize(1/0, 1, 1)"),
            "model.lua:1: resize: option 'newsize' must be finite, got inf");
  EXPECT_EQ(message_of("return cube(1):resize(1, -1, 1)"),
            "model.lua:1: resize: option 'newsize' must not be negative, got -1");
  EXPECT_EQ(message_of("return resize(7)").substr(0, 60),
            "model.lua:1: resize: the first argument must be a solid, got ");
}

TEST(Sections, Mistakes) {
  EXPECT_EQ(message_of("return cube(1):projection{cutt = true}"),
            "model.lua:1: projection: unknown option 'cutt' (did you mean 'cut'?)");
  EXPECT_EQ(message_of("return cube(1):projection{cut = 1}"),
            "model.lua:1: projection: option 'cut' must be true or false, got 1");
  EXPECT_EQ(message_of("return cube(1):project(1)"),
            "model.lua:1: project: takes no arguments; slice(z) cuts");
  EXPECT_EQ(message_of("return cube(1):slice('a')"),
            "model.lua:1: slice: option 'z' must be a number, got string");
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
            "numbers");
  EXPECT_EQ(message_of("return cube(1):decompose(1)"),
            "model.lua:1: decompose: takes no arguments");
}

}  // namespace
}  // namespace csgrun::testing
