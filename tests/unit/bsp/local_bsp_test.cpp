// A labelled BSP of convex polygons: its labels against winding in rationals is what the tests of
// the kernel look at; here, whether the plane that divides a node is the cheapest of the three
// tried.
#include "engine/bsp/local_bsp.h"

#include <gtest/gtest.h>

#include "tests/support/gmp_bridge.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun::local_bsp_test {
namespace {

/// What a plane costs: three for each polygon that it splits, and one for each that one side has
/// more.
int cost_of(CellGeometry& geometry, const PlaneTable& planes, uint32_t plane,
            const std::vector<Fragment>& polygons) {
  int front = 0, back = 0, split = 0;
  for (const Fragment& f : polygons) {
    if (f.support.index() == plane) continue;
    bool above = false, below = false;
    for (uint32_t c = 0; c < f.count; ++c) {
      const int s =
          test::gmp_side(planes.plane(plane), test::to_gmp(geometry.exact(geometry.corners(f)[c])));
      above |= s > 0;
      below |= s < 0;
    }
    ++(above && below ? split : above ? front : back);
  }
  return 3 * split + std::abs(front - back);
}

TEST(LocalBsp, DividesByTheCheapestOfThreePlanes) {
  test::Random random(31);
  std::array<int, 3> chosen{};
  for (int i = 0; i < 300; ++i) {
    const std::vector<Operand> operands{test::operand_of(test::random_leaf(random)),
                                        test::operand_of(test::random_leaf(random))};
    Job job(operands);
    CellGeometry geometry(job.planes(), &job);
    // Of two leaves, since those of one hardly ever split each other.
    std::vector<Fragment> polygons;
    const auto most = static_cast<size_t>(random.integer(1, 12));
    for (uint32_t p = 0; p < job.polygons().size(); ++p) job.ensure_planes(p);
    for (size_t k = 0; k < most; ++k) {
      polygons.push_back(geometry.load(static_cast<uint32_t>(
          random.integer(0, static_cast<int64_t>(job.polygons().size()) - 1))));
    }
    LocalBsp bsp;
    bsp.build(geometry, polygons, false);
    size_t expected = 0;
    const size_t n = polygons.size();
    if (n >= 4) {
      const std::array<size_t, 3> tried{0, (n - 1) / 2, n - 1};
      std::array<int, 3> cost{};
      for (size_t c = 0; c < 3; ++c) {
        cost[c] = cost_of(geometry, job.planes(), polygons[tried[c]].support.index(), polygons);
      }
      const size_t best =
          static_cast<size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
      expected = tried[best];
      ++chosen[best];
    }
    ASSERT_GE(bsp.root(), 0);
    ASSERT_EQ(bsp.nodes()[bsp.root()].plane, polygons[expected].support.index())
        << n << " polygons";
  }
  for (const int c : chosen) EXPECT_GT(c, 20);
}

TEST(LocalBsp, OfNothingIsWhatTheCornerSays) {
  PlaneTable planes;
  CellGeometry geometry(planes, nullptr);
  LocalBsp bsp;
  bsp.build(geometry, {}, true);
  EXPECT_EQ(bsp.root(), LocalBsp::kInside);
  bsp.build(geometry, {}, false);
  EXPECT_EQ(bsp.root(), LocalBsp::kOutside);
}

}  // namespace
}  // namespace csgrun::local_bsp_test
