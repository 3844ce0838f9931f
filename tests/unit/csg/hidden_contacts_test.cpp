// Many operands of which most is inside of others: cells prune what whole faces would be cut into.
#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>

#include "test_meshes.h"

namespace csgrun::hidden_contacts_test {
namespace {

using namespace testing;

/// Rings of scales about an axis, each overlapping its neighbours, around a core that is a
/// difference, so that the scales cannot stand in groups.
NodePtr scaled_trunk() {
  std::vector<NodePtr> parts{subtract({prism(12, 3, 16), moved(0, 0, 15, prism(6, 1, 2))})};
  const NodePtr scale = turned(20, {0, 1, 0}, box({-0.4, -1.5, -0.5}, {0.4, 1.5, 4}));
  for (int ring = 0; ring < 8; ++ring) {
    for (int i = 0; i < 16; ++i) {
      const double angle = 22.5 * i + 7 * ring + 0.1;
      parts.push_back(turned(angle, {0, 0, 1}, moved(2.5, 0, 1.3 * ring, scale)));
    }
  }
  return unite(parts);
}

TEST(HiddenContacts, AreLeftToCells) {
  const NodePtr trunk = scaled_trunk();
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options);
  const auto solid = evaluator.evaluate(trunk);
  ASSERT_TRUE(solid) << solid.error().message;
  // What whole faces leave open by themselves is 68.
  EXPECT_GT(evaluator.stats().solved_cells, 500u);
  options.whole_faces = false;
  const SolidPtr by_cells = solid_of(trunk, options);
  EXPECT_EQ((*solid)->canonical_hash, by_cells->canonical_hash);
  EXPECT_EQ((*solid)->positions, by_cells->positions);
  EXPECT_EQ((*solid)->triangles, by_cells->triangles);
}

}  // namespace
}  // namespace csgrun::hidden_contacts_test
