// What may not change a result, does not: the way of evaluation, the arithmetic's tier, where the
// axes point, where the origin is, the order of operands.
#include <gtest/gtest.h>

#include "engine/exact/forced_tier.h"
#include "engine/exact/predicates.h"
#include "tests/support/exact_measures.h"
#include "tests/support/fuzz/campaign.h"
#include "tests/support/fuzz/case.h"
#include "tests/support/fuzz/check.h"
#include "tests/support/fuzz/nodes.h"
#include "tests/support/kernel_case.h"
#include "tests/support/kernel_checks.h"

namespace csgrun::metamorphic_test {
namespace {

using namespace test;  // NOLINT: a test

Boundary boundary_of(const FuzzCase& c, EvaluateStats* stats = nullptr) {
  FuzzEvaluator evaluator(c);
  const auto result = evaluator.run();
  EXPECT_TRUE(result) << text(result.error()) << "\n" << text(c);
  if (stats) *stats = evaluator.stats();
  return result ? *result : nullptr;
}

/// Calls f(case) for so many random cases, with CSGRUN_SEED and CSGRUN_CASES as elsewhere.
template <class F>
void for_cases(uint64_t seed, int ordinary, FuzzKinds kinds, F&& f) {
  Campaign campaign;
  campaign.seed = seed;
  campaign.kinds = kinds;
  if (const char* given = std::getenv("CSGRUN_SEED")) {
    campaign.seed = std::strtoull(given, nullptr, 10);
  }
  const int n = cases(ordinary);
  for (int i = 0; i < n && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(campaign.seed) + ", case " + std::to_string(i));
    f(fuzz_case(campaign, static_cast<uint64_t>(i)));
  }
}

TEST(Metamorphic, WaysOfEvaluation) {
  Random random(51);
  for_cases(51, 250, {}, [&](FuzzCase c) {
    const Boundary base = boundary_of(c);
    ASSERT_TRUE(base);
    for (int way = 0; way < 5; ++way) {
      FuzzCase other = c;
      other.options = random_options(random);
      other.options.threads = way == 0 ? 7 : 1;
      other.options.literal_cells = way == 1 ? !c.options.literal_cells : c.options.literal_cells;
      other.options.whole_faces = way != 0;
      other.nest = way == 2   ? ~kInPieces
                   : way == 3 ? random.bits()
                   : way == 4 ? c.nest ^ kInPieces
                              : c.nest;
      const Boundary b = boundary_of(other);
      ASSERT_TRUE(b);
      ASSERT_EQ(difference_between(*base, *b), "") << text(c) << text(other);
    }
  });
}

/// Holds the tier for its lifetime.
class ForcedTier {
 public:
  explicit ForcedTier(int tier) { forced_tier = tier; }
  ~ForcedTier() { forced_tier = -1; }
  ForcedTier(const ForcedTier&) = delete;
  ForcedTier& operator=(const ForcedTier&) = delete;
};

TEST(Metamorphic, EachTierForced) {
  uint64_t filtered = 0, filtered_when_forced = 0;
  for_cases(52, 120, {}, [&](const FuzzCase& c) {
    EvaluateStats stats;
    const Boundary base = boundary_of(c, &stats);
    ASSERT_TRUE(base);
    filtered += stats.sign_filter;
    const auto solid = present(*base, test_context());
    ASSERT_TRUE(solid);
    for (int tier = 0; tier < static_cast<int>(kTierBits.size()); ++tier) {
      const ForcedTier forced(tier);
      const Boundary b = boundary_of(c, &stats);
      ASSERT_TRUE(b);
      filtered_when_forced += stats.sign_filter;
      ASSERT_EQ(difference_between(*base, *b), "") << "tier " << tier << "\n" << text(c);
      const auto again = present(*b, test_context());
      ASSERT_TRUE(again);
      ASSERT_EQ((*solid)->canonical_hash, (*again)->canonical_hash);
    }
  });
  EXPECT_GT(filtered, 0u);
  EXPECT_EQ(filtered_when_forced, 0u) << "the filter was not off";
}

/// The 48 symmetries of the axes.
std::vector<GridMap> symmetries() {
  std::vector<GridMap> all;
  std::array<int, 3> axes{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      GridMap map;
      for (int k = 0; k < 3; ++k) {
        map.rows[k] = {0, 0, 0};
        map.rows[k][axes[k]] = signs >> k & 1 ? -1 : 1;
      }
      all.push_back(map);
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return all;
}

FuzzCase turned(FuzzCase c, const GridMap& map) {
  for (FuzzLeaf& l : c.leaves) {
    if (l.frame != 0) continue;
    l.faces = mapped(l.faces, map);
    const IVec3 move = l.move;
    for (int k = 0; k < 3; ++k) l.move[k] = dot_of(map.rows[k], move);
  }
  // From the new world to the old one, by the transpose, and on.
  for (size_t f = 1; f < c.frames.size(); ++f) {
    const auto m = c.frames[f].matrix;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) c.frames[f].matrix[i][k] = dot_of(m[i], map.rows[k]);
    }
  }
  return c;
}

/// A result under a frame and a move, as a result.
Boundary placed(const Boundary& b, const Frame& frame, const IVec3& move) {
  Operand o;
  o.boundary = b;
  o.frame = frame;
  o.translation = move;
  const auto result = evaluate(leaf(0), {o});
  EXPECT_TRUE(result) << text(result.error());
  return result ? *result : nullptr;
}

