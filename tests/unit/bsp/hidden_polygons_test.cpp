// Polygons inside of what is added or taken away, or outside of what all is cut with, are held
// against nothing, so that the outlines of what meets their neighbours have ends. The result is
// that of cells, which know nothing of it.
#include <gtest/gtest.h>

#include "engine/bsp/covered_polygons.h"
#include "engine/bsp/kernel.h"
#include "engine/bsp/live_faces.h"
#include "engine/bsp/untouched.h"
#include "engine/bsp/whole_faces.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/convex_operand.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"
#include "tests/support/random_trees.h"

namespace csgrun::hidden_polygons_test {
namespace {

using test::convex_operand;
using test::octahedron;

/// What the operands of a cluster look like.
struct Cluster {
  uint64_t seed;
  int64_t reach;           ///< of the middles
  int64_t radius;          ///< of the largest
  bool is_round;           ///< hulls of points all around, instead of bodies with few directions
  bool others;             ///< some operands are not convex, or turned
  bool is_common = false;  ///< what all have in common, instead of unions and differences
};

IVec3 random_point(test::Random& random, int64_t reach) {
  return {random.integer(-reach, reach), random.integer(-reach, reach),
          random.integer(-reach, reach)};
}

/// A body with the shape of a ball, about, of up to so many corners.
Operand round_body(test::Random& random, const IVec3& middle, int64_t radius, int64_t corners) {
  for (;;) {
    std::vector<IVec3> points;
    for (int64_t i = 0; i < corners; ++i) {
      std::array<double, 3> at{};
      double length = 0;
      while (length < 0.1 || length > 1) {
        for (double& c : at) c = static_cast<double>(random.integer(-1000, 1000)) / 1000;
        length = std::hypot(at[0], at[1], at[2]);
      }
      IVec3& p = points.emplace_back();
      for (size_t k = 0; k < 3; ++k) {
        p[k] = middle[k] + std::llround(at[k] / length * static_cast<double>(radius));
      }
    }
    const auto loops = test::hull_loops(points);
    if (!loops.empty()) return convex_operand(loops);
  }
}

Operand random_body(test::Random& random, const Cluster& cluster) {
  const IVec3 middle = random_point(random, cluster.reach);
  // Every third one is large: it hides much of the others.
  const int64_t radius = random.integer(0, 2) == 0
                             ? 2 * cluster.radius
                             : random.integer(2 + cluster.radius / 8, cluster.radius);
  if (cluster.is_round) return round_body(random, middle, radius, random.integer(6, 16));
  if (random.integer(0, 1) == 0) return octahedron(middle, radius);
  IVec3 lo = middle, hi = middle;
  for (size_t k = 0; k < 3; ++k) {
    lo[k] -= random.integer(1, radius);
    hi[k] += random.integer(1, radius);
  }
  return convex_operand(test::box_loops(lo, hi));
}

/// Its bodies, all but the first one of one kind, and a node over them.
test::RandomTree make(test::Random& random, const Cluster& cluster) {
  test::RandomTree tree;
  const auto count = static_cast<uint32_t>(random.integer(3, 9));
  const int64_t half = cluster.reach + cluster.radius / 2;
  for (uint32_t o = 0; o < count; ++o) {
    Operand operand = random_body(random, cluster);
    if (o == 0 && random.integer(0, 2) > 0) {
      operand = convex_operand(test::box_loops({-half, -half, -half}, {half, half, half / 2}));
    }
    if (cluster.others && random.integer(0, 3) == 0) {
      operand = test::operand_of(test::make_leaf(test::mapped(
          test::complex_loops(random),
          {{{{half / 3, 0, 0}, {0, half / 3, 0}, {0, 0, half / 3}}}, {-half, -half, -half}})));
    } else if (cluster.others && random.integer(0, 5) == 0) {
      operand.frame = test::random_frame(random);
    }
    operand.first_source = o;
    tree.operands.push_back(operand);
  }
  const auto op = static_cast<BooleanOp>(random.integer(0, 5) == 0 ? 3
                                         : random.integer(0, 1)    ? 0
                                                                   : 2);
  tree.expression = test::flat_expression(cluster.is_common ? BooleanOp::kIntersection : op, count);
  if (random.integer(0, 3) == 0) {  // one of the bodies is met with another one before
    Expression& e = tree.expression;
    const auto last = static_cast<uint32_t>(e.nodes.size() - 1);
    Expression::Node node = e.nodes[last];
    Expression::Node& inner = e.nodes[last];
    inner.op = BooleanOp::kIntersection;
    inner.first_child = static_cast<uint32_t>(e.children.size());
    inner.child_count = 2;
    e.children.insert(e.children.end(), {count - 2, count - 1});
    node.first_child = static_cast<uint32_t>(e.children.size());
    node.child_count = count - 1;
    for (uint32_t o = 0; o + 2 < count; ++o) e.children.push_back(o);
    e.children.push_back(last);
    e.nodes.push_back(node);
  }
  if (random.integer(0, 2) == 0) {  // all of it is taken from a block, or added to it
    Expression& e = tree.expression;
    const auto last = static_cast<uint32_t>(e.nodes.size() - 1);
    Operand block = convex_operand(test::box_loops({-half, -half, -half}, {half, half, half}));
    block.first_source = count;
    tree.operands.push_back(block);
    Expression::Node node;
    node.operand = count;
    e.nodes.push_back(node);
    node = {};
    node.is_operand = false;
    node.op = random.integer(0, 1) == 0 ? BooleanOp::kDifference : BooleanOp::kUnion;
    node.first_child = static_cast<uint32_t>(e.children.size());
    node.child_count = 2;
    e.children.insert(e.children.end(), {last + 1, last});
    e.nodes.push_back(node);
  }
  tree.region = test::TreeMaker::region_of(tree.operands);
  return tree;
}

enum class Way { kCells, kAllFaces, kLiveFaces };

std::shared_ptr<const BoundaryMesh> evaluate(const test::RandomTree& tree, Way way,
                                             unsigned threads) {
  KernelOptions options;
  options.whole_faces = way != Way::kCells;
  options.name_untouched = way == Way::kLiveFaces;
  if (way == Way::kLiveFaces) options.faces_for_near = 0;
  options.threads = threads;
  EvaluateStats stats;
  const auto result = evaluate_boolean(tree.operands, tree.expression, tree.region, options, stats);
  EXPECT_TRUE(result) << result.error().message;
  return result ? expanded(*result) : std::make_shared<BoundaryMesh>();
}

/// Bars that go through one another, mostly inside of a large body, which is taken away from a
/// block as they are, or they are added to it.
test::RandomTree make_bars(test::Random& random) {
  test::RandomTree tree;
  const int64_t size = random.integer(0, 1) == 0 ? 24 : 3000, wall = random.integer(1, size / 4);
  const bool is_taken_away = random.integer(0, 2) > 0;
  const auto add = [&](Operand operand) {
    operand.first_source = static_cast<uint32_t>(tree.operands.size());
    tree.operands.push_back(std::move(operand));
  };
  if (is_taken_away) {
    add(convex_operand(test::box_loops({-size, -size, -size}, {size, size, size})));
  }
  const int64_t within = size - wall;
  switch (random.integer(0, 2)) {
    case 0:
      add(convex_operand(test::box_loops({-within, -within, -within}, {within, within, size})));
      break;
    case 1:
      add(octahedron({0, 0, 0}, within + size / 2));
      break;
    default:
      add(round_body(random, {0, 0, 0}, within, random.integer(12, 30)));
  }
  const int64_t bars = random.integer(3, 9);
  for (int64_t bar = 0; bar < bars; ++bar) {
    IVec3 lo{}, hi{};
    for (size_t k = 0; k < 3; ++k) {
      lo[k] = random.integer(-size, size - 1);
      hi[k] = lo[k] + random.integer(1, size / 4);
    }
    const auto along = static_cast<size_t>(random.integer(0, 2));
    lo[along] = random.integer(0, 3) == 0 ? random.integer(-size, 0) : -size - 2;
    hi[along] = random.integer(0, 3) == 0 ? random.integer(1, size) : size + 2;
    Operand operand = convex_operand(test::box_loops(lo, hi));
    if (random.integer(0, 5) == 0) operand.frame = test::random_frame(random);
    add(std::move(operand));
  }
  tree.expression =
      test::flat_expression(is_taken_away ? BooleanOp::kDifference : BooleanOp::kUnion,
                            static_cast<uint32_t>(tree.operands.size()));
  tree.region = test::TreeMaker::region_of(tree.operands);
  return tree;
}

TEST(HiddenPolygons, OfBarsThatMeetInACavity) {
  size_t within = 0;
  for (uint64_t i = 0; i < 400; ++i) {
    auto random = test::Random::of_case(972, i);
    const test::RandomTree tree = make_bars(random);
    const Job job(tree.operands);
    const PlainlyCovered plainly = find_plainly_covered(job, tree.expression);
    const auto polygons = static_cast<uint32_t>(job.polygons().size());
    for (uint32_t p = 0; p < polygons; ++p) {
      for (uint32_t q = 0; q < p; ++q) {
        within += job.polygons()[p].operand != job.polygons()[q].operand &&
                  job.boxes()[p].meets(job.boxes()[q]) && plainly.meet_within(job, p, q);
      }
    }
    const auto expected = evaluate(tree, Way::kCells, 1);
    for (const Way way : {Way::kAllFaces, Way::kLiveFaces}) {
      for (const unsigned threads : {1u, 2u}) {
        ASSERT_EQ(test::first_difference(*evaluate(tree, way, threads), *expected), "")
            << "case " << i << ", " << threads << " threads, way " << static_cast<int>(way);
      }
    }
  }
  EXPECT_GT(within, 1000u);
}

constexpr uint64_t kCases = 50;

class HiddenPolygonsOf : public ::testing::TestWithParam<Cluster> {};

TEST_P(HiddenPolygonsOf, ChangeNothing) {
  const Cluster& cluster = GetParam();
  size_t hidden = 0, open = 0, partial = 0;
  for (uint64_t i = 0; i < kCases; ++i) {
    auto random = test::Random::of_case(cluster.seed, i);
    const test::RandomTree tree = make(random, cluster);
    const PlainlyCovered plainly = find_plainly_covered(Job(tree.operands), tree.expression);
    hidden += std::count(plainly.hidden.begin(), plainly.hidden.end(), 1);
    open += std::count(plainly.is_open.begin(), plainly.is_open.end(), 1);
    const auto expected = evaluate(tree, Way::kCells, 1);
    for (const Way way : {Way::kAllFaces, Way::kLiveFaces}) {
      for (const unsigned threads : {1u, 2u}) {
        ASSERT_EQ(test::first_difference(*evaluate(tree, way, threads), *expected), "")
            << "case " << i << ", " << threads << " threads, way " << static_cast<int>(way);
      }
    }
    partial += find_live_faces(tree.operands, tree.expression).has_value();
  }
  EXPECT_GT(hidden, 100u);
  EXPECT_GT(open, 30u);
  EXPECT_GT(partial, 1u);
}

INSTANTIATE_TEST_SUITE_P(
    Clusters, HiddenPolygonsOf,
    ::testing::Values(Cluster{961, 8, 14, false, false}, Cluster{962, 12, 12, false, true},
                      Cluster{963, 40, 60, true, false}, Cluster{964, 3000, 5000, true, false},
                      Cluster{965, 3000, 4000, true, true}, Cluster{966, 5, 9, true, true},
                      Cluster{967, 20, 60, false, false}, Cluster{968, 20, 60, true, false, true},
                      Cluster{969, 1000, 4000, true, false, true},
                      Cluster{970, 1000, 4000, true, true, true},
                      Cluster{971, 30, 60, false, true, true}),
    [](const auto& test) { return "Seed" + std::to_string(test.param.seed); });

}  // namespace
}  // namespace csgrun::hidden_polygons_test
