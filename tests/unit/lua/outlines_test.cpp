// What functions of 2D shapes say when they are called wrongly.
#include "lua_support.h"

namespace csgrun::testing::outlines_test {
namespace {

TEST(Outlines, Mistakes) {
  EXPECT_EQ(message_of("return square(1):offset{delte = 2}"),
            "model.lua:1: offset: unknown option 'delte' (did you mean 'delta'?)");
  EXPECT_EQ(message_of("return square(1):offset('a')"),
            "model.lua:1: offset: option 'r' must be a number, got the string \"a\"");
  EXPECT_EQ(message_of("return square(1):offset(0/0)"),
            "model.lua:1: offset: option 'r' must be finite, got nan");
  EXPECT_EQ(message_of("return square(1):offset{r = 1, chamfer = true}"),
            "model.lua:1: offset: option 'chamfer' goes with 'delta', not with 'r'");
  EXPECT_EQ(message_of("return offset(5)"),
            "model.lua:1: offset: the first argument must be a 2D shape, got 5; as a method it is "
            "called with a colon, shape:offset(...)");
  EXPECT_EQ(message_of("return minkowski(square(1), cube(1))"),
            "model.lua:1: minkowski: a solid and a 2D shape cannot be combined; make a solid of "
            "the shape first, with linear_extrude or rotate_extrude");
  EXPECT_EQ(message_of("return square(1):resize()"),
            "model.lua:1: resize: needs the new lengths: (20, 10), or 0 where nothing changes");
  EXPECT_EQ(message_of("return square(1):resize(-1, 2)"),
            "model.lua:1: resize: option 'newsize' must not be negative, got -1");
  EXPECT_EQ(message_of("return square(1):resize({1, 2}, {outo = true})"),
            "model.lua:1: resize: unknown option 'outo' (did you mean 'auto'?)");
  EXPECT_EQ(message_of("return square(1):fill(2)"),
            "model.lua:1: fill: takes no arguments here, got 2");
  EXPECT_EQ(message_of("return regular_polygon()"),
            "model.lua:1: regular_polygon: needs the number of corners");
  EXPECT_EQ(message_of("return regular_polygon(2)"),
            "model.lua:1: regular_polygon: option 'n' must be at least 3, got 2");
  EXPECT_EQ(message_of("return regular_polygon(6, {r = 1, side = 2})"),
            "model.lua:1: regular_polygon: give only one of 'r', 'd', 'side' and 'across'");
  EXPECT_EQ(message_of("return square{4, 3, r = 2}"),
            "model.lua:1: square: r must be at most half of the shorter side, 1.5, got 2");
  EXPECT_EQ(message_of("return square(1):perimeter(1)"),
            "model.lua:1: perimeter: takes no arguments");
}

TEST(Sweeps, Mistakes) {
  EXPECT_EQ(message_of("return square(1):sweep()"),
            "model.lua:1: sweep: needs a path, a list of points {x, y, z}");
  EXPECT_EQ(message_of("return square(1):sweep{{0, 0}, {1, 1}}"),
            "model.lua:1: sweep: point 0 must be a list of three numbers, got a list of 2 values");
  EXPECT_EQ(message_of("return square(1):sweep({{0, 0, 0}, {0, 0, 1}}, {twits = 3})"),
            "model.lua:1: sweep: unknown option 'twits' (did you mean 'twist'?)");
  EXPECT_EQ(message_of("return square(1):sweep({{0, 0, 0}, {0, 0, 1}}, {scale = {1, 0}})"),
            "model.lua:1: sweep: scale must be positive, or 0 both ways, got 0");
  EXPECT_EQ(message_of("return square(1):sweep{{0, 0, 0}, {0, 0, 0}}"),
            "model.lua:1: sweep: the path needs at least 2 different points, got 1");
  EXPECT_EQ(
      message_of("return loft(square(1), 2)"),
      "model.lua:1: loft: its outlines are one list, and their heights follow: loft({a, b}, 10)");
  EXPECT_EQ(message_of("return loft({square(1), cube(1)}, 2)"),
            "model.lua:1: loft: outline 2 must be a 2D shape or a point {x, y}, got solid");
  EXPECT_EQ(message_of("return loft({square(1), square(1)})"),
            "model.lua:1: loft: needs a list of shapes and their heights");
  EXPECT_EQ(message_of("return loft({square(1), square(1)}, {0, 'x'})"),
            "model.lua:1: loft: height 2 must be a number, got the string \"x\"");
  EXPECT_EQ(message_of("return loft({square(1), square(1)}, 0)"),
            "model.lua:1: loft: option 'heights' must be positive, got 0");
  EXPECT_EQ(message_of("return loft({square(1), square(1)}, {1, 0})"),
            "model.lua:1: loft: heights must increase, got 0 after 1");
}

}  // namespace
}  // namespace csgrun::testing::outlines_test
