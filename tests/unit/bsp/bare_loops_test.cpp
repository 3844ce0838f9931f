// Faces in several parts that lie on faces of others, whose loops are asked about together, against
// cells.
#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/bsp/kernel.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/convex_operand.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun::bare_loops_test {
namespace {

/// A ring about the Z axis; all its faces above and below are triangles.
Operand ring(int64_t inner, int64_t outer, int64_t low, int64_t high) {
  const std::array<std::array<int64_t, 2>, 8> rim{
      {{5, 2}, {2, 5}, {-2, 5}, {-5, 2}, {-5, -2}, {-2, -5}, {2, -5}, {5, -2}}};
  std::vector<test::Loop> loops;
  for (size_t i = 0; i < rim.size(); ++i) {
    const auto at = [&](size_t corner, int64_t size, int64_t z) {
      const auto& [x, y] = rim[corner % rim.size()];
      return IVec3{size * x, size * y, z};
    };
    const size_t j = i + 1;
    for (const int64_t z : {low, high}) {
      std::array<test::Loop, 2> parts{
          test::Loop{at(i, inner, z), at(i, outer, z), at(j, outer, z)},
          test::Loop{at(i, inner, z), at(j, outer, z), at(j, inner, z)}};
      for (test::Loop& part : parts) {
        if (z == low) std::reverse(part.begin(), part.end());
        loops.push_back(part);
      }
    }
    loops.push_back({at(i, outer, low), at(j, outer, low), at(j, outer, high), at(i, outer, high)});
    loops.push_back({at(j, inner, low), at(i, inner, low), at(i, inner, high), at(j, inner, high)});
  }
  auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(loops));
  leaf->opposite = pair_edges(*leaf).opposite;
  leaf->may_touch = false;
  EXPECT_FALSE(leaf->opposite.empty());
  return test::operand_of(std::move(leaf));
}

/// Of which the bottom or the top is in the plane z = 0.
Operand plate(test::Random& random) {
  const auto from = [&] { return random.integer(-45, 20); };
  const bool is_above = random.integer(0, 2) != 0;
  const int64_t height = random.integer(1, 6);
  const IVec3 lo{from(), from(), is_above ? 0 : -height};
  const IVec3 hi{random.integer(21, 45), random.integer(21, 45), is_above ? height : 0};
  return test::convex_operand(test::box_loops(lo, hi));
}

std::shared_ptr<const BoundaryMesh> evaluate(const std::vector<Operand>& operands, BooleanOp op,
                                             bool whole_faces, unsigned threads = 1) {
  KernelOptions options;
  options.whole_faces = whole_faces;
  options.threads = threads;
  EvaluateStats stats;
  const auto result =
      evaluate_boolean(operands, test::flat_expression(op, static_cast<uint32_t>(operands.size())),
                       test::region_of(operands), options, stats);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *result : std::make_shared<BoundaryMesh>();
}

// Rings, nested or not, on plates that end anywhere, in any order.
TEST(BareLoops, OfRingsOnPlatesAreWhatCellsGive) {
  test::Random random(61207);
  size_t faces = 0;
  for (int i = 0; i < 150; ++i) {
    std::vector<Operand> operands;
    for (int64_t o = random.integer(1, 3); o > 0; --o) {
      const int64_t inner = random.integer(1, 6);
      const int64_t low = random.integer(0, 3) ? 0 : -random.integer(1, 3);
      operands.push_back(
          ring(inner, inner + random.integer(1, 3), low, low + random.integer(3, 5)));
    }
    for (int64_t o = random.integer(1, 2); o > 0; --o) operands.push_back(plate(random));
    for (size_t o = operands.size(); --o > 0;) {
      std::swap(operands[o],
                operands[static_cast<size_t>(random.integer(0, static_cast<int64_t>(o)))]);
    }
    for (uint32_t o = 0; o < operands.size(); ++o) operands[o].first_source = 100 * o;
    for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kDifference, BooleanOp::kIntersection,
                               BooleanOp::kSymmetricDifference}) {
      const auto slow = evaluate(operands, op, false);
      ASSERT_EQ(test::first_difference(*evaluate(operands, op, true), *slow), "") << "case " << i;
      ASSERT_EQ(test::first_difference(*evaluate(operands, op, true, 3), *slow), "");
      faces += slow->faces.size();
    }
  }
  EXPECT_GT(faces, 1000u);
}

}  // namespace
}  // namespace csgrun::bare_loops_test
