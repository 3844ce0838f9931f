// Edges and vertices that are no manifold's, against counts of directed edges and faces joined one
// by one.
#include "engine/bsp/non_manifold.h"

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "engine/bsp/union_find.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun::non_manifold_test {
namespace {

using Edge = std::array<uint32_t, 2>;

/// Calls visit(face, corner, from, to) for all directed edges.
template <class Visit>
void for_each_edge(const LeafGeometry& leaf, Visit visit) {
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
    for (uint32_t c = begin; c < end; ++c) {
      visit(f, c, leaf.corners[c], leaf.corners[c + 1 < end ? c + 1 : begin]);
    }
  }
}

NonManifold by_counting(const LeafGeometry& leaf) {
  std::map<Edge, std::vector<uint32_t>> faces, corners;  // of directed edges
  for_each_edge(leaf, [&](uint32_t f, uint32_t c, uint32_t a, uint32_t b) {
    faces[{a, b}].push_back(f);
    corners[{a, b}].push_back(c);
  });
  NonManifold result;
  result.opposite.assign(leaf.corners.size(), UINT32_MAX);
  std::set<uint32_t> ends;
  std::map<uint32_t, std::vector<Edge>> joined;  // faces, by vertex
  for_each_edge(leaf, [&](uint32_t, uint32_t c, uint32_t a, uint32_t b) {
    const auto own = faces[{a, b}], reverse = faces[{b, a}];
    if (own.size() == 1 && reverse.size() == 1) {
      result.opposite[c] = corners[{b, a}][0];
      for (const uint32_t v : {a, b}) joined[v].push_back({own[0], reverse[0]});
      return;
    }
    result.edges.push_back({std::min(a, b), std::max(a, b)});
    ends.insert({a, b});
  });
  std::sort(result.edges.begin(), result.edges.end());
  result.edges.erase(std::unique(result.edges.begin(), result.edges.end()), result.edges.end());
  for (const auto& [vertex, pairs] : joined) {
    if (ends.count(vertex) != 0) continue;
    UnionFind fans(leaf.face_count());
    for (const auto& [f, g] : pairs) fans.join(f, g);
    std::set<uint32_t> roots;
    for (const auto& [f, g] : pairs) roots.insert(fans.find(f));
    if (roots.size() > 1) result.vertices.push_back(vertex);
  }
  return result;
}

TEST(NonManifold, IsFoundInSolidsSideBySide) {
  test::Random random(881);
  size_t edges = 0, vertices = 0, clean = 0;
  for (int round = 0; round < 400; ++round) {
    std::vector<test::Loop> loops;
    for (int64_t i = random.integer(1, 3); i > 0; --i) {
      const auto own = test::random_loops(random, 3);
      loops.insert(loops.end(), own.begin(), own.end());
    }
    auto leaf = *test::make_leaf(loops);
    // A vertex of no face.
    if (round % 4 == 0) leaf.vertices.push_back({70, 70, 70});
    const NonManifold found = find_non_manifold(leaf), expected = by_counting(leaf);
    ASSERT_EQ(found.edges, expected.edges) << round;
    ASSERT_EQ(found.vertices, expected.vertices) << round;
    ASSERT_EQ(found.opposite, expected.opposite) << round;
    leaf.opposite = pair_edges(leaf).opposite;
    ASSERT_EQ(leaf.opposite.empty(), !expected.edges.empty()) << round;
    ASSERT_EQ(find_non_manifold(leaf).vertices, expected.vertices) << round;
    edges += found.edges.size();
    vertices += found.vertices.size();
    clean += found.edges.empty() && found.vertices.empty();
  }
  EXPECT_GT(edges, 200u);
  EXPECT_GT(vertices, 50u);
  EXPECT_GT(clean, 50u);
}

}  // namespace
}  // namespace csgrun::non_manifold_test
