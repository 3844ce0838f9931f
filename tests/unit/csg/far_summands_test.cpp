// Minkowski sums with operands that are far larger than what is seen of the sum: they are those of
// operands that are just large enough, on the grid of what is seen.
#include <array>
#include <random>

#include <gtest/gtest.h>

#include "draw.h"
#include "test_meshes.h"

namespace csgrun::far_summands_test {
namespace {

using namespace testing;

NodePtr sum(std::vector<NodePtr> operands) { return Node::minkowski_sum(std::move(operands)); }

NodePtr everything(double length) {
  return box({-length, -length, -length}, {length, length, length});
}
NodePtr all_but(const NodePtr& part, double length) { return subtract({everything(length), part}); }

/// With the origin inside, around its middle or not.
NodePtr ball_of(Draw& draw) {
  switch (draw.below(3)) {
    case 0:
      return moved(0, 0, -0.25, prism(3 + draw.below(5), 0.375, 0.5));
    case 1:
      return box({-0.125, -0.25, -0.25}, {0.25, 0.25, 0.125});
    default:
      return turned(45, {0, 0, 1}, moved(0, 0, -0.25, prism(4, 0.5, 0.5)));
  }
}

NodePtr part_of(Draw& draw) {
  const NodePtr bar = moved(draw.upto(3), draw.upto(3), 0, prism(3 + draw.below(5), 1, 4));
  const NodePtr block = box({0, 0, 0}, {4 + draw.upto(1), 3, 2});
  return draw.below(2) == 0 ? unite({block, bar}) : subtract({block, bar});
}

/// Of operands that reach to `length`, with the same draws.
NodePtr sum_of(unsigned seed, double length) {
  Draw draw{std::mt19937(seed)};
  const NodePtr part = part_of(draw), ball = ball_of(draw);
  const NodePtr region = box({-1, -1, 0.5}, {4, 5, 3});
  const NodePtr inset = subtract({everything(length), sum({all_but(part, length), ball})});
  const NodePtr small = moved(draw.upto(4), draw.upto(3), draw.upto(2), cube(0.75));
  switch (seed % 9) {
    case 0:
      return inset;
    case 1:
      return intersect({region, sum({all_but(part, length), ball})});
    case 2:
      return subtract({region, sum({ball, all_but(part, length)})});
    case 3:
      return sum({inset, ball});
    case 4:
      return subtract({region, sum({unite({all_but(part, length), small}), ball})});
    case 5:
      return unite({moved(1, 2, 3, turned(90, {0, 0, 1}, inset)), moved(9, 0, 0, small)});
    case 6:
      return subtract({region, sum({all_but(part, length), ball, cube(0.25)})});
    case 7:
      return intersect({sum({box({-length, -length, -length}, {length, 1, length}), ball}), part});
    default:
      return turned(20, {1, 2, 3}, subtract({region, sum({all_but(part, length), ball})}));
  }
}

TEST(FarSummands, SumUpAsNearOnesDo) {
  constexpr double kNear = 64;  // these are not cut
  EvaluateOptions options;
  options.grid = *GridStep::parse("2^-19mm");
  int empty = 0;
  for (unsigned seed = 0; seed < 45; ++seed) {
    const SolidPtr truth = solid_of(sum_of(seed, kNear), options);
    empty += truth->empty();
    for (const double length : {3e3, 1e10}) {
      const SolidPtr far = solid_of(sum_of(seed, length), options);
      EXPECT_EQ(far->canonical_hash, truth->canonical_hash) << seed << ' ' << length;
      // On a grid that is chosen, which is not coarser by much.
      const SolidPtr chosen = solid_of(sum_of(seed, length));
      EXPECT_NEAR(chosen->measures.volume, truth->measures.volume, 1e-4) << seed << ' ' << length;
    }
  }
  EXPECT_LT(empty, 10);
}

// What is seen may be at the far end.
TEST(FarSummands, AreWholeWhereTheyAreSeen) {
  const NodePtr rounded = sum({everything(1000), box({-1, -1, -1}, {1, 1, 1})});
  EXPECT_EQ(solid_of(rounded)->measures.volume, 2002.0 * 2002 * 2002);
  // The ends of what is taken away stay where they are.
  const NodePtr rest = subtract({box({0, 0, 0}, {2000, 1, 1}), rounded});
  EXPECT_EQ(solid_of(rest)->measures.volume, 2000 - 1001);
  // A ball that is not around the origin moves its complement: a strip is left at the far end.
  const NodePtr ball = box({1, 1, 1}, {2, 2, 2});
  const NodePtr part = box({0, 0, 0}, {10, 10, 10});
  const NodePtr left = subtract({everything(1000), sum({all_but(part, 1000), ball})});
  const double strip = 2000.0 * 2000 * 2000 - 1999.0 * 1999 * 1999;
  EXPECT_EQ(solid_of(left)->measures.volume, strip + 9 * 9 * 9);
}

// Flat solids are summands, though nothing is inside of them.
TEST(FarSummands, AreAlsoFlat) {
  PolygonMesh sheet;  // aslant
  sheet.points = {
      {-1000, -1000, -1000}, {1000, -1000, 1000}, {1000, 1000, 1000}, {-1000, 1000, -1000}};
  sheet.add_face(std::array<uint32_t, 4>{0, 1, 2, 3});
  sheet.add_face(std::array<uint32_t, 4>{3, 2, 1, 0});
  const NodePtr plate = sum({leaf(sheet, FillRule::kNonZero), cube(1)});
  // The plane x = z, and what is up to 1 beyond along each axis: |x - z| < 1.
  const SolidPtr seen = solid_of(intersect({box({0, 0, 0}, {4, 4, 4}), plate}));
  EXPECT_NEAR(seen->measures.volume, 4 * (16 - 9), 1e-3);
}

// Operands that are empty do not count, which is not known before they are evaluated.
TEST(FarSummands, AreAlsoSeenWhereNothingMovesThem) {
  const NodePtr nothing = intersect({cube(1), moved(0.5, 0, 0, subtract({cube(1), cube(2)}))});
  const NodePtr away = moved(0, 0, 500, nothing);
  const NodePtr cut =
      intersect({box({0, 0, 0}, {1, 1, 1}), sum({everything(1e6), away, cube(0.5)})});
  EXPECT_EQ(solid_of(cut)->measures.volume, 1);
  const NodePtr gone =
      subtract({everything(300), sum({all_but(box({0, 0, 0}, {3, 3, 3}), 300), away})});
  EXPECT_EQ(solid_of(gone)->measures.volume, 27);
}

}  // namespace
}  // namespace csgrun::far_summands_test
