// Minimal cases of faults that were found once.
#include <gtest/gtest.h>

#include "tests/support/exact_measures.h"
#include "tests/support/kernel_checks.h"
#include "tests/support/random_solids.h"

namespace csgrun::regress_test {
namespace {

using namespace test;  // NOLINT: a test

// Two notches meet in the point (2, 2) of a straight edge: the wedge between them has a corner
// there, the rest of the face has none (its two edges lie on one line, and do not name a point).
TEST(Regress, AStraightAngleWhereWedgesTouchIsNoCorner) {
  for (const bool reversed : {false, true}) {  // another first plane, another way of cutting
    auto left = prism_loops({{-2, 2}, {2, 2}, {0, 6}}, -1, 5);
    if (reversed) std::reverse(left.begin(), left.end());
    const std::vector<Operand> leaves{
        operand_of(box_leaf({0, 0, 0}, {4, 4, 4})), operand_of(make_leaf(left)),
        operand_of(make_leaf(prism_loops({{2, 2}, {6, 2}, {4, 6}}, -1, 5)))};
    const auto r = evaluate(less({leaf(0), leaf(1), leaf(2)}), leaves);
    ASSERT_TRUE(r) << text(r.error());
    ASSERT_EQ(fault_in(**r), "");
    EXPECT_EQ(volume(**r), 4 * (8 + 2));  // half the square, and a triangle of base 2 and height 2
    const auto solid = present(**r, test_context());
    ASSERT_TRUE(solid) << text(solid.error());
    EXPECT_EQ(fault_in(**solid, **r), "");
  }
}

// Two blocks touch along an edge and are one solid above and below it: both ends of the edge have
// one fan each, and the edge must not be there twice between the same two vertices.
TEST(Regress, WedgesThatTouchAndAreConnectedAroundBothEnds) {
  const std::vector<Operand> leaves{
      operand_of(box_leaf({0, 0, 1}, {2, 2, 2})), operand_of(box_leaf({-2, -2, 1}, {0, 0, 2})),
      operand_of(box_leaf({-2, -2, 2}, {2, 2, 3})), operand_of(box_leaf({-2, -2, 0}, {2, 2, 1}))};
  const auto r = evaluate(join({leaf(0), leaf(1), leaf(2), leaf(3)}), leaves);
  ASSERT_TRUE(r) << text(r.error());
  const auto solid = present(**r, test_context());
  ASSERT_TRUE(solid) << text(solid.error());
  EXPECT_EQ(fault_in(**solid, **r), "");
  EXPECT_EQ((*solid)->measures.components, 1);
}

// Three tetrahedra of the six around a cube's diagonal: three planes pass through the diagonal, and
// each is one face on both sides of it. Triangulation may put an edge there for some of them only.
TEST(Regress, FacesThatPassThroughALineWhereWedgesTouch) {
  const auto tetrahedron = [](const IVec3& a, const IVec3& b) {
    auto loops = hull_loops({{0, 0, 0}, {2, 2, 2}, a, b});
    return loops;
  };
  std::vector<Loop> all;
  for (const auto& [a, b] : {std::pair<IVec3, IVec3>{{2, 0, 2}, {2, 0, 0}},
                             {{2, 2, 0}, {0, 2, 0}},
                             {{0, 2, 2}, {0, 0, 2}}}) {
    for (const Loop& l : tetrahedron(a, b)) all.push_back(l);
  }
  std::array<int, 3> axes{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      GridMap map;
      for (int k = 0; k < 3; ++k) {
        map.rows[k] = {0, 0, 0};
        map.rows[k][axes[k]] = signs >> k & 1 ? -1 : 1;
      }
      const auto r = evaluate(leaf(0), {operand_of(make_leaf(mapped(all, map)))});
      ASSERT_TRUE(r) << text(r.error());
      EXPECT_EQ(fault_in(**r), "");
      const auto solid = present(**r, test_context());
      ASSERT_TRUE(solid) << text(solid.error());
      EXPECT_EQ(fault_in(**solid, **r), "");
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
}

// A symmetric difference turns a part of a facet over, another one turns it back: the facet is
// whole again, also when the first was materialised.
TEST(Regress, AFacetCutByASymmetricDifferenceIsMadeWholeByAnother) {
  const std::vector<Operand> leaves{operand_of(make_leaf(box_loops({0, 0, 0}, {4, 4, 4}), true)),
                                    operand_of(box_leaf({2, 1, 1}, {6, 3, 3})),
                                    operand_of(box_leaf({2, 1, 1}, {6, 3, 3}))};
  const Tree tree = differ({differ({leaf(0), leaf(1)}), leaf(2)});
  const auto flat = evaluate(tree, leaves);
  const auto nested = evaluate(tree, leaves, {}, [](const Tree&) { return true; });
  ASSERT_TRUE(flat && nested);
  EXPECT_EQ((*flat)->faces.size(), 6u);
  for (const auto& f : (*flat)->faces) EXPECT_TRUE(f.whole);
  EXPECT_EQ(difference_between(**flat, **nested), "");
}

// Wedges touch a face from behind along lines that go on beyond it, past a place where its rim has
// no vertex: the face is cut along the parts inside only.
TEST(Regress, ContactsThatGoOnBeyondAFace) {
  std::vector<Loop> all;
  for (const auto& t : {std::array<IVec3, 4>{{{0, 1, 1}, {1, 1, 1}, {1, 2, 1}, {1, 2, 2}}},
                        {{{0, 1, 1}, {0, 1, 2}, {1, 1, 2}, {1, 2, 2}}},
                        {{{1, 1, 1}, {1, 1, 2}, {2, 2, 2}, {1, 2, 2}}},
                        {{{0, 2, 1}, {0, 2, 2}, {1, 2, 2}, {1, 3, 2}}},
                        {{{1, 2, 1}, {1, 2, 2}, {2, 2, 2}, {2, 3, 2}}}}) {
    for (const Loop& l : hull_loops({t.begin(), t.end()})) all.push_back(l);
  }
  // Faces that two tetrahedra share are inside.
  std::map<std::set<IVec3>, std::vector<Loop>> by_corners;
  for (const Loop& l : all) by_corners[{l.begin(), l.end()}].push_back(l);
  std::vector<Loop> outer;
  for (const auto& [corners, loops] : by_corners) {
    if (loops.size() == 1) outer.push_back(loops[0]);
  }
  const auto r = evaluate(leaf(0), {operand_of(make_leaf(outer))});
  ASSERT_TRUE(r) << text(r.error());
  ASSERT_EQ(fault_in(**r), "");
  const auto solid = present(**r, test_context());
  ASSERT_TRUE(solid) << text(solid.error());
  EXPECT_EQ(fault_in(**solid, **r), "");
}

}  // namespace
}  // namespace csgrun::regress_test
