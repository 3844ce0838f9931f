// Results that end in a plane in which tools that take nothing away have faces, and results around
// which there is much room: all ways to them agree.
#include <optional>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>

#include "test_meshes.h"

namespace csgrun::result_regions_test {
namespace {

using namespace testing;

/// Of the cut faces, the cells and the paper's cells, flattened and operation by operation.
void expect_one_value(const NodePtr& root, double volume) {
  std::optional<std::array<uint64_t, 2>> hash;
  for (const bool whole : {true, false}) {
    for (const bool literal : {false, true}) {
      for (const bool flat : {true, false}) {
        EvaluateOptions options;
        options.whole_faces = whole;
        options.literal_cells = literal;
        options.flatten = flat;
        const auto solid = Evaluator(options).evaluate(root);
        ASSERT_TRUE(solid) << solid.error().message << " " << whole << literal << flat;
        EXPECT_NEAR((*solid)->measures.volume, volume, 1e-9) << whole << literal << flat;
        if (!hash) hash = (*solid)->canonical_hash;
        EXPECT_EQ((*solid)->canonical_hash, *hash) << whole << literal << flat;
      }
    }
  }
}

NodePtr painted(float red, float green, const NodePtr& node) {
  Appearance colour;
  colour.is_default = false;
  colour.red = red;
  colour.green = green;
  return Node::painted(colour, node);
}

TEST(ResultRegions, ToolsOnTheOtherSideOfTheirPlane) {
  const NodePtr upper = painted(1, 0, box({-3, -3, 0}, {3, 3, 3})),
                lower = painted(0, 1, box({-3, -3, -3}, {3, 3, 0})),
                part = painted(0, 0, box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
  for (const double degrees : {0.0, 10.0, 45.0, 90.0}) {
    for (const double size : {0.2, 1.0}) {
      const NodePtr body =
          painted(1, 1, turned(degrees, {0, 0, 1}, box({-size, -size, 0}, {size, size, 1})));
      for (const NodePtr& tool : {intersect({body, upper}), intersect({upper, body}), body}) {
        expect_one_value(intersect({subtract({part, tool}), lower}), 0.5);
        expect_one_value(intersect({lower, subtract({part, tool})}), 0.5);
      }
    }
  }
}

TEST(ResultRegions, ReachToWhereNothingIsSeen) {
  const NodePtr a = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}),
                b = moved(4e4, 8e4, -160710.678118655,
                          prism(4, 70710.6781186547, 141421.356237309)),
                c = intersect({cube(1e5), cube(3)}), d = moved(-5e5, -5e5, 1e5, cube(1e6));
  expect_one_value(intersect({unite({a, b}), unite({c, d})}), 0.125);
  expect_one_value(intersect({unite({c, d}), unite({b, a})}), 0.125);
}

}  // namespace
}  // namespace csgrun::result_regions_test
