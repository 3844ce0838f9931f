// Points by name: the same for an edge from either face, by value where names differ, however many.
#include "engine/bsp/crossing_points.h"

#include <map>

#include <gtest/gtest.h>

#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun {
namespace {

TEST(CrossingPoints, HaveOneNumberEach) {
  // Poles along z through a stack of plates: each edge of a pole passes through each of their
  // faces.
  std::vector<Operand> operands;
  constexpr int64_t kPoles = 8, kPlates = 25;
  for (int64_t i = 0; i < kPlates; ++i) {
    operands.push_back(test::operand_of(
        test::box_leaf({-1, -1, 4 * i}, {10 * kPoles + 1, 10 * kPoles + 1, 4 * i + 2})));
  }
  for (int64_t i = 0; i < kPoles; ++i) {
    operands.push_back(
        test::operand_of(test::box_leaf({10 * i, 10 * i, -5}, {10 * i + 4, 10 * i + 4, 200})));
  }
  Job job(operands);
  for (uint32_t p = 0; p < job.polygons().size(); ++p) job.ensure_planes(p);
  CellGeometry geometry(job.planes(), &job);
  PointIndex index(geometry);
  CrossingPoints points(job, geometry, index);
  const auto is_level = [&](uint32_t p) {
    const Plane& plane = job.planes().plane(job.polygons()[p].support.index());
    return plane.a == 0 && plane.b == 0;
  };
  std::map<test::Rational3, uint32_t> number;
  for (int round = 0; round < 2; ++round) {
    for (uint32_t p = job.polygon_start(kPlates); p < job.polygons().size(); ++p) {
      if (is_level(p)) continue;
      const auto corners = job.corners(job.polygons()[p]);
      for (uint32_t e = 0; e < corners.size(); ++e) {
        const auto &a = job.rounded(corners[e]),
                   &b = job.rounded(corners[(e + 1) % corners.size()]);
        if (a[2] == b[2]) continue;  // along the plates
        for (uint32_t q = 0; q < job.polygon_start(kPlates); ++q) {
          if (!is_level(q)) continue;
          const uint32_t x = points.point(p, e, q);
          const test::GmpPoint g = test::to_gmp(geometry.exact(x));
          const test::Rational3 at{mpq_class(g.x) / g.w, mpq_class(g.y) / g.w,
                                   mpq_class(g.z) / g.w};
          ASSERT_EQ(at[0], a[0]);
          ASSERT_EQ(at[1], a[1]);
          ASSERT_EQ(at[2], job.rounded(job.corners(job.polygons()[q])[0])[2]);
          ASSERT_EQ(number.emplace(at, x).first->second, x);
        }
      }
    }
    // Made once: four edges of a pole, seen from two faces each, through two faces of a plate.
    EXPECT_EQ(number.size(), size_t{kPoles * 4 * kPlates * 2});
    EXPECT_EQ(geometry.point_count(), number.size());
  }
}

}  // namespace
}  // namespace csgrun
