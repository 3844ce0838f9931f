// Cells of a surface that crosses itself, against rationals: what they hold, the winding numbers at
// their corners, and that nothing which has to be found out is left out.
#include "engine/bsp/surface_octree.h"

#include <atomic>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/exact_solid.h"
#include "tests/support/gmp_bridge.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"
#include "tests/support/rational_polygons.h"

namespace csgrun::surface_octree_test {
namespace {

using test::Rational3;

struct Walls {
  Rational3 lo, hi;

  Walls(const CellBox& box, int64_t prime) {
    for (int k = 0; k < 3; ++k) {
      const mpq_class shift(1, static_cast<unsigned long>(prime));
      lo[k] = mpz_class(box.lo[k]) + shift, hi[k] = mpz_class(box.hi[k]) + shift;
    }
  }
  [[nodiscard]] bool holds(const Rational3& p) const {
    for (int k = 0; k < 3; ++k) {
      if (p[k] < lo[k] || p[k] > hi[k]) return false;
    }
    return true;
  }
};

/// Whether a point is in a cell, or beside it by less than a step.
bool is_near(const CellBox& box, const std::array<double, 3>& p) {
  for (int k = 0; k < 3; ++k) {
    if (p[k] < static_cast<double>(box.lo[k]) || p[k] > static_cast<double>(box.hi[k]) + 1) {
      return false;
    }
  }
  return true;
}

TEST(SurfaceOctree, CellsHoldWhatCrossesAndWitnesses) {
  test::Random random(61);
  size_t cells = 0, corners_inside = 0;
  for (int i = 0; i < 30; ++i) {
    std::vector<test::Loop> loops;
    for (int64_t k = random.integer(1, 3); k > 0; --k) {
      auto own = test::random_loops(random, 6);
      if (random.integer(0, 2) == 0) test::turn_over(own);
      loops.insert(loops.end(), own.begin(), own.end());
    }
    const std::vector<Operand> operands{test::operand_of(test::make_leaf(loops))};
    Job job(operands);
    const test::ExactSolid surface = test::exact_solid(operands[0]);
    std::vector<uint32_t> all(job.polygons().size()), witnesses;
    std::vector<uint8_t> crosses;
    const bool few = random.integer(0, 1) != 0;
    for (uint32_t p = 0; p < all.size(); ++p) {
      all[p] = p;
      crosses.push_back(random.integer(0, few ? 9 : 2) == 0);
    }
    if (random.integer(0, 2)) {
      witnesses.push_back(
          static_cast<uint32_t>(random.integer(0, static_cast<int64_t>(job.vertex_count()) - 1)));
    }
    KernelOptions options;
    options.cell_limit = static_cast<uint32_t>(random.integer(0, 9));
    for (auto& s : options.octree_shift) s = static_cast<uint32_t>(random.integer(0, 5));
    const SurfaceOctree tree = build_surface_octree(job, all, crosses, witnesses, options);
    ASSERT_EQ(tree.visited % 2, 1u);  // each division makes two of one

    std::vector<std::vector<Rational3>> polygons;
    for (const auto& face : surface.faces) {
      auto& polygon = polygons.emplace_back();
      for (const uint32_t v : face.loops[0]) polygon.push_back(surface.points[v]);
    }
    size_t listed = 0;
    std::vector<Walls> walls;
    for (const SurfaceCell& cell : tree.cells) {
      const Walls& own = walls.emplace_back(cell.box, job.prime());
      const std::set<uint32_t> held(tree.polygons.begin() + cell.first_polygon,
                                    tree.polygons.begin() + cell.first_polygon + cell.count);
      ASSERT_EQ(held.size(), cell.count);
      ASSERT_EQ(cell.first_polygon, listed);
      listed += cell.count;
      for (uint32_t p = 0; p < polygons.size(); ++p) {
        if (held.count(p)) {
          ASSERT_TRUE(may_meet(job, p, cell.box));
        } else {
          ASSERT_FALSE(test::meets(polygons[p], own.lo, own.hi)) << "case " << i;
        }
      }
      Rational3 corner = own.lo;
      for (int k = 0; k < 3; ++k) corner[k] += test::tiny(150 * (k + 1));
      ASSERT_EQ(cell.corner_winding, test::winding_around(surface, corner)) << "case " << i;
      corners_inside += cell.corner_winding != 0;
      // One of them is reason enough to solve the cell.
      ASSERT_GT(cell.count, 0u);
      ASSERT_TRUE(std::any_of(held.begin(), held.end(), [&](uint32_t p) { return crosses[p]; }) ||
                  std::any_of(witnesses.begin(), witnesses.end(),
                              [&](uint32_t v) { return is_near(cell.box, job.rounded(v)); }))
          << "case " << i;
      for (int k = 0; k < 3; ++k) ASSERT_LT(cell.box.lo[k], cell.box.hi[k]);
    }
    ASSERT_EQ(listed, tree.polygons.size());
    cells += walls.size();
    const auto in_cells = [&](const Rational3& p) {
      size_t count = 0;
      for (const Walls& w : walls) count += w.holds(p);
      return count;
    };
    for (const uint32_t v : witnesses) {
      const test::GmpPoint p = test::to_gmp(job.exact(v));
      ASSERT_EQ(in_cells({mpq_class(p.x) / p.w, mpq_class(p.y) / p.w, mpq_class(p.z) / p.w}), 1u);
    }
    // Points of the polygons that cross others: each in one cell.
    for (uint32_t p = 0; p < polygons.size(); ++p) {
      if (!crosses[p]) continue;
      for (int k = 0; k < 4; ++k) {
        Rational3 at{0, 0, 0};
        mpq_class total = 0;
        for (const Rational3& corner : polygons[p]) {
          const mpq_class weight(static_cast<unsigned long>(random.integer(1, 1000003)));
          at = test::sum(at, corner, weight);
          total += weight;
        }
        for (mpq_class& c : at) c /= total;
        ASSERT_EQ(in_cells(at), 1u) << "case " << i;
      }
    }
  }
  EXPECT_GT(cells, 500u);
  EXPECT_GT(corners_inside, 100u);
}

/// Of all polygons of a leaf, which cross others or do not.
/// witness.
SurfaceOctree octree_of(const std::vector<test::Loop>& loops, uint32_t limit, bool crossing,
                        const std::atomic<bool>* cancel = nullptr) {
  const std::vector<Operand> operands{test::operand_of(test::make_leaf(loops))};
  Job job(operands);
  std::vector<uint32_t> all(job.polygons().size());
  for (uint32_t p = 0; p < all.size(); ++p) all[p] = p;
  KernelOptions options;
  options.cell_limit = limit;
  options.cancel = cancel;
  return build_surface_octree(job, all, std::vector<uint8_t>(all.size(), crossing), {}, options);
}

TEST(SurfaceOctree, WithoutCrossingsOrPolygonsThereIsNothingToSolve) {
  const auto box = test::box_loops({0, 0, 0}, {9, 9, 9});
  EXPECT_TRUE(octree_of(box, 1, false).cells.empty());
  EXPECT_EQ(octree_of(box, 1, false).visited, 1u);
  EXPECT_EQ(octree_of(box, 6, true).visited, 1u);
  EXPECT_EQ(octree_of(box, 6, true).cells.size(), 1u);
  EXPECT_GT(octree_of(box, 5, true).visited, 1u);
  EXPECT_EQ(octree_of({}, 5, true).visited, 0u);
}

TEST(SurfaceOctree, IsNotDividedOnceCancelled) {
  const auto box = test::box_loops({0, 0, 0}, {9, 9, 9});
  std::atomic<bool> cancel = true;
  EXPECT_EQ(octree_of(box, 1, true, &cancel).visited, 1u);
  cancel = false;
  EXPECT_EQ(octree_of(box, 1, true, &cancel).visited, octree_of(box, 1, true).visited);
}

TEST(SurfaceOctree, ThingsThatAreApartComeApart) {
  // Pairs of boxes across each other, far apart.
  std::vector<test::Loop> loops;
  for (int64_t i = 0; i < 27; ++i) {
    const IVec3 at{40 * (i % 3), 40 * (i / 3 % 3), 40 * (i / 9)};
    for (const int64_t d : {0, 2}) {
      const auto box = test::box_loops({at[0] + d, at[1] + d, at[2] + d},
                                       {at[0] + d + 4, at[1] + d + 4, at[2] + d + 4});
      loops.insert(loops.end(), box.begin(), box.end());
    }
  }
  const SurfaceOctree tree = octree_of(loops, 12, true);
  for (const SurfaceCell& cell : tree.cells) EXPECT_LE(cell.count, 12u);
  EXPECT_GE(tree.cells.size(), 27u);
  EXPECT_LT(tree.visited, 100u);
}

TEST(SurfaceOctree, WhatCannotComeApartIsLeftSoon) {
  // A fan of triangles around one point: wherever it is divided, all of them are in one half.
  std::vector<test::Loop> loops;
  for (int64_t i = 0; i < 60; ++i) {
    loops.push_back({{1000, 1000, 1000},
                     {2000, 1000 + 7 * i, 1900 - 13 * i},
                     {1900 - 11 * i, 2000, 1000 + 5 * i}});
  }
  const SurfaceOctree tree = octree_of(loops, 1, true);
  EXPECT_LT(tree.visited, 250u);
  EXPECT_GT(tree.visited, 20u);
  // Nor do polygons that are all the same, down to a step.
  const SurfaceOctree same =
      octree_of(std::vector<test::Loop>(200, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), 1, true);
  for (const SurfaceCell& cell : same.cells) {
    for (int k = 0; k < 3; ++k) EXPECT_LT(cell.box.lo[k], cell.box.hi[k]);
  }
}

}  // namespace
}  // namespace csgrun::surface_octree_test
