// How much work the kernel does, in cells and signs, which are the same on every run. A short
// way that is no longer taken gives the same results, so that nothing else would tell.
//
// Limits are what was counted when they were written. Less work is fine; for more, look why.
#include <gtest/gtest.h>

#include "engine/bsp/kernel.h"
#include "engine/bsp/result_pieces.h"
#include "engine/bsp/self_resolution.h"
#include "engine/mesh/leaf_check.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/convex_operand.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"
#include "tests/support/random_trees.h"

namespace csgrun::work_test {
namespace {

struct Work {
  uint64_t cells, surface_cells, solved_cells, critical_cells, filtered, symbolic, exact;
};

void expect_at_most(const EvaluateStats& stats, const Work& limit) {
  EXPECT_LE(stats.cells, limit.cells);
  EXPECT_LE(stats.surface_cells, limit.surface_cells);
  EXPECT_LE(stats.solved_cells, limit.solved_cells);
  EXPECT_LE(stats.critical_cells, limit.critical_cells);
#ifdef NDEBUG  // assertions ask for signs, too
  EXPECT_LE(stats.sign_filter, limit.filtered);
  EXPECT_LE(stats.sign_symbolic, limit.symbolic);
  uint64_t exact = 0;
  for (const uint64_t n : stats.sign_exact) exact += n;
  EXPECT_LE(exact, limit.exact);
#endif
}

EvaluateStats work_of_trees(uint64_t seed, int count, const test::TreeShape& shape,
                            const KernelOptions& options) {
  test::Random random = test::Random::of_case(seed, 0);
  test::TreeMaker maker(random);
  EvaluateStats stats;
  for (int i = 0; i < count; ++i) {
    const auto tree = maker.make(shape);
    EXPECT_TRUE(evaluate_boolean(tree.operands, tree.expression, tree.region, options, stats));
  }
  return stats;
}

KernelOptions cells_only(bool literal) {
  KernelOptions options;
  options.whole_faces = false;
  options.literal_cells = literal;
  options.cell_limit = 5;
  return options;
}

TEST(Work, OfLeavesThatTouch) {
  const EvaluateStats stats = work_of_trees(601, 40, {.size = 4, .operands = 4, .known = true}, {});
  expect_at_most(stats, {197, 120, 111, 98, 45523, 3100, 9486});
}

TEST(Work, OfLeavesThatMayTouchThemselves) {
  const EvaluateStats stats = work_of_trees(602, 40, {.size = 4, .operands = 4}, {});
  expect_at_most(stats, {206, 124, 116, 99, 56697, 4837, 13592});
}

TEST(Work, OfTurnedLeaves) {
  const EvaluateStats stats =
      work_of_trees(603, 20, {.size = 5, .operands = 4, .frames = true, .known = true}, {});
  expect_at_most(stats, {118, 71, 66, 41, 17077, 1223, 1924});
}

TEST(Work, OfLeavesThatCross) {
  const EvaluateStats stats =
      work_of_trees(604, 60, {.size = 1000, .operands = 5, .known = true}, {});
  expect_at_most(stats, {342, 229, 138, 59, 18976, 537, 1699});
}

TEST(Work, OfCells) {
  expect_at_most(work_of_trees(605, 20, {.size = 5, .operands = 4}, cells_only(false)),
                 {1718, 607, 516, 175, 62272, 1604, 4823});
  expect_at_most(
      work_of_trees(606, 10, {.size = 5, .operands = 3, .frames = true}, cells_only(false)),
      {840, 320, 308, 45, 29093, 685, 1151});
  expect_at_most(work_of_trees(607, 20, {.size = 1000, .operands = 4}, cells_only(false)),
                 {1398, 539, 376, 173, 46122, 1187, 1993});
}

TEST(Work, OfLiteralCells) {
  expect_at_most(work_of_trees(608, 8, {.size = 5, .operands = 3}, cells_only(true)),
                 {574, 210, 170, 0, 36306, 3241, 2434});
}

/// Where somebody who presents results has to look for contacts.
struct Places {
  uint64_t boxes = 0;
  int64_t extent = 0;  ///< the sum of the three lengths of all of them
  uint64_t anywhere = 0;

