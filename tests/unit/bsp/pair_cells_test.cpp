// Every pair of polygons of different operands whose boxes overlap is looked at once, whichever way
// cells were found.
#include "engine/bsp/pair_cells.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "engine/base/parallel.h"
#include "engine/bsp/coarse_cells.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"
#include "tests/support/seeded.h"

namespace csgrun::pair_cells_test {
namespace {

using Pairs = std::map<std::pair<uint32_t, uint32_t>, int>;

bool overlap(const PolygonBox& a, const PolygonBox& b) {
  for (size_t k = 0; k < 3; ++k) {
    if (a.lo[k] > b.hi[k] || b.lo[k] > a.hi[k]) return false;
  }
  return true;
}

Pairs all_pairs(const Job& job) {
  Pairs pairs;
  for (uint32_t q = 0; q < job.polygons().size(); ++q) {
    for (uint32_t p = 0; p < q; ++p) {
      if (job.polygons()[p].operand != job.polygons()[q].operand &&
          overlap(job.boxes()[p], job.boxes()[q])) {
        pairs[{p, q}] = 1;
      }
    }
  }
  return pairs;
}

Pairs visited(const Job& job, const PairCells& cells) {
  Pairs pairs;
  CellPairs look({});
  for (const PairCells::Cell& cell : cells.cells) {
    look.visit(job, cells, cell, [&](uint32_t p, uint32_t q) { ++pairs[{p, q}]; });
  }
  return pairs;
}

/// Boxes of all sizes, of which some touch.
std::vector<Operand> random_boxes(test::Random& random, int count, int64_t reach, int64_t size) {
  std::vector<Operand> operands;
  for (int i = 0; i < count; ++i) {
    IVec3 lo{}, hi{};
    for (size_t k = 0; k < 3; ++k) {
      lo[k] = random.integer(-reach, reach);
      hi[k] = lo[k] + random.integer(1, size);
    }
    operands.push_back(test::operand_of(test::box_leaf(lo, hi)));
  }
  return operands;
}

/// Two surfaces of many squares each.
std::vector<Operand> tilings(test::Random& random, int64_t squares) {
  std::vector<Operand> operands;
  for (int i = 0; i < 2; ++i) {
    std::vector<test::Loop> loops;
    for (int64_t x = 0; x < squares; ++x) {
      for (int64_t y = 0; y < squares; ++y) {
        const int64_t z = random.integer(0, 3);
        loops.push_back({{x, y, z}, {x + 1, y, z}, {x + 1, y + 1, z}, {x, y + 1, z}});
      }
    }
    operands.push_back(test::operand_of(test::make_leaf(loops)));
    operands.back().translation = {random.integer(-9, 9), random.integer(-9, 9), 0};
  }
  return operands;
}

void expect_all_pairs(const std::vector<Operand>& operands, size_t& grids) {
  const Job job(operands);
  const Pairs expected = all_pairs(job);
  for (const uint32_t limit : {1u, 5u, 17u}) {
    KernelOptions options;
    options.cell_limit = limit;
    ASSERT_EQ(visited(job, find_pair_cells(job, {}, options)), expected) << "limit " << limit;
    const PairCells coarse = find_coarse_cells(job, {}, limit);
    ASSERT_EQ(visited(job, coarse), expected) << "limit " << limit;
    if (coarse.cells.size() < 2) continue;
    ++grids;
    for (const PairCells::Cell& cell : coarse.cells) {
      const auto of = [&](uint32_t i) {
        return job.polygons()[coarse.polygons[cell.first + i]].operand;
      };
      ASSERT_NE(of(0), of(cell.count - 1));
    }
  }
}

TEST(PairCells, LookAtEachPairOnce) {
  test::Random random(501);
  size_t grids = 0;
  for (const int count : {1, 2, 3, 40, 120}) {
    for (const int64_t size : {3, 30, 300}) {
      ASSERT_NO_FATAL_FAILURE(expect_all_pairs(random_boxes(random, count, 100, size), grids));
    }
  }
  for (const int64_t squares : {5, 20, 30}) {
    ASSERT_NO_FATAL_FAILURE(expect_all_pairs(tilings(random, squares), grids));
  }
  EXPECT_GE(grids, 10u);
  EXPECT_LT(grids, 50u);
}

// Polygons that reach far beyond what boxes can tell, and operands with nothing in common.
TEST(PairCells, FarAndApart) {
  test::Random random(502);
  size_t grids = 0;
  std::vector<Operand> operands = tilings(random, 30);
  operands[1].translation = {int64_t{1} << 39, 0, 0};
  expect_all_pairs(operands, grids);
  operands[0].translation = {-(int64_t{1} << 39), 0, 0};
  expect_all_pairs(operands, grids);
  operands[0].translation = {int64_t{1} << 39, 5, 0};
  expect_all_pairs(operands, grids);
  operands.push_back(
      test::operand_of(test::box_leaf({-(1 << 20), -(1 << 20), 1}, {1 << 20, 1 << 20, 1 << 20})));
  expect_all_pairs(operands, grids);
}

/// A cone of long triangles, whose boxes overlap in many places, around thousands of small ones.
std::vector<Operand> long_among_small(test::Random& random) {
  constexpr int64_t kLow = 26000, kHigh = 4000, kHeight = 22000;
  constexpr int kSides = 72, kSmall = 20000;
  std::vector<test::Loop> cone, small;
  const auto point = [](int side, int64_t radius, int64_t z) {
    const double angle = 2 * M_PI * side / kSides, r = static_cast<double>(radius);
    return IVec3{std::lround(r * std::cos(angle)), std::lround(r * std::sin(angle)), z};
  };
  for (int i = 0; i < kSides; ++i) {
    cone.push_back({point(i, kLow, 0), point(i + 1, kLow, 0), point(i, kHigh, kHeight)});
    cone.push_back({point(i + 1, kLow, 0), point(i + 1, kHigh, kHeight), point(i, kHigh, kHeight)});
  }
  for (int i = 0; i < kSmall; ++i) {
    const int64_t z = random.integer(0, kHeight - 100);
    const IVec3 p = point(i % kSides, random.integer(3500, 4000), z);
    small.push_back({p, {p[0] + 1100, p[1], z + 50}, {p[0], p[1] + 700, z + 70}});
  }
  return {test::operand_of(test::make_leaf(cone)), test::operand_of(test::make_leaf(small)),
          test::operand_of(test::box_leaf({-kHigh, -kHigh, -kHeight}, {kHigh, kHigh, 0}))};
}

// Cells are not made smaller where that only copies long polygons.
TEST(PairCells, LongPolygonsAreNotCopiedWithoutEnd) {
  test::Random random(503);
  const std::vector<Operand> operands = long_among_small(random);
  const Job job(operands);
  PairCells cells = find_pair_cells(job, {}, {});
  cells.slabs.clear();  // nothing is sifted
  EXPECT_EQ(visited(job, cells), all_pairs(job));
  EXPECT_LT(cells.visited, 5 * job.polygons().size());
  EXPECT_LT(cells.polygons.size(), 40 * job.polygons().size());
}

TEST(PairCells, NothingIsNoPair) {
  size_t grids = 0;
  expect_all_pairs({}, grids);
  EXPECT_EQ(grids, 0u);
  const std::vector<Operand> none;
  EXPECT_TRUE(find_coarse_cells(Job(none), {}, 1).cells.empty());
}

bool overlap(const PairCells::Cell& a, const PairCells::Cell& b) {
  return overlap(PolygonBox{a.lo, a.hi}, PolygonBox{b.lo, b.hi});
}

/// What a grid is for: cells apart, in what is common to two operands, with polygons that meet
/// them.
void expect_good_grid(const Job& job, const PairCells& grid, uint32_t limit) {
  std::vector<uint8_t> is_in(job.polygons().size(), 0);
  for (size_t c = 0; c < grid.cells.size(); ++c) {
    const PairCells::Cell& cell = grid.cells[c];
    for (size_t d = 0; d < c; ++d) ASSERT_FALSE(overlap(cell, grid.cells[d])) << c << ' ' << d;
    for (size_t k = 0; k < 3; ++k) {
      ASSERT_LE(cell.lo[k], cell.hi[k]);
      if (job.operand_count() != 2) continue;
      for (const size_t o : {0, 1}) {
        ASSERT_GE(cell.lo[k], job.operand_box(o).lo[k]);
        ASSERT_LE(cell.hi[k], job.operand_box(o).hi[k]);
      }
    }
    for (uint32_t i = 0; i < cell.count; ++i) {
      const uint32_t p = grid.polygons[cell.first + i];
      ASSERT_TRUE(overlap(job.boxes()[p], PolygonBox{cell.lo, cell.hi}));
      is_in[p] = 1;
    }
  }
  const auto alone = static_cast<uint32_t>(std::count(is_in.begin(), is_in.end(), 0));
  EXPECT_EQ(grid.surface, (alone + limit - 1) / limit);
}

TEST(PairCells, GridsHoldWhatIsShared) {
  test::Random random(503);
  for (int i = 0; i < 6; ++i) {
    std::vector<Operand> operands = tilings(random, 30);
    operands[1].translation = {random.integer(-20, 20), random.integer(-20, 20), i % 3};
    if (i >= 3) {  // of several operands all is shared; one of them is empty
      operands.push_back(test::operand_of(std::make_shared<LeafGeometry>()));
      operands.push_back(test::operand_of(test::box_leaf({-5, -5, 1}, {5, 5, 9})));
    }
    const Job job(operands);
    for (const uint32_t limit : {1u, 2u, 5u}) {
      const PairCells grid = find_coarse_cells(job, {}, limit);
      ASSERT_GT(grid.cells.size(), 1u);
      ASSERT_NO_FATAL_FAILURE(expect_good_grid(job, grid, limit)) << i << " limit " << limit;
    }
  }
}

// Cells of a grid with few polygons are taken as they are, those with more are divided.
// Slices of the cells are filled at the same time, each with what it has with one thread.
TEST(PairCells, SharedCellsAreTheSameOnAnyThreads) {
  const PolygonBox all{{0, 0, 0}, {1023, 1023, 255}};
  for (const size_t count : {3, 400, 40000}) {
    const auto listed = [&](unsigned threads) {
      return with_threads(threads, [&] {
        test::Random random(static_cast<uint64_t>(count));
        CoarseGrid grid(all, CoarseGrid::most_cells(count, 1));
        std::vector<CoarseGrid::Cells> cells(count);
        for (size_t p = 0; p < count; ++p) {
          PolygonBox box{};
          for (size_t k = 0; k < 3; ++k) {
            box.lo[k] = static_cast<int32_t>(random.integer(-20, 1040));
            box.hi[k] = box.lo[k] + static_cast<int32_t>(random.integer(0, 12));
          }
          EXPECT_TRUE(grid.find_cells(box, cells[p]));
          const auto own = static_cast<uint32_t>(1 + p % 2);
          grid.each_cell(cells[p], [&](uint32_t& c) { CoarseGrid::mark(c, own, false); });
        }
        return list_shared_cells(grid, cells, 5, 2);
      });
    };
    const PairCells one = listed(1), three = listed(3);
    EXPECT_EQ(one.cells.empty(), count == 3);
    EXPECT_EQ(one.surface, three.surface);
    ASSERT_EQ(one.polygons, three.polygons);
    ASSERT_EQ(one.cells.size(), three.cells.size());
    uint32_t next = 0;
    for (size_t c = 0; c < one.cells.size(); ++c) {
      const auto &a = one.cells[c], &b = three.cells[c];
      EXPECT_EQ(a.lo, b.lo);
      EXPECT_EQ(a.first, b.first);
      ASSERT_EQ(a.first, next);
      ASSERT_EQ(a.count, b.count);
      next += a.count;
      const auto begin = one.polygons.begin() + a.first;
      EXPECT_TRUE(std::is_sorted(begin, begin + a.count));
    }
    EXPECT_EQ(next, one.polygons.size());
  }
}

TEST(PairCells, CellsOfAGridAreDividedIfTheyHoldMany) {
  test::Random random(507);
  size_t as_they_are = 0, at_the_limit = 0, divided = 0;
  for (int i = 0; i < 6; ++i) {
    const std::vector<Operand> operands = random_boxes(random, 120, 100, i % 2 ? 10 : 30);
    const Job job(operands);
    for (const uint32_t limit : {1u, 2u, 3u}) {
      KernelOptions options;
      options.cell_limit = limit;
      const PairCells grid = find_coarse_cells(job, {}, limit),
                      cells = find_pair_cells(job, {}, options);
      ASSERT_GT(grid.cells.size(), 1u);
      size_t few = 0;
      for (const PairCells::Cell& g : grid.cells) {
        const bool is_there =
            std::any_of(cells.cells.begin(), cells.cells.end(), [&](const PairCells::Cell& c) {
              return c.lo == g.lo && c.hi == g.hi && c.count == g.count;
            });
        at_the_limit += g.count == 4 * limit;
        few += g.count <= 4 * limit;
        if (g.count <= 4 * limit) {
          ASSERT_TRUE(is_there);
        } else {
          divided += !is_there;
        }
      }
      as_they_are += few;
      if (few == grid.cells.size()) {
        EXPECT_EQ(cells.visited, few);
        EXPECT_EQ(cells.surface, grid.surface + few);
      } else {
        EXPECT_GE(cells.visited, grid.cells.size());
      }
    }
  }
  EXPECT_GT(as_they_are, 100u);
  EXPECT_GT(at_the_limit, 0u);
  EXPECT_GT(divided, 0u);
}

// Pairs of two covered polygons are left out; those of one are not.
TEST(PairCells, OfCoveredPolygonsAreThoseWithOthers) {
  test::Random random(508);
  size_t grids = 0, left_out = 0;
  for (int i = 0; i < 12; ++i) {
    const std::vector<Operand> operands =
        i % 2 ? tilings(random, 30) : random_boxes(random, 80, 100, 30);
    const Job job(operands);
    std::vector<uint8_t> covered(job.polygons().size(), 0);
    for (uint8_t& c : covered) c = random.integer(0, i % 3 ? 1 : 9) != 0;
    Pairs expected = all_pairs(job);
    left_out += std::erase_if(expected, [&](const auto& pair) {
      return covered[pair.first.first] && covered[pair.first.second];
    });
    for (const uint32_t limit : {1u, 5u}) {
      KernelOptions options;
      options.cell_limit = limit;
      const PairCells coarse = find_coarse_cells(job, covered, limit);
      grids += coarse.cells.size() > 1;
      for (const PairCells& cells : {coarse, find_pair_cells(job, covered, options)}) {
        Pairs pairs;
        CellPairs look(covered);
        for (const PairCells::Cell& cell : cells.cells) {
          look.visit(job, cells, cell, [&](uint32_t p, uint32_t q) { ++pairs[{p, q}]; });
        }
        ASSERT_EQ(pairs, expected) << i << " limit " << limit;
      }
    }
  }
  EXPECT_GT(grids, 5u);
  EXPECT_GT(left_out, 1000u);
}

// A flag that is there but not set stops nothing.
TEST(PairCells, AreNotLookedForOnceCancelled) {
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {9, 9, 9})),
                                      test::operand_of(test::box_leaf({3, 3, 3}, {12, 12, 12}))};
  const Job job(operands);
  std::atomic<bool> cancel = false;
  KernelOptions options;
  options.cell_limit = 1;
  options.cancel = &cancel;
  EXPECT_EQ(visited(job, find_pair_cells(job, {}, options)), all_pairs(job));
  cancel = true;
  EXPECT_TRUE(find_pair_cells(job, {}, options).cells.empty());
}

