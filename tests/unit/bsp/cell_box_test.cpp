// Octree cells: no polygon is missed, hardly one is kept for nothing, and cells are divided where
// it helps. Against clipping in rationals and counts by hand.
#include "engine/bsp/cell_box.h"

#include <gtest/gtest.h>

#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun {
namespace {

using test::Rational3;

/// Whether a convex polygon meets the box [lo, hi], by clipping it.
bool meets(std::vector<Rational3> polygon, const Rational3& lo, const Rational3& hi) {
  for (int k = 0; k < 3; ++k) {
    for (int upper = 0; upper < 2; ++upper) {
      const auto depth = [&](const Rational3& p) -> mpq_class {
        return upper ? mpq_class(hi[k] - p[k]) : mpq_class(p[k] - lo[k]);
      };
      std::vector<Rational3> rest;
      for (size_t i = 0; i < polygon.size(); ++i) {
        const Rational3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const mpq_class s = depth(p), t = depth(q);
        if (s >= 0) rest.push_back(p);
        if (s * t < 0) {
          Rational3 x;
          for (int j = 0; j < 3; ++j) x[j] = p[j] + (q[j] - p[j]) * s / (s - t);
          rest.push_back(x);
        }
      }
      polygon = rest;
    }
  }
  return !polygon.empty();
}

struct Count {
  int met = 0, missed = 0, kept_for_nothing = 0, dropped = 0;
};

Count count_polygons(test::Random& random, int64_t reach, int64_t move) {
  Count count;
  for (int i = 0; i < 2500; ++i) {
    const auto coordinate = [&] { return move + random.integer(-reach, reach); };
    const auto point = [&] { return IVec3{coordinate(), coordinate(), coordinate()}; };
    const IVec3 a = point(), b = point(), c = point();
    if (test::cross_of(test::sub(b, a), test::sub(c, a)) == IVec3{0, 0, 0}) continue;
    // A triangle or a parallelogram.
    test::Loop loop{a, b, c};
    if (i % 2) loop.push_back({a[0] + c[0] - b[0], a[1] + c[1] - b[1], a[2] + c[2] - b[2]});
    const std::vector<Operand> operands{test::operand_of(test::make_leaf({loop}))};
    const Job job(operands);
    CellBox cell;
    const int64_t size = int64_t{1} << random.integer(0, 5);
    for (int k = 0; k < 3; ++k) cell.lo[k] = coordinate(), cell.hi[k] = cell.lo[k] + size;
    std::vector<Rational3> corners;
    for (const IVec3& p : loop) {
      corners.push_back(
          {mpq_class(mpz_class(p[0])), mpq_class(mpz_class(p[1])), mpq_class(mpz_class(p[2]))});
    }
    const auto grown = [&](const mpq_class& by) {
      Rational3 lo, hi;
      for (int k = 0; k < 3; ++k) {
        const mpq_class shift(1, static_cast<unsigned long>(job.prime()));
        lo[k] = mpz_class(cell.lo[k]) + shift - by;
        hi[k] = mpz_class(cell.hi[k]) + shift + by;
      }
      return meets(corners, lo, hi);
    };
    const bool kept = may_meet(job, 0, cell);
    if (grown(0)) {
      ++count.met;
      count.missed += !kept;
    } else if (!grown(3)) {  // beyond the margins
      ++(kept ? count.kept_for_nothing : count.dropped);
    }
  }
  return count;
}

TEST(CellBox, MayMeetMissesNothingAndKeepsLittleForNothing) {
  test::Random random(41);
  Count all;
  for (const auto& [reach, move] :
       {std::pair<int64_t, int64_t>{40, 0}, {60, -100000}, {40, 1 << 27}}) {
    const Count c = count_polygons(random, reach, move);
    EXPECT_EQ(c.missed, 0) << "at " << move;
    all.met += c.met;
    all.kept_for_nothing += c.kept_for_nothing;
    all.dropped += c.dropped;
  }
  EXPECT_GT(all.met, 400);
  EXPECT_GT(all.dropped, 1500);
  // Not all of the separating axes are tried.
  EXPECT_LT(all.kept_for_nothing, all.dropped / 40);
}

TEST(CellBox, RootCellIsTheSmallestCubeOfAPowerOfTwo) {
  test::Random random(42);
  for (int i = 0; i < 500; ++i) {
    GridBox region;
    std::array<uint32_t, 3> shift{};
    const int64_t reach = int64_t{1} << random.integer(0, 40);
    int64_t extent = 1;
    for (int k = 0; k < 3; ++k) {
      region.lo[k] = random.integer(-reach, reach);
      region.hi[k] = region.lo[k] + random.integer(0, 2 * reach);
      shift[k] = static_cast<uint32_t>(random.integer(0, 5));
      extent = std::max(extent, region.hi[k] - region.lo[k] + 2 + shift[k]);
    }
    const CellBox cell = root_cell(region, shift);
    const int64_t size = cell.hi[0] - cell.lo[0];
    for (int k = 0; k < 3; ++k) {
      // One step of room on either side, for walls beside whole numbers.
      ASSERT_EQ(cell.lo[k], region.lo[k] - 1 - shift[k]);
      ASSERT_EQ(cell.hi[k] - cell.lo[k], size);
      ASSERT_GE(cell.hi[k], region.hi[k] + 1);
    }
    ASSERT_EQ(size & (size - 1), 0);
    ASSERT_TRUE(size == 1 || size / 2 < extent);
  }
}

TEST(CellBox, DividesTheLongestAxisUnlessAnotherThinsOut) {
  const CellBox cube{{0, 0, 0}, {8, 8, 8}}, tall{{0, 0, 0}, {8, 8, 16}}, thin{{0, 0, 0}, {8, 1, 8}};
  EXPECT_EQ(AxisChoice(cube).longest(), 0);
  EXPECT_EQ(AxisChoice(tall).longest(), 2);
  EXPECT_EQ(AxisChoice({{0, 0, 0}, {8, 9, 9}}).longest(), 1);
  EXPECT_EQ(AxisChoice({{-9, 0, 0}, {0, 8, 8}}).longest(), 0);
  EXPECT_EQ(AxisChoice({{0, 5, 9}, {8, 14, 18}}).longest(), 1);
  // Boxes that span x, all on one side of the middle of y.
  const auto best = [](const CellBox& cell, const std::vector<PolygonBox>& boxes) {
    AxisChoice choice(cell);
    for (const PolygonBox& b : boxes) choice.count(b);
    return choice.best();
  };
  const PolygonBox low{{0, 0, 0}, {8, 3, 8}}, high{{0, 6, 0}, {8, 8, 8}}, all{{0, 0, 0}, {8, 8, 8}};
  EXPECT_EQ(best(cube, {low, high}), 1);
  EXPECT_EQ(best(tall, {{{0, 0, 0}, {8, 3, 16}}, {{0, 6, 0}, {8, 8, 16}}}), 1);
  EXPECT_EQ(best(tall, {low, high, low}), 2);
  EXPECT_EQ(best(cube, {all, all}), 0);
  EXPECT_EQ(best(thin, {{{0, 0, 0}, {8, 0, 8}}}), 0);  // one step cannot be divided
  // A wall stands at middle + 1/p: a box that ends in 4 is below, one that starts in 5 above.
  EXPECT_EQ(best(cube, {{{0, 0, 0}, {8, 4, 8}}}), 1);
  EXPECT_EQ(best(cube, {{{0, 5, 0}, {8, 8, 8}}}), 1);
  EXPECT_EQ(best(cube, {{{0, 4, 0}, {8, 8, 8}}}), 0);
  EXPECT_EQ(best(cube, {{{0, 0, 0}, {8, 5, 8}}}), 0);
  // Less by a tenth is not worth it: 18 and 20 halves, 17 and 20 are.
  EXPECT_EQ(best(cube, {all, all, all, all, all, all, all, all, low, low}), 0);
  EXPECT_EQ(best(cube, {all, all, all, all, all, all, all, low, low, low}), 1);
  // The best of all, not the first that is good.
  const PolygonBox corner{{0, 0, 0}, {8, 3, 3}}, edge{{0, 0, 0}, {8, 8, 3}};
  EXPECT_EQ(best(cube, {corner, edge, edge, edge}), 2);
  EXPECT_EQ(best({{-8, -8, -8}, {8, 8, 8}}, {{{-8, -8, -8}, {8, 8, 0}}}), 2);
}

}  // namespace
}  // namespace csgrun
