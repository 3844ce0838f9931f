// The table of widths in docs/numerics.md is what widths.h computes.
#include "engine/exact/widths.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "engine/exact/predicates.h"
#include "tests/support/source_folder.h"

namespace csgrun::widths_test {
namespace {

std::string row(const std::string& what, int plain, int far, int framed) {
  return "| " + what + " | " + std::to_string(plain) + " | " + std::to_string(far) + " | " +
         std::to_string(framed) + " |";
}

TEST(Widths, AreThoseOfTheDocument) {
  namespace w = widths;
  struct Widths {
    int normal, offset;
    [[nodiscard]] int point_w() const { return w::point_w(normal); }
    [[nodiscard]] int point_xyz() const { return w::point_xyz(normal, offset); }
    [[nodiscard]] int side() const { return w::side(point_xyz(), point_w(), normal, offset); }
  };
  const Widths plain{w::normal(w::kGrid), w::offset(w::kGrid)};
  const Widths far{w::normal(w::kFarGrid), w::offset(w::kFarGrid)};
  const Widths framed{w::framed_normal(plain.normal, w::kFrame), w::framed_offset(plain.offset)};
  std::ifstream file(test::source_folder() / "docs/numerics.md");
  ASSERT_TRUE(file);
  std::stringstream text;
  text << file.rdbuf();
  for (const std::string& line :
       {row("plane normal", plain.normal, far.normal, framed.normal),
        row("plane offset", plain.offset, far.offset, framed.offset),
        row("three-plane point, w", plain.point_w(), far.point_w(), framed.point_w()),
        row("three-plane point, x y z", plain.point_xyz(), far.point_xyz(), framed.point_xyz()),
        row("point against plane", plain.side(), far.side(), framed.side())}) {
    EXPECT_NE(text.str().find(line), std::string::npos) << "missing: " << line;
  }
  EXPECT_LT(std::max({plain.side(), far.side(), framed.side()}), kTierBits.back());
}

// The bounds, in numbers: what a compiler may not have folded.
TEST(Widths, AreBounds) {
  volatile int grid = 27;
  EXPECT_EQ(widths::normal(grid), 56);
  EXPECT_EQ(widths::offset(grid), 83);
  volatile int normal = 56, offset = 83, frame = 40;
  EXPECT_EQ(widths::framed_normal(normal, frame), 98);
  EXPECT_EQ(widths::framed_offset(offset), 123);
  EXPECT_EQ(widths::point_w(normal), 171);
  EXPECT_EQ(widths::point_xyz(normal, offset), 198);
  // The wider of three products n . xyz and one d w, and the sum of four.
  volatile int wide = 100, narrow = 10;
  EXPECT_EQ(widths::side(wide, narrow, 20, 30), 122);
  EXPECT_EQ(widths::side(narrow, wide, 20, 30), 132);
  EXPECT_EQ(widths::side(narrow, wide, 200, 30), 212);
  EXPECT_EQ(widths::side(wide, narrow, 20, 115), 127);
  EXPECT_EQ(widths::max_of(wide, narrow), 100);
  EXPECT_EQ(widths::max_of(narrow, wide), 100);
  // A magnitude and a sign.
  for (const auto& [bits, limbs] :
       {std::pair{1, 1}, {63, 1}, {64, 2}, {127, 2}, {128, 3}, {383, 6}}) {
    EXPECT_EQ(widths::limbs(bits), limbs);
  }
}

}  // namespace
}  // namespace csgrun::widths_test