// An operand that is empty says nothing about what two others have in common.
TEST(PairCells, GridsOfTwoOperandsAndNothing) {
  test::Random random(504);
  std::vector<Operand> operands = tilings(random, 30);
  operands[1].translation = {25, 20, 0};
  const PairCells grid = find_coarse_cells(Job(operands), {}, 1);
  operands.insert(operands.begin(), test::operand_of(std::make_shared<LeafGeometry>()));
  const PairCells with = find_coarse_cells(Job(operands), {}, 1);
  ASSERT_EQ(with.cells.size(), grid.cells.size());
  for (size_t c = 0; c < grid.cells.size(); ++c) EXPECT_EQ(with.cells[c].lo, grid.cells[c].lo);
}

// What is apart along any axis is not looked at.
TEST(PairCells, NothingInCommonIsNoCell) {
  test::Random random(505);
  for (size_t k = 0; k < 3; ++k) {
    std::vector<Operand> operands = tilings(random, 30);
    operands[0].translation = operands[1].translation = {0, 0, 0};
    operands[1].translation[k] = 31;
    const Job job(operands);
    const PairCells grid = find_coarse_cells(job, {}, 1);
    EXPECT_TRUE(grid.cells.empty());
    EXPECT_EQ(grid.surface, job.polygons().size());
  }
}

