// Identities of Booleans on random pairs of small solids, exactly.
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/support/exact_measures.h"
#include "tests/support/kernel_case.h"
#include "tests/support/oracle.h"

namespace csgrun {
namespace {

using namespace test;  // NOLINT: a test

int cases(int in_ci) {
  const char* given = std::getenv("CSGRUN_CASES");
  return given ? std::atoi(given) : in_ci;
}

/// A point near something: a vertex, or between two of them, moved a little or a lot.
Query random_query(Random& random, const ExactSolid& a, const ExactSolid& b) {
  const ExactSolid& s = (random.bits() & 1) && !b.points.empty() ? b : a;
  Query q{};
  const auto pick = [&] {
    return s
        .points[static_cast<size_t>(random.integer(0, static_cast<int64_t>(s.points.size()) - 1))];
  };
  const auto p = pick(), r = pick();
  const double t = random.unit(), reach = std::ldexp(1.0, -static_cast<int>(random.integer(0, 10)));
  for (int k = 0; k < 3; ++k) {
    q[k] = p[k].get_d() + t * (r[k].get_d() - p[k].get_d()) + (random.unit() - 0.5) * reach;
  }
  return q;
}

/// Compares a result with the expression at points; the count of disagreements.
std::string disagreement(Random& random, const Tree& tree, const std::vector<Oracle>& leaves,
                         const BoundaryMesh& result, int points) {
  const Oracle oracle(exact_solid(result));
  for (int i = 0; i < points; ++i) {
    const auto& some =
        leaves[static_cast<size_t>(random.integer(0, static_cast<int64_t>(leaves.size()) - 1))];
    const Query q = random_query(random, some.solid(), oracle.solid());
    std::vector<bool> inside;
    bool known = true;
    for (const Oracle& o : leaves) {
      const auto w = o.winding(q);
      known = known && w.has_value();
      if (!known) break;
      if (*w != 0 && *w != 1) return "a leaf is not sound";
      inside.push_back(*w == 1);
    }
    const auto w = oracle.winding(q);
    if (!known || !w) continue;
    if (*w != (tree.inside(inside) ? 1 : 0)) {
      return "winding number " + std::to_string(*w) + " of " + tree.text() + " at " +
             std::to_string(q[0]) + " " + std::to_string(q[1]) + " " + std::to_string(q[2]);
    }
  }
  return "";
}

KernelOptions random_options(Random& random) {
  KernelOptions o;
  constexpr uint32_t kLimits[] = {1, 3, 9, 17, 33};
  o.cell_limit = kLimits[random.integer(0, 4)];
  for (auto& s : o.octree_shift) s = static_cast<uint32_t>(random.integer(0, 3));
  return o;
}

TEST(Identities, HoldOnRandomPairs) {
  Random random(1);
  const int n = cases(600);
  for (int i = 0; i < n; ++i) {
    const std::vector<Operand> leaves{operand_of(random_leaf(random)),
                                      operand_of(random_leaf(random))};
    const std::vector<Oracle> oracles{Oracle(exact_solid(leaves[0])),
                                      Oracle(exact_solid(leaves[1]))};
    SCOPED_TRACE("case " + std::to_string(i));
    mpq_class v[5];
    const Tree trees[5] = {join({leaf(0), leaf(1)}), meet({leaf(0), leaf(1)}),
                           less({leaf(0), leaf(1)}), less({leaf(1), leaf(0)}),
                           differ({leaf(0), leaf(1)})};
    for (int t = 0; t < 5; ++t) {
      const auto r = evaluate(trees[t], leaves, random_options(random));
      ASSERT_TRUE(r) << trees[t].text() << ": " << text(r.error());
      ASSERT_EQ(fault_in(**r), "") << trees[t].text();
      ASSERT_EQ(disagreement(random, trees[t], oracles, **r, 40), "");
      v[t] = volume(**r);
    }
    const mpq_class a = volume(oracles[0].solid()), b = volume(oracles[1].solid());
    ASSERT_EQ(v[0] + v[1], a + b);
    ASSERT_EQ(v[2], a - v[1]);
    ASSERT_EQ(v[3], b - v[1]);
    ASSERT_EQ(v[4], v[0] - v[1]);
  }
}

}  // namespace
}  // namespace csgrun
