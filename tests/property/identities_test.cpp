// Identities of Booleans on random solids with vertices in {0..5}^3, exactly.
#include <gtest/gtest.h>

#include "tests/support/exact_measures.h"
#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/kernel_checks.h"
#include "tests/support/oracle.h"
#include "tests/support/random_solids.h"

namespace csgrun::identities_test {
namespace {

using namespace test;  // NOLINT: a test

std::vector<Operand> random_leaves(Random& random, int64_t n) {
  std::vector<Operand> leaves;
  for (; n > 0; --n) leaves.push_back(operand_of(random_leaf(random)));
  return leaves;
}

std::vector<Oracle> oracles_of(const std::vector<Operand>& leaves) {
  std::vector<Oracle> oracles;
  for (const Operand& o : leaves) oracles.emplace_back(exact_solid(o));
  return oracles;
}

TEST(Identities, VolumesOfRandomPairs) {
  Random random(1);
  const int n = cases(600);
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const auto leaves = random_leaves(random, 2);
    const auto oracles = oracles_of(leaves);
    mpq_class v[5];
    const Tree trees[5] = {join({leaf(0), leaf(1)}), meet({leaf(0), leaf(1)}),
                           less({leaf(0), leaf(1)}), less({leaf(1), leaf(0)}),
                           differ({leaf(0), leaf(1)})};
    for (int t = 0; t < 5; ++t) {
      const auto r = evaluate(trees[t], leaves, random_options(random));
      ASSERT_TRUE(r) << trees[t].text() << ": " << text(r.error());
      ASSERT_EQ(fault_in(**r), "") << trees[t].text();
      ASSERT_EQ(disagreement(random, trees[t], oracles, **r, 25), "");
      v[t] = volume(**r);
    }
    const mpq_class a = volume(oracles[0].solid()), b = volume(oracles[1].solid());
    ASSERT_EQ(v[0] + v[1], a + b);
    ASSERT_EQ(v[2], a - v[1]);
    ASSERT_EQ(v[3], b - v[1]);
    ASSERT_EQ(v[4], v[0] - v[1]);
  }
}

TEST(Identities, PresentedResultsAreManifold) {
  Random random(2);
  const int n = cases(300);
  const PresentContext context = test_context();
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const auto leaves = random_leaves(random, random.integer(1, 3));
    const Tree tree = random_tree(random, 0, static_cast<int>(leaves.size()) - 1);
    const auto r = evaluate(tree, leaves, random_options(random));
    ASSERT_TRUE(r) << tree.text() << ": " << text(r.error());
    const auto solid = present(**r, context);
    ASSERT_TRUE(solid) << tree.text() << ": " << text(solid.error());
    ASSERT_EQ(fault_in(**solid, **r), "") << tree.text();
  }
}

TEST(Identities, PresentedComplexesAreManifold) {
  Random random(7);
  const int n = cases(200);
  const PresentContext context = test_context();
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const auto loops = complex_loops(random);
    if (loops.empty()) continue;
    const auto r = evaluate(leaf(0), {operand_of(make_leaf(loops))}, random_options(random));
    ASSERT_TRUE(r) << text(r.error());
    const auto solid = present(**r, context);
    ASSERT_TRUE(solid) << text(solid.error());
    ASSERT_EQ(fault_in(**solid, **r), "");
  }
}

// The value of an expression does not depend on the way of evaluation: flat, with any subtrees
// materialised on the way, in cells of any size, from any origin.
TEST(Identities, OneValueForEveryWayOfEvaluation) {
  Random random(3);
  const int n = cases(300);
  const PresentContext context = test_context();
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const auto leaves = random_leaves(random, random.integer(2, i % 10 ? 5 : 12));
    const auto oracles = oracles_of(leaves);
    const Tree tree = random_tree(random, 0, static_cast<int>(leaves.size()) - 1);
    const auto flat = evaluate(tree, leaves);
    ASSERT_TRUE(flat) << tree.text() << ": " << text(flat.error());
    ASSERT_EQ(fault_in(**flat), "") << tree.text();
    ASSERT_EQ(disagreement(random, tree, oracles, **flat, 60), "");
    const auto flat_solid = present(**flat, context);
    ASSERT_TRUE(flat_solid) << text(flat_solid.error());
    for (int way = 0; way < 3; ++way) {
      const bool all = way == 0;
      KernelOptions options = random_options(random);
      options.literal_cells = way == 2;  // the paper's path
      const auto r =
          evaluate(tree, leaves, options, [&](const Tree&) { return all || (random.bits() & 1); });
      ASSERT_TRUE(r) << tree.text() << ": " << text(r.error());
      ASSERT_EQ(difference_between(**flat, **r), "") << tree.text();
      const auto solid = present(**r, context);
      ASSERT_TRUE(solid) << text(solid.error());
      ASSERT_EQ(difference_between(**flat_solid, **solid), "") << tree.text();
    }
  }
}

// One tool after another, each result materialised: nothing degrades, and the value is that of one
// node.
TEST(Identities, ChainsOfTools) {
  Random random(6);
  const int n = cases(6);
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const auto leaves = random_leaves(random, 24);
    Tree chain = leaf(0);
    for (int k = 1; k < 24; ++k) {
      // Mostly differences, so that something is always left and always being cut.
      const bool add = random.integer(0, 2) == 0;
      chain = add ? join({chain, leaf(k)}) : less({chain, leaf(k)});
    }
    const auto flat = evaluate(chain, leaves);
    ASSERT_TRUE(flat) << text(flat.error());
    ASSERT_EQ(fault_in(**flat), "");
    const auto nested =
        evaluate(chain, leaves, random_options(random), [](const Tree&) { return true; });
    ASSERT_TRUE(nested) << text(nested.error());
    ASSERT_EQ(difference_between(**flat, **nested), "") << chain.text();
    const auto solid = present(**nested, test_context());
    ASSERT_TRUE(solid) << text(solid.error());
    ASSERT_EQ(fault_in(**solid, **nested), "");
  }
}

