// Tools that are far larger than what they cut, turned too: they cut as tools do that are just
// large enough, on the grid of the part.
#include <random>

#include <gtest/gtest.h>

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

struct Draw {
  std::mt19937 random;
  double upto(double most) { return static_cast<double>(random() % 1000) / 1000 * most; }
  int below(int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); }
};

/// Of tools of that length, with the same draws.
NodePtr cut_of(unsigned seed, double length) {
  Draw draw{std::mt19937(seed)};
  const NodePtr part = unite({box({0, 0, 0}, {4.007, 3, 2}), moved(1, 1, 1, prism(5, 1, 4))});
  std::vector<NodePtr> tools;
  for (int i = 0; i < 2; ++i) {
    NodePtr tool = tool_of(draw.below(4), length);
    const double degrees = draw.upto(90), x = draw.upto(4), y = draw.upto(3), z = draw.upto(2);
    tool = turned(draw.below(4) == 0 ? 90 : degrees, {1.0 * draw.below(3), 1, 2}, tool);
    tools.push_back(moved(x, y, z, tool));
  }
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
