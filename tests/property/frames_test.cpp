// Leaves under frames: rotations, mirrors and shears as exact affine maps, mixed with each other.
#include <gtest/gtest.h>

#include "tests/support/exact_measures.h"
#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/kernel_checks.h"
#include "tests/support/oracle.h"
#include "tests/support/random_frames.h"

namespace csgrun::frames_test {
namespace {

using namespace test;  // NOLINT: a test

/// A random solid somewhere, small or as large as the grid allows.
Leaf placed_leaf(Random& random, bool may_be_large) {
  GridMap map;
  const int64_t size = random.integer(0, may_be_large ? 3 : 1);
  if (size == 3) {
    map = random_map(random, static_cast<int>(random.integer(10, 22)));
  } else {
    const int64_t scale = size == 0   ? 1
                          : size == 1 ? random.integer(2, 300)
                                      : random.integer(1, 1 << 22);
    for (int k = 0; k < 3; ++k) map.rows[k][k] = scale, map.move[k] = scale * random.integer(-3, 1);
  }
  return make_leaf(mapped(random_loops(random), map), random.integer(0, 3) == 0,
                   static_cast<uint32_t>(random.integer(0, 4) == 0),
                   static_cast<uint32_t>(random.integer(0, 1)));
}

std::vector<Oracle> oracles_of(const std::vector<Operand>& leaves) {
  std::vector<Oracle> oracles;
  for (const Operand& o : leaves) oracles.emplace_back(exact_solid(o));
  return oracles;
}

/// Leaves of comparable size, each in one of three frames, the first of which is the world's.
std::vector<Operand> framed_leaves(Random& random, int64_t n) {
  const std::array<Frame, 3> frames{Frame(), random_frame(random), random_frame(random)};
  const int64_t scale = random.integer(0, 2) == 0 ? 1 : random.integer(1, 1000);
  const int bits = random.integer(0, 4) == 0 ? static_cast<int>(random.integer(4, 20)) : 0;
  GridMap map;
  if (bits) map = random_map(random, bits);
  std::vector<Operand> leaves;
  for (; n > 0; --n) {
    GridMap m = map;
    for (auto& row : m.rows) {
      for (auto& v : row) v *= bits ? 1 : scale;
    }
    // Centred about the origin, where all frames meet.
    for (int k = 0; k < 3; ++k)
      m.move[k] = -(m.rows[k][0] + m.rows[k][1] + m.rows[k][2]) * random.integer(2, 3);
    Operand o = operand_of(make_leaf(mapped(random_loops(random), m), random.integer(0, 3) == 0, 0,
                                     static_cast<uint32_t>(random.integer(0, 1))));
    o.frame = frames[static_cast<size_t>(random.integer(0, 2))];
    for (auto& t : o.translation) t = random.integer(0, 2) ? 0 : random.integer(-2, 2) * scale;
    leaves.push_back(o);
  }
  return leaves;
}

TEST(Frames, IdentitiesOfMixedFrames) {
  Random random(11);
  const int n = cases(60);
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const auto leaves = framed_leaves(random, 2);
    const auto oracles = oracles_of(leaves);
    mpq_class v[4];
    const Tree trees[4] = {join({leaf(0), leaf(1)}), meet({leaf(0), leaf(1)}),
                           less({leaf(0), leaf(1)}), differ({leaf(0), leaf(1)})};
    for (int t = 0; t < 4; ++t) {
      const auto r = evaluate(trees[t], leaves, random_options(random));
      ASSERT_TRUE(r) << trees[t].text() << ": " << text(r.error());
      ASSERT_EQ(fault_in(**r), "") << trees[t].text();
      ASSERT_EQ(disagreement(random, trees[t], oracles, **r, 40), "");
      v[t] = volume(**r);
      const auto solid = present(**r, test_context());
      ASSERT_TRUE(solid) << text(solid.error());
      ASSERT_EQ(fault_in(**solid, **r), "") << trees[t].text();
    }
    const mpq_class a = volume(oracles[0].solid()), b = volume(oracles[1].solid());
    ASSERT_EQ(v[0] + v[1], a + b);
    ASSERT_EQ(v[2], a - v[1]);
    ASSERT_EQ(v[3], v[0] - v[1]);
  }
}

TEST(Frames, OneValueForEveryWayOfEvaluation) {
  Random random(12);
  const int n = cases(80);
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const auto leaves = framed_leaves(random, random.integer(2, 5));
    const auto oracles = oracles_of(leaves);
    const Tree tree = random_tree(random, 0, static_cast<int>(leaves.size()) - 1);
    const auto flat = evaluate(tree, leaves);
    ASSERT_TRUE(flat) << tree.text() << ": " << text(flat.error());
    ASSERT_EQ(fault_in(**flat), "") << tree.text();
    ASSERT_EQ(disagreement(random, tree, oracles, **flat, 60), "");
    for (int way = 0; way < 2; ++way) {
      const bool all = way == 0;
      const auto r = evaluate(tree, leaves, random_options(random),
                              [&](const Tree&) { return all || (random.bits() & 1); });
      ASSERT_TRUE(r) << tree.text() << ": " << text(r.error());
      ASSERT_EQ(difference_between(**flat, **r), "") << tree.text();
    }
  }
}

