// Octree cells: no polygon is missed, hardly one is kept for nothing, and cells are divided where
// it helps. Against clipping in rationals and counts by hand.
#include "engine/bsp/cell_box.h"

#include <algorithm>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/support/exact_solid.h"
#include "tests/support/gmp_bridge.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"
#include "tests/support/rational_polygons.h"

namespace csgrun::cell_box_test {
namespace {

using test::meets;
using test::Rational3;

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

bool may_meet_triangle(const test::Loop& loop, const CellBox& cell) {
  const std::vector<Operand> operands{test::operand_of(test::make_leaf({loop}))};
  return may_meet(Job(operands), 0, cell);
}

IVec3 plus(const IVec3& a, const IVec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

// Polygons that miss the cell [0, 64]^3 by one separating axis alone, at any place and in any turn.
TEST(CellBox, EachSeparatingAxisDropsAPolygon) {
  const auto near = [](int64_t at) { return CellBox{{at, at, at}, {at + 64, at + 64, at + 64}}; };
  for (const int64_t at : {int64_t{0}, int64_t{1} << 29}) {
    for (int turn = 0; turn < 12; ++turn) {
      const int axis = turn % 3, rotation = turn / 3 % 2, mirrored = turn / 6;
      const auto placed = [&](test::Loop loop) {
        std::rotate(loop.begin(), loop.begin() + rotation, loop.end());
        for (IVec3& p : loop) {
          std::rotate(p.begin(), p.begin() + axis, p.end());
          for (int64_t& c : p) c = at + (mirrored ? 64 - c : c);
        }
        return loop;
      };
      // By its box: on the cell's lower wall or above the upper one; else inside.
      for (const auto& [x, expected] :
           {std::pair<int64_t, bool>{-1, false}, {0, mirrored != 0}, {1, true}, {40, true}}) {
        EXPECT_EQ(may_meet_triangle(placed({{x, 9, 9}, {x, 20, 9}, {x, 9, 30}}), near(at)),
                  expected)
            << x << " turn " << turn << " at " << at;
      }
      // By its plane, which cuts off a corner of the box: x + y + z = -10.
      EXPECT_FALSE(
          may_meet_triangle(placed({{60, -35, -35}, {-35, 60, -35}, {-35, -35, 60}}), near(at)))
          << turn << " at " << at;
      EXPECT_TRUE(
          may_meet_triangle(placed({{80, -35, -35}, {-35, 80, -35}, {-35, -35, 80}}), near(at)));
      // By an edge, x + y = -20 in the plane z = 30.
      EXPECT_FALSE(
          may_meet_triangle(placed({{60, -80, 30}, {-80, 60, 30}, {-80, -80, 30}}), near(at)))
          << turn << " at " << at;
      EXPECT_FALSE(
          may_meet_triangle(placed({{-80, 60, 30}, {60, -80, 30}, {-80, -80, 30}}), near(at)))
          << turn << " at " << at;
      EXPECT_TRUE(
          may_meet_triangle(placed({{80, -70, 30}, {-70, 80, 30}, {-80, -80, 30}}), near(at)));
    }
  }
}

// The first three corners turn by so little that doubles cannot say to which side, or how the plane
// lies; the polygon is wide all the same.
TEST(CellBox, MayMeetMissesNothingOfPolygonsThatStartStraight) {
  test::Random random(43);
  int met = 0;
  for (int i = 0; i < 4000; ++i) {
    // A basis of the plane, and numbers p s - q r = 1 as long as the coordinates allow.
    const int small = static_cast<int>(random.integer(0, 12));
    const auto basis = [&] {
      const int64_t reach = (int64_t{1} << small) - 1;
      return IVec3{random.integer(-reach, reach), random.integer(-reach, reach),
                   random.integer(-reach, reach)};
    };
    const int64_t large = int64_t{1} << (26 - small);
    IVec3 along = basis(), across = basis();
    if (small == 0 || test::cross_of(along, across) == IVec3{0, 0, 0}) {
      along = {1, 0, 0}, across = {0, 1, 0};
      std::rotate(along.begin(), along.begin() + i % 3, along.end());
      std::rotate(across.begin(), across.begin() + i % 3, across.end());
    }
    int64_t p = random.integer(large / 2, large), q = random.integer(1, large), r = 0, s = 0;
    {
      int64_t a = p, b = q, a_p = 1, a_q = 0, b_p = 0, b_q = 1;
      while (b != 0) {
        const int64_t n = a / b;
        std::tie(a, b) = std::pair(b, a - n * b);
        std::tie(a_p, b_p) = std::pair(b_p, a_p - n * b_p);
        std::tie(a_q, b_q) = std::pair(b_q, a_q - n * b_q);
      }
      if (a != 1) continue;
      s = a_p, r = -a_q;  // p a_p + q a_q = 1
      if (r < 0 || (r == 0 && s < 0)) r += p, s += q;
    }
    const auto at = [&](int64_t u, int64_t v) {
      return IVec3{u * along[0] + v * across[0], u * along[1] + v * across[1],
                   u * along[2] + v * across[2]};
    };
    test::Loop loop{at(0, 0), at(p, q), at(p + r, q + s), at(p + r - q, q + s + p), at(-q, p)};
    std::rotate(loop.begin(), loop.begin() + random.integer(0, 4), loop.end());
    const std::vector<Operand> operands{test::operand_of(test::make_leaf({loop}))};
    const Job job(operands);
    std::vector<Rational3> corners;
    for (const IVec3& c : loop) {
      corners.push_back(
          {mpq_class(mpz_class(c[0])), mpq_class(mpz_class(c[1])), mpq_class(mpz_class(c[2]))});
    }
    for (int k = 0; k < 4; ++k) {
      // A grid point of the polygon, anywhere in it, and a cell around it.
      const double u = random.unit(), v = random.unit();
      const IVec3 inside = plus(at(static_cast<int64_t>(u * static_cast<double>(p)),
                                   static_cast<int64_t>(u * static_cast<double>(q))),
                                at(static_cast<int64_t>(-v * static_cast<double>(q)),
                                   static_cast<int64_t>(v * static_cast<double>(p))));
      CellBox cell;
      const int64_t size = int64_t{1} << random.integer(0, 6);
      for (int c = 0; c < 3; ++c) {
        cell.lo[c] = inside[c] - random.integer(1, size);
        cell.hi[c] = cell.lo[c] + size;
      }
      const mpq_class shift(1, static_cast<unsigned long>(job.prime()));
      Rational3 lo, hi;
      for (int c = 0; c < 3; ++c) {
        lo[c] = mpz_class(cell.lo[c]) + shift, hi[c] = mpz_class(cell.hi[c]) + shift;
      }
      if (!meets(corners, lo, hi)) continue;
      ++met;
      ASSERT_TRUE(may_meet(job, 0, cell)) << "case " << i;
    }
  }
  EXPECT_GT(met, 2000);
}

// Corners of turned leaves are rounded; of a small polygon far from the middle of a large cell that
// is much.
TEST(CellBox, MayMeetMissesNothingOfSmallRoundedPolygons) {
  test::Random random(44);
  int met = 0, dropped = 0;
  for (int i = 0; i < 6000; ++i) {
    const int bits = static_cast<int>(random.integer(20, 28));
    const int64_t reach = int64_t{1} << bits, size = random.integer(1, 4);
    const auto far = [&] { return random.integer(-reach, reach); };
    const IVec3 at{far(), far(), far()};
    const auto near = [&] {
      return plus(at, {random.integer(-size, size), random.integer(-size, size),
                       random.integer(-size, size)});
    };
    test::Loop loop{near(), near(), near()};
    if (test::cross_of(test::sub(loop[1], loop[0]), test::sub(loop[2], loop[0])) ==
        IVec3{0, 0, 0}) {
      continue;
    }
    if (i % 3 == 0) {  // with a straight angle at the start
      for (IVec3& p : loop) p = plus(p, test::sub(p, at));
      loop.insert(loop.begin() + 1, {(loop[0][0] + loop[1][0]) / 2, (loop[0][1] + loop[1][1]) / 2,
                                     (loop[0][2] + loop[1][2]) / 2});
    }
    Operand operand = test::operand_of(test::make_leaf({loop}));
    operand.frame = test::random_frame(random);
    const std::vector<Operand> operands{operand};
    const Job job(operands);
    std::vector<Rational3> corners;
    for (const uint32_t v : job.corners(job.polygons()[0])) {
      const test::GmpPoint x = test::to_gmp(job.exact(v));
      corners.push_back({mpq_class(x.x) / x.w, mpq_class(x.y) / x.w, mpq_class(x.z) / x.w});
    }
    for (int trial = 0; trial < 4; ++trial) {
      // A cell of any size that has a corner, an edge or a side there.
      CellBox cell;
      const int64_t extent = int64_t{1} << random.integer(1, bits);
      for (int k = 0; k < 3; ++k) {
        const auto here = static_cast<int64_t>(job.rounded(0)[k]) + random.integer(-3, 3);
        cell.lo[k] = here - (random.integer(0, 4) ? (random.integer(0, 1) ? 0 : extent)
                                                  : random.integer(0, extent));
        cell.hi[k] = cell.lo[k] + extent;
      }
      const mpq_class shift(1, static_cast<unsigned long>(job.prime()));
      Rational3 lo, hi;
      for (int c = 0; c < 3; ++c) {
        lo[c] = mpz_class(cell.lo[c]) + shift, hi[c] = mpz_class(cell.hi[c]) + shift;
      }
      const bool kept = may_meet(job, 0, cell);
      dropped += !kept;
      if (!meets(corners, lo, hi)) continue;
      ++met;
      ASSERT_TRUE(kept) << "case " << i;
    }
  }
  EXPECT_GT(met, 2000);
  EXPECT_GT(dropped, 1000);
}

// Long polygons in frames, one of whose edges is tiny: what its rounded ends say of its direction,
// and of the plane, is far off at the other end.
TEST(CellBox, MayMeetMissesNothingOfLongPolygonsWithATinyEdge) {
  test::Random random(45);
  int met = 0, dropped = 0;
  for (int i = 0; i < 2500; ++i) {
    const int64_t reach = int64_t{1} << random.integer(18, 24);
    const auto step = [&] {
      return IVec3{random.integer(-3, 3), random.integer(-3, 3), random.integer(-3, 3)};
    };
    const IVec3 along = step(), across = step();
    if (test::cross_of(along, across) == IVec3{0, 0, 0}) continue;
    const IVec3 origin{random.integer(-reach, reach), random.integer(-reach, reach),
                       random.integer(-reach, reach)};
    const auto at = [&](int64_t u, int64_t v) {
      IVec3 p = origin;
      for (size_t k = 0; k < 3; ++k) p[k] += u * along[k] + v * across[k];
      return p;
    };
    const int64_t length = random.integer(reach, 2 * reach), width = random.integer(1, 1 << 12);
    // The tiny edge in line with the long one, or at right angles to it.
    test::Loop loop{at(0, 0), at(1, 0), at(length, 0), at(length, width), at(0, 1)};
    std::rotate(loop.begin(), loop.begin() + random.integer(0, 4), loop.end());
    Operand operand = test::operand_of(test::make_leaf({loop}));
    operand.frame = test::random_frame(random);
    const std::vector<Operand> operands{operand};
    const Job job(operands);
    std::vector<Rational3> corners;
    for (const uint32_t v : job.corners(job.polygons()[0])) {
      const test::GmpPoint x = test::to_gmp(job.exact(v));
      corners.push_back({mpq_class(x.x) / x.w, mpq_class(x.y) / x.w, mpq_class(x.z) / x.w});
    }
    for (int trial = 0; trial < 4; ++trial) {
      // A small cell at a corner, mostly at the far end.
      const auto& corner = job.rounded(static_cast<uint32_t>(random.integer(0, 4)));
      CellBox cell;
      const int64_t extent = int64_t{1} << random.integer(0, 3);
      for (int k = 0; k < 3; ++k) {
        cell.lo[k] = static_cast<int64_t>(corner[k]) - random.integer(0, extent + 1);
        cell.hi[k] = cell.lo[k] + extent;
      }
      const mpq_class shift(1, static_cast<unsigned long>(job.prime()));
      Rational3 lo, hi;
      for (int c = 0; c < 3; ++c) {
        lo[c] = mpz_class(cell.lo[c]) + shift, hi[c] = mpz_class(cell.hi[c]) + shift;
      }
      const bool kept = may_meet(job, 0, cell);
      dropped += !kept;
      if (!meets(corners, lo, hi)) continue;
      ++met;
      ASSERT_TRUE(kept) << "case " << i;
    }
  }
  EXPECT_GT(met, 2000);
  EXPECT_GT(dropped, 20);
}

/// A frame that is turned and stretched by so little that far vertices move by a few steps, to
/// places off the grid.
Frame nearly_straight_frame(test::Random& random) {
  Frame frame;
  frame.is_identity = false;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      frame.matrix[i][j] =
          (i == j ? int64_t{1} << 40 : 0) + random.integer(-(1 << 18), int64_t{1} << 18);
    }
  }
  return frame;
}

/// Whether the cell meets the only polygon of a job.
bool truly_meets(const Job& job, const CellBox& cell) {
  std::vector<Rational3> corners;
  for (const uint32_t v : job.corners(job.polygons()[0])) {
    const test::GmpPoint x = test::to_gmp(job.exact(v));
    corners.push_back({mpq_class(x.x) / x.w, mpq_class(x.y) / x.w, mpq_class(x.z) / x.w});
  }
  const mpq_class shift(1, static_cast<unsigned long>(job.prime()));
  Rational3 lo, hi;
  for (int c = 0; c < 3; ++c) {
    lo[c] = mpz_class(cell.lo[c]) + shift, hi[c] = mpz_class(cell.hi[c]) + shift;
  }
  return meets(corners, lo, hi);
}

// A cell may be long and thin. Where a polygon starts beside the middle of it, its plane and its
// edges are known badly at the ends, however near that middle is.
TEST(CellBox, MayMeetMissesNothingAtTheEndsOfLongCells) {
  test::Random random(46);
  int met = 0, dropped = 0;
  for (int i = 0; i < 3000; ++i) {
    const bool is_fan = i % 2 != 0;
    const size_t along = i / 2 % 3, across = (along + 1 + i / 6 % 2) % 3;
    const int64_t far = random.integer(1 << 24, (1 << 27) - 1);
    const auto at = [&](int64_t x, int64_t y) {
      IVec3 p{0, 0, 0};
      p[along] = x, p[across] = y;
      return p;
    };
    // Tiny edges around the start: aslant, or in line with two long ones.
    test::Loop loop = is_fan
                          ? test::Loop{at(0, 0), at(1, -2), at(far, -far), at(far, far), at(1, 2)}
                          : test::Loop{at(0, 0),    at(1, 0),    at(far, 0), at(far, 5),
                                       at(-far, 5), at(-far, 0), at(-1, 0)};
    if (i / 12 % 2) std::reverse(loop.begin(), loop.end());
    const auto start = random.integer(0, static_cast<int64_t>(loop.size()) - 1);
    std::rotate(loop.begin(), loop.begin() + start, loop.end());
    Operand operand = test::operand_of(test::make_leaf({loop}));
    operand.frame = nearly_straight_frame(random);
    for (int64_t& t : operand.translation) {
      t = random.integer(1 << 29, 7 << 27) * (random.integer(0, 1) ? 1 : -1);
    }
    const std::vector<Operand> operands{operand};
    const Job job(operands);
    const auto corners = job.corners(job.polygons()[0]);
    const auto number = [&](const IVec3& p) {
      return corners[std::find(loop.begin(), loop.end(), p) - loop.begin()];
    };
    const auto middle = job.rounded(number(at(0, 0)));
    for (int trial = 0; trial < 4; ++trial) {
      // Around a place far out, thin, and as long on either side of the start.
      std::array<double, 3> p{};
      if (is_fan) {
        const auto &u = job.rounded(number(at(far, -far))), &v = job.rounded(number(at(far, far)));
        for (size_t k = 0; k < 3; ++k) p[k] = (u[k] + v[k]) / 2;
      } else {
        p = job.rounded(number(at(trial % 2 ? far : -far, trial / 2 ? 5 : 0)));
      }
      const int64_t thin = random.integer(2, 8);
      CellBox cell;
      for (size_t k = 0; k < 3; ++k) {
        cell.lo[k] = static_cast<int64_t>(p[k]) - random.integer(0, thin + 1);
        cell.hi[k] = cell.lo[k] + thin;
      }
      cell.lo[along] = static_cast<int64_t>(middle[along]) - far - 9;
      cell.hi[along] = cell.lo[along] + 2 * far + 18;
      const bool kept = may_meet(job, 0, cell);
      dropped += !kept;
      if (!truly_meets(job, cell)) continue;
      ++met;
      EXPECT_TRUE(kept) << "case " << i;
    }
  }
  EXPECT_GT(met, 2000);
  EXPECT_GT(dropped, 20);
}

// Nor is it what the coordinates of the two ends add up to that counts: from one end of a polygon
// to the other its edges run through zero.
TEST(CellBox, MayMeetMissesNothingAtTheOtherEnd) {
  test::Random random(47);
  std::array<int, 3> met{};
  for (int i = 0; i < 1200; ++i) {
    const size_t along = i % 3, across = (along + 1 + i / 3 % 2) % 3;
    const int64_t far = random.integer(1 << 25, (1 << 27) - 1);
    const auto at = [&](int64_t x, int64_t y) {
      IVec3 p{0, 0, 0};
      p[along] = x, p[across] = y;
      return p;
    };
    test::Loop loop{at(-far, 0), at(1 - far, 0), at(far, 0), at(far, 5), at(-far, 5)};
    const bool is_reversed = random.integer(0, 1) != 0;
    if (is_reversed) std::reverse(loop.begin(), loop.end());
    Operand operand = test::operand_of(test::make_leaf({loop}));
    operand.frame = nearly_straight_frame(random);
    for (int64_t& t : operand.translation) {
      t = random.integer(1 << 29, 7 << 27) * (random.integer(0, 1) ? 1 : -1);
    }
    operand.translation[along] = random.integer(-9, 9);
    const std::vector<Operand> operands{operand};
    const Job job(operands);
    const auto& end = job.rounded(job.corners(job.polygons()[0])[2]);
    for (int trial = 0; trial < 4; ++trial) {
      CellBox cell;
      const int64_t extent = random.integer(1, 8);
      for (size_t k = 0; k < 3; ++k) {
        cell.lo[k] = static_cast<int64_t>(end[k]) - random.integer(0, extent + 1);
        cell.hi[k] = cell.lo[k] + extent;
      }
      if (!truly_meets(job, cell)) continue;
      ++met[along];
      EXPECT_TRUE(may_meet(job, 0, cell)) << "case " << i;
    }
  }
  for (const int n : met) EXPECT_GT(n, 300);
}

TEST(CellBox, RoundedOutwardsHoldsTheWalls) {
  const GridBox box = CellBox{{-3, 4, 5}, {6, 7, 8}}.rounded_outwards();
  EXPECT_EQ(box.lo, (IVec3{-3, 4, 5}));  // -3 + 1/p and 6 + 1/p, rounded
  EXPECT_EQ(box.hi, (IVec3{7, 8, 9}));
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
  EXPECT_EQ(best({{0, 0, 0}, {8, 2, 8}}, {{{0, 0, 0}, {8, 1, 8}}}), 1);  // two can
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
}  // namespace csgrun::cell_box_test
