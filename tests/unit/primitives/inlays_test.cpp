// What is cut out of a shape fits into it again, without a crack: against the union of both.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <csgrun/primitives/shape2d.h>

#include "tests/unit/primitives/outlines.h"

namespace csgrun::inlays_test {
namespace {

using testing::good;
using testing::length_of;
using testing::outlines;

class Inlays : public ::testing::Test {
 protected:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  /// A star or a polygon somewhere near the origin.
  Shape2D shape() {
    const int corners = static_cast<int>(between(3, 9));
    const double turn = between(0, 7), x = between(-3, 3), y = between(-3, 3);
    Shape2D::Loop loop;
    for (int c = 0; c < corners; ++c) {
      const double angle = turn + 6.283185307179586 * c / corners, radius = between(1, 6);
      loop.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle));
    }
    return outlines({loop});
  }
  static Shape2D of_two(BooleanOp op, const Shape2D& a, const Shape2D& b) {
    return good(Shape2D::boolean(op, {a, b}));
  }
  static void expect_same(const Shape2D& fitted, const Shape2D& expected, int i) {
    EXPECT_EQ(fitted.loops().size(), expected.loops().size()) << "case " << i;
    EXPECT_NEAR(length_of(fitted), length_of(expected), 1e-6) << "case " << i;
    EXPECT_NEAR(fitted.area(), expected.area(), 1e-6) << "case " << i;
  }

 private:
  std::mt19937 random_{47};
};

TEST_F(Inlays, FitIntoWhatTheyWereCutFrom) {
  for (int i = 0; i < 200; ++i) {
    const Shape2D a = shape(), b = shape();
    const Shape2D both = of_two(BooleanOp::kUnion, a, b);
    const Shape2D less = of_two(BooleanOp::kDifference, a, b);
    const Shape2D common = of_two(BooleanOp::kIntersection, a, b);
    expect_same(of_two(BooleanOp::kUnion, less, b), both, i);
    expect_same(of_two(BooleanOp::kUnion, less, common), a, i);
    EXPECT_TRUE(of_two(BooleanOp::kIntersection, less, b).empty()) << "case " << i;
    // All parts at once, some of them twice.
    expect_same(good(Shape2D::boolean(BooleanOp::kUnion, {less, b, common, less, b})), both, i);
  }
}

// Maps that round corners and edges anew.
TEST_F(Inlays, FitWhenBothWereMapped) {
  for (int i = 0; i < 200; ++i) {
    Affine map;
    map.m[0] = {between(0.5, 2), i % 2 ? between(-1, 1) : 0, 0, between(-2, 2)};
    map.m[1] = {0, between(0.5, 2), 0, between(-2, 2)};
    const Shape2D a = shape(), b = shape();
    const Shape2D less = good(of_two(BooleanOp::kDifference, a, b).transformed(map));
    const Shape2D mapped = good(b.transformed(map));
    expect_same(of_two(BooleanOp::kUnion, less, mapped),
                good(of_two(BooleanOp::kUnion, a, b).transformed(map)), i);
  }
}

}  // namespace
}  // namespace csgrun::inlays_test
