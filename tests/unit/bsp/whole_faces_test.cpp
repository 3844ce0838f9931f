// The fast way and the general one give the same value; and the fast one leaves little.
#include "engine/bsp/whole_faces.h"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <random>
#include <thread>
#include <tuple>

#include <gtest/gtest.h>

#include "engine/bsp/find_contacts.h"
#include "engine/bsp/grid_planes.h"
#include "engine/bsp/kernel.h"
#include "engine/bsp/unate.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/half_space.h"
#include "tests/support/kernel_case.h"
#include "tests/support/prepared_leaf.h"
#include "tests/support/random_solids.h"
#include "tests/support/random_trees.h"

namespace csgrun::whole_faces_test {
namespace {

std::shared_ptr<const BoundaryMesh> evaluate(const test::RandomTree& tree, bool whole_faces,
                                             unsigned threads = 1) {
  KernelOptions options;
  options.whole_faces = whole_faces;
  options.threads = threads;
  EvaluateStats stats;
  const auto result = evaluate_boolean(tree.operands, tree.expression, tree.region, options, stats);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *result : std::make_shared<BoundaryMesh>();
}

/// Random trees of one shape; a part of them a test, which is quick.
struct Shape {
  uint64_t seed;
  test::TreeShape shape;
  uint64_t trees;  ///< a part
};
class WholeFacesOfTrees : public ::testing::TestWithParam<std::tuple<Shape, uint64_t>> {};

TEST_P(WholeFacesOfTrees, AreWhatCellsGive) {
  const auto& [shape, part] = GetParam();
  for (uint64_t i = part * shape.trees; i < (part + 1) * shape.trees; ++i) {
    auto random = test::Random::of_case(shape.seed, i);
    const auto tree = test::TreeMaker(random).make(shape.shape);
    const auto slow = evaluate(tree, false);
    ASSERT_EQ(test::first_difference(*evaluate(tree, true), *slow), "") << "tree " << i;
    ASSERT_EQ(test::first_difference(*evaluate(tree, true, 3), *slow), "") << "tree " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Parts, WholeFacesOfTrees,
    ::testing::Combine(
        ::testing::Values(
            Shape{401, {.size = 5, .operands = 2, .depth = 1, .frames = false}, 25},
            Shape{402, {.size = 8, .operands = 6, .depth = 3, .frames = false}, 8},
            Shape{403, {.size = 1000, .operands = 4, .depth = 2, .frames = false}, 8},
            Shape{404, {.size = 6, .operands = 3, .depth = 2, .frames = true}, 6},
            Shape{409, {.size = 4, .operands = 4, .depth = 2, .frames = false, .known = true}, 20},
            Shape{410, {.size = 8, .operands = 6, .depth = 3, .frames = true, .known = true}, 6}),
        ::testing::Range<uint64_t>(0, 10)),
    [](const auto& test) {
      return "Seed" + std::to_string(std::get<0>(test.param).seed) + "Part" +
             std::to_string(std::get<1>(test.param));
    });

/// A tetrahedron one of whose faces has the origin inside, so that all such faces, and what they
/// cross, meet in one point.
test::Leaf wedge_at_origin(test::Random& random) {
  for (;;) {
    const auto vector = [&] {
      return IVec3{random.integer(-40, 40), random.integer(-40, 40), random.integer(-40, 40)};
    };
    const IVec3 a = vector(), b = vector(), tip = vector();
    const IVec3 c{-a[0] - b[0], -a[1] - b[1], -a[2] - b[2]};
    if (std::abs(test::dot_of(test::cross_of(a, b), tip)) < 10000) continue;
    return test::make_leaf(test::hull_loops({a, b, c, tip}));
  }
}

// By names nothing touches here, and yet cuts meet in one point, inside of a face and on its edge.
TEST(WholeFaces, CutsThatMeetInOnePointAreLikeThoseOfCells) {
  test::Random random(407);
  for (int i = 0; i < 24; ++i) {
    test::RandomTree tree;
    tree.operands.emplace_back().leaf =
        test::box_leaf({-50, -50, -50}, {50, i % 3 ? 50 : 0, i % 2 ? 0 : 50});
    for (int k = 0; k < 3; ++k) tree.operands.emplace_back().leaf = wedge_at_origin(random);
    for (uint32_t o = 0; o < 4; ++o) tree.operands[o].first_source = o;
    tree.expression = test::flat_expression(static_cast<BooleanOp>(i / 6), 4);
    tree.region = test::TreeMaker::region_of(tree.operands);
    ASSERT_EQ(test::first_difference(*evaluate(tree, true), *evaluate(tree, false)), "")
        << "case " << i;
  }
}

// A sheet along several edges of its polygon, between which there are straight angles, passes
// corners of others of its operand.
TEST(WholeFaces, SheetsAlongSeveralEdgesAreLikeThoseOfCells) {
  test::Random random(419);
  for (int i = 0; i < 400; ++i) {
    test::RandomTree tree;
    for (uint32_t o = 0; o < 2; ++o) {
      std::vector<test::Loop> loops;
      while (loops.empty()) loops = test::tent_loops(random, 5);
      if (o == 0 && i % 2 == 0) loops = test::box_loops({0, 0, 0}, {5, 5, 5});
      Operand& operand = tree.operands.emplace_back();
      operand.leaf = test::as_prepared(test::make_leaf(loops));
      operand.first_source = o;
    }
    tree.expression = test::flat_expression(static_cast<BooleanOp>(i / 2 % 4), 2);
    tree.region = test::TreeMaker::region_of(tree.operands);
    ASSERT_EQ(test::first_difference(*evaluate(tree, true), *evaluate(tree, false)), "")
        << "case " << i;
  }
}

// The same with edges through the point: cuts end where others pass.
TEST(WholeFaces, CutsThatEndOnOthersAreLikeThoseOfCells) {
  test::Random random(414);
  for (int i = 0; i < 80; ++i) {
    const auto vector = [&] {
      return IVec3{random.integer(-30, 30), random.integer(-30, 30), random.integer(-30, 30)};
    };
    const auto edge_at_origin = [&] {
      for (;;) {
        const IVec3 a = vector(), tip = vector(), other = vector();
        if (std::abs(test::dot_of(test::cross_of(a, tip), other)) < 5000 || std::abs(a[2]) < 5) {
          continue;
        }
        return test::make_leaf(test::hull_loops({a, {-a[0], -a[1], -a[2]}, tip, other}));
      }
    };
    test::RandomTree tree;
    tree.operands.emplace_back().leaf = test::box_leaf({-50, -50, -50}, {50, 50, 0});
    tree.operands.emplace_back().leaf = edge_at_origin();
    tree.operands.emplace_back().leaf = i % 2 ? edge_at_origin() : wedge_at_origin(random);
    std::shuffle(tree.operands.begin() + 1, tree.operands.end(), std::mt19937(i));
    for (uint32_t o = 0; o < 3; ++o) tree.operands[o].first_source = o;
    tree.expression = test::flat_expression(static_cast<BooleanOp>(i % 4), 3);
    tree.region = test::TreeMaker::region_of(tree.operands);
    ASSERT_EQ(test::first_difference(*evaluate(tree, true), *evaluate(tree, false)), "")
        << "case " << i;
  }
}

// Leaves that reach far beyond what is asked for, where the boxes of polygons end.
TEST(WholeFaces, OfLeavesThatReachFar) {
  test::Random random(408);
  for (int i = 0; i < 60; ++i) {
    test::RandomTree tree;
    const auto tetrahedron = [&](int64_t size, int64_t move) {
      const auto corner = [&](int64_t x, int64_t y, int64_t z) {
        const auto at = [&](int64_t c) { return c * size + random.integer(-move, move); };
        return IVec3{at(x), at(y), at(z)};
      };
      const IVec3 a = corner(-1, -1, -1), b = corner(1, 0, -1), c = corner(-1, 1, 0),
                  d = corner(0, 0, 1);
      const Plane base = plane_through(a, b, c);  // wide enough, unlike grid steps
      std::vector<test::Loop> loops{{a, b, c}, {a, c, d}, {c, b, d}, {b, a, d}};
      if (base.a * d[0] + base.b * d[1] + base.c * d[2] + base.d > 0) test::turn_over(loops);
      return test::make_leaf(loops);
    };
    tree.operands.emplace_back().leaf = tetrahedron(1000, 300);
    tree.region = test::TreeMaker::region_of(tree.operands);
    // The others are far tetrahedra with the first one in the midst, or beside it, far or not.
    for (int k = 0; k < 2; ++k) {
      const int64_t far = int64_t{1} << random.integer(24, 36);
      tree.operands.emplace_back().leaf = tetrahedron(far, far / 8 * random.integer(1, 4));
    }
    for (uint32_t o = 0; o < 3; ++o) tree.operands[o].first_source = o;
    tree.expression =
        test::flat_expression(i % 2 ? BooleanOp::kDifference : BooleanOp::kIntersection, 3);
    ASSERT_EQ(test::first_difference(*evaluate(tree, true), *evaluate(tree, false)), "")
        << "case " << i;
  }
}

/// Octagonal columns that are known to be convex, most of them flush.
test::RandomTree convex_columns(test::Random& random) {
  const std::vector<IVec3> rim{{1, 0, 0}, {3, 0, 0}, {4, 1, 0}, {4, 3, 0},
                               {3, 4, 0}, {1, 4, 0}, {0, 3, 0}, {0, 1, 0}};
  test::Loop bottom(rim.rbegin(), rim.rend()), top = rim;
  for (IVec3& p : top) p[2] = 3;
  std::vector<test::Loop> loops{bottom, top};
  for (size_t i = 0; i < 8; ++i) {
    loops.push_back({rim[i], rim[(i + 1) % 8], top[(i + 1) % 8], top[i]});
  }
  auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(loops));
  leaf->opposite = pair_edges(*leaf).opposite;
  leaf->convex = true;
  leaf->may_touch = false;
  test::RandomTree tree;
  const auto count = static_cast<uint32_t>(random.integer(2, 6));
  for (uint32_t o = 0; o < count; ++o) {
    Operand& operand = tree.operands.emplace_back();
    operand.leaf = leaf;
    operand.first_source = o;
    operand.translation = {random.integer(-3, 3), random.integer(-3, 3), random.integer(-1, 1)};
    tree.expression.nodes.emplace_back().operand = o;
  }
  // The last two are a node of their own now and then: no operands of the root.
  const auto join = [&](uint32_t first, uint32_t last) {
    Expression::Node node;
    node.is_operand = false;
    node.op = static_cast<BooleanOp>(random.integer(0, 3));
    node.first_child = static_cast<uint32_t>(tree.expression.children.size());
    node.child_count = last - first;
    for (uint32_t o = first; o < last; ++o) tree.expression.children.push_back(o);
    tree.expression.nodes.push_back(node);
  };
  if (count > 3 && random.integer(0, 1) == 0) {
    join(count - 2, count);
    join(0, count - 2);
    tree.expression.nodes.back().child_count++;
    tree.expression.children.push_back(count);
  } else {
    join(0, count);
  }
  tree.region = test::TreeMaker::region_of(tree.operands);
  return tree;
}

// What touches a convex body from within is not looked at, and a side of one in a polygon's plane
// says all about it.
TEST(WholeFaces, OfFlushConvexBodiesAreWhatCellsGive) {
  test::Random random(408);
  for (int i = 0; i < 400; ++i) {
    const auto tree = convex_columns(random);
    ASSERT_EQ(test::first_difference(*evaluate(tree, true), *evaluate(tree, false)), "")
        << "tree " << i;
  }
}

/// A leaf of two bodies: an edge of the second lies in a face of the first, or on an edge of it, or
/// ends there.
std::shared_ptr<LeafGeometry> touching_bodies(test::Random& random) {
  auto loops = test::box_loops({0, 0, 0}, {4, 4, 4});
  const int64_t y = random.integer(0, 1) ? 4 : random.integer(1, 3);
  const int64_t from = random.integer(-1, 3), to = random.integer(from + 1, 5);
  const auto beyond = [&] {
    return IVec3{random.integer(5, 7), random.integer(0, 6), random.integer(0, 5)};
  };
  std::vector<test::Loop> second;
  while (second.empty()) {
    second = test::hull_loops({{4, y, from}, {4, y, to}, beyond(), beyond(), beyond()});
  }
  loops.insert(loops.end(), second.begin(), second.end());
  auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(loops, random.integer(0, 1) == 1));
  leaf->opposite = pair_edges(*leaf).opposite;
  return leaf;
}

/// Two boxes with a common edge, which is an edge of four faces of one leaf that crosses nothing.
std::shared_ptr<LeafGeometry> boxes_sharing_an_edge() {
  auto loops = test::box_loops({0, 0, 0}, {3, 3, 4});
  const auto second = test::box_loops({3, 3, 0}, {6, 6, 4});
  loops.insert(loops.end(), second.begin(), second.end());
  // make_leaf numbers equal corners once.
  auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(loops));
  leaf->opposite = pair_edges(*leaf).opposite;
  leaf->may_touch = false;
  return leaf;
}

