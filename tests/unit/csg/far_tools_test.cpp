// Tools that are far larger than what they cut, turned too: they cut as tools do that are just
// large enough, on the grid of the part.
#include <array>
#include <random>

#include <gtest/gtest.h>

#include "draw.h"
#include "test_meshes.h"

namespace csgrun::far_tools_test {
namespace {

using namespace testing;

NodePtr drill(double length) {
  PolygonMesh mesh = *prism(7, 1.25, 1)->mesh();
  for (glm::dvec3& p : mesh.points) p.z = p.z > 0 ? length : -length;
  return leaf(mesh, FillRule::kNonZero);
}

/// What reaches from its end at 0 or from its sides to `length`.
NodePtr tool_of(int kind, double length) {
  switch (kind % 4) {
    case 0:
      return box({0, -length, -length}, {length, length, length});  // a half-space
    case 1:
      return box({-length, -length, -0.5}, {length, length, 0.75});  // a slab
    case 2:
      return drill(length);  // a drill
    default:
      return box({0.5, 0.25, 0}, {length, length, length});  // a corner
  }
}

NodePtr part_to_cut() {
  return unite({box({0, 0, 0}, {4.007, 3, 2}), moved(1, 1, 1, prism(5, 1, 4))});
}

NodePtr placed_tool(Draw& draw, double length) {
  NodePtr tool = tool_of(draw.below(4), length);
  const double degrees = draw.upto(90), x = draw.upto(4), y = draw.upto(3), z = draw.upto(2);
  tool = turned(draw.below(4) == 0 ? 90 : degrees, {1.0 * draw.below(3), 1, 2}, tool);
  return moved(x, y, z, tool);
}

/// Of tools of that length, with the same draws.
NodePtr cut_of(unsigned seed, double length) {
  Draw draw{std::mt19937(seed)};
  const NodePtr part = part_to_cut();
  const NodePtr first = placed_tool(draw, length), second = placed_tool(draw, length);
  const std::vector<NodePtr> tools{first, second};
  switch (draw.below(5)) {
    case 0:
      return subtract({part, tools[0], tools[1]});
    case 1:
      return intersect({part, tools[0]});
    case 2:
      return subtract({part, intersect(tools)});
    case 3:
      return unite({subtract({part, tools[0]}), moved(9, 0, 0, intersect({part, tools[1]}))});
    default:
      return intersect({symmetric(tools), part});
  }
}

TEST(FarTools, CutAsNearOnesDo) {
  constexpr double kNear = 40;  // about ten times the part
  EvaluateOptions options;
  options.grid = *GridStep::parse("2^-19mm");
  int empty = 0;
  for (unsigned seed = 0; seed < 120; ++seed) {
    const SolidPtr truth = solid_of(cut_of(seed, kNear), options);
    empty += truth->empty();
    for (const double length : {3e3, 1e6, 1e10}) {
      const SolidPtr cut = solid_of(cut_of(seed, length), options);
      EXPECT_EQ(cut->canonical_hash, truth->canonical_hash) << seed << ' ' << length;
      // On a grid that is chosen, which is not coarser by much.
      const SolidPtr chosen = solid_of(cut_of(seed, length));
      EXPECT_NEAR(chosen->measures.volume, truth->measures.volume, 1e-4) << seed << ' ' << length;
    }
  }
  EXPECT_LT(empty, 40);
}

// Each result goes on from the one before.
TEST(FarTools, CutAsNearOnesDoInChains) {
  EvaluateOptions options;
  options.grid = *GridStep::parse("2^-19mm");
  for (unsigned seed = 0; seed < 40; ++seed) {
    Evaluator near(options), far(options);
    Draw draw{std::mt19937(seed)};
    NodePtr near_part = part_to_cut(), far_part = near_part;
    for (int step = 0; step < 8; ++step) {
      Draw again = draw;
      const double length = std::array{3e3, 3e5, 1e9}[step % 3];
      const NodePtr near_tool = placed_tool(draw, 40), far_tool = placed_tool(again, length);
      const NodePtr more = moved(draw.upto(4), draw.upto(3), draw.upto(2), cube(1.5));
      if (draw.below(3) == 0) {
        near_part = unite({near_part, intersect({more, near_tool})});
        far_part = unite({far_part, intersect({more, far_tool})});
      } else {
        near_part = subtract({near_part, near_tool});
        far_part = subtract({far_part, far_tool});
      }
      const auto truth = near.extent(near_part), cut = far.extent(far_part);
      ASSERT_TRUE(truth && cut) << seed << ' ' << step;
      EXPECT_EQ(cut->volume, truth->volume) << seed << ' ' << step;
      EXPECT_EQ(cut->bbox, truth->bbox) << seed << ' ' << step;
    }
    EXPECT_EQ((*far.evaluate(far_part))->canonical_hash,
              (*near.evaluate(near_part))->canonical_hash)
        << seed;
  }
}

// What touches a part is seen in a face, an edge or a corner alone, and is not drawn to that.
TEST(FarTools, ThatTouchOnlyKeepTheirVolume) {
  const NodePtr part = box({0, 0, 0}, {10, 10, 10});
  const std::vector<NodePtr> tools = {
      box({10, 0, 0}, {20, 10, 10}),         box({-3, 2, 10}, {90, 8, 11}),
      box({10, 10, 0}, {30, 20, 10}),        box({10, 10, 10}, {11, 11, 11}),
      moved(5, 5, 10, prism(6, 3, 5)),       box({10 - 1e-6, 0, 0}, {20, 10, 10}),
      box({10, -1e6, -1e6}, {1e6, 1e6, 1e6})};
  for (size_t t = 0; t < tools.size(); ++t) {
    for (const double degrees : {0.0, 30.0}) {
      const NodePtr a = turned(degrees, {1, 2, 3}, part), b = turned(degrees, {1, 2, 3}, tools[t]);
      for (const NodePtr& node : {subtract({a, b}), intersect({a, b})}) {
        Evaluator evaluator{EvaluateOptions{}};
        const auto solid = evaluator.evaluate(node);
        ASSERT_TRUE(solid) << t;
        EXPECT_EQ(evaluator.warnings(), std::vector<std::string>()) << t << ' ' << degrees;
      }
      EXPECT_NEAR(solid_of(subtract({a, b}))->measures.volume, t == 5 ? 1000 - 1e-4 : 1000, 2e-5)
          << t << ' ' << degrees;
    }
  }
}

// Only what has straight sides may lose of its length.
TEST(FarTools, KeepTheSlopeOfTheirSides) {
  PolygonMesh wedge = box_mesh({-1e4, -1, 0}, {1e4, 1, 1});
  for (glm::dvec3& p : wedge.points) {
    if (p.x > 0 && p.z > 0) p.z = 2;  // 1.5 in the middle
  }
  const NodePtr tool = turned(30, {0, 0, 1}, leaf(wedge, FillRule::kNonZero));
  const SolidPtr cut =
      solid_of(intersect({turned(30, {0, 0, 1}, box({-1, -1, 0}, {1, 1, 9})), tool}));
  EXPECT_NEAR(cut->measures.volume, 2 * 2 * 1.5, 5e-3);
  EXPECT_NEAR(cut->measures.bbox[1].z, 1.5 + 0.5e-4, 1e-3);
}

}  // namespace
}  // namespace csgrun::far_tools_test
