// Facets that nodes of .csg trees ask for: what nobody can mean is refused, for all nodes alike.
#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <csgrun/primitives/csg_file.h>

#include "tests/unit/primitives/csg_trees.h"

namespace csgrun::csg_facets_test {
namespace {

using testing::error;
using testing::parse;

/// All nodes that take $fn, with FACETS for it.
const std::vector<std::pair<std::string, std::string>> kNodes{
    {"circle", "circle(FACETS, r = 5);"},
    {"sphere", "sphere(FACETS, r = 5);"},
    {"cylinder", "cylinder(FACETS, h = 5, r1 = 2, r2 = 0);"},
    {"offset", "offset(r = 1, FACETS) { square(size = [4, 4]); }"},
    {"offset", "offset(delta = 1, chamfer = false, FACETS) { square(size = [4, 4]); }"},
    {"rotate_extrude", "rotate_extrude(angle = 90, start = 0, FACETS) { square(size = [4, 4]); }"},
    {"linear_extrude", "linear_extrude(height = 3, FACETS) { square(size = [4, 4]); }"},
    {"linear_extrude", "linear_extrude(height = 3, twist = 90, FACETS) { square(size = [4, 4]); }"},
    {"text", "text(text = \"ab\", size = 10, FACETS);"},
    {"roof", "roof(method = \"voronoi\", FACETS) { square(size = [4, 4]); }"},
    {"import", "import(file = \"a.svg\", FACETS);"},
};

std::string with(std::string node, const std::string& facets) {
  return node.replace(node.find("FACETS"), 6, facets);
}

TEST(CsgFacets, HugeNumbersAreRefusedAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  for (const auto& [name, node] : kNodes) {
    EXPECT_EQ(error(with(node, "$fn = 1e9, $fa = 12, $fs = 2")),
              "m.csg:1: " + name + ": $fn must be at most 100000, got 1e+09");
    EXPECT_EQ(error(with(node, "$fn = 100001")),
              "m.csg:1: " + name + ": $fn must be at most 100000, got 100001");
  }
  // What is made of such a number takes minutes, if there is room for it.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  // Of what is not drawn nothing is asked.
  EXPECT_EQ(error("%" + with(kNodes[0].second, "$fn = 1e9") + " cube(size = [1, 1, 1]);"),
            "no error");
  EXPECT_EQ(parse(with(kNodes[0].second, "$fn = 100000")).shape.loops()[0].size(), 100000u);
}

TEST(CsgFacets, SmallSidesAreAsSmallAsInOpenScad) {
  // 0.01 degrees or mm, so at most 36000 sides; and OpenSCAD says so.
  const CsgModel fine = parse("circle($fn = 0, $fa = 0.0001, $fs = 1e-9, r = 5);");
  EXPECT_EQ(fine.shape.loops()[0].size(), 3142u);
  EXPECT_EQ(fine.warnings,
            (std::vector<std::string>{
                "m.csg:1: circle: $fa must be at least 0.01, which was taken for 1e-04",
                "m.csg:1: circle: $fs must be at least 0.01, which was taken for 1e-09"}));
  EXPECT_EQ(parse("circle($fa = 0, $fs = 0, r = 5000);").shape.loops()[0].size(), 36000u);
  EXPECT_TRUE(parse("circle($fn = 0, $fa = 0.01, $fs = 0.01, r = 5);").warnings.empty());
  EXPECT_NE(error("sphere($fn = 0, $fa = 0, $fs = 0, r = 500);").find("the limit is"),
            std::string::npos);
}

TEST(CsgFacets, SidesOfAnyLengthOrAngleAreFive) {
  for (const std::string facets : {"$fa = inf, $fs = 2", "$fa = 12, $fs = inf", "$fa = 1e9"}) {
    const CsgModel model = parse("circle($fn = 0, " + facets + ", r = 50);");
    EXPECT_TRUE(model.warnings.empty());
    ASSERT_FALSE(model.shape.empty()) << facets;
    EXPECT_EQ(model.shape.loops()[0].size(), 5u) << facets;
  }
}

}  // namespace
}  // namespace csgrun::csg_facets_test
