// Offset, hull, Minkowski sum, fill and resize against closed formulas, distances and Booleans.
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <csgrun/primitives/shape_operations.h>

#include "tests/unit/primitives/outlines.h"

namespace csgrun::shape_operations_test {
namespace {

using Loop = Shape2D::Loop;
using testing::box;
using testing::good;
using testing::outlines;

constexpr double kPi = 3.14159265358979323846;

Shape2D offset(const Shape2D& shape, double distance, OffsetJoin join, double fn = 32) {
  return good(offset_shape(shape, {distance, join, Facets{fn, 12, 2}}));
}

Shape2D minkowski(const Shape2D& a, const Shape2D& b) { return good(minkowski_of_shapes({a, b})); }

Shape2D moved(const Shape2D& shape, double x, double y, double factor = 1) {
  Affine map;
  map.m[0] = {factor, 0, 0, x};
  map.m[1] = {0, factor, 0, y};
  return good(shape.transformed(map));
}

/// A polygon around the origin, star-shaped, not convex.
Shape2D star(std::mt19937& random, int corners, double least, double most) {
  std::uniform_real_distribution<double> radius(least, most);
  Loop loop;
  for (int i = 0; i < corners; ++i) {
    const double r = radius(random), a = 2 * kPi * i / corners;
    loop.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return outlines({loop});
}

double distance_to(const Shape2D& shape, const glm::dvec2& q) {
  if (shape.contains(q)) return 0;
  double best = std::numeric_limits<double>::infinity();
  for (const Loop& loop : shape.loops()) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec2 a = loop[i], d = loop[(i + 1) % loop.size()] - a, aq = q - a;
      const double t =
          std::min(1.0, std::max(0.0, (d.x * aq.x + d.y * aq.y) / (d.x * d.x + d.y * d.y)));
      best = std::min(best, std::hypot(aq.x - t * d.x, aq.y - t * d.y));
    }
  }
  return best;
}

TEST(Offset, SquaresByFormula) {
  const Shape2D square = box(0, 0, 10, 10);
  const Shape2D sharp = offset(square, 2, OffsetJoin::kMitre);
  EXPECT_EQ(sharp.loops(), box(-2, -2, 12, 12).loops());
  EXPECT_EQ(offset(square, -2, OffsetJoin::kMitre).loops(), box(2, 2, 8, 8).loops());
  EXPECT_EQ(offset(square, -2, OffsetJoin::kRound).loops(), box(2, 2, 8, 8).loops());
  EXPECT_TRUE(offset(square, -5, OffsetJoin::kMitre).empty());
  // A square cut at 2 from its corners: legs of 2 (2 - sqrt 2) are lost of each corner of 14.
  const double leg = 2 * (2 - std::sqrt(2.0));
  const Shape2D cut = offset(square, 2, OffsetJoin::kChamfer);
  EXPECT_NEAR(cut.area(), 14 * 14 - 2 * leg * leg, 1e-6);
  EXPECT_EQ(cut.loops()[0].size(), 8u);
  // OpenSCAD's steps: 32 fragments, 8 for each corner.
  const Shape2D round = offset(square, 2, OffsetJoin::kRound);
  EXPECT_EQ(round.loops()[0].size(), 36u);
  EXPECT_NEAR(round.area(), 100 + 4 * 20 + 16 * 4 * std::sin(2 * kPi / 32), 1e-6);
  EXPECT_EQ(offset(square, 0, OffsetJoin::kRound).loops(), square.loops());
  EXPECT_TRUE(offset(Shape2D(), 3, OffsetJoin::kRound).empty());
}

TEST(Offset, ConvexPolygonsGrowByPerimeterAndFans) {
  for (const int n : {3, 5, 7, 12, 40}) {
    const Shape2D shape = good(make_circle(7, Facets{double(n), 12, 2}));
    for (const double r : {0.5, 3.0}) {
      // Each of the n corners turns by 360/n and is cut in ceil(48/n) steps, the last one shorter.
      const double turn = 2 * kPi / n, step = 2 * kPi / 48;
      const int whole = static_cast<int>(std::ceil(48.0 / n - 1e-9)) - 1;
      const double fan = r * r / 2 * (whole * std::sin(step) + std::sin(turn - whole * step));
      const double expected = shape.area() + r * perimeter_of(shape) + n * fan;
      EXPECT_NEAR(offset(shape, r, OffsetJoin::kRound, 48).area(), expected, 1e-6) << n;
      const double mitred = shape.area() + r * perimeter_of(shape) + n * r * r * std::tan(kPi / n);
      EXPECT_NEAR(offset(shape, r, OffsetJoin::kMitre).area(), mitred, 1e-6) << n;
      // And back: the mitred one shrinks to what it was.
      EXPECT_NEAR(offset(offset(shape, r, OffsetJoin::kMitre), -r, OffsetJoin::kMitre).area(),
                  shape.area(), 1e-6);
    }
  }
}

TEST(Offset, HolesShrinkAndCloseAndNecksPart) {
  const Shape2D ring =
      good(Shape2D::boolean(BooleanOp::kDifference, {box(-10, -10, 10, 10), box(-3, -3, 3, 3)}));
  EXPECT_NEAR(offset(ring, 1, OffsetJoin::kMitre).area(), 22 * 22 - 4 * 4, 1e-9);
  EXPECT_EQ(offset(ring, 3, OffsetJoin::kMitre).loops().size(), 1u);
  EXPECT_NEAR(offset(ring, 40, OffsetJoin::kMitre).area(), 100 * 100, 1e-9);
  EXPECT_NEAR(offset(ring, -1, OffsetJoin::kMitre).area(), 18 * 18 - 8 * 8, 1e-9);
  EXPECT_TRUE(offset(ring, -3.5, OffsetJoin::kMitre).empty());
  const Shape2D dumbbell = good(Shape2D::boolean(
      BooleanOp::kUnion, {box(0, 0, 4, 4), box(4, 1.5, 8, 2.5), box(8, 0, 12, 4)}));
  EXPECT_EQ(offset(dumbbell, -0.5, OffsetJoin::kRound).regions().size(), 2u);
  EXPECT_EQ(offset(dumbbell, -0.4, OffsetJoin::kRound).regions().size(), 1u);
}

TEST(Offset, AgreesWithDistances) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-16, 16);
  for (int run = 0; run < 12; ++run) {
    const Shape2D shape = good(Shape2D::boolean(
        BooleanOp::kDifference, {star(random, 14, 3, 10), star(random, 9, 0.5, 2.5)}));
    const double r = 0.3 + run * 0.3;
    const Shape2D grown = offset(shape, r, OffsetJoin::kRound, 64);
    const Shape2D shrunk = offset(shape, -r, OffsetJoin::kRound, 64);
    const Shape2D outside =
        good(Shape2D::boolean(BooleanOp::kDifference, {box(-40, -40, 40, 40), shape}));
    const double inner = r * std::cos(kPi / 64) - 1e-6;
    for (int i = 0; i < 300; ++i) {
      const glm::dvec2 q(place(random), place(random));
      const double to_shape = distance_to(shape, q), to_outside = distance_to(outside, q);
      if (to_shape < inner) {
        EXPECT_TRUE(grown.contains(q)) << run << " " << to_shape;
      }
      if (to_shape > r + 1e-6) {
        EXPECT_FALSE(grown.contains(q)) << run << " " << to_shape;
      }
      if (to_outside < inner) {
        EXPECT_FALSE(shrunk.contains(q)) << run << " " << to_outside;
      }
      if (to_outside > r + 1e-6) {
        EXPECT_TRUE(shrunk.contains(q)) << run << " " << to_outside;
      }
    }
  }
}

