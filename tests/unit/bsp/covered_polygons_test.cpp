// Polygons that are said to be boundary of nothing are: cut or not, no result has a piece of them.
#include "engine/bsp/covered_polygons.h"

#include <gtest/gtest.h>

#include "engine/mesh/opposite_edges.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun {
namespace {

/// An octahedron that knows that it is convex.
Operand octahedron(const IVec3& middle, int64_t radius) {
  std::vector<IVec3> points;
  for (size_t k = 0; k < 3; ++k) {
    for (const int64_t r : {-radius, radius}) {
      points.push_back(middle);
      points.back()[k] += r;
    }
  }
  auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(test::hull_loops(points)));
  leaf->opposite = pair_edges(*leaf).opposite;
  leaf->convex = true;
  leaf->may_touch = false;
  return test::operand_of(std::move(leaf));
}

/// Whether a point is strictly inside an octahedron.
bool is_inside(const IVec3& middle, int64_t radius, const std::array<double, 3>& p) {
  double sum = 0;
  for (size_t k = 0; k < 3; ++k) sum += std::fabs(p[k] - static_cast<double>(middle[k]));
  return sum < static_cast<double>(radius);
}

TEST(CoveredPolygons, AreInsideOfAnotherOrBesideTheFirst) {
  test::Random random(951);
  size_t covered = 0, left = 0;
  for (int round = 0; round < 60; ++round) {
    const BooleanOp op = round % 2 == 0 ? BooleanOp::kUnion : BooleanOp::kDifference;
    std::vector<Operand> operands;
    std::vector<std::pair<IVec3, int64_t>> made;
    for (int i = 0; i < 12; ++i) {
      IVec3 middle{};
      for (int64_t& c : middle) c = random.integer(-60, 60);
      made.emplace_back(middle, random.integer(5, 90));
      operands.push_back(octahedron(middle, made.back().second));
    }
    const Job job(operands);
    const auto found = find_plainly_covered(job, test::flat_expression(op, 12));
    for (uint32_t p = 0; p < found.size(); ++p) {
      if (!found[p]) {
        ++left;
        continue;
      }
      ++covered;
      const JobPolygon& polygon = job.polygons()[p];
      bool is_in_one = false;
      for (uint32_t o = op == BooleanOp::kUnion ? 0 : 1; o < 12; ++o) {
        const auto corners = job.corners(polygon);
        is_in_one |=
            o != polygon.operand && std::all_of(corners.begin(), corners.end(), [&](uint32_t v) {
              return is_inside(made[o].first, made[o].second, job.rounded(v));
            });
      }
      const bool is_beside = op == BooleanOp::kDifference && polygon.operand > 0 &&
                             !job.operand_box(0).meets(job.boxes()[p]);
      ASSERT_TRUE(is_in_one || is_beside) << "round " << round;
    }
  }
  EXPECT_GT(covered, 300u);
  EXPECT_GT(left, 300u);
}

TEST(CoveredPolygons, AreNotLookedForWhereAllCount) {
  std::vector<Operand> operands{octahedron({0, 0, 0}, 50), octahedron({3, 0, 0}, 5)};
  const auto covered = [&](BooleanOp op) {
    const Job job(operands);
    const auto found = find_plainly_covered(
        job, test::flat_expression(op, static_cast<uint32_t>(operands.size())));
    return std::count(found.begin(), found.end(), 1);
  };
  EXPECT_EQ(covered(BooleanOp::kUnion), 0);  // two that do not meet at all
  operands.push_back(octahedron({40, 0, 0}, 5));
  EXPECT_EQ(covered(BooleanOp::kUnion), 8);
  EXPECT_EQ(covered(BooleanOp::kDifference), 0);
  EXPECT_EQ(covered(BooleanOp::kSymmetricDifference), 0);
  // The last two have no box in common.
  EXPECT_EQ(covered(BooleanOp::kIntersection), 24);
}

}  // namespace
}  // namespace csgrun
