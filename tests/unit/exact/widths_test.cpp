// The table of widths in docs/numerics.md is what widths.h computes.
#include "engine/exact/widths.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "engine/exact/predicates.h"

namespace csgrun {
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
  const std::filesystem::path here = __FILE__;
  std::ifstream file(here.parent_path() / "../../../docs/numerics.md");
  if (!file) GTEST_SKIP() << "docs/numerics.md is not beside the tests";
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

}  // namespace
}  // namespace csgrun