// Leaves that touch themselves have segments on a polygon that meet elsewhere than at their ends.
TEST(WholeFaces, OfLeavesThatTouchThemselves) {
  test::Random random(413);
  test::TreeMaker maker(random);
  for (int i = 0; i < 120; ++i) {
    auto tree = maker.make({.size = 6, .operands = 3, .depth = 1, .known = i % 2 == 0});
    tree.operands[0].leaf = i % 4 == 3 ? boxes_sharing_an_edge() : touching_bodies(random);
    if (i % 3 == 0) tree.operands[1].leaf = touching_bodies(random);
    tree.region = test::TreeMaker::region_of(tree.operands);
    ASSERT_EQ(test::first_difference(*evaluate(tree, true), *evaluate(tree, false)), "")
        << "tree " << i;
  }
  EXPECT_TRUE(boxes_sharing_an_edge()->opposite.empty());
}

// A body stands with an edge on a face of a leaf, where a body of the same leaf may stand as well:
// then the face alone does not tell what the first one is inside of.
TEST(WholeFaces, OfEdgesOnFacesAreWhatCellsGive) {
  test::Random random(414);
  test::TreeMaker maker(random);
  for (int i = 0; i < 300; ++i) {
    auto tree = maker.make({.size = 6, .operands = 2, .depth = 1, .frames = false, .known = true});
    const int64_t y = random.integer(1, 3), from = random.integer(0, 2),
                  to = random.integer(from + 1, 4);
    const auto body = [&](int64_t first, int64_t last) {
      std::vector<test::Loop> loops;
      while (loops.empty()) {
        const auto beyond = [&] {
          return IVec3{random.integer(0, 9), random.integer(-2, 6), random.integer(-1, 5)};
        };
        loops = test::hull_loops({{4, y, first}, {4, y, last}, beyond(), beyond(), beyond()});
      }
      return loops;
    };
    auto loops = test::box_loops({0, 0, -2}, {4, 4, 6});
    if (i % 3 != 0) {
      std::vector<test::Loop> second;
      while (second.empty()) {
        second = test::hull_loops({{4, y, -1},
                                   {4, y, 5},
                                   {9, random.integer(2, 8), 5},
                                   {9, random.integer(-4, 2), -1},
                                   {9, 2, random.integer(0, 4)}});
      }
      loops.insert(loops.end(), second.begin(), second.end());
    }
    auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(loops));
    leaf->opposite = pair_edges(*leaf).opposite;
    tree.operands[0].leaf = leaf;
    auto other = std::make_shared<LeafGeometry>(*test::make_leaf(body(from, to)));
    other->opposite = pair_edges(*other).opposite;
    tree.operands[1].leaf = other;
    for (Operand& operand : tree.operands) operand.translation = {0, 0, 0};
    tree.region = test::TreeMaker::region_of(tree.operands);
    ASSERT_EQ(test::first_difference(*evaluate(tree, true), *evaluate(tree, false)), "")
        << "tree " << i;
  }
}

