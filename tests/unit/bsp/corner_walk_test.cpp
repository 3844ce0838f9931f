// Vertices of several fans, by joining faces at each vertex; and that they are where a resolved
// surface may touch itself.
#include "engine/bsp/corner_walk.h"

#include <set>

#include <gtest/gtest.h>

#include "engine/bsp/self_resolution.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun::corner_walk_test {
namespace {

std::shared_ptr<LeafGeometry> paired(const std::vector<test::Loop>& loops) {
  auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(loops));
  leaf->opposite = pair_edges(*leaf).opposite;
  return leaf;
}

/// Two tetrahedra with a corner in common.
std::vector<test::Loop> two_at(const IVec3& p) {
  auto loops =
      test::hull_loops({p, {p[0] + 3, p[1], p[2]}, {p[0], p[1] + 3, p[2]}, {p[0], p[1], p[2] + 3}});
  const auto more =
      test::hull_loops({p, {p[0] - 3, p[1], p[2]}, {p[0], p[1] - 3, p[2]}, {p[0], p[1], p[2] - 3}});
  loops.insert(loops.end(), more.begin(), more.end());
  return loops;
}

/// Vertices whose faces are not all joined by edges that end there.
std::vector<uint32_t> by_joining(const std::vector<test::Loop>& loops, const LeafGeometry& leaf) {
  std::vector<uint32_t> found;
  for (uint32_t v = 0; v < leaf.vertices.size(); ++v) {
    const IVec3& at = leaf.vertices[v];
    std::vector<std::set<IVec3>> fans;  // neighbours of the vertex
    for (const test::Loop& loop : loops) {
      const auto corner = std::find(loop.begin(), loop.end(), at);
      if (corner == loop.end()) continue;
      const auto i = static_cast<size_t>(corner - loop.begin());
      std::set<IVec3> fan{loop[(i + 1) % loop.size()], loop[(i + loop.size() - 1) % loop.size()]};
      for (size_t f = 0; f < fans.size();) {
        if (std::none_of(fan.begin(), fan.end(),
                         [&](const IVec3& p) { return fans[f].count(p); })) {
          ++f;
          continue;
        }
        fan.insert(fans[f].begin(), fans[f].end());
        fans.erase(fans.begin() + static_cast<std::ptrdiff_t>(f));
      }
      fans.push_back(fan);
    }
    if (fans.size() > 1) found.push_back(v);
  }
  return found;
}

TEST(CornerWalk, FindsVerticesOfSeveralFans) {
  test::Random random(993);
  size_t total = 0, leaves = 0;
  for (int i = 0; i < 300; ++i) {
    const auto loops = i < 30 ? two_at({i, 0, 0}) : test::random_loops(random);
    const auto leaf = paired(loops);
    if (leaf->opposite.empty()) continue;
    // Every vertex is the last one now and then, and some belong to no face.
    auto turned = *leaf;
    const auto count = static_cast<uint32_t>(leaf->vertices.size());
    const auto by = static_cast<uint32_t>(random.integer(0, count - 1));
    for (uint32_t v = 0; v < count; ++v) turned.vertices[(v + by) % count] = leaf->vertices[v];
    for (uint32_t& v : turned.corners) v = (v + by) % count;
    ASSERT_EQ(find_vertices_of_fans(turned), by_joining(loops, turned)) << "case " << i;
    turned.vertices.push_back({99, 99, 99});
    ASSERT_EQ(find_vertices_of_fans(turned), by_joining(loops, turned)) << "case " << i;
    total += find_vertices_of_fans(turned).size();
    ++leaves;
  }
  EXPECT_GT(total, 20u);
  EXPECT_GT(leaves, 150u);
}

TEST(CornerWalk, TheLastVertexMayHaveSeveralFans) {
  auto leaf = *paired(two_at({0, 0, 0}));
  const auto last = static_cast<uint32_t>(leaf.vertices.size() - 1);
  const auto at =
      static_cast<uint32_t>(std::find(leaf.vertices.begin(), leaf.vertices.end(), IVec3{0, 0, 0}) -
                            leaf.vertices.begin());
  std::swap(leaf.vertices[at], leaf.vertices[last]);
  for (uint32_t& v : leaf.corners) v = v == at ? last : v == last ? at : v;
  EXPECT_EQ(find_vertices_of_fans(leaf), std::vector<uint32_t>{last});
}

TEST(CornerWalk, ResolvedSurfacesMayTouchThere) {
  EvaluateStats stats;
  const auto result = resolve_surface(test::operand_of(paired(two_at({20, 30, 40}))), {},
                                      InsideRule::kNonZero, {}, stats);
  ASSERT_TRUE(result);
  ASSERT_EQ((*result)->touches.size(), 1u);
  EXPECT_EQ((*result)->touches[0].lo, (IVec3{20, 30, 40}));
  EXPECT_EQ((*result)->touches[0].hi, (IVec3{20, 30, 40}));
}

}  // namespace
}  // namespace csgrun::corner_walk_test