TEST(Offset, BadInputIsAnError) {
  const auto bad = offset_shape(box(0, 0, 1, 1), {std::nan(""), OffsetJoin::kRound, {}});
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().message, "offset: distance must be finite, got nan");
  EXPECT_FALSE(offset_shape(box(0, 0, 1, 1), {1e13, OffsetJoin::kMitre, {}}));
  EXPECT_FALSE(offset_shape(box(0, 0, 1, 1), {1, OffsetJoin::kRound, Facets{1e9, 12, 2}}));
}

TEST(Minkowski2D, ConvexSumsByFormula) {
  EXPECT_EQ(minkowski(box(0, 0, 10, 10), box(-1, 0, 1, 4)).loops(), box(-1, 0, 11, 14).loops());
  // A + B + the mixed area, which is half the perimeter's support: here perimeter times radius.
  const Shape2D triangle = outlines({{{0, 0}, {9, 0}, {0, 7}}});
  const Shape2D disc = good(make_circle(1, Facets{400, 12, 2}));
  EXPECT_NEAR(minkowski(triangle, disc).area(), triangle.area() + perimeter_of(triangle) + kPi,
              2e-3);
  EXPECT_EQ(minkowski(triangle, disc).loops(), minkowski(disc, triangle).loops());
  // Edges that are parallel in both become one.
  EXPECT_EQ(minkowski(triangle, triangle).loops(), moved(triangle, 0, 0, 2).loops());
}

