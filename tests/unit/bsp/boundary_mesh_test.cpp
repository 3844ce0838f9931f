// Results that are moved without a job, against rationals and against the job.
#include "engine/bsp/boundary_mesh.h"

#include <gtest/gtest.h>

#include "tests/support/exact_measures.h"
#include "tests/support/kernel_case.h"

namespace csgrun {
namespace {

using namespace test;  // NOLINT: a test

TEST(BoundaryMesh, MovesByWholeSteps) {
  Random random(41);
  size_t off_grid = 0;
  for (int i = 0; i < 40; ++i) {
    const auto built = evaluate(less({leaf(0), leaf(1)}),
                                {operand_of(random_leaf(random)), operand_of(random_leaf(random))});
    ASSERT_TRUE(built) << text(built.error());
    Operand operand;
    operand.boundary = *built;
    for (int64_t& t : operand.translation) t = random.integer(-70, 70);
    const BoundaryMesh moved = translated(**built, operand.translation);
    const ExactSolid from = exact_solid(**built), to = exact_solid(moved);
    ASSERT_EQ(to.points.size(), from.points.size());
    for (size_t p = 0; p < to.points.size(); ++p) {
      for (int k = 0; k < 3; ++k) {
        const mpq_class& c = to.points[p][k];
        ASSERT_EQ(c, from.points[p][k] + static_cast<long>(operand.translation[k]));
        ASSERT_TRUE(is_correctly_rounded(c, moved.point_rounded[p][k]));
        off_grid += c.get_den() != 1;
      }
    }
    const auto by_job = evaluate(leaf(0), {operand});
    ASSERT_TRUE(by_job) << text(by_job.error());
    EXPECT_EQ(moved.faces.size(), (*by_job)->faces.size());
    EXPECT_EQ(moved.corners.size(), (*by_job)->corners.size());
    EXPECT_EQ(volume(moved), volume(**by_job));
  }
  EXPECT_GT(off_grid, 50u);
}

}  // namespace
}  // namespace csgrun
