// Faces that lie on those of other operands: what covers what, and that results do not depend on
// it.
#include "engine/bsp/flat_cover.h"

#include <array>
#include <utility>

#include <gtest/gtest.h>

#include "engine/bsp/kernel.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/convex_operand.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"
#include "tests/support/seeded.h"

namespace csgrun::flat_cover_test {
namespace {

using test::convex_operand;
using Point = std::array<int64_t, 2>;

/// A prism over the hull of points, its foot in a plane: z = 0, or x + y + z = 0.
Operand prism(const std::vector<Point>& base, int64_t height, bool aslant) {
  std::vector<IVec3> points;
  for (const Point& p : base) {
    for (const int64_t up : {int64_t{0}, height}) {
      points.push_back(aslant ? IVec3{p[0] + up, p[1] + up, up - p[0] - p[1]}
                              : IVec3{p[0], p[1], up});
    }
  }
  return convex_operand(test::hull_loops(points));
}

int64_t turn(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Three points, or three and the one that makes a parallelogram.
std::vector<Point> random_base(test::Random& random) {
  std::vector<Point> base(3);
  do {
    for (Point& p : base) p = {random.integer(0, 4), random.integer(0, 4)};
  } while (turn(base[0], base[1], base[2]) == 0);
  if (random.integer(0, 1) != 0) {
    base.push_back({base[1][0] + base[2][0] - base[0][0], base[1][1] + base[2][1] - base[0][1]});
  }
  return base;
}

/// Whether a point is in the hull of some: in one of the triangles of these.
bool is_in_hull(const std::vector<Point>& hull, const Point& p) {
  for (size_t i = 0; i < hull.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      for (size_t k = 0; k < j; ++k) {
        const std::array<int64_t, 3> sides{turn(hull[i], hull[j], p), turn(hull[j], hull[k], p),
                                           turn(hull[k], hull[i], p)};
        if (turn(hull[i], hull[j], hull[k]) == 0) continue;
        bool left = true, right = true;
        for (const int64_t s : sides) left &= s >= 0, right &= s <= 0;
        if (left || right) return true;
      }
    }
  }
  return false;
}

/// The polygon of an operand all of whose corners are in the feet's plane.
uint32_t foot_of(const Job& job, uint32_t operand, bool aslant) {
  for (uint32_t p = job.polygon_start(operand); p < job.polygon_start(operand + 1); ++p) {
    bool is_foot = true;
    for (const uint32_t v : job.corners(job.polygons()[p])) {
      const auto& at = job.rounded(v);
      is_foot &= (aslant ? at[0] + at[1] + at[2] : at[2]) == 0;
    }
    if (is_foot) return p;
  }
  return ~0u;
}

TEST(FlatCover, IsToldByCorners) {
  test::Random random(1009);
  size_t covered = 0, beside = 0;
  for (int round = 0; round < 10'000; ++round) {
    const bool aslant = round % 2 == 1;
    const auto outer = random_base(random), inner = random_base(random);
    const std::vector<Operand> operands{prism(outer, random.integer(0, 1) != 0 ? 3 : -3, aslant),
                                        prism(inner, 2, aslant)};
    const Job job(operands);
    const uint32_t q = foot_of(job, 0, aslant), p = foot_of(job, 1, aslant);
    ASSERT_TRUE(q != ~0u && p != ~0u);
    bool expected = true;
    for (const Point& at : inner) expected &= is_in_hull(outer, at);
    ASSERT_EQ(covers(job, q, p), expected) << round;
    covered += expected;
    beside += !expected;
  }
  EXPECT_GT(covered, 100u);
  EXPECT_GT(beside, 5000u);
}

/// 0 op (1 op (2 op ...)), or ((0 op 1) op 2) op ...
Expression chain(const std::vector<BooleanOp>& ops, bool to_the_right) {
  Expression e;
  const auto count = static_cast<uint32_t>(ops.size() + 1);
  for (uint32_t o = 0; o < count; ++o) {
    e.nodes.emplace_back();
    e.nodes.back().operand = o;
  }
  uint32_t last = to_the_right ? count - 1 : 0;
  for (uint32_t i = 0; i + 1 < count; ++i) {
    Expression::Node node;
    node.is_operand = false;
    node.op = ops[i];
    node.first_child = static_cast<uint32_t>(e.children.size());
    node.child_count = 2;
    const uint32_t other = to_the_right ? count - 2 - i : i + 1;
    e.children.push_back(to_the_right ? other : last);
    e.children.push_back(to_the_right ? last : other);
    e.nodes.push_back(node);
    last = static_cast<uint32_t>(e.nodes.size() - 1);
  }
  return e;
}

std::shared_ptr<const BoundaryMesh> evaluate(const std::vector<Operand>& operands,
                                             const Expression& expression, bool whole_faces,
                                             uint64_t& signs) {
  KernelOptions options;
  options.whole_faces = whole_faces;
  EvaluateStats stats;
  const auto result =
      evaluate_boolean(operands, expression, test::region_of(operands), options, stats);
  EXPECT_TRUE(result);
  signs = stats.sign_filter + stats.sign_symbolic;
  for (const uint64_t n : stats.sign_exact) signs += n;
  return result ? *result : nullptr;
}

// Cells know nothing of covers.
TEST(FlatCover, MakesNoDifferenceToResults) {
  test::Random random(1013);
  size_t faces = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<Operand> operands;
    std::vector<BooleanOp> ops;
    const int64_t count = random.integer(2, 7);
    for (int64_t o = 0; o < count; ++o) {
      operands.push_back(prism(random_base(random), random.integer(1, 2), round % 4 == 3));
      operands.back().first_source = static_cast<uint32_t>(o);
      if (random.integer(0, 3) == 0) operands.back().translation = {0, 0, random.integer(-2, 0)};
      if (o > 0) {
        // Mostly differences, which is where it is hardest to tell.
        ops.push_back(random.integer(0, 1) != 0 ? BooleanOp::kDifference
                                                : static_cast<BooleanOp>(random.integer(0, 3)));
      }
    }
    const Expression expression = chain(ops, round % 3 != 0);
    uint64_t signs = 0;
    const auto whole = evaluate(operands, expression, true, signs);
    const auto cells = evaluate(operands, expression, false, signs);
    ASSERT_TRUE(whole && cells);
    ASSERT_EQ(test::first_difference(*whole, *cells), "") << round;
    faces += whole->faces.size();
  }
  EXPECT_GT(faces, 1000u);
}

// Prisms in one another that share a corner and three planes: layers, of which each has a rim in
// all three. Signs grow as pairs do: faces of inner ones are not cut by all others.
TEST(FlatCover, OfNestedDifferencesOneFaceIsCut) {
  uint64_t before = 0;
  for (const int64_t count : {16, 32, 64}) {
    std::vector<Operand> operands;
    for (int64_t i = count; i > 0; --i) {
      const int64_t size = 1000 * i;
      operands.push_back(prism({{0, 0}, {size, 0}, {0, size}}, size, false));
      operands.back().first_source = static_cast<uint32_t>(count - i);
    }
    const std::vector<BooleanOp> ops(operands.size() - 1, BooleanOp::kDifference);
    uint64_t signs = 0;
    const auto result = evaluate(operands, chain(ops, true), true, signs);
    ASSERT_TRUE(result);
    // Of each layer slope and lid, outside and inside, and one region of each of the three planes,
    // which have the label of the first operand everywhere.
    EXPECT_EQ(result->faces.size(), static_cast<size_t>(2 * count + 3));
    EXPECT_EQ(result->loop_starts.size() - 1, static_cast<size_t>(2 * count + 3 * count / 2));
    if (before != 0) {
      EXPECT_LT(signs, 5 * before) << count;
    }
    before = signs;
  }
}

}  // namespace
}  // namespace csgrun::flat_cover_test
