// Long triangles aslant: the results that they have a part in, against those of cells.
#include "engine/bsp/wide_triangles.h"

#include <array>

#include <gtest/gtest.h>

#include "engine/bsp/find_contacts.h"
#include "tests/support/kernel_case.h"
#include "tests/support/named_results.h"

namespace csgrun::wide_triangles_test {
namespace {

using namespace test;  // NOLINT: a test

/// A rotation, 15 times as large.
Loop aslant(const Loop& loop) {
  constexpr std::array<IVec3, 3> kRows{{{2, 10, 11}, {14, -5, 2}, {5, 10, -10}}};
  Loop turned;
  for (const IVec3& p : loop) {
    IVec3 q{};
    for (size_t r = 0; r < 3; ++r) {
      q[r] = kRows[r][0] * p[0] + kRows[r][1] * p[1] + kRows[r][2] * p[2];
    }
    turned.push_back(q);
  }
  return turned;
}

/// A cube of so many slices along y, each of which has long triangles around it.
std::vector<Loop> sliced_cube(int64_t side, int64_t slices) {
  const auto at = [&](int64_t x, int64_t y, int64_t z) { return IVec3{x * side, y, z * side}; };
  std::vector<Loop> loops;
  for (int64_t i = 0; i < slices; ++i) {
    const int64_t y = side * i / slices, next = side * (i + 1) / slices;
    add_quad(loops, at(0, y, 0), at(0, next, 0), at(1, next, 0), at(1, y, 0), i % 2 == 0);
    add_quad(loops, at(0, y, 1), at(1, y, 1), at(1, next, 1), at(0, next, 1), i % 2 == 0);
    add_quad(loops, at(0, y, 0), at(0, y, 1), at(0, next, 1), at(0, next, 0), i % 3 == 0);
    add_quad(loops, at(1, y, 0), at(1, next, 0), at(1, next, 1), at(1, y, 1), i % 3 == 0);
  }
  add_quad(loops, at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1), false);
  add_quad(loops, at(0, side, 0), at(0, side, 1), at(1, side, 1), at(1, side, 0), false);
  return loops;
}

// A cube of long triangles and one of many small ones, which have planes, edges and corners
// in common or pass through one another.
TEST(WideTriangles, GiveWhatCellsGive) {
  Random random(6301);
  size_t wide_ones = 0, coplanar = 0, crossing = 0;
  for (int round = 0; round < 24; ++round) {
    std::vector<Operand> operands;
    for (const bool is_sliced : {round % 2 == 0, round % 2 != 0}) {
      std::vector<Loop> loops;
      for (const Loop& loop :
           is_sliced ? sliced_cube(24, 12) : tiled_box(random, {0, 0, 0}, 14, 2)) {
        loops.push_back(aslant(loop));
      }
      IVec3 at{};
      for (int64_t& x : at) x = random.integer(-6, 6) * (round % 4 < 2 ? 2 : 3);
      operands.push_back(placed(leaf_of_triangles(loops), aslant({at})[0]));
      operands.back().first_source = static_cast<uint32_t>(operands.size());
    }
    Job job(operands);
    wide_ones += WideTriangles(job).list().size();
    EvaluateStats stats;
    for (const Contact& c : find_contacts(job, {}, {}, stats).contacts) {
      ++(c.is_coplanar ? coplanar : crossing);
    }
    const Tree tree = random_binary_tree(random, 0, 2);
    const Pair both = evaluate_both(tree, operands);
    ASSERT_NO_FATAL_FAILURE(expect_one_value(both, tree.text()));
    KernelOptions options;
    options.whole_faces = false;
    const auto by_cells = evaluate(tree, operands, options);
    ASSERT_TRUE(by_cells) << text(by_cells.error());
    ASSERT_EQ(difference_between(*both.spelled, **by_cells), "") << round << tree.text();
  }
  EXPECT_GT(wide_ones, 100u);
  EXPECT_GT(coplanar, 100u);
  EXPECT_GT(crossing, 1000u);
}

}  // namespace
}  // namespace csgrun::wide_triangles_test