TEST(Minkowski2D, SumsOfRectanglesAreUnionsOfSums) {
  const Shape2D l = good(Shape2D::boolean(BooleanOp::kUnion, {box(0, 0, 10, 5), box(0, 0, 5, 10)}));
  EXPECT_NEAR(minkowski(l, l).area(), 325, 1e-9);  // 20x10, 15x15 and 10x20 from one corner
  EXPECT_NEAR(minkowski(l, box(0, 0, 1, 1)).area(), 96, 1e-9);
  const Shape2D ring =
      good(Shape2D::boolean(BooleanOp::kDifference, {box(-5, -5, 5, 5), box(-3, -3, 3, 3)}));
  EXPECT_NEAR(minkowski(ring, box(-1, -1, 1, 1)).area(), 12 * 12 - 4 * 4, 1e-9);
  EXPECT_NEAR(minkowski(ring, ring).area(), 20 * 20, 1e-9);
  // A part of one piece swept over another that lies apart.
  const Shape2D two =
      good(Shape2D::boolean(BooleanOp::kUnion, {box(0, 0, 1, 1), box(9, 0, 10, 1)}));
  EXPECT_NEAR(minkowski(two, two).area(), 2 * 2 * 3, 1e-9);
  EXPECT_NEAR(minkowski(two, good(Shape2D::boolean(BooleanOp::kUnion, {l, ring}))).loops().empty(),
              0, 0);
}

TEST(Minkowski2D, AgreesWithIntersections) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-14, 14);
  for (int run = 0; run < 12; ++run) {
    // Half of the time there is no hole.
    const Shape2D outline = star(random, 11, 2, 8), hole = star(random, 5, 0.3, 1.8);
    const Shape2D a =
        run < 6 ? good(Shape2D::boolean(BooleanOp::kDifference, {outline, hole})) : outline;
    const Shape2D b = moved(star(random, run % 2 == 0 ? 8 : 3, 0.5, 4), 1.25, -0.5);
    const Shape2D total = minkowski(a, b);
    const Shape2D turned = moved(b, 0, 0, -1);
    for (int i = 0; i < 120; ++i) {
      const glm::dvec2 q(place(random), place(random));
      const Shape2D common =
          good(Shape2D::boolean(BooleanOp::kIntersection, {a, moved(turned, q.x, q.y)}));
      if (common.area() > 1e-3) {
        EXPECT_TRUE(total.contains(q)) << run << " " << common.area();
      }
      if (common.empty()) {
        EXPECT_FALSE(total.contains(q)) << run;
      }
    }
  }
}

