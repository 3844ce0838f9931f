// What the kernel says beside its result: boxes, bytes, and how much work it was.
#include "engine/bsp/kernel.h"

#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/exact_solid.h"
#include "tests/support/random_solids.h"
#include "tests/support/random_trees.h"

namespace csgrun::kernel_test {
namespace {

using Boundary = std::shared_ptr<const BoundaryMesh>;

Boundary evaluate(const test::RandomTree& tree, const KernelOptions& options,
                  EvaluateStats& stats) {
  const auto result = evaluate_boolean(tree.operands, tree.expression, tree.region, options, stats);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *result : nullptr;
}

std::vector<uint64_t> numbers(const EvaluateStats& s) {
  std::vector<uint64_t> n{s.cells,          s.surface_cells, s.solved_cells,
                          s.critical_cells, s.sign_filter,   s.sign_symbolic};
  n.insert(n.end(), s.sign_exact.begin(), s.sign_exact.end());
  return n;
}

TEST(Kernel, StatsAreAddedToAndDoNotDependOnThreads) {
  test::Random random(81);
  test::TreeMaker maker(random);
  EvaluateStats sum;
  for (int i = 0; i < 40; ++i) {
    const auto tree = maker.make({.size = 8, .operands = 6, .depth = 3, .frames = i % 3 == 0});
    KernelOptions options;
    options.cell_limit = 3;
    options.whole_faces = i % 2 == 0;
    EvaluateStats one, four, twice;
    evaluate(tree, options, one);
    evaluate(tree, options, twice);
    evaluate(tree, options, twice);
    options.threads = 4;
    evaluate(tree, options, four);
    ASSERT_EQ(numbers(one), numbers(four));
    const auto single = numbers(one), two = numbers(twice);
    for (size_t k = 0; k < single.size(); ++k) ASSERT_EQ(two[k], 2 * single[k]) << k;
    // Counts, not what is left of subtractions.
    for (const uint64_t n : single) ASSERT_LT(n, 100'000'000u);
    ASSERT_LE(one.critical_cells, one.solved_cells);
    ASSERT_LE(one.solved_cells, one.surface_cells);
    // Each division makes two cells of one.
    ASSERT_EQ(one.cells % 2, 1u);
    ASSERT_LT(one.solved_cells, one.cells);
    evaluate(tree, options, sum);
  }
  for (const uint64_t n : {sum.cells, sum.surface_cells, sum.solved_cells, sum.critical_cells,
                           sum.sign_filter, sum.sign_symbolic, sum.sign_exact[0]}) {
    EXPECT_GT(n, 200u);
  }
}

test::RandomTree tree_of(BooleanOp op, const std::vector<test::Leaf>& leaves) {
  test::RandomTree tree;
  Expression::Node root;
  root.is_operand = false;
  root.op = op;
  for (uint32_t o = 0; o < leaves.size(); ++o) {
    tree.operands.emplace_back().leaf = leaves[o];
    tree.operands.back().first_source = o;
    Expression::Node node;
    node.operand = o;
    tree.expression.nodes.push_back(node);
    tree.expression.children.push_back(o);
  }
  root.child_count = static_cast<uint32_t>(leaves.size());
  tree.expression.nodes.push_back(root);
  tree.region = test::TreeMaker::region_of(tree.operands);
  return tree;
}

uint64_t signs(const EvaluateStats& s) {
  return std::accumulate(s.sign_exact.begin(), s.sign_exact.end(), s.sign_filter + s.sign_symbolic);
}

// Cells of two boxes, counted by hand. (A symmetric difference: others are decided on the lattice
// of their planes, without such cells.)
TEST(Kernel, WorkIsWhereSurfacesAreNearEachOther) {
  const auto box = [](const IVec3& lo, const IVec3& hi) { return test::box_leaf(lo, hi); };
  {
    // Twelve faces in one cell of up to 17.
    EvaluateStats s;
    evaluate(tree_of(BooleanOp::kSymmetricDifference,
                     {box({0, 0, 0}, {4, 4, 4}), box({2, 2, 2}, {6, 6, 6})}),
             {}, s);
    EXPECT_EQ((std::vector<uint64_t>{s.cells, s.surface_cells, s.solved_cells, s.critical_cells}),
              (std::vector<uint64_t>{1, 1, 1, 1}));
  }
  {
    // Solved together, but they do not meet.
    EvaluateStats s;
    evaluate(tree_of(BooleanOp::kSymmetricDifference,
                     {box({0, 0, 0}, {2, 2, 2}), box({4, 4, 4}, {6, 6, 6})}),
             {}, s);
    EXPECT_EQ((std::vector<uint64_t>{s.cells, s.surface_cells, s.solved_cells, s.critical_cells}),
              (std::vector<uint64_t>{1, 1, 1, 0}));
  }
  {
    // Sixteen boxes in a row, far apart: halved until each stands alone; none is solved.
    std::vector<test::Leaf> leaves;
    for (int64_t i = 0; i < 16; ++i)
      leaves.push_back(box({16 * i + 6, 6, 6}, {16 * i + 10, 10, 10}));
    KernelOptions options;
    options.cell_limit = 1;
    EvaluateStats s;
    const Boundary result = evaluate(tree_of(BooleanOp::kSymmetricDifference, leaves), options, s);
    EXPECT_EQ(result->faces.size(), 96u);
    EXPECT_EQ(s.solved_cells, 0u);
    EXPECT_EQ(s.critical_cells, 0u);
    EXPECT_LT(s.cells, 150u);
    // A box in a cell of its own is six cells' worth of surface at one polygon a cell. Nothing is
    // cut.
    EXPECT_EQ(s.surface_cells, 96u);
    EXPECT_EQ(signs(s), 0u);
    // Holes in a block: all faces are copied, those of the tools turned over.
    leaves.insert(leaves.begin(), box({0, 0, 0}, {256, 16, 16}));
    s = {};
    const Boundary less = evaluate(tree_of(BooleanOp::kSymmetricDifference, leaves), options, s);
    EXPECT_EQ(less->faces.size(), 102u);
    EXPECT_EQ(s.solved_cells, 0u);
    EXPECT_EQ(signs(s), 0u);
  }
}

// Of cells in which two operands have surface, those count where a surface passes or covers
// another.
TEST(Kernel, CriticalCellsAreThoseWithContact) {
  const auto tetrahedron = [](const IVec3& p) {
    const auto at = [&](int64_t x, int64_t y, int64_t z) {
      return IVec3{p[0] + x, p[1] + y, p[2] + z};
    };
    return test::make_leaf(test::hull_loops({at(0, 0, 0), at(6, 1, 0), at(1, 7, 2), at(2, 1, 9)}));
  };
  const auto critical = [&](const test::Leaf& a, const test::Leaf& b) {
    KernelOptions options;
    options.whole_faces = false;
    EvaluateStats s;
    evaluate(tree_of(BooleanOp::kUnion, {a, b}), options, s);
    EXPECT_EQ(s.solved_cells, 1u);
    return s.critical_cells;
  };
  const test::Leaf one = tetrahedron({0, 0, 0});
  EXPECT_EQ(critical(one, tetrahedron({8, 0, 0})), 0u);
  EXPECT_EQ(critical(one, tetrahedron({1, 1, 1})), 1u);  // they cross
  EXPECT_EQ(critical(one, one), 1u);                     // one covers the other
}

// No cell holds much more than the limit, unless dividing does not help.
TEST(Kernel, CellsAreDividedDownToTheLimit) {
  std::vector<test::Leaf> leaves;
  test::Random random(83);
  for (int i = 0; i < 60; ++i) {
    const IVec3 at{random.integer(0, 900), random.integer(0, 900), random.integer(0, 900)};
    leaves.push_back(test::box_leaf(at, {at[0] + 60, at[1] + 60, at[2] + 60}));
  }
  const auto tree = tree_of(BooleanOp::kUnion, leaves);
  std::vector<uint64_t> cells;
  for (const uint32_t limit : {5u, 10u, 20u, 40u, 80u, 1000u}) {
    KernelOptions options;
    options.cell_limit = limit;
    EvaluateStats s;
    evaluate(tree, options, s);
    cells.push_back(s.cells);
  }
  EXPECT_EQ(cells.back(), 1u);
  for (size_t i = 1; i < cells.size(); ++i) EXPECT_LT(cells[i], cells[i - 1]);
  // 360 polygons: a few hundred cells at twenty, not many thousands.
  EXPECT_GT(cells[2], 40u);
  EXPECT_LT(cells[2], 400u);
}

TEST(Kernel, BoxesAreRoundedOutwardsToWholeSteps) {
  test::Random random(82);
  test::TreeMaker maker(random);
  int fractions = 0;
  for (int i = 0; i < 60; ++i) {
    const auto tree = maker.make({.size = 5, .operands = 3, .depth = 2, .frames = true});
    EvaluateStats stats;
    const Boundary b = evaluate(tree, {}, stats);
    const GridBox box = bounding_box(*b);
    ASSERT_EQ(is_empty(*b), b->faces.empty());
    ASSERT_EQ(box.empty(), is_empty(*b));
    if (is_empty(*b)) continue;
    const auto points = test::exact_solid(*b).points;
    for (int k = 0; k < 3; ++k) {
      mpq_class lo = points[0][k], hi = lo;
      for (const auto& p : points) lo = std::min(lo, p[k]), hi = std::max(hi, p[k]);
      ASSERT_LE(mpz_class(box.lo[k]), lo);
      ASSERT_GE(mpz_class(box.hi[k]), hi);
      ASSERT_GE(mpz_class(box.lo[k]) + 1, lo);
      ASSERT_LE(mpz_class(box.hi[k]) - 1, hi);
      fractions += lo.get_den() != 1;
    }
  }
  EXPECT_GT(fractions, 20);
  EXPECT_TRUE(bounding_box(BoundaryMesh()).empty());
}

TEST(Kernel, BytesAreThoseOfTheArrays) {
  EvaluateStats stats;
  const Boundary b =
      evaluate(tree_of(BooleanOp::kUnion, {test::box_leaf({0, 0, 0}, {1, 2, 3})}), {}, stats);
  const auto bytes = [](const auto&... vector) {
    return ((vector.size() * sizeof(vector[0])) + ...);
  };
  EXPECT_EQ(memory_bytes(*b),
            sizeof(BoundaryMesh) + bytes(b->planes, b->point_planes, b->point_rounded, b->faces,
                                         b->loop_starts, b->corners));
}

}  // namespace
}  // namespace csgrun::kernel_test
