// Points by name: the same for an edge from either face, by value where names differ, however many.
#include "engine/bsp/crossing_points.h"

#include <array>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "engine/bsp/point_index.h"
#include "tests/support/exact_solid.h"
#include "tests/support/gmp_bridge.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun::crossing_points_test {
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
  for (uint32_t p = 0; p < job.polygons().size(); ++p) job.ensure_support(p);
  CellGeometry geometry(job.planes(), &job);
  PointIndex index(geometry);
  CrossingPoints points(job, geometry, index);
  points.make_room(100);  // far fewer than there will be
  const auto is_level = [&](uint32_t p) {
    const Plane& plane = job.planes().plane(job.polygons()[p].support.index());
    return plane.a == 0 && plane.b == 0;
  };
  // Names first, points after each few poles.
  struct Expected {
    uint32_t crossing;
    std::array<double, 3> at;
  };
  std::map<test::Rational3, uint32_t> number;
  for (int round = 0; round < 2; ++round) {
    std::vector<Expected> expected;
    const auto check = [&] {
      points.make_points();
      for (const Expected& e : expected) {
        const uint32_t x = points.point(e.crossing);
        const test::GmpPoint g = test::to_gmp(geometry.exact(x));
        const test::Rational3 at{mpq_class(g.x) / g.w, mpq_class(g.y) / g.w, mpq_class(g.z) / g.w};
        for (size_t k = 0; k < 3; ++k) ASSERT_EQ(at[k], e.at[k]);
        ASSERT_EQ(number.emplace(at, x).first->second, x);
      }
      expected.clear();
    };
    for (uint32_t p = job.polygon_start(kPlates); p < job.polygons().size(); ++p) {
      if (is_level(p)) continue;
      const auto corners = job.corners(job.polygons()[p]);
      for (uint32_t e = 0; e < corners.size(); ++e) {
        const auto &a = job.rounded(corners[e]),
                   &b = job.rounded(corners[(e + 1) % corners.size()]);
        if (a[2] == b[2]) continue;  // along the plates
        for (uint32_t q = 0; q < job.polygon_start(kPlates); ++q) {
          if (!is_level(q)) continue;
          expected.push_back({points.number({p, e, q}),
                              {a[0], a[1], job.rounded(job.corners(job.polygons()[q])[0])[2]}});
        }
      }
      if (p % 17 == 0) {
        ASSERT_NO_FATAL_FAILURE(check());
      }
    }
    ASSERT_NO_FATAL_FAILURE(check());
    // Made once: four edges of a pole, seen from two faces each, through two faces of a plate.
    EXPECT_EQ(number.size(), size_t{kPoles * 4 * kPlates * 2});
    EXPECT_EQ(geometry.point_count(), number.size());
  }
}

}  // namespace
}  // namespace csgrun::crossing_points_test