size_t count_general(const test::RandomTree& tree, size_t& polygons) {
  Job job(tree.operands);
  EvaluateStats stats;
  const auto faces = evaluate_whole_faces(job, tree.expression, {}, stats);
  EXPECT_TRUE(faces) << faces.error().message;
  polygons += job.polygons().size();
  return static_cast<size_t>(std::count(faces->general.begin(), faces->general.end(), 1));
}

// What is left to cells is what edges of more than two faces make hard.
TEST(WholeFaces, LeaveLittleToCells) {
  test::Random random(405);
  test::TreeMaker maker(random);
  size_t polygons = 0, general = 0;
  for (int i = 0; i < 60; ++i) {
    general += count_general(maker.make({.size = 6, .operands = 4, .depth = 2, .frames = false}),
                             polygons);
  }
  EXPECT_GT(polygons, 1000u);
  EXPECT_LT(general * 10, polygons);
}

// Names do where nothing touches: no polygon is looked at by value, which would be noted.
TEST(WholeFaces, ThatTouchNothingAreCutByNames) {
  test::Random random(411);
  test::TreeMaker maker(random);
  size_t plain = 0, crossing = 0, told = 0;
  for (int i = 0; i < 400; ++i) {
    const auto tree = maker.make(
        {.size = 1000, .operands = 4, .depth = 2, .frames = i % 3 == 0, .known = i % 2 == 0});
    Job job(tree.operands);
    EvaluateStats stats;
    const auto contacts = find_contacts(job, {}, {}, stats).contacts;
    const auto is_plain = [](const Contact& c) { return c.is_plain; };
    if (!std::all_of(contacts.begin(), contacts.end(), is_plain)) continue;
    const auto faces = evaluate_whole_faces(job, tree.expression, {}, stats);
    ASSERT_TRUE(faces) << faces.error().message;
    // Three operands may meet in a point on which two parts of a symmetric difference have corners.
    ASSERT_TRUE(faces->touching.empty() || !is_unate(tree.expression)) << "tree " << i;
    told += faces->touching.empty();
    ASSERT_FALSE(faces->any_general) << "tree " << i;
    ASSERT_EQ(std::count(faces->general.begin(), faces->general.end(), 1), 0) << "tree " << i;
    ASSERT_EQ(test::first_difference(*evaluate(tree, true), *evaluate(tree, false)), "")
        << "tree " << i;
    ++plain;
    crossing += faces->cut.pieces.size();
  }
  EXPECT_GT(plain, 30u);
  EXPECT_GT(told, 30u);
  EXPECT_GT(crossing, 300u);
}

