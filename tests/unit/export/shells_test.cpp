// Surfaces inside out or on the wrong side of others are found, and no others.
#include <gtest/gtest.h>

#include "export/defects.h"
#include "tests/unit/export/hand_made.h"

namespace csgrun::testing::shells_test {
namespace {

constexpr std::array<std::array<int, 4>, 6> kSides{
    {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}};

/// A box that looks inwards.
void add_void(HandMade& made, const glm::dvec3& low, const glm::dvec3& high) {
  std::array<uint32_t, 8> v{};
  for (uint32_t i = 0; i < 8; ++i)
    v[i] = made.vertex(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  for (const auto& s : kSides) {
    made.face({v[static_cast<size_t>(s[3])], v[static_cast<size_t>(s[2])],
               v[static_cast<size_t>(s[1])], v[static_cast<size_t>(s[0])]});
  }
}

/// A box whose top has a vertex in its middle.
void add_box_with_middle(HandMade& made, double size) {
  std::array<uint32_t, 8> v{};
  for (uint32_t i = 0; i < 8; ++i)
    v[i] = made.vertex(i & 1 ? size : -size, i & 2 ? size : -size, i & 4 ? 0 : -size);
  const uint32_t m = made.vertex(0, 0, 0);
  for (size_t s = 0; s < 6; ++s) {
    std::vector<uint32_t> loop;
    for (const int i : kSides[s]) loop.push_back(v[static_cast<size_t>(i)]);
    if (s == 1) {
      made.face({loop}, {{loop[0], loop[1], m},
                         {loop[1], loop[2], m},
                         {loop[2], loop[3], m},
                         {loop[3], loop[0], m}});
    } else {
      made.face(loop);
    }
  }
}

Defects defects_of(const HandMade& made) {
  const SolidPtr solid = made.share();
  const auto mesh = round_part(*solid, {}, Precision::kFloat, false);
  EXPECT_TRUE(mesh);
  return find_defects(*mesh, face_directions(*solid, {}));
}

void expect_right(const HandMade& made) {
  const Defects defects = defects_of(made);
  EXPECT_TRUE(defects.none()) << defects.crossings.size() << " crossings, "
                              << defects.inverted.size() << " inverted";
}

TEST(Shells, ThinTetrahedronThatRoundingTurnsInsideOut) {
  // Thinner than the step of floats there, 1/16.
  const glm::dvec3 a{1000009.105408, 1000008.941568, 999991.115776},
      b{999991.7056, 1000006.713344, 1000004.714496},
      c{1000003.403776, 999996.162048, 1000002.125824},
      d{1000001.404928, 1000003.960832, 999999.340544};
  HandMade made;
  made.tetrahedron({a, c, b, d});
  const Defects defects = defects_of(made);
  EXPECT_TRUE(defects.crossings.empty() && defects.degenerate.empty() && defects.flipped.empty());
  EXPECT_EQ(defects.inverted.size(), 1u);
}

TEST(Shells, VoidsBelongInBodiesAndBodiesOutside) {
  HandMade nested;
  nested.box({0, 0, 0}, {20, 20, 20});
  add_void(nested, {1, 1, 1}, {18, 18, 18});
  nested.box({2, 2, 2}, {16, 16, 16});
  add_void(nested, {3, 3, 3}, {14, 14, 14});
  nested.box({4, 4, 4}, {6, 6, 6});
  nested.box({8, 8, 8}, {9, 9, 9});
  expect_right(nested);

  HandMade popped;  // through the wall and above it
  popped.box({0, 0, 0}, {20, 20, 20});
  add_void(popped, {3, 3, 21}, {4, 4, 22});
  EXPECT_EQ(defects_of(popped).inverted, (std::vector<uint32_t>{12}));

  HandMade swallowed;  // a body in a wall, and a void in that
  swallowed.box({0, 0, 0}, {20, 20, 20});
  swallowed.box({2, 2, 2}, {16, 16, 16});
  add_void(swallowed, {3, 3, 3}, {14, 14, 14});
  EXPECT_EQ(defects_of(swallowed).inverted, (std::vector<uint32_t>{12, 24}));

  HandMade twice;  // a void in a void
  twice.box({0, 0, 0}, {20, 20, 20});
  add_void(twice, {2, 2, 2}, {16, 16, 16});
  add_void(twice, {3, 3, 3}, {14, 14, 14});
  EXPECT_EQ(defects_of(twice).inverted, (std::vector<uint32_t>{24}));
}

TEST(Shells, ThatTouchAreRight) {
  HandMade at_an_edge;
  at_an_edge.box({0, 0, 0}, {1, 1, 1});
  at_an_edge.box({-1, -1, 0}, {0, 0, 1});
  expect_right(at_an_edge);
  HandMade at_a_corner;
  at_a_corner.box({0, 0, 0}, {1, 1, 1});
  at_a_corner.box({-1, -1, -1}, {0, 0, 0});
  expect_right(at_a_corner);
  // Upon the highest vertex of the one below, around the way up and leaning to each side; and
  // hanging below the top within a void.
  for (const double lean : {-3.0, 0.0, 3.0}) {
    HandMade standing;
    add_box_with_middle(standing, 8);
    standing.tetrahedron({{{lean - 1, -1, 4}, {lean - 1, 3, 4}, {lean + 3, -1, 4}, {0, 0, 0}}});
    EXPECT_FALSE(defects_of(standing).inverted.empty());  // this one looks inwards
    HandMade right;
    add_box_with_middle(right, 8);
    right.tetrahedron({{{lean - 1, -1, 4}, {lean + 3, -1, 4}, {lean - 1, 3, 4}, {0, 0, 0}}});
    expect_right(right);
    HandMade pocket;
    add_box_with_middle(pocket, 8);
    pocket.tetrahedron({{{lean - 1, -1, -4}, {lean + 3, -1, -4}, {lean - 1, 3, -4}, {0, 0, 0}}});
    expect_right(pocket);
    HandMade buried;
    add_box_with_middle(buried, 8);
    buried.tetrahedron({{{lean - 1, -1, -4}, {lean - 1, 3, -4}, {lean + 3, -1, -4}, {0, 0, 0}}});
    EXPECT_EQ(defects_of(buried).inverted.size(), 1u);
  }
}

TEST(Shells, SheetsThatMeetInAnEdgeAreLookedAtOneByOne) {
  // Four triangles meet in the edge that two boxes share; the second one is inside out.
  HandMade made;
  made.box({0, 0, 0}, {1, 1, 1});
  add_void(made, {-1, -1, 0}, {0, 0, 1});
  EXPECT_EQ(defects_of(made).inverted, (std::vector<uint32_t>{12}));
}

TEST(Shells, AreNotLookedForWhereSomethingCrosses) {
  HandMade made;
  made.box({0, 0, 0}, {2, 2, 2});
  add_void(made, {1, 1, 1}, {3, 3, 3});
  const Defects defects = defects_of(made);
  EXPECT_FALSE(defects.crossings.empty());
  EXPECT_TRUE(defects.inverted.empty());
}

}  // namespace
}  // namespace csgrun::testing::shells_test