  void add(const BoundaryMesh& mesh) {
    anywhere += mesh.may_touch && mesh.touches.empty();
    boxes += mesh.touches.size();
    for (const GridBox& b : mesh.touches) {
      for (size_t k = 0; k < 3; ++k) extent += b.hi[k] - b.lo[k];
    }
  }
};

/// More of them cost time. Fewer may be fine, but then places may have been lost: look why.
void expect_same(const Places& places, const Places& expected) {
  EXPECT_EQ(places.boxes, expected.boxes);
  EXPECT_EQ(places.extent, expected.extent);
  EXPECT_EQ(places.anywhere, expected.anywhere);
}

/// Two boxes with a common edge, which is an edge of four faces of one leaf that crosses nothing.
std::shared_ptr<LeafGeometry> boxes_sharing_an_edge() {
  auto loops = test::box_loops({0, 0, 0}, {2, 2, 4});
  const auto second = test::box_loops({2, 2, 0}, {4, 4, 4});
  loops.insert(loops.end(), second.begin(), second.end());
  auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(loops));
  leaf->may_touch = false;
  return leaf;
}

/// `sharing`: some leaves have an edge of four faces, at which much is left to cells.
Places places_of_trees(uint64_t seed, int count, const test::TreeShape& shape,
                       bool sharing = false) {
  test::Random random = test::Random::of_case(seed, 0);
  test::TreeMaker maker(random);
  EvaluateStats stats;
  Places places;
  for (int i = 0; i < count; ++i) {
    auto tree = maker.make(shape);
    if (sharing) tree.operands[static_cast<size_t>(i % 2)].leaf = boxes_sharing_an_edge();
    const auto mesh = evaluate_boolean(tree.operands, tree.expression, tree.region, {}, stats);
    EXPECT_TRUE(mesh);
    if (mesh) places.add(**mesh);
  }
  return places;
}

// What is found about contacts when a result is made spares those who present it the search.
TEST(Work, OfLookingForContacts) {
  expect_same(places_of_trees(613, 150, {.size = 4, .operands = 3, .known = true}),
              {1736, 12706, 0});
  expect_same(places_of_trees(614, 60, {.size = 5, .operands = 4, .frames = true, .known = true}),
              {745, 4641, 0});
  expect_same(places_of_trees(615, 40, {.size = 1000, .operands = 4, .known = true}),
              {48, 8128, 0});
  expect_same(places_of_trees(617, 60, {.size = 5, .operands = 3, .known = true}, true),
              {2298, 16194, 0});
}

/// Tetrahedra about as large as the distance between them.
std::vector<Operand> cloud(test::Random& random, int count) {
  std::vector<Operand> operands;
  while (operands.size() < static_cast<size_t>(count)) {
    const IVec3 at{random.integer(0, 4000), random.integer(0, 4000), random.integer(0, 4000)};
    std::vector<IVec3> corners(4, at);
    for (IVec3& p : corners) {
      for (int64_t& c : p) c += random.integer(-400, 400);
    }
    const auto loops = test::hull_loops(corners);
    if (loops.empty()) continue;
    auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(loops));
    leaf->opposite = pair_edges(*leaf).opposite;
    leaf->may_touch = false;
    leaf->convex = true;
    operands.push_back(test::operand_of(leaf));
    operands.back().first_source = static_cast<uint32_t>(operands.size());
  }
  return operands;
}

TEST(Work, OfManyOperands) {
  test::Random random = test::Random::of_case(609, 0);
  const std::vector<Operand> operands = cloud(random, 100);
  const GridBox region = test::TreeMaker::region_of(operands);
  const auto work = [&](BooleanOp op, bool whole_faces) {
    KernelOptions options;
    options.cell_limit = 3;
    options.whole_faces = whole_faces;
    EvaluateStats stats;
    EXPECT_TRUE(evaluate_boolean(operands, test::flat_expression(op, 100), region, options, stats));
    return stats;
  };
  expect_at_most(work(BooleanOp::kUnion, true), {490, 389, 297, 22, 3465, 0, 0});
  expect_at_most(work(BooleanOp::kUnion, false), {6909, 3282, 1289, 356, 157976, 0, 1416});
  expect_at_most(work(BooleanOp::kDifference, true), {5, 137, 2, 0, 0, 0, 0});
  expect_at_most(work(BooleanOp::kDifference, false), {41, 6, 0, 0, 0, 0, 0});
  expect_at_most(work(BooleanOp::kSymmetricDifference, true), {490, 389, 297, 22, 3465, 0, 0});
}

TEST(Work, OfBoxes) {
  test::Random random = test::Random::of_case(612, 0);
  std::vector<Operand> boxes;
  for (uint32_t o = 0; o < 80; ++o) {
    IVec3 lo{}, hi{};
    for (size_t k = 0; k < 3; ++k) {
      lo[k] = random.integer(0, 60);
      hi[k] = lo[k] + random.integer(1, 12);
    }
    boxes.push_back(test::operand_of(test::box_leaf(lo, hi)));
    boxes.back().first_source = o;
  }
  const GridBox region = test::TreeMaker::region_of(boxes);
  for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kDifference}) {
    EvaluateStats stats;
    EXPECT_TRUE(evaluate_boolean(boxes, test::flat_expression(op, 80), region, {}, stats));
    expect_at_most(stats, op == BooleanOp::kUnion ? Work{167, 84, 81, 40, 7348, 1164, 1056}
                                                  : Work{15, 37, 1, 0, 0, 0, 0});
  }
}