// What is on a polygon tells nearly all where no leaf touches itself.
TEST(WholeFaces, OfSimpleLeavesLeaveHardlyAnything) {
  test::Random random(412);
  test::TreeMaker maker(random);
  size_t polygons = 0, general = 0;
  for (int i = 0; i < 100; ++i) {
    general += count_general(
        maker.make({.size = 4, .operands = 3, .depth = 2, .frames = false, .known = true}),
        polygons);
  }
  EXPECT_GT(polygons, 1000u);
  EXPECT_LT(general * 300, polygons);
}

// Both ways report to one measure of progress.
TEST(WholeFaces, ProgressDoesNotGoBack) {
  test::Random random(407);
  test::TreeMaker maker(random);
  int reports = 0;
  for (int i = 0; i < 60; ++i) {
    const auto tree = maker.make({.size = 6, .operands = 6, .depth = 2, .frames = i % 2 == 0});
    KernelOptions options;
    options.cell_limit = 1;
    double last = 0;
    options.progress = [&](uint64_t done, uint64_t total) {
      const double share = static_cast<double>(done) / static_cast<double>(total);
      EXPECT_GE(share, last);
      EXPECT_EQ(total % 2, 0u);  // either way has a half
      EXPECT_LE(share, 1);
      last = share;
      ++reports;
    };
    EvaluateStats stats;
    ASSERT_TRUE(evaluate_boolean(tree.operands, tree.expression, tree.region, options, stats));
  }
  EXPECT_GT(reports, 40);
}