// A subtree of one frame is evaluated in the frame's coordinates, and its result put under the
// frame: the same as evaluating the leaves under the frame; also beside other operands.
TEST(Frames, AResultUnderAFrameIsItsLeavesUnderTheFrame) {
  Random random(13);
  const int n = cases(150);
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const Frame frame = random_frame(random);
    const IVec3 move{random.integer(-3, 3), random.integer(-3, 3), random.integer(-3, 3)};
    const int last = static_cast<int>(random.integer(0, 3));
    std::vector<Operand> plain, framed;
    for (int k = 0; k <= last; ++k) {
      plain.push_back(operand_of(random_leaf(random)));
      framed.push_back(plain.back());
      framed.back().frame = frame;
      framed.back().translation = move;
    }
    const Tree tree = random_tree(random, 0, last);
    const auto in_frame = evaluate(tree, plain, random_options(random));
    ASSERT_TRUE(in_frame) << text(in_frame.error());
    Operand reused;
    reused.boundary = *in_frame;
    reused.frame = frame;
    reused.translation = move;
    const auto direct = evaluate(tree, framed, random_options(random));
    ASSERT_TRUE(direct) << text(direct.error());
    ASSERT_EQ(fault_in(**direct), "");
    const auto turned = evaluate(leaf(0), {reused}, random_options(random));
    ASSERT_TRUE(turned) << text(turned.error());
    ASSERT_EQ(difference_between(**direct, **turned), "") << tree.text();
    // The frame changes no combinatorics but their order.
    ASSERT_EQ((*direct)->corners.size(), (*in_frame)->corners.size());
    ASSERT_EQ((*direct)->faces.size(), (*in_frame)->faces.size());
    ASSERT_EQ((*direct)->point_planes.size(), (*in_frame)->point_planes.size());

    Operand other = operand_of(random_leaf(random));
    if (random.bits() & 1) other.frame = random_frame(random);
    const auto op = static_cast<BooleanOp>(random.integer(0, 3));
    framed.push_back(other);
    const Tree direct_tree{-1, op, {tree, leaf(last + 1)}}, reused_tree{-1, op, {leaf(0), leaf(1)}};
    const auto a = evaluate(direct_tree, framed, random_options(random));
    ASSERT_TRUE(a) << text(a.error());
    std::vector<Operand> two{reused, other};
    // Sources are counted over the leaves of the whole tree.
    auto b = [&] {
      two[1].first_source = static_cast<uint32_t>(last) + 1;
      Expression expression;
      expression.nodes = {{true, op, 0, 0, 0}, {true, op, 1, 0, 0}, {false, op, 0, 0, 2}};
      expression.children = {0, 1};
      EvaluateStats stats;
      return evaluate_boolean(two, expression, region_of(two), random_options(random), stats);
    }();
    ASSERT_TRUE(b) << text(b.error());
    ASSERT_EQ(difference_between(**a, **b), "") << direct_tree.text();
  }
}

TEST(Frames, LargeAndSmallTogether) {
  Random random(14);
  const int n = cases(60);
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    std::vector<Operand> leaves;
    for (int k = 0; k < 2; ++k) {
      leaves.push_back(operand_of(placed_leaf(random, true)));
      if (random.bits() & 1) leaves.back().frame = random_frame(random);
    }
    const auto oracles = oracles_of(leaves);
    const Tree trees[2] = {join({leaf(0), leaf(1)}), meet({leaf(0), leaf(1)})};
    mpq_class v[2];
    for (int t = 0; t < 2; ++t) {
      const auto r = evaluate(trees[t], leaves, random_options(random));
      ASSERT_TRUE(r) << trees[t].text() << ": " << text(r.error());
      ASSERT_EQ(fault_in(**r), "") << trees[t].text();
      ASSERT_EQ(disagreement(random, trees[t], oracles, **r, 40), "");
      v[t] = volume(**r);
    }
    ASSERT_EQ(v[0] + v[1], volume(oracles[0].solid()) + volume(oracles[1].solid()));
  }
}

}  // namespace
}  // namespace csgrun::frames_test
