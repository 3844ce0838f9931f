// Minimal cases of faults that were found once.
#include <gtest/gtest.h>

#include "tests/support/exact_measures.h"
#include "tests/support/kernel_case.h"

namespace csgrun {
namespace {

using namespace test;  // NOLINT: a test

// Two notches meet in the point (2, 2) of a straight edge: the wedge between them has a corner
// there, the rest of the face has none (its two edges lie on one line, and do not name a point).
TEST(Regress, AStraightAngleWhereWedgesTouchIsNoCorner) {
  const std::vector<Operand> leaves{
      operand_of(box_leaf({0, 0, 0}, {4, 4, 4})),
      operand_of(make_leaf(prism_loops({{-2, 2}, {2, 2}, {0, 6}}, -1, 5))),
      operand_of(make_leaf(prism_loops({{2, 2}, {6, 2}, {4, 6}}, -1, 5)))};
  const auto r = evaluate(less({leaf(0), leaf(1), leaf(2)}), leaves);
  ASSERT_TRUE(r) << text(r.error());
  EXPECT_EQ(fault_in(**r), "");
  EXPECT_EQ(volume(**r), 4 * (8 + 2));  // half the square, and a triangle of base 2 and height 2
}

}  // namespace
}  // namespace csgrun