TEST(WholeFaces, StopWhenCancelled) {
  test::Random random(406);
  const auto tree =
      test::TreeMaker(random).make({.size = 6, .operands = 4, .depth = 2, .frames = false});
  std::atomic<bool> cancel = true;
  KernelOptions options;
  options.cancel = &cancel;
  EvaluateStats stats;
  const auto result = evaluate_boolean(tree.operands, tree.expression, tree.region, options, stats);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
}

// Where nothing was found to cut because somebody cancelled, that is no result.
TEST(WholeFaces, StopWhenCancelledBeforeAnythingIsCut) {
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {9, 9, 9})),
                                      test::operand_of(test::box_leaf({3, 3, 3}, {12, 12, 12}))};
  std::atomic<bool> cancel = true;
  KernelOptions options;
  options.cancel = &cancel;
  EvaluateStats stats;
  Job job(operands);
  const auto faces =
      evaluate_whole_faces(job, test::flat_expression(BooleanOp::kUnion, 2), options, stats);
  ASSERT_FALSE(faces);
  EXPECT_EQ(faces.error().code, ErrorCode::kCancelled);
}

// Somebody cancels at any time meanwhile: that ends it while polygons are cut, too, and what comes
// out is all or nothing.
TEST(WholeFaces, StopWhenCancelledWhileTheyCut) {
  std::vector<Operand> plates;
  for (int64_t i = 0; i < 24; ++i) {
    IVec3 lo{-i, -i, -i}, hi{1000 + i, 1000 + i, 1000 + i};
    lo[i % 3] = 10 * i + 5, hi[i % 3] = 10 * i + 8;
    plates.push_back(test::operand_of(test::box_leaf(lo, hi)));
  }
  const Expression all = test::flat_expression(BooleanOp::kSymmetricDifference, 24);
  EvaluateStats stats;
  Job whole(plates), untouched(plates);
  const auto expected = evaluate_whole_faces(whole, all, {}, stats);
  ASSERT_TRUE(expected);
  ASSERT_GT(expected->cut.pieces.size(), 1000u);
  find_contacts(untouched, {}, {}, stats);
  bool was_cutting = false;
  for (int i = 0; i < 200 && !was_cutting; ++i) {
    Job job(plates);
    std::atomic<bool> found = false, cancel = false, done = false;
    KernelOptions options;
    options.cancel = &cancel;
    options.progress = [&](uint64_t, uint64_t) { found = true; };
    std::thread somebody([&] {
      while (!found && !done) std::this_thread::yield();
      std::this_thread::sleep_for(std::chrono::microseconds(200 * i));
      cancel = true;
    });
    const auto faces = evaluate_whole_faces(job, all, options, stats);
    done = true;
    somebody.join();
    if (faces) {
      ASSERT_EQ(faces->cut.pieces.size(), expected->cut.pieces.size());
      ASSERT_EQ(faces->whole.size(), expected->whole.size());
    } else {
      ASSERT_EQ(faces.error().code, ErrorCode::kCancelled);
      // Planes are made after all contacts were found.
      was_cutting = job.planes().size() > untouched.planes().size();
    }
  }
  EXPECT_TRUE(was_cutting);
}

