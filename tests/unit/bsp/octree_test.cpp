// The octree of a Boolean at its borders: nothing to look at, a stop, boxes that hold nothing.
#include "engine/bsp/octree.h"

#include <atomic>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"
#include "tests/support/rational_polygons.h"

namespace csgrun::octree_test {
namespace {

Octree octree_of(const std::vector<Operand>& operands, const GridBox& region,
                 const KernelOptions& options) {
  const Expression expression =
      test::flat_expression(BooleanOp::kUnion, static_cast<uint32_t>(operands.size()));
  Job job(operands);
  return build_octree(job, expression, region, options);
}

// Also where operands reach out of the region, so that its corner may be inside.
TEST(Octree, CriticalCellsHoldAllThatMeetsThem) {
  test::Random random(62);
  size_t cells = 0, inside = 0;
  for (int i = 0; i < 40; ++i) {
    std::vector<Operand> operands;
    for (int o = 0; o < 3; ++o) operands.push_back(test::operand_of(test::random_leaf(random)));
    GridBox region;
    for (size_t k = 0; k < 3; ++k) {
      region.lo[k] = random.integer(-2, 3);
      region.hi[k] = region.lo[k] + random.integer(1, 4);
    }
    KernelOptions options;
    options.cell_limit = static_cast<uint32_t>(random.integer(1, 12));
    const Octree tree = octree_of(operands, region, options);
    const Job job(operands);
    ASSERT_EQ(tree.cells % 2, 1u);
    ASSERT_GE(tree.surface_cells, tree.critical.size());
    ASSERT_LT(tree.surface_cells, 10000u);
    std::vector<test::ExactSolid> solids;
    for (const Operand& o : operands) solids.push_back(test::exact_solid(o));
    for (const CriticalCell& cell : tree.critical) {
      test::Rational3 lo, hi, corner;
      for (int k = 0; k < 3; ++k) {
        const mpq_class shift(1, static_cast<unsigned long>(job.prime()));
        lo[k] = mpz_class(cell.box.lo[k]) + shift, hi[k] = mpz_class(cell.box.hi[k]) + shift;
        corner[k] = lo[k] + test::tiny(150 * (k + 1));
      }
      ASSERT_GE(cell.presence_count, 2u);
      for (uint32_t n = 0; n < cell.presence_count; ++n) {
        const CriticalCell::Presence& p = tree.presences[cell.first_presence + n];
        const test::ExactSolid& solid = solids[p.operand];
        ASSERT_EQ(p.corner_inside, test::winding_around(solid, corner) != 0) << "case " << i;
        inside += p.corner_inside;
        const std::set<uint32_t> held(tree.cell_polygons.begin() + p.first_polygon,
                                      tree.cell_polygons.begin() + p.first_polygon + p.count);
        ASSERT_EQ(held.size(), p.count);
        for (uint32_t f = 0; f < solid.faces.size(); ++f) {
          std::vector<test::Rational3> polygon;
          for (const uint32_t v : solid.faces[f].loops[0]) polygon.push_back(solid.points[v]);
          const uint32_t number = job.polygon_start(p.operand) + f;
          if (held.count(number)) {
            ASSERT_TRUE(may_meet(job, number, cell.box));
            ASSERT_TRUE(tree.fate[number] & static_cast<uint8_t>(Copy::kCritical));
          } else {
            ASSERT_FALSE(test::meets(polygon, lo, hi)) << "case " << i;
          }
        }
      }
      for (const CriticalCell& other : tree.critical) {
        bool apart = &other == &cell;
        for (int k = 0; k < 3; ++k) {
          apart = apart || other.box.hi[k] <= cell.box.lo[k] || other.box.lo[k] >= cell.box.hi[k];
        }
        ASSERT_TRUE(apart);
      }
    }
    cells += tree.critical.size();
  }
  EXPECT_GT(cells, 300u);
  EXPECT_GT(inside, 100u);
}

TEST(Octree, OfAnEmptyRegionHasNoCells) {
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {4, 4, 4})),
                                      test::operand_of(test::box_leaf({2, 2, 2}, {6, 6, 6}))};
  EXPECT_EQ(octree_of(operands, test::region_of(operands), {}).cells, 1u);
  const Octree none = octree_of(operands, {}, {});
  EXPECT_EQ(none.cells, 0u);
  EXPECT_TRUE(none.critical.empty());
}

// What one operand alone has in a cell is copied, and counted in cells of so many polygons.
TEST(Octree, CountsWhatItCopies) {
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {40, 40, 40}))};
  const std::array<std::pair<uint32_t, uint64_t>, 6> expected{
      {{1, 6}, {2, 3}, {3, 2}, {4, 2}, {6, 1}, {17, 1}}};
  for (const auto& [limit, cells] : expected) {
    KernelOptions options;
    options.cell_limit = limit;
    const Octree tree = octree_of(operands, test::region_of(operands), options);
    EXPECT_EQ(tree.surface_cells, cells) << limit;
    EXPECT_EQ(tree.cells, 1u);
    EXPECT_EQ(tree.copied.size(), 6u);
  }
}

TEST(Octree, IsNotDividedOnceCancelled) {
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {40, 40, 40})),
                                      test::operand_of(test::box_leaf({20, 20, 20}, {60, 60, 60}))};
  const GridBox region = test::region_of(operands);
  KernelOptions options;
  options.cell_limit = 1;
  const uint64_t cells = octree_of(operands, region, options).cells;
  EXPECT_GT(cells, 1u);
  std::atomic<bool> cancel = false;
  options.cancel = &cancel;
  EXPECT_EQ(octree_of(operands, region, options).cells, cells);
  cancel = true;
  EXPECT_EQ(octree_of(operands, region, options).cells, 1u);
}

TEST(GridBox, IsEmptyWhereAnAxisIs) {
  EXPECT_TRUE(GridBox{}.empty());
  for (size_t k = 0; k < 3; ++k) {
    GridBox box{{1, 2, 3}, {4, 5, 6}};
    EXPECT_FALSE(box.empty());
    box.hi[k] = box.lo[k];
    EXPECT_FALSE(box.empty());
    box.hi[k] = box.lo[k] - 1;
    EXPECT_TRUE(box.empty());
  }
}

}  // namespace
}  // namespace csgrun::octree_test