/// A random shape of unit squares: many edges run the same way, and corners touch.
Shape2D random_squares(std::mt19937& random, int size, int count) {
  std::vector<Shape2D> squares;
  for (int i = 0; i < count; ++i) {
    const auto x = static_cast<double>(random() % static_cast<unsigned>(size)),
               y = static_cast<double>(random() % static_cast<unsigned>(size));
    squares.push_back(box(x, y, x + 1, y + 1));
  }
  return good(Shape2D::boolean(BooleanOp::kUnion, squares));
}

TEST(Minkowski2D, SumsOfSquaresAreUnionsOfSums) {
  std::mt19937 random(29);
  int without_holes = 0;
  for (int run = 0; run < 60; ++run) {
    std::vector<Shape2D> parts;
    const Shape2D a = random_squares(random, 5, 9), b = random_squares(random, 4, 5);
    without_holes += a.loops().size() == a.regions().size();
    // Each square of one with the other, which is convex then.
    for (int x = 0; x < 4; ++x) {
      for (int y = 0; y < 4; ++y) {
        if (b.contains({x + 0.5, y + 0.5})) parts.push_back(minkowski(a, box(x, y, x + 1, y + 1)));
      }
    }
    const Shape2D total = minkowski(a, b);
    EXPECT_EQ(total.loops(), good(Shape2D::boolean(BooleanOp::kUnion, parts)).loops()) << run;
    EXPECT_EQ(minkowski(b, a).loops(), total.loops()) << run;
  }
  EXPECT_GT(without_holes, 30);
}

// Each edge of one swept along each edge of the other would make millions of crossings.
TEST(Minkowski2D, OfManyCornersIsTheBoundaryOfAFewCurves) {
  std::mt19937 random(5);
  const Shape2D a = star(random, 61, 5, 8), b = star(random, 51, 3, 5);
  const Shape2D total = minkowski(a, b);
  const Shape2D hull = good(hull_of_shapes({total}));
  EXPECT_EQ(hull.loops(), minkowski(good(hull_of_shapes({a})), good(hull_of_shapes({b}))).loops());
  EXPECT_LT(total.area(), hull.area());
}

// Holes that touch one another and the outline, or see few corners, and islands in them.
TEST(Minkowski2D, HolesOfAllKindsAreUnionsOfSums) {
  std::mt19937 random(31);
  size_t holes = 0;
  for (int run = 0; run < 60; ++run) {
    const auto plate = good(
        Shape2D::boolean(BooleanOp::kDifference, {box(0, 0, 9, 9), random_squares(random, 9, 26)}));
    const Shape2D a = good(Shape2D::boolean(BooleanOp::kUnion, {plate, box(-1, -1, 1, 1)}));
    const Shape2D b = random_squares(random, 3, 4);
    holes += a.loops().size() - a.regions().size();
    std::vector<Shape2D> parts;
    for (int x = 0; x < 3; ++x) {
      for (int y = 0; y < 3; ++y) {
        if (b.contains({x + 0.5, y + 0.5})) parts.push_back(minkowski(a, box(x, y, x + 1, y + 1)));
      }
    }
    EXPECT_EQ(minkowski(a, b).loops(), good(Shape2D::boolean(BooleanOp::kUnion, parts)).loops())
        << run;
  }
  EXPECT_GT(holes, 100u);
}

TEST(Minkowski2D, EmptyOperandsCountForNothing) {
  const Shape2D square = box(0, 0, 3, 3);
  EXPECT_EQ(good(minkowski_of_shapes({Shape2D(), square, Shape2D()})).loops(), square.loops());
  EXPECT_TRUE(good(minkowski_of_shapes({})).empty());
  EXPECT_EQ(good(minkowski_of_shapes({square, square, square})).loops(), box(0, 0, 9, 9).loops());
}