// A part of a face that has no corner of the face, and lies beside another surface by less than its
// coordinates are rounded.
TEST(WholeFaces, OfSurfacesCloserThanRounding) {
  test::Random random(415);
  for (int i = 0; i < 40; ++i) {
    const int64_t q = (int64_t{1} << 22) + random.integer(0, int64_t{1} << 20),
                  height = int64_t{1} << random.integer(10, 24);
    const IVec3 lo{-random.integer(9, 19), -random.integer(9, 19), height - 30},
        hi{lo[0] + random.integer(1, 9), lo[1] + random.integer(1, 9), height + 30};
    test::RandomTree tree;
    tree.operands = {test::half_space(q, height, true), test::half_space(q + 1, height, true),
                     test::operand_of(test::box_leaf(lo, hi))};
    if (i % 2) std::swap(tree.operands[0], tree.operands[1]);
    for (uint32_t o = 0; o < 3; ++o) tree.operands[o].first_source = o;
    tree.region = {{lo[0] - 1, lo[1] - 1, lo[2]}, {hi[0] + 1, hi[1] + 1, hi[2]}};
    for (const BooleanOp op : {BooleanOp::kIntersection, BooleanOp::kSymmetricDifference}) {
      tree.expression = test::flat_expression(op, 3);
      if (op == BooleanOp::kSymmetricDifference) {
        tree.region = test::TreeMaker::region_of(tree.operands);
      }
      ASSERT_EQ(test::first_difference(*evaluate(tree, true), *evaluate(tree, false)), "")
          << "case " << i;
    }
  }
}

