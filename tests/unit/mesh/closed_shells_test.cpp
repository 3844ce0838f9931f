#include "engine/mesh/closed_shells.h"

#include <gtest/gtest.h>

#include "engine/mesh/opposite_edges.h"
#include "tests/support/random_solids.h"

namespace csgrun::test::closed_shells_test {
namespace {

LeafGeometry leaf_of(const std::vector<std::vector<Loop>>& shells, bool keep_facets = false) {
  std::vector<Loop> all;
  for (const auto& loops : shells) all.insert(all.end(), loops.begin(), loops.end());
  LeafGeometry leaf = *make_leaf(all, keep_facets);
  leaf.opposite = pair_edges(leaf).opposite;
  return leaf;
}
Shell faces(uint32_t first, uint32_t count) {
  Shell shell;
  for (uint32_t i = 0; i < count; ++i) shell.push_back(first + i);
  return shell;
}

const std::vector<Loop> kBox = box_loops({0, 0, 0}, {4, 4, 4});

TEST(ClosedShells, ApartWithoutCommonEdges) {
  const LeafGeometry leaf = leaf_of({kBox, box_loops({1, 1, 1}, {2, 2, 2}),
                                     box_loops({4, 4, 4}, {5, 5, 5})});  // a corner in common
  ASSERT_FALSE(leaf.opposite.empty());
  EXPECT_EQ(closed_shells(leaf), (std::vector<Shell>{faces(0, 6), faces(6, 6), faces(12, 6)}));
}

TEST(ClosedShells, BodiesThatFollowOneAnotherStayApart) {
  // The same faces, a face, or an edge in common.
  const LeafGeometry leaf =
      leaf_of({kBox, kBox, box_loops({4, 0, 0}, {8, 4, 4}), box_loops({4, 4, 0}, {6, 6, 4}), kBox});
  ASSERT_TRUE(leaf.opposite.empty());
  EXPECT_EQ(closed_shells(leaf), (std::vector<Shell>{faces(0, 6), faces(6, 6), faces(12, 6),
                                                     faces(18, 6), faces(24, 6)}));
}

TEST(ClosedShells, PartsOfAFacetStayTogether) {
  LeafGeometry leaf = leaf_of({kBox, box_loops({10, 0, 0}, {11, 1, 1})}, true);
  std::vector<uint32_t> facets = leaf.facet.list(12);
  for (size_t f = 6; f < 12; ++f) --facets[f];  // the last face of one and the first of the other
  leaf.facet = facets;
  EXPECT_EQ(closed_shells(leaf), (std::vector<Shell>{faces(0, 12)}));
}

/// Whether each edge of a leaf is balanced.
bool is_closed(const LeafGeometry& leaf) { return pair_edges(leaf).is_balanced; }

TEST(ClosedShells, AreClosedAndHaveAllFaces) {
  for (int i = 0; i < 200; ++i) {
    Random random(100 + i);
    std::vector<Loop> loops;
    for (int64_t k = random.integer(1, 5); k > 0; --k) {
      const auto own = random_loops(random, 3);
      loops.insert(loops.end(), own.begin(), own.end());
    }
    for (size_t k = loops.size(); k > 1; --k) {
      std::swap(loops[k - 1],
                loops[static_cast<size_t>(random.integer(0, static_cast<int64_t>(k) - 1))]);
    }
    const LeafGeometry leaf = leaf_of({loops}, true);
    std::vector<uint8_t> is_met(leaf.face_count(), 0);
    uint32_t before = 0;
    for (const Shell& shell : closed_shells(leaf)) {
      EXPECT_TRUE(before == 0 || shell[0] > before);
      before = shell[0];
      const LeafGeometry part = leaf_of_faces(leaf, shell);
      EXPECT_TRUE(is_closed(part));
      const auto own = loops_of(part);
      for (size_t k = 0; k < shell.size(); ++k) {
        EXPECT_EQ(is_met[shell[k]]++, 0);
        EXPECT_EQ(own[k], loops[shell[k]]);
        EXPECT_EQ(part.facet[k], leaf.facet[shell[k]]);
      }
    }
    EXPECT_EQ(std::count(is_met.begin(), is_met.end(), 1), std::ssize(is_met));
  }
}

TEST(ClosedShells, NumbersOfSomeFaces) {
  LeafGeometry leaf = leaf_of({kBox, box_loops({1, 1, 1}, {2, 2, 2})}, true);
  leaf.surface = std::vector<uint32_t>{0, 1, 2, 3, 4, 5, 7, 7, 7, 7, 7, 7};
  const LeafGeometry part = leaf_of_faces(leaf, faces(6, 6));
  EXPECT_TRUE(part.facet.count_up());
  EXPECT_EQ(part.facet[5], 12u);
  EXPECT_EQ(part.surface.common(), 7u);
  EXPECT_EQ(part.surface.stored(), 0u);
  EXPECT_EQ(part.vertices.size(), 8u);
  const LeafGeometry some = leaf_of_faces(leaf, std::vector<uint32_t>{0, 2, 3});
  EXPECT_EQ(some.facet.list(3), (std::vector<uint32_t>{1, 3, 4}));
  EXPECT_EQ(some.surface.list(3), (std::vector<uint32_t>{0, 2, 3}));
}

}  // namespace
}  // namespace csgrun::test::closed_shells_test