TEST(Hull2D, IsTheSmallestConvexShape) {
  EXPECT_NEAR(good(hull_of_shapes({box(0, 0, 1, 1), box(5, 5, 6, 6)})).area(), 1 + 2 * 5, 1e-9);
  EXPECT_EQ(good(hull_of_shapes({box(0, 0, 1, 1), box(1, 0, 2, 1), Shape2D()})).loops(),
            box(0, 0, 2, 1).loops());
  EXPECT_TRUE(good(hull_of_shapes({})).empty());
  std::mt19937 random(3);
  for (int run = 0; run < 20; ++run) {
    const Shape2D a = star(random, 13, 1, 9), b = moved(star(random, 7, 1, 4), 8, 3);
    const Shape2D hull = good(hull_of_shapes({a, b}));
    ASSERT_EQ(hull.loops().size(), 1u);
    const Loop& loop = hull.loops()[0];
    for (size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec2 p = loop[i], d = loop[(i + 1) % loop.size()] - p;
      size_t on_line = 0;
      for (const Shape2D& shape : {a, b}) {
        for (const glm::dvec2& q : shape.loops()[0]) {
          const double side = d.x * (q.y - p.y) - d.y * (q.x - p.x);
          EXPECT_GE(side, -1e-6);
          if (std::hypot(q.x - p.x, q.y - p.y) < 1e-7) ++on_line;
        }
      }
      EXPECT_EQ(on_line, 1u);  // its corners are corners of theirs
    }
  }
}

TEST(Fill, DropsHolesAndWhatIsInThem) {
  const Shape2D nested = outlines({box(-9, -9, 9, 9).loops()[0], box(-7, -7, 7, 7).loops()[0],
                                   box(-5, -5, 5, 5).loops()[0], box(20, 0, 21, 1).loops()[0]});
  ASSERT_EQ(nested.loops().size(), 4u);
  const Shape2D filled = good(fill_shape(nested));
  EXPECT_EQ(filled.loops().size(), 2u);
  EXPECT_NEAR(filled.area(), 18 * 18 + 1, 1e-9);
}

TEST(Resize, FollowsOpenScad) {
  using Pair = std::array<double, 2>;
  EXPECT_EQ(resize_factors<2>({10, 20}, {30, 10}, {false, false}), (Pair{3, 0.5}));
  EXPECT_EQ(resize_factors<2>({10, 20}, {30, 0}, {false, false}), (Pair{3, 1}));
  EXPECT_EQ(resize_factors<2>({10, 20}, {30, 0}, {false, true}), (Pair{3, 3}));
  EXPECT_EQ(resize_factors<2>({10, 20}, {0, 5}, {true, true}), (Pair{0.25, 0.25}));
  EXPECT_EQ(resize_factors<2>({10, 20}, {0, 0}, {true, true}), (Pair{1, 1}));
}

TEST(Pieces, AreTheRegions) {
  const Shape2D two = outlines(
      {box(-9, -9, 9, 9).loops()[0], box(-7, -7, 7, 7).loops()[0], box(-5, -5, 5, 5).loops()[0]});
  const auto pieces = pieces_of_shape(two);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_NEAR(pieces[0].area(), 18 * 18 - 14 * 14, 1e-9);
  EXPECT_NEAR(pieces[1].area(), 100, 1e-9);
  EXPECT_NEAR(perimeter_of(two), 4 * (18 + 14 + 10), 1e-9);
}

TEST(RoundedSquare, HasQuartersAtItsCorners) {
  const Shape2D shape = good(make_rounded_square({10, 6}, 2, Facets{16, 12, 2}, {true, false}));
  EXPECT_EQ(shape.loops()[0].size(), 20u);
  EXPECT_NEAR(shape.area(), 60 - 16 + 8 * 4 * std::sin(2 * kPi / 16), 1e-12);
  EXPECT_EQ(shape.bounds()[0], glm::dvec2(-5, 0));
  EXPECT_EQ(shape.bounds()[1], glm::dvec2(5, 6));
  EXPECT_EQ(good(make_rounded_square({4, 4}, 2, Facets{8, 12, 2})).loops()[0].size(), 8u);
  const auto bad = make_rounded_square({4, 3}, 2, Facets{});
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().message, "square: r must be at most half of the shorter side, 1.5, got 2");
}

}  // namespace
}  // namespace csgrun::shape_operations_test