// What is too far away for boxes to tell is whole, and left to cells.
TEST(WholeFaces, OfLeavesThatAreFarAway) {
  constexpr int64_t kFar = int64_t{1} << 33;
  test::RandomTree tree;
  const IVec3 a{-kFar, -kFar, -kFar}, b{kFar, 0, -kFar}, c{-kFar, kFar, 0}, d{0, 0, kFar};
  tree.operands.emplace_back().leaf = test::make_leaf({{a, c, b}, {a, d, c}, {c, d, b}, {b, d, a}});
  tree.operands.emplace_back().leaf = test::box_leaf({0, 0, 0}, {5, 6, 7});
  tree.operands[1].first_source = 1;
  tree.region = test::TreeMaker::region_of(tree.operands);
  for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kDifference, BooleanOp::kIntersection,
                             BooleanOp::kSymmetricDifference}) {
    tree.expression = test::flat_expression(op, 2);
    const auto fast = evaluate(tree, true);
    ASSERT_EQ(test::first_difference(*fast, *evaluate(tree, false)), "");
    const size_t far = op == BooleanOp::kIntersection ? 0 : 4,
                 near = op == BooleanOp::kUnion ? 0 : 6;
    EXPECT_EQ(fast->faces.size(), far + near);
  }
}

// Nor does what is left touch anything where it is plainly crossed.
TEST(WholeFaces, FarLeavesThatAreCrossedTouchNothing) {
  constexpr int64_t kFar = int64_t{1} << 33;
  const IVec3 a{-kFar, -kFar, 1}, b{kFar, -kFar, 2}, c{0, kFar, -1}, d{0, 0, -kFar};
  const Operand far =
                    test::operand_of(test::make_leaf({{a, b, c}, {b, a, d}, {c, b, d}, {a, c, d}})),
                near = test::operand_of(test::box_leaf({-5, -6, -7}, {5, 6, 7}));
  for (const std::vector<Operand>& operands : {std::vector<Operand>{far, near}, {near, far}}) {
    Job job(operands);
    EvaluateStats stats;
    const auto faces =
        evaluate_whole_faces(job, test::flat_expression(BooleanOp::kUnion, 2), {}, stats);
    ASSERT_TRUE(faces);
    const auto contacts = find_contacts(job, {}, {}, stats).contacts;
    ASSERT_EQ(contacts.size(), 4u);
    for (const Contact& contact : contacts) {
      EXPECT_TRUE(contact.is_plain);
      EXPECT_NE(faces->general[contact.p], faces->general[contact.q]);
    }
    EXPECT_TRUE(faces->touching.empty());
  }
}

// Plates that all cross each other: so many contacts are left to cells, unless most of them are of
// faces that touch, as those of plates do that end in one plane.
TEST(WholeFaces, LeaveDenseContactsToCells) {
  const auto is_left = [](int64_t plates, bool end_together) {
    std::vector<Operand> operands;
    for (int64_t i = 0; i < plates; ++i) {
      for (size_t axis = 0; axis < 3; ++axis) {
        const int64_t more = end_together ? 0 : static_cast<int64_t>(operands.size());
        IVec3 lo{-more, -more, -more}, hi{1000 + more, 1000 + more, 1000 + more};
        lo[axis] = 10 * i + 5, hi[axis] = 10 * i + 8;
        operands.push_back(test::operand_of(test::box_leaf(lo, hi)));
      }
    }
    Job job(operands);
    EvaluateStats stats;
    const auto contacts = find_contacts(job, {}, {}, stats).contacts;
    const auto plain = std::count_if(contacts.begin(), contacts.end(),
                                     [](const Contact& c) { return c.is_plain; });
    EXPECT_GT(contacts.size(), plates > 4 ? 64 * job.polygons().size() : 0);
    const auto faces = evaluate_whole_faces(
        job, test::flat_expression(BooleanOp::kUnion, static_cast<uint32_t>(operands.size())), {},
        stats);
    EXPECT_TRUE(faces);
    const bool any = faces->any_general;
    EXPECT_EQ(any, plain > 64 * static_cast<long>(job.polygons().size()));
    EXPECT_EQ(std::count(faces->general.begin(), faces->general.end(), 1),
              any ? static_cast<long>(job.polygons().size()) : 0);
    return any;
  };
  EXPECT_FALSE(is_left(4, false));
  EXPECT_TRUE(is_left(52, false));
  EXPECT_FALSE(is_left(30, true));
}

}  // namespace
}  // namespace csgrun::whole_faces_test