// A long strip of small squares, and one polygon along all of it: too many cells to name.
TEST(PairCells, LongPolygonsAreTooLargeForAGrid) {
  std::vector<test::Loop> strip;
  for (int64_t x = 0; x < 3000; ++x) strip.push_back({{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}});
  const auto cells_beside = [&](int64_t length) {
    std::vector<Operand> operands{
        test::operand_of(test::make_leaf(strip)),
        test::operand_of(test::make_leaf({{{0, 0, 0}, {length, 0, 0}, {length, 1, 0}},
                                          {{0, 0, 0}, {3000, 0, 0}, {3000, 1, 0}}}))};
    if (length < 3000)
      operands[1].leaf = test::make_leaf({{{0, 0, 0}, {length, 0, 0}, {length, 1, 0}}});
    const Job job(operands);
    const PairCells grid = find_coarse_cells(job, {}, 1);
    EXPECT_EQ(visited(job, grid), all_pairs(job)) << length;
    return grid.cells.size();
  };
  EXPECT_GT(cells_beside(100), 1u);
  EXPECT_EQ(cells_beside(3000), 1u);

  // Nor when the long one is covered, which is looked at last.
  for (const int64_t length : {100, 3000}) {
    const std::vector<Operand> operands{
        test::operand_of(test::make_leaf(strip)),
        test::operand_of(test::make_leaf({{{0, 0, 0}, {length, 0, 0}, {length, 1, 0}}}))};
    const Job job(operands);
    std::vector<uint8_t> covered(job.polygons().size(), 0);
    covered.back() = 1;
    const PairCells grid = find_coarse_cells(job, covered, 1);
    EXPECT_EQ(visited(job, grid), all_pairs(job)) << length;
    EXPECT_EQ(grid.cells.size() == 1, length == 3000);
    EXPECT_EQ(grid.polygons.size() == job.polygons().size(), length == 3000);
  }
}

