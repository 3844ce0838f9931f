#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <csgrun/primitives/shape2d.h>

#include "primitives/shape2d/grid2d.h"
#include "tests/unit/primitives/outlines.h"

namespace csgrun::shape2d_test {
namespace {

using Loop = Shape2D::Loop;
using testing::box;
using testing::outlines;

Shape2D boolean(BooleanOp op, const std::vector<Shape2D>& operands) {
  auto r = Shape2D::boolean(op, operands);
  EXPECT_TRUE(r) << (r ? "" : r.error().message);
  return r ? *r : Shape2D();
}

/// What the header promises of every shape: simple loops, no crossings, touching only in vertices,
/// directions, order, and holes that belong to their region. Quadratic on purpose.
void expect_clean(const Shape2D& shape) {
  const auto grid = Grid2D::for_extent(1000);
  ASSERT_TRUE(grid);
  struct Edge {
    Point2D a, b;
  };
  std::vector<Edge> edges;
  std::vector<GridLoop> loops;
  for (const Loop& loop : shape.loops()) {
    ASSERT_GE(loop.size(), 3u);
    GridLoop& snapped = loops.emplace_back();
    for (const glm::dvec2& p : loop) {
      snapped.push_back(grid->snap(p));
      EXPECT_EQ(grid->unsnap(snapped.back()), p);
      EXPECT_FALSE(std::signbit(p.x) && p.x == 0);
    }
    EXPECT_EQ(std::set<Point2D>(snapped.begin(), snapped.end()).size(), snapped.size());
    for (size_t i = 0; i < snapped.size(); ++i) {
      edges.push_back({snapped[i], snapped[(i + 1) % snapped.size()]});
      EXPECT_LE(snapped[0], snapped[i]);
    }
  }
  EXPECT_TRUE(std::is_sorted(loops.begin(), loops.end()));
  for (size_t i = 0; i < edges.size(); ++i) {
    for (size_t j = i + 1; j < edges.size(); ++j) {
      const auto& [a, b] = edges[i];
      const auto& [c, d] = edges[j];
      const int o1 = orient(a, b, c), o2 = orient(a, b, d);
      const int o3 = orient(c, d, a), o4 = orient(c, d, b);
      EXPECT_FALSE(o1 * o2 < 0 && o3 * o4 < 0) << "crossing";
      auto inside = [](const Point2D& p, const Edge& e, int o) {
        const auto [low, high] = std::minmax(e.a, e.b);
        return o == 0 && low < p && p < high;
      };
      EXPECT_FALSE(inside(c, edges[i], o1) || inside(d, edges[i], o2) || inside(a, edges[j], o3) ||
                   inside(b, edges[j], o4))
          << "a vertex on an edge";
    }
  }
  std::vector<int> seen(loops.size(), 0);
  for (const Shape2D::Region& region : shape.regions()) {
    auto twice_area = [&](uint32_t l) {
      int128 sum = 0;
      for (size_t i = 0; i < loops[l].size(); ++i) {
        sum += cross(loops[l][i], loops[l][(i + 1) % loops[l].size()]);
      }
      return sum;
    };
    ++seen[region.outer];
    EXPECT_GT(sign(twice_area(region.outer)), 0);
    for (const uint32_t hole : region.holes) {
      ++seen[hole];
      EXPECT_LT(sign(twice_area(hole)), 0);
      for (const Point2D& p : loops[hole]) {
        EXPECT_TRUE(outlines({shape.loops()[region.outer]}).contains(grid->unsnap(p)));
      }
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<long>(seen.size()));
}

TEST(Shape2D, DecimalsMeetExactly) {
  const Shape2D joined = boolean(BooleanOp::kUnion, {box(0, 0, 0.1 + 0.2, 1), box(0.3, 0, 1, 1)});
  ASSERT_EQ(joined.loops().size(), 1u);
  EXPECT_EQ(joined.loops()[0], (Loop{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(box(0, 0, 0.3, 0.7).loops()[0][2], glm::dvec2(0.3, 0.7));
}

TEST(Shape2D, SquareAndCircleKeepTheirDoubles) {
  const double third = 1.0 / 3;
  const auto square = make_square({third, 2}, {true, false});
  ASSERT_TRUE(square);
  EXPECT_EQ(square->loops()[0],
            (Loop{{-third / 2, 0}, {third / 2, 0}, {third / 2, 2}, {-third / 2, 2}}));
  const auto circle = make_circle(third, Facets{8, 12, 2});
  ASSERT_TRUE(circle);
  EXPECT_EQ(circle->loops()[0].size(), 8u);
  EXPECT_EQ(circle->loops()[0][0], glm::dvec2(-third, 0));
  EXPECT_EQ(circle->loops()[0][2], glm::dvec2(0, -third));
  EXPECT_NEAR(circle->area(), 0.5 * 8 * std::sqrt(0.5) / 9, 1e-15);
  EXPECT_EQ(*Shape2D::boolean(BooleanOp::kUnion, {*circle, Shape2D()})->loops().data(),
            circle->loops()[0]);
}

TEST(Shape2D, HolesAndIslandsNest) {
  const Shape2D rings = outlines({{{0, 0}, {10, 0}, {10, 10}, {0, 10}},
                                  {{1, 1}, {9, 1}, {9, 9}, {1, 9}},
                                  {{2, 2}, {8, 2}, {8, 8}, {2, 8}},
                                  {{3, 3}, {4, 3}, {4, 4}, {3, 4}},
                                  {{5, 5}, {6, 5}, {6, 6}, {5, 6}}});
  expect_clean(rings);
  ASSERT_EQ(rings.regions().size(), 2u);
  EXPECT_EQ(rings.regions()[0].holes.size(), 1u);
  EXPECT_EQ(rings.regions()[1].holes.size(), 2u);
  EXPECT_EQ(rings.area(), 100 - 64 + 36 - 2);
  EXPECT_TRUE(rings.contains({0.5, 0.5}));
  EXPECT_TRUE(rings.contains({1, 5}));
  EXPECT_FALSE(rings.contains({1.5, 5}));
  EXPECT_FALSE(rings.contains({3.5, 3.5}));
  EXPECT_TRUE(rings.contains({4.5, 4.5}));
  EXPECT_FALSE(rings.contains({11, 5}));
  EXPECT_FALSE(rings.contains({std::nan(""), 5}));
}

TEST(Shape2D, TouchingCornersSplitLoops) {
  const Shape2D diagonal = boolean(BooleanOp::kUnion, {box(0, 0, 1, 1), box(1, 1, 2, 2)});
  expect_clean(diagonal);
  EXPECT_EQ(diagonal.regions().size(), 2u);
  // A hole that touches the middle of its outline and the corner of a second hole.
  const Shape2D holed =
      boolean(BooleanOp::kDifference, {box(0, 0, 10, 10), outlines({{{5, 0}, {6, 2}, {4, 2}}}),
                                       outlines({{{6, 2}, {8, 4}, {7, 5}}})});
  expect_clean(holed);
  ASSERT_EQ(holed.regions().size(), 1u);
  EXPECT_EQ(holed.regions()[0].holes.size(), 2u);
  EXPECT_EQ(holed.loops()[holed.regions()[0].outer].size(), 5u);
  // A ring of holes around an island that touches it in corners: the island is a region of its own.
  const Shape2D bow = outlines({{{0, 0}, {4, 4}, {4, 0}, {0, 4}}});
  expect_clean(bow);
  EXPECT_EQ(bow.area(), 8);
  EXPECT_EQ(bow.regions().size(), 2u);
}

TEST(Shape2D, BooleansOfSquares) {
  const Shape2D a = box(0, 0, 2, 2), b = box(1, 1, 3, 3), c = box(1, 0, 2, 3);
  EXPECT_EQ(boolean(BooleanOp::kUnion, {a, b, c}).area(), 7);
  EXPECT_EQ(boolean(BooleanOp::kIntersection, {a, b, c}).area(), 1);
  EXPECT_EQ(boolean(BooleanOp::kDifference, {a, b, c}).area(), 2);
  EXPECT_EQ(boolean(BooleanOp::kSymmetricDifference, {a, b, c}).area(), 5);
  EXPECT_TRUE(boolean(BooleanOp::kDifference, {a, a}).empty());
  EXPECT_TRUE(boolean(BooleanOp::kIntersection, {a, Shape2D()}).empty());
  EXPECT_TRUE(boolean(BooleanOp::kDifference, {Shape2D(), a}).empty());
  EXPECT_EQ(boolean(BooleanOp::kDifference, {a, Shape2D()}).area(), 4);
}

/// Area by membership of unit cells: shapes with corners on whole numbers and axis-parallel edges.
TEST(Shape2D, RandomRectanglesAgreeWithCells) {
  std::mt19937 random(3);
  auto coordinate = [&] { return static_cast<int>(random() % 7); };
  for (int round = 0; round < 400; ++round) {
    std::vector<Shape2D> operands;
    std::vector<std::set<std::pair<int, int>>> cells;
    const int count = 2 + static_cast<int>(random() % 4);
    for (int i = 0; i < count; ++i) {
      std::vector<Loop> loops;
      std::map<std::pair<int, int>, int> parity;
      for (int k = 0; k < 2; ++k) {
        const int x0 = coordinate(), y0 = coordinate(), x1 = x0 + 1 + coordinate(),
                  y1 = y0 + 1 + coordinate();
        loops.push_back({{x0, y0}, {x0, y1}, {x1, y1}, {x1, y0}});
        for (int x = x0; x < x1; ++x) {
          for (int y = y0; y < y1; ++y) ++parity[{x, y}];
        }
      }
      operands.push_back(outlines(loops));
      expect_clean(operands.back());
      cells.emplace_back();
      for (const auto& [cell, n] : parity) {
        if (n % 2 == 1) cells.back().insert(cell);
      }
      EXPECT_EQ(operands.back().area(), static_cast<double>(cells.back().size()));
    }
    for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kIntersection, BooleanOp::kDifference,
                               BooleanOp::kSymmetricDifference}) {
      const Shape2D result = boolean(op, operands);
      expect_clean(result);
      int expected = 0;
      for (int x = 0; x < 14; ++x) {
        for (int y = 0; y < 14; ++y) {
          int in = 0;
          for (const auto& set : cells) in += static_cast<int>(set.count({x, y}));
          const bool first = cells[0].count({x, y}) > 0;
          const bool inside = op == BooleanOp::kUnion          ? in > 0
                              : op == BooleanOp::kIntersection ? in == count
                              : op == BooleanOp::kDifference   ? first && in == 1
                                                               : in % 2 == 1;
          expected += inside ? 1 : 0;
          EXPECT_EQ(result.contains({x + 0.5, y + 0.5}), inside);
        }
      }
      EXPECT_EQ(result.area(), expected) << "round " << round;
    }
  }
}

/// Polygons that cross themselves and one another at any angle, on a coarse and on a fine lattice.
TEST(Shape2D, RandomPolygonsAreCleanAndAreasAddUp) {
  std::mt19937 random(4);
  for (int round = 0; round < 300; ++round) {
    const double scale = round % 3 == 0 ? 1 : round % 3 == 1 ? 1e-7 : 0.0137;
    const unsigned lattice = round % 2 == 0 ? 6 : 1000;
    auto polygon = [&] {
      Loop loop(3 + random() % 8);
      for (glm::dvec2& p : loop) {
        p = {scale * static_cast<int>(random() % lattice),
             scale * static_cast<int>(random() % lattice)};
      }
      return outlines({loop});
    };
    const Shape2D a = polygon(), b = polygon(), c = polygon();
    for (const Shape2D& s : {a, b, c}) expect_clean(s);
    const Shape2D u = boolean(BooleanOp::kUnion, {a, b}),
                  i = boolean(BooleanOp::kIntersection, {a, b}),
                  d = boolean(BooleanOp::kDifference, {a, b}),
                  x = boolean(BooleanOp::kSymmetricDifference, {a, b, c});
    for (const Shape2D& s : {u, i, d, x}) expect_clean(s);
    // Crossings move by less than a step.
    const double tolerance = 60 * scale * lattice * 1.5625e-8;
    EXPECT_NEAR(u.area() + i.area(), a.area() + b.area(), tolerance);
    EXPECT_NEAR(d.area(), a.area() - i.area(), tolerance);
    const Shape2D ab = boolean(BooleanOp::kSymmetricDifference, {a, b});
    EXPECT_NEAR(x.area(), boolean(BooleanOp::kSymmetricDifference, {ab, c}).area(), tolerance);
    EXPECT_TRUE(boolean(BooleanOp::kDifference, {u, u}).empty());
    EXPECT_EQ(boolean(BooleanOp::kUnion, {u, u, u}).loops(), u.loops());
  }
}

TEST(Shape2D, NearlyParallelEdgesSettle) {
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    std::vector<Loop> needles;
    for (int k = 0; k < 12; ++k) {
      auto noise = [&] { return static_cast<int>(random() % 7) * 1.5625e-8; };
      needles.push_back(
          {{noise(), noise()}, {300 + noise(), noise()}, {300 + noise(), 1e-7 + noise()}});
    }
    expect_clean(outlines(needles));
  }
}

TEST(Shape2D, TransformsMirrorAndVanish) {
  const Shape2D ring = boolean(BooleanOp::kDifference, {box(0, 0, 4, 2), box(1, 0.5, 2, 1.5)});
  Affine mirror;
  mirror.m[0][0] = -1;
  mirror.m[0][3] = 10;
  const auto mirrored = ring.transformed(mirror);
  ASSERT_TRUE(mirrored);
  expect_clean(*mirrored);
  EXPECT_EQ(mirrored->area(), 7);
  EXPECT_EQ(mirrored->bounds()[0], glm::dvec2(6, 0));
  EXPECT_TRUE(mirrored->contains({7, 1}));
  EXPECT_FALSE(mirrored->contains({8.5, 1}));
  Affine flat;
  flat.m[1][1] = 0;
  EXPECT_TRUE(ring.transformed(flat)->empty());
  Affine bad;
  bad.m[0][3] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(ring.transformed(bad));
}

TEST(Shape2D, OrderOfInputDoesNotMatter) {
  const Loop a{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, b{{2, 2}, {2, 4}, {4, 4}, {4, 2}};
  const Loop a2{{10, 10}, {10, 0}, {0, 0}, {0, 10}};
  EXPECT_EQ(outlines({a, b}).loops(), outlines({b, a2}).loops());
}

TEST(Shape2D, BadInputIsAnError) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  auto message = [](const Result<Shape2D>& r) {
    return r ? std::string("no error") : r.error().message;
  };
  EXPECT_EQ(message(make_square({0, 1})), "square: size.x must be positive, got 0");
  EXPECT_EQ(message(make_square({1, nan})), "square: size.y must be finite, got nan");
  EXPECT_EQ(message(make_circle(-2, {})), "circle: r must be positive, got -2");
  EXPECT_EQ(message(make_circle(1, Facets{inf, 12, 2})), "circle: fn must be finite, got inf");
  EXPECT_EQ(message(make_polygon({{0, 0}, {1, 0}}, {})), "polygon: needs at least 3 points, got 2");
  EXPECT_EQ(message(make_polygon({{0, 0}, {1, 0}, {2, 0}}, {})), "polygon: encloses no area");
  EXPECT_EQ(message(make_polygon({{0, 0}, {1, 0}, {inf, 1}}, {})),
            "polygon: point 2 must be finite, got inf");
  EXPECT_EQ(message(make_polygon({{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 3}})),
            "polygon: path 0: index 3 is out of range, there are 3 points; indices count from 0");
  EXPECT_EQ(message(make_polygon({{0, 0}, {1e13, 0}, {0, 1}}, {})),
            "2D shape: coordinates up to 1e+13 mm, the limit is 1e+12");
}

TEST(Shape2D, LargeCoordinatesUseACoarserDecimalGrid) {
  const Shape2D field = box(0, 0, 1e6, 0.001);
  EXPECT_EQ(field.bounds()[1], glm::dvec2(1e6, 0.001));
}

}  // namespace
}  // namespace csgrun::shape2d_test