TEST(Identities, OneValueForAllCellsOriginsAndThreads) {
  Random random(4);
  const int n = cases(12);
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    // Grown, so that there are many cells and a shift does something.
    std::vector<Operand> leaves;
    for (int64_t k = random.integer(2, 5); k > 0; --k) {
      GridMap map;
      for (int a = 0; a < 3; ++a) map.rows[a][a] = 7, map.move[a] = 7 * random.integer(-1, 1);
      leaves.push_back(operand_of(make_leaf(mapped(random_loops(random), map))));
    }
    const Tree tree = random_tree(random, 0, static_cast<int>(leaves.size()) - 1);
    const auto first = evaluate(tree, leaves);
    ASSERT_TRUE(first) << text(first.error());
    for (const uint32_t limit : {1u, 3u, 9u, 17u, 33u}) {
      for (const std::array<uint32_t, 3> shift :
           {std::array<uint32_t, 3>{0, 0, 0}, {1, 0, 5}, {13, 6, 2}}) {
        for (const unsigned threads : {1u, 2u, 7u}) {
          KernelOptions options;
          options.cell_limit = limit;
          options.octree_shift = shift;
          options.threads = threads;
          const auto r = evaluate(tree, leaves, options);
          ASSERT_TRUE(r) << text(r.error());
          ASSERT_EQ(difference_between(**first, **r), "")
              << tree.text() << " m " << limit << " threads " << threads;
        }
      }
    }
  }
}

/// A presented solid without the labels that only say where faces come from.
struct Shape {
  std::vector<glm::dvec3> positions;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<uint32_t> loop_starts, loop_vertices;
  bool operator==(const Shape&) const = default;
};

class ShapeOf {
 public:
  explicit ShapeOf(const std::vector<Operand>& leaves, Random& random)
      : leaves_(leaves), random_(random) {}
  Shape operator()(const Tree& tree) {
    const auto r = evaluate(tree, leaves_, random_options(random_),
                            [&](const Tree&) { return random_.bits() & 1; });
    EXPECT_TRUE(r) << tree.text() << ": " << text(r.error());
    if (!r) return {};
    const auto solid = present(**r, test_context());
    EXPECT_TRUE(solid) << tree.text() << ": " << text(solid.error());
    if (!solid) return {};
    return {(*solid)->positions, (*solid)->triangles, (*solid)->loop_starts,
            (*solid)->loop_vertices};
  }

 private:
  const std::vector<Operand>& leaves_;
  Random& random_;
};

TEST(Identities, LawsOfSetAlgebra) {
  Random random(5);
  const int n = cases(50);
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    std::vector<Operand> leaves;
    for (int k = 0; k < 3; ++k) leaves.push_back(operand_of(make_leaf(random_loops(random))));
    leaves.push_back(operand_of(box_leaf({-1, -1, -1}, {6, 6, 6})));
    leaves.push_back(operand_of(box_leaf({0, 0, 0}, {5, 5, 5})));
    ShapeOf shape(leaves, random);
    const Tree a = leaf(0), b = leaf(1), c = leaf(2);
    ASSERT_TRUE(shape(less({a, a})).triangles.empty());
    ASSERT_TRUE(shape(differ({a, a})).triangles.empty());
    const Shape alone = shape(a);
    ASSERT_FALSE(alone.triangles.empty());
    ASSERT_EQ(shape(join({a, a})), alone);
    ASSERT_EQ(shape(meet({a, a})), alone);
    ASSERT_EQ(shape(differ({a, b, b})), alone);
    ASSERT_EQ(shape(join({a, meet({a, b})})), alone);
    ASSERT_EQ(shape(meet({a, join({a, b})})), alone);
    ASSERT_EQ(shape(join({meet({a, b}), less({a, b})})), alone);
    for (const Tree& box : {leaf(3), leaf(4)}) {
      ASSERT_EQ(shape(less({box, less({box, a})})), alone);
      ASSERT_EQ(shape(less({box, join({a, b})})), shape(meet({less({box, a}), less({box, b})})));
      ASSERT_EQ(shape(less({box, meet({a, b})})), shape(join({less({box, a}), less({box, b})})));
      ASSERT_EQ(shape(less({box, differ({a, b})})), shape(differ({less({box, a}), b})));
    }
    ASSERT_EQ(shape(join({a, b, c})), shape(join({join({c, b}), a})));
    ASSERT_EQ(shape(meet({a, b, c})), shape(meet({c, meet({b, a})})));
    ASSERT_EQ(shape(differ({a, b, c})), shape(differ({b, differ({c, a})})));
    ASSERT_EQ(shape(less({a, b, c})), shape(less({a, join({c, b})})));
    ASSERT_EQ(shape(meet({a, join({b, c})})), shape(join({meet({a, b}), meet({a, c})})));
    ASSERT_EQ(shape(differ({a, b})), shape(join({less({a, b}), less({b, a})})));
  }
}

}  // namespace
}  // namespace csgrun::identities_test