// Large polygons that are in all cells each.
TEST(PairCells, LargePolygonsAreNotPutIntoAGrid) {
  test::Random random(506);
  std::vector<Operand> operands;
  for (int i = 0; i < 60; ++i) {
    IVec3 lo{}, hi{};
    for (size_t k = 0; k < 3; ++k)
      lo[k] = random.integer(0, 9), hi[k] = 1000 - random.integer(0, 9);
    operands.push_back(test::operand_of(test::box_leaf(lo, hi)));
  }
  const Job job(operands);
  EXPECT_EQ(find_coarse_cells(job, {}, 1).cells.size(), 1u);
}

using Corners = std::vector<IVec3>;

IVec3 minus(const IVec3& a, const IVec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Exactly: some plane along a side or across two sides parts them.
bool are_apart(const Corners& s, const Corners& t) {
  std::vector<IVec3> sides_of_s, sides_of_t;
  for (size_t i = 0; i < 3; ++i) {
    sides_of_s.push_back(minus(s[(i + 1) % 3], s[i]));
    sides_of_t.push_back(minus(t[(i + 1) % 3], t[i]));
  }
  const IVec3 s_normal = test::cross_of(sides_of_s[0], sides_of_s[1]),
              t_normal = test::cross_of(sides_of_t[0], sides_of_t[1]);
  std::vector<IVec3> ways{s_normal, t_normal};
  for (size_t i = 0; i < 3; ++i) {
    ways.push_back(test::cross_of(sides_of_s[i], s_normal));
    ways.push_back(test::cross_of(sides_of_t[i], t_normal));
    for (const IVec3& side : sides_of_t) ways.push_back(test::cross_of(sides_of_s[i], side));
  }
  return std::any_of(ways.begin(), ways.end(), [&](const IVec3& way) {
    const auto range = [&](const Corners& x) {
      return std::minmax(
          {test::dot_of(x[0], way), test::dot_of(x[1], way), test::dot_of(x[2], way)});
    };
    return range(s).second < range(t).first || range(t).second < range(s).first;
  });
}

bool are_coplanar(const Corners& s, const Corners& t) {
  const IVec3 normal = test::cross_of(minus(s[1], s[0]), minus(s[2], s[0]));
  return std::all_of(t.begin(), t.end(),
                     [&](const IVec3& p) { return test::dot_of(normal, minus(p, s[0])) == 0; });
}

/// So many slivers and some squares, anywhere: not a closed surface, which nobody asks for.
test::Leaf random_faces(test::Random& random, size_t count) {
  const auto at = [&] { return random.integer(-100, 100); };
  std::vector<test::Loop> faces;
  while (faces.size() < count) {
    IVec3 a{at(), at(), at()}, b{at(), at(), at()}, c{a[0] + at() / 9, a[1] + at() / 9, a[2]};
    if (random.integer(0, 9) == 0) a[2] = b[2] = c[2] = 0;
    if (test::cross_of(minus(b, a), minus(c, a)) == IVec3{}) continue;
    faces.push_back({a, b, c});
    if (random.integer(0, 7) > 0) continue;
    const IVec3 d{b[0] + c[0] - a[0], b[1] + c[1] - a[1], b[2] + c[2] - a[2]};
    faces.back() = {a, b, d, c};
  }
  return test::make_leaf(faces);
}

/// Whether a triangle is clearly apart from another one along a direction of the latter: its
/// normal, or, if the triangle is not in its plane, what is across a side of it.
bool is_clearly_beyond(const Corners& s, const Corners& t) {
  const IVec3 normal = test::cross_of(minus(t[1], t[0]), minus(t[2], t[0]));
  for (size_t i = 0; i < 4; ++i) {
    const IVec3 way = i == 3 ? normal : test::cross_of(minus(t[(i + 1) % 3], t[i]), normal);
    const auto range = [&](const Corners& x) {
      return std::minmax(
          {test::dot_of(x[0], way), test::dot_of(x[1], way), test::dot_of(x[2], way)});
    };
    const auto gap = std::max(range(s).first - range(t).second, range(t).first - range(s).second);
    const auto length = std::sqrt(static_cast<double>(test::dot_of(way, way)));
    if (static_cast<double>(gap) > 0.01 * length) return true;
  }
  return false;
}

// In a crowd, triangles that are plainly apart are no pairs; all others are, once.
TEST(PairCells, CrowdsAreSifted) {
  size_t left_out = 0, apart = 0, coplanar = 0;
  for (int i = 0; i < 40; ++i) {
    test::Random random(8800 + i);
    const bool are_two = i % 2 == 0;
    const uint32_t crowd = are_two ? kCrowdOfTwo : kCrowd;
    // One fewer than a crowd, a crowd, and more.
    const auto count = static_cast<size_t>(i < 8    ? crowd - 1
                                           : i < 16 ? crowd
                                                    : crowd + random.integer(0, 90));
    const auto first = static_cast<size_t>(random.integer(10, 50));
    std::vector<Operand> operands{test::operand_of(random_faces(random, first))};
    if (!are_two) operands.push_back(test::operand_of(random_faces(random, first)));
    operands.push_back(test::operand_of(random_faces(random, count - operands.size() * first)));
    const Job job(operands);
    ASSERT_EQ(crowd_of(job), crowd);
    PairCells cells;
    for (uint32_t p = 0; p < count; ++p) cells.polygons.push_back(p);
    cells.cells.push_back({{-200, -200, -200}, {200, 200, 200}, 0, static_cast<uint32_t>(count)});
    EXPECT_EQ(visited(job, cells), all_pairs(job));  // without slabs all are
    add_slabs(job, cells);
    EXPECT_EQ(cells.slabs.empty(), count < crowd);
    const Pairs found = visited(job, cells), all = all_pairs(job);
    for (const auto& [pair, times] : found) EXPECT_TRUE(all.contains(pair) && times == 1);
    for (const auto& [pair, times] : all) {
      const auto corners = [&](uint32_t p) {
        Corners result;
        for (const uint32_t v : job.corners(job.polygons()[p])) {
          const auto& x = job.rounded(v);
          result.push_back(
              {static_cast<int64_t>(x[0]), static_cast<int64_t>(x[1]), static_cast<int64_t>(x[2])});
        }
        return result;
      };
      const Corners s = corners(pair.first), t = corners(pair.second);
      const bool may_be_out = count >= crowd && s.size() == 3 && t.size() == 3 &&
                              !are_coplanar(s, t) && are_apart(s, t);
      coplanar += count >= crowd && are_coplanar(s, t);
      EXPECT_TRUE(found.contains(pair) || may_be_out) << i;
      EXPECT_FALSE(found.contains(pair) && may_be_out && is_clearly_beyond(s, t)) << i;
      left_out += !found.contains(pair);
      apart += may_be_out;
    }
  }
  EXPECT_GT(left_out, apart / 2);
  EXPECT_GT(apart, 10000u);
  EXPECT_GT(coplanar, 100u);
}

}  // namespace
}  // namespace csgrun::pair_cells_test
