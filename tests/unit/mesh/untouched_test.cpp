// Results that name untouched triangles of leaves against the same results spelled out: both must
// be one value, and present as the same arrays to the last bit.
#include "engine/bsp/untouched.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/mesh/convex_surface.h"
#include "engine/mesh/leaf_shape.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/kernel_case.h"
#include "tests/support/named_results.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::untouched_test {
namespace {

using namespace test;  // NOLINT: a test

/// A ball of triangles without facets of their own; some lie in one plane with a neighbour. (Small
/// ones of many triangles are not convex: 12 steps allow 3 an edge of an octant.)
std::shared_ptr<LeafGeometry> ball(int64_t radius, int n) {
  std::vector<Loop> loops;
  for (int octant = 0; octant < 8; ++octant) {
    const auto at = [&](int i, int j) {
      const int c[3] = {i, j, n - i - j};
      const double length = std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
      IVec3 p;
      for (int k = 0; k < 3; ++k) {
        p[k] =
            std::llround(static_cast<double>(radius) * c[k] / length) * (octant >> k & 1 ? -1 : 1);
      }
      return p;
    };
    const auto add = [&](Loop loop) {
      const bool mirrored = ((octant & 1) + (octant >> 1 & 1) + (octant >> 2 & 1)) % 2 != 0;
      if (mirrored) std::reverse(loop.begin(), loop.end());
      loops.push_back(std::move(loop));
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        add({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < n) add({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  auto leaf = std::make_shared<LeafGeometry>(*make_leaf(loops, false, 1));
  leaf->opposite = pair_edges(*leaf).opposite;
  leaf->may_touch = false;
  leaf->convex = find_convex_surface(*leaf, box_of_points(leaf->vertices)).is_convex;
  EXPECT_TRUE(leaf->convex);
  return leaf;
}

TEST(Untouched, RandomTreesOfBumpySurfaces) {
  Random random(1201);
  constexpr int64_t kSize = 1 << 20;
  size_t total = 0, spelled = 0;
  for (int round = 0; round < 12; ++round) {
    const IVec3 origin{0, 0, 0};
    const auto once = leaf_of_triangles(bumpy_torus(random, origin, kSize));
    const auto twice = leaf_of_triangles(bumpy_torus(random, origin, kSize) +
                                         bumpy_torus(random, {0, 0, kSize}, kSize));
    const auto numbers = [&](size_t count) {
      std::vector<uint32_t> list(count);
      for (uint32_t& n : list) n = static_cast<uint32_t>(random.integer(0, 2));
      return list;
    };
    once->appearance = numbers(once->face_count());
    twice->surface = numbers(twice->face_count());
    std::vector<Operand> operands;
    for (int i = 0; i < 4; ++i) {
      const auto move = [&] { return random.integer(-kSize, kSize); };
      operands.push_back(placed(random.integer(0, 1) ? once : twice, {move(), move(), move()}));
      if (random.integer(0, 3) == 0) operands.back().appearance = 3;
    }
    const Tree tree = random_binary_tree(random, 0, 4);
    const Pair pair = evaluate_both(tree, operands);
    total += named(*pair.naming);
    // Faces next to a cut one are named, too: but for some that were cut and are whole again.
    for (const BoundaryMesh::Face& f : pair.naming->faces) spelled += f.whole;
    ASSERT_NO_FATAL_FAILURE(expect_one_value(pair, tree.text()));
  }
  EXPECT_GT(total, 500u);
  EXPECT_LT(spelled, total / 40);
}

// Turned, sheared and mirrored leaves, whose points are quotients, among others.
TEST(Untouched, InFrames) {
  Random random(1206);
  constexpr int64_t kSize = 1 << 18;
  size_t total = 0, in_frames = 0;
  for (int round = 0; round < 24; ++round) {
    std::vector<Operand> operands;
    for (int i = 0; i < 3; ++i) {
      const auto move = [&] { return random.integer(-kSize, kSize); };
      const auto torus = leaf_of_triangles(bumpy_torus(random, {0, 0, 0}, kSize));
      const auto box =
          leaf_of_triangles(tiled_box(random, {-kSize / 2, -kSize / 2, -kSize / 2}, 8, kSize / 8));
      operands.push_back(placed(round % 3 == 0   ? box
                                : round % 3 == 1 ? torus
                                                 : ball(kSize, 6),
                                {move(), move(), move()}));
      if (i > 0) operands.back().frame = random_frame(random);
    }
    const Tree tree = random_binary_tree(random, 0, 3);
    const Pair pair = evaluate_both(tree, operands);
    total += named(*pair.naming);
    for (const UntouchedPart& part : pair.naming->parts) {
      if (!part.map.is_identity()) in_frames += part.faces.size();
    }
    ASSERT_NO_FATAL_FAILURE(expect_one_value(pair, std::to_string(round) + tree.text()));
    // Moving by whole steps.
    Pair moved;
    moved.spelled =
        std::make_shared<BoundaryMesh>(translated(*pair.spelled, {17, -12345, 1 << 20}));
    moved.naming = std::make_shared<BoundaryMesh>(translated(*pair.naming, {17, -12345, 1 << 20}));
    ASSERT_NO_FATAL_FAILURE(expect_one_value(moved, std::to_string(round) + " moved"));
  }
  EXPECT_GT(total, 500u);
  EXPECT_GT(in_frames, 500u);
}

/// Random trees over what `make(round)` gives. Many faces must be named, and more than so many
/// results touch themselves, or nothing was tested.
template <class Make>
void expect_one_value_of_trees(Random& random, int rounds, size_t least_contacts, Make&& make) {
  size_t total = 0, contacts = 0;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Operand> operands = make(round);
    const Tree tree = random_binary_tree(random, 0, static_cast<int>(operands.size()));
    const Pair pair = evaluate_both(tree, operands);
    total += named(*pair.naming);
    contacts += pair.naming->may_touch;
    ASSERT_NO_FATAL_FAILURE(expect_one_value(pair, std::to_string(round) + tree.text()));
  }
  EXPECT_GT(total, 500u);
  EXPECT_GT(contacts, least_contacts);
}

TEST(Untouched, ContactsOfTiledBoxes) {
  Random random(1202);
  expect_one_value_of_trees(random, 60, 20, [&](int) {
    std::vector<Operand> operands;
    for (int i = 0; i < 3; ++i) {
      const auto move = [&] { return random.integer(-6, 6); };
      const int64_t step = random.integer(1, 2);
      const auto box =
          leaf_of_triangles(tiled_box(random, {0, 0, 0}, random.integer(4, 12) / step, step));
      operands.push_back(placed(box, {move(), move(), move()}));
    }
    return operands;
  });
}

TEST(Untouched, Balls) {
  Random random(1205);
  expect_one_value_of_trees(random, 120, 3, [&](int round) {
    const int64_t radius = round % 2 ? 1 << 20 : 12, step = round % 2 ? 1 : 3;
    std::vector<Operand> operands;
    for (int i = 0; i < 4; ++i) {
      const auto move = [&] {
        return step * random.integer(-2 * radius / step, 2 * radius / step);
      };
      operands.push_back(placed(ball(radius, round % 2 ? 8 : 3), {move(), move(), move()}));
    }
    return operands;
  });
}

// A hole whose rim is edges of the ball that made it: the faces at the rim are met there, and
// named.
TEST(Untouched, WhatOthersOnlyRestOn) {
  const int64_t radius = 1 << 20;
  const auto tool = ball(radius, 8);
  size_t below = 0;
  for (size_t f = 0; f < tool->face_count(); ++f) {
    below += std::all_of(tool->corners.begin() + tool->face_starts[f],
                         tool->corners.begin() + tool->face_starts[f + 1],
                         [&](uint32_t v) { return tool->vertices[v][2] <= 0; });
  }
  ASSERT_EQ(2 * below, tool->face_count());
  const auto block = std::make_shared<LeafGeometry>(
      *box_leaf({-3 * radius, -3 * radius, -3 * radius}, {3 * radius, 3 * radius, 0}));
  block->may_touch = false;
  std::vector<Operand> operands{operand_of(block), placed(tool, {5, 7, 0})};
  const Pair hole = evaluate_both(less({leaf(0), leaf(1)}), operands);
  EXPECT_EQ(named(*hole.naming), below);
  EXPECT_FALSE(hole.naming->may_touch);
  expect_one_value(hole, "a hole");
  const Pair bump = evaluate_both(join({leaf(0), leaf(1)}), operands);
  EXPECT_EQ(named(*bump.naming), below);
  expect_one_value(bump, "a bump");
  // Another ball that rests on the first one's rim with a corner: there, two fans meet.
  operands.push_back(placed(tool, {5 + 2 * radius, 7, 0}));
  const Pair both = evaluate_both(less({leaf(0), leaf(1), leaf(2)}), operands);
  EXPECT_LT(named(*both.naming), 2 * below);
  EXPECT_GT(named(*both.naming), 2 * below - 20);
  expect_one_value(both, "two holes");
}

// Balls and blocks that share corners, edges and planes everywhere.
TEST(Untouched, RimsOfBallsOnBlocks) {
  Random random(1207);
  constexpr int64_t kRadius = 12;
  expect_one_value_of_trees(random, 150, 20, [&](int) {
    std::vector<Operand> operands;
    for (int i = 0; i < 4; ++i) {
      const auto move = [&] { return kRadius / 2 * random.integer(-2, 2); };
      const IVec3 at{move(), move(), random.integer(0, 3) == 0 ? move() : 0};
      if (random.integer(0, 2) == 0) {
        operands.push_back(placed(box_leaf({-20, -20, -20}, {20, 20, 0}), at));
      } else {
        operands.push_back(placed(ball(kRadius, static_cast<int>(random.integer(1, 3))), at));
      }
    }
    return operands;
  });
}

TEST(Untouched, MovedAndTurnedOver) {
  Random random(1203);
  const auto torus = leaf_of_triangles(bumpy_torus(random, {5, 6, 7}, 1000.5));
  const auto box = leaf_of_triangles(tiled_box(random, {-300, -300, -300}, 20, 30));
  const auto check = [](const Tree& tree, const std::vector<Operand>& operands) {
    Pair pair = evaluate_both(tree, operands);
    EXPECT_GT(named(*pair.naming), 100u) << tree.text();
    ASSERT_NO_FATAL_FAILURE(expect_one_value(pair, tree.text()));
    for (Boundary* result : {&pair.spelled, &pair.naming}) {
      *result = std::make_shared<BoundaryMesh>(translated(**result, {17, -123456, 1 << 20}));
    }
    ASSERT_NO_FATAL_FAILURE(expect_one_value(pair, tree.text() + " moved"));
  };
  check(leaf(0), {placed(torus, {0, 0, 0})});
  // A cavity: its faces are turned over.
  check(less({leaf(0), leaf(1)}),
        {placed(leaf_of_triangles(tiled_box(random, {-4000, -4000, -4000}, 16, 500)), {0, 0, 0}),
         placed(torus, {1, 2, 3})});
  check(differ({leaf(0), leaf(1)}), {placed(torus, {0, 0, 0}), placed(box, {1000, 0, 0})});
  check(join({leaf(0), leaf(1)}), {placed(torus, {0, 0, 0}), placed(torus, {0, 0, 100000})});
}

TEST(Untouched, WhatCannotBeNamed) {
  Random random(1204);
  const auto loops = tiled_box(random, {0, 0, 0}, 6, 2);
  const auto count = [](const Leaf& leaf) {
    return named(*evaluate_both(test::leaf(0), {operand_of(leaf)}).naming);
  };
  const auto plain = leaf_of_triangles(loops);
  EXPECT_EQ(count(plain), plain->face_count());
  const auto changed = [&](auto change) {
    auto leaf = std::make_shared<LeafGeometry>(*plain);
    change(*leaf);
    return count(leaf);
  };
  EXPECT_EQ(changed([](LeafGeometry& l) { l.may_touch = true; }), 0u);
  EXPECT_EQ(changed([](LeafGeometry& l) { l.opposite.clear(); }), 0u);
  EXPECT_EQ(changed([](LeafGeometry& l) { l.facet = FaceNumbers(); }), 0u);
  EXPECT_EQ(changed([](LeafGeometry& l) {
              l.facet = FaceNumbers();
              l.convex = true;
            }),
            0u);
  // Two triangles that are one facet; they lie in one plane. Nor are those at its corners named.
  std::vector<uint32_t> facets = plain->facet.list(plain->face_count());
  facets[1] = facets[0];
  const size_t others = changed([&](LeafGeometry& l) { l.facet = facets; });
  EXPECT_LT(others, plain->face_count() - 2);
  EXPECT_GT(others, plain->face_count() - 30);
  // Several in a row: the facet runs straight past corners of its neighbours.
  auto row = std::make_shared<LeafGeometry>(*plain);
  std::fill(facets.begin(), facets.begin() + 8, facets[0]);
  row->facet = facets;
  const Pair straight = evaluate_both(leaf(0), {operand_of(row)});
  EXPECT_GT(named(*straight.naming), plain->face_count() / 2);
  expect_one_value(straight, "a row of triangles");
  // Boxes that have a corner in common: its faces form two fans.
  const auto corner = leaf_of_triangles(loops + tiled_box(random, {12, 12, 12}, 6, 2));
  ASSERT_FALSE(corner->opposite.empty());
  const Pair pair = evaluate_both(leaf(0), {operand_of(corner)});
  EXPECT_LT(named(*pair.naming), corner->face_count());
  EXPECT_GT(named(*pair.naming), corner->face_count() - 20);
  expect_one_value(pair, "two boxes");
}

}  // namespace
}  // namespace csgrun::untouched_test
