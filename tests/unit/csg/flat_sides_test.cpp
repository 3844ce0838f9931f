// Faces of convex leaves that are joined, and what is made of them.
#include "engine/csg/flat_sides.h"

#include <gtest/gtest.h>

#include "engine/bsp/kernel.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/random_solids.h"
#include "tests/support/random_trees.h"

namespace csgrun::flat_sides_test {
namespace {

using test::Loop;

LeafGeometry convex_leaf(const std::vector<Loop>& loops) {
  LeafGeometry leaf = *test::make_leaf(loops);
  leaf.opposite = pair_edges(leaf).opposite;
  leaf.convex = true;
  leaf.may_touch = false;
  EXPECT_FALSE(leaf.opposite.empty());
  return leaf;
}

/// Each side of a box of size n as n x n squares of two triangles.
std::vector<Loop> divided_box(int64_t n) {
  std::vector<Loop> loops;
  for (const Loop& side : test::box_loops({0, 0, 0}, {1, 1, 1})) {
    const auto at = [&](int64_t i, int64_t j) {
      IVec3 p;
      for (size_t k = 0; k < 3; ++k) {
        p[k] = n * side[0][k] + i * (side[1][k] - side[0][k]) + j * (side[3][k] - side[0][k]);
      }
      return p;
    };
    for (int64_t i = 0; i < n; ++i) {
      for (int64_t j = 0; j < n; ++j) {
        loops.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        loops.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  return loops;
}

TEST(FlatSides, OfABoxAreSix) {
  for (const int64_t n : {1, 2, 5}) {
    LeafGeometry leaf = convex_leaf(divided_box(n));
    join_flat_faces(leaf);
    EXPECT_EQ(leaf.face_count(), 6u);
    EXPECT_EQ(leaf.corners.size(), 24u);
    EXPECT_EQ(leaf.vertices.size(), 8u);
    EXPECT_TRUE(leaf.convex);
    EXPECT_FALSE(leaf.may_touch);
    const EdgePairing pairing = pair_edges(leaf);
    EXPECT_TRUE(pairing.is_balanced);
    EXPECT_EQ(leaf.opposite, pairing.opposite);
  }
}

TEST(FlatSides, OfOtherLabelsStayApart) {
  // A triangle of a side in a colour of its own: both are convex. A square of four: what is left is
  // not, and stays as it was, and so do all corners on edges that the side still has.
  for (int kind = 0; kind < 3; ++kind) {
    const auto label = [&](LeafGeometry& leaf, uint32_t f) {
      FaceNumbers& numbers = kind == 0 ? leaf.appearance : kind == 1 ? leaf.surface : leaf.facet;
      std::vector<uint32_t> list = numbers.list(leaf.face_count());
      list[f] = 9;
      numbers = list;
    };
    LeafGeometry halves = convex_leaf(divided_box(1));
    label(halves, 3);
    join_flat_faces(halves);
    EXPECT_EQ(halves.face_count(), 7u);
    EXPECT_EQ(halves.corners.size(), 26u);
    LeafGeometry quarter = convex_leaf(divided_box(2));
    label(quarter, 0), label(quarter, 1);
    join_flat_faces(quarter);
    // Five sides, the square, and six triangles; two corners in the middle of edges and the middle.
    EXPECT_EQ(quarter.face_count(), 12u);
    EXPECT_EQ(quarter.vertices.size(), 13u);
    EXPECT_TRUE(pair_edges(quarter).is_balanced);
  }
}

TEST(FlatSides, OfMeshesWithoutAnyAreLeftAsTheyAre) {
  const LeafGeometry before = convex_leaf({{{0, 0, 0}, {0, 4, 0}, {4, 0, 0}},
                                           {{0, 0, 0}, {4, 0, 0}, {0, 0, 4}},
                                           {{0, 0, 0}, {0, 0, 4}, {0, 4, 0}},
                                           {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}}});
  LeafGeometry leaf = before;
  join_flat_faces(leaf);
  EXPECT_EQ(leaf.corners, before.corners);
  EXPECT_EQ(leaf.vertices, before.vertices);
}

// Large coordinates: doubles say nothing of what is nearly flat.
TEST(FlatSides, AreFlatExactly) {
  constexpr int64_t big = (int64_t{1} << 27) - 2;
  for (const int64_t bulge : {0, 1}) {
    // A pyramid over a square whose half bends by one step in 2^27.
    const IVec3 a{0, 0, 0}, b{big, 0, 0}, c{big, big, -bulge}, d{0, big, 0},
        top{big / 2, big / 2, big};
    LeafGeometry leaf =
        convex_leaf({{b, a, d}, {b, d, c}, {a, b, top}, {b, c, top}, {c, d, top}, {d, a, top}});
    join_flat_faces(leaf);
    EXPECT_EQ(leaf.face_count(), bulge ? 6u : 5u);
  }
}

TEST(FlatSides, ChangeNoResult) {
  test::Random random(511);
  size_t joined = 0;
  for (int i = 0; i < 60; ++i) {
    std::vector<Operand> plain, flat;
    for (uint32_t o = 0; o < 3; ++o) {
      LeafGeometry leaf = convex_leaf(divided_box(random.integer(1, 3)));
      Operand operand;
      operand.first_source = o;
      for (int64_t& t : operand.translation) t = random.integer(-2, 2);
      operand.leaf = std::make_shared<LeafGeometry>(leaf);
      plain.push_back(operand);
      const size_t before = leaf.face_count();
      join_flat_faces(leaf);
      joined += before - leaf.face_count();
      operand.leaf = std::make_shared<LeafGeometry>(std::move(leaf));
      flat.push_back(operand);
    }
    Expression e;
    for (uint32_t o = 0; o < 3; ++o) {
      e.nodes.emplace_back().operand = o;
      e.children.push_back(o);
    }
    Expression::Node root;
    root.is_operand = false;
    root.op = static_cast<BooleanOp>(random.integer(0, 3));
    root.child_count = 3;
    e.nodes.push_back(root);
    EvaluateStats stats;
    KernelOptions options;
    options.whole_faces = false;
    const GridBox region = test::TreeMaker::region_of(plain);
    const auto x = evaluate_boolean(plain, e, region, options, stats);
    const auto y = evaluate_boolean(flat, e, region, {}, stats);
    ASSERT_TRUE(x && y);
    ASSERT_EQ(test::first_difference(**x, **y), "");
  }
  EXPECT_GT(joined, 1000u);
}

}  // namespace
}  // namespace csgrun::flat_sides_test