// Of a convex body with a face in a polygon's plane, that face alone is asked.
TEST(Work, OfCapsInOnePlane) {
  std::vector<Operand> prisms;
  for (int64_t x = 0; x < 5; ++x) {
    for (int64_t y = 0; y < 5; ++y) {
      std::vector<IVec3> corners;
      for (const int64_t z : {0, 1000}) {
        for (const int64_t s : {-1, 1}) {
          for (const int64_t t : {-1, 1}) {
            corners.push_back({1000 * x + 600 * s, 1000 * y + 250 * t, z});
            corners.push_back({1000 * x + 250 * s, 1000 * y + 600 * t, z});
          }
        }
      }
      prisms.push_back(test::convex_operand(test::hull_loops(corners)));
    }
  }
  EvaluateStats stats;
  EXPECT_TRUE(evaluate_boolean(prisms, test::flat_expression(BooleanOp::kUnion, 25),
                               test::TreeMaker::region_of(prisms), {}, stats));
  expect_at_most(stats, {95, 48, 48, 48, 30471, 2555, 910});
}

TEST(Work, OfSurfacesThatCrossThemselves) {
  test::Random random = test::Random::of_case(610, 0);
  EvaluateStats stats[5];
  for (int i = 0; i < 4; ++i) {
    std::vector<test::Loop> loops;
    for (int k = 0; k < 4; ++k) {
      auto own = test::random_loops(random, 4);
      if (k == 3) {
        for (auto& loop : own) {
          for (IVec3& p : loop) p[0] += 20;
        }
      }
      loops.insert(loops.end(), own.begin(), own.end());
    }
    const Operand surface = test::operand_of(test::make_leaf(loops));
    const auto crossings = find_self_intersections(*surface.leaf);
    for (size_t rule = 0; rule < 5; ++rule) {
      EXPECT_TRUE(
          resolve_surface(surface, crossings, static_cast<InsideRule>(rule), {}, stats[rule]));
    }
  }
  expect_at_most(stats[0], {102, 38, 38, 0, 51714, 5402, 6890});
  expect_at_most(stats[1], {102, 38, 38, 0, 51714, 5402, 6890});
  expect_at_most(stats[2], {102, 38, 38, 0, 51714, 5402, 6890});
  expect_at_most(stats[3], {182, 79, 79, 0, 100649, 13758, 10352});
  expect_at_most(stats[4], {182, 79, 79, 0, 100649, 13758, 10352});
}

TEST(Work, OfChains) {
  test::Random random = test::Random::of_case(611, 0);
  const std::vector<Operand> operands = cloud(random, 120);
  const GridBox region = test::TreeMaker::region_of(operands);
  EvaluateStats stats;
  auto version = evaluate_pieces({operands[0], operands[1]},
                                 test::flat_expression(BooleanOp::kUnion, 2), region, {}, stats);
  for (size_t i = 2; i < operands.size(); ++i) {
    ASSERT_TRUE(version && *version);
    const auto op = i % 4 == 0 ? BooleanOp::kDifference : BooleanOp::kUnion;
    version =
        change_pieces(**version, {operands[i]}, test::flat_expression(op, 2), region, {}, stats);
  }
  expect_at_most(stats, {133, 126, 45, 18, 3697, 60, 7});
  uint64_t bytes = (*version)->bytes;
  EXPECT_LE(bytes, 29872u);
}

// What is left of a polygon is cut into as few pieces as one region needs, whatever it was put
// together from.
TEST(Work, OfChainsThatTouch) {
  test::Random random = test::Random::of_case(616, 0);
  test::TreeMaker maker(random);
  EvaluateStats stats;
  size_t pieces = 0, points = 0;
  for (int i = 0; i < 20; ++i) {
    const auto tree = maker.make({.size = 4, .operands = 8, .known = true});
    auto version =
        evaluate_pieces({tree.operands[0], tree.operands[1]},
                        test::flat_expression(BooleanOp::kUnion, 2), tree.region, {}, stats);
    for (size_t o = 2; o < tree.operands.size() && version && *version; ++o) {
      const auto op = o % 2 ? BooleanOp::kDifference : BooleanOp::kUnion;
      version = change_pieces(**version, {tree.operands[o]}, test::flat_expression(op, 2),
                              tree.region, {}, stats);
    }
    ASSERT_TRUE(version);
    if (!*version) continue;
    pieces += (*version)->store->piece_count();
    points += (*version)->store->point_count();
  }
  EXPECT_LE(pieces, 1409u);
  EXPECT_LE(points, 2468u);
}

}  // namespace
}  // namespace csgrun::work_test