TEST(Metamorphic, SignedPermutationsOfTheAxes) {
  const auto all = symmetries();
  ASSERT_EQ(all.size(), 48u);
  for_cases(53, 25, {}, [&](const FuzzCase& c) {
    const Boundary base = boundary_of(c);
    ASSERT_TRUE(base);
    const mpq_class expected = volume(*base);
    for (const GridMap& map : all) {
      const Boundary b = boundary_of(turned(c, map));
      ASSERT_TRUE(b);
      ASSERT_EQ(volume(*b), expected) << text(c);
      Frame back;  // what takes this world to the turned one
      back.is_identity = false;
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) back.matrix[i][k] = map.rows[i][k] << Frame::kShift;
      }
      const Boundary again = placed(b, back, {0, 0, 0});
      ASSERT_TRUE(again);
      ASSERT_EQ(difference_between(*base, *again), "") << text(c);
    }
  });
}

TEST(Metamorphic, TranslationsByWholeSteps) {
  Random random(54);
  for_cases(54, 250, {false, true, true}, [&](const FuzzCase& c) {
    const Boundary base = boundary_of(c);
    ASSERT_TRUE(base);
    for (const int64_t reach : {int64_t{3}, int64_t{1} << 26}) {
      FuzzCase moved = c;
      IVec3 by, back;
      for (int k = 0; k < 3; ++k) {
        by[k] = random.integer(-reach, reach);
        back[k] = -by[k];
      }
      for (FuzzLeaf& l : moved.leaves) {
        for (int k = 0; k < 3; ++k) l.move[k] += by[k];
      }
      const Boundary b = boundary_of(moved);
      ASSERT_TRUE(b);
      const Boundary again = placed(b, Frame(), back);
      ASSERT_TRUE(again);
      ASSERT_EQ(difference_between(*base, *again), "") << text(c);
    }
  });
}

/// The same set by other orders of operands.
FuzzNode shuffled(Random& random, const FuzzNode& n, const std::vector<FuzzLeaf>& leaves,
                  std::vector<FuzzLeaf>& order) {
  FuzzNode r = n;
  if (n.leaf >= 0) {
    r.leaf = static_cast<int>(order.size());
    order.push_back(leaves[static_cast<size_t>(n.leaf)]);
    return r;
  }
  const size_t first = n.op == BooleanOp::kDifference ? 1 : 0;
  std::vector<size_t> at(n.children.size());
  for (size_t i = 0; i < at.size(); ++i) at[i] = i;
  for (size_t i = at.size() - 1; i > first; --i) {
    std::swap(at[i], at[static_cast<size_t>(
                         random.integer(static_cast<int64_t>(first), static_cast<int64_t>(i)))]);
  }
  r.children.clear();
  for (const size_t i : at) r.children.push_back(shuffled(random, n.children[i], leaves, order));
  return r;
}

TEST(Metamorphic, OrdersOfOperands) {
  Random random(55);
  for_cases(55, 250, {}, [&](FuzzCase c) {
    // Labels depend on the order; the point set does not.
    for (FuzzLeaf& l : c.leaves) {
      l.keep_facets = false;
      l.appearance = 0;
    }
    FuzzCase other = c;
    other.leaves.clear();
    other.tree = shuffled(random, c.tree, c.leaves, other.leaves);
    const Boundary a = boundary_of(c), b = boundary_of(other);
    ASSERT_TRUE(a && b);
    const auto x = present(*a, test_context()), y = present(*b, test_context());
    ASSERT_TRUE(x && y);
    ASSERT_EQ((*x)->canonical_hash, (*y)->canonical_hash) << text(c) << text(other);
    ASSERT_EQ((*x)->positions, (*y)->positions);
    ASSERT_EQ((*x)->triangles, (*y)->triangles);
  });
}

// The public evaluator, which folds transforms, quantises, shares and caches, against the kernel
// that is given the same leaves.
TEST(Metamorphic, TheEvaluatorIsTheKernel) {
  Random random(56);
  for_cases(56, 400, {false, true, true}, [&](FuzzCase c) {
    put_in_turned_frames(random, c);
    const Boundary b = boundary_of(c);
    ASSERT_TRUE(b);
    const auto expected = present(*b, test_context());
    ASSERT_TRUE(expected);
    for (const bool flatten : {true, false}) {
      EvaluateOptions options;
      options.grid.numerator = 1;
      options.flatten = flatten;
      options.threads = flatten ? 2 : 1;
      options.cell_limit = c.options.cell_limit;
      options.octree_shift = c.options.octree_shift;
      const auto solid = Evaluator(options).evaluate(node_of(c));
      ASSERT_TRUE(solid) << solid.error().message << "\n" << text(c);
      if (b->faces.empty()) {
        ASSERT_TRUE((*solid)->empty()) << text(c);
        continue;
      }
      ASSERT_EQ((*solid)->canonical_hash, (*expected)->canonical_hash) << text(c);
      ASSERT_EQ((*solid)->positions, (*expected)->positions);
      ASSERT_EQ((*solid)->triangles, (*expected)->triangles);
      ASSERT_EQ((*solid)->measures.volume, (*expected)->measures.volume);
    }
  });
}

}  // namespace
}  // namespace csgrun::metamorphic_test
