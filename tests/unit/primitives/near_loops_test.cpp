// Booleans by the loops that are near give what arranging all loops gives.
#include "primitives/shape2d/near_loops.h"

#include <random>

#include <gtest/gtest.h>

namespace csgrun::near_loops_test {
namespace {

/// The same shape, of which it is not known that an arrangement gave it.
Shape2D forgotten(const Shape2D& shape) {
  return Shape2DFactory::canonical(shape.loops(), Shape2DFactory::outer_of(shape));
}

Shape2D of_grid(const Grid2D& grid, const std::vector<GridLoop>& loops) {
  std::vector<Shape2D::Loop> outlines;
  for (const GridLoop& loop : loops) {
    auto& outline = outlines.emplace_back();
    for (const Point2D& p : loop) outline.push_back(grid.unsnap(p));
  }
  return *Shape2D::from_outlines(outlines);
}

void expect_equal(const Shape2D& a, const Shape2D& b, int step) {
  ASSERT_EQ(a.loops(), b.loops()) << step;
  ASSERT_EQ(a.regions().size(), b.regions().size()) << step;
  for (size_t r = 0; r < a.regions().size(); ++r) {
    ASSERT_EQ(a.regions()[r].outer, b.regions()[r].outer) << step;
    ASSERT_EQ(a.regions()[r].holes, b.regions()[r].holes) << step;
  }
}

class Tools {
 public:
  Tools(uint32_t seed, bool is_coarse, bool is_starry)
      : random_(seed), is_coarse_(is_coarse), is_starry_(is_starry) {}

  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  /// A small one mostly: a square, a star, which touches itself if it has five corners, or a ring;
  /// at times a bar across all.
  Shape2D next() {
    const double x = place(), y = place();
    switch (whole(0, 9)) {
      case 0:
        return rectangle(x, -50, x + 1.5, 50);
      case 1:
        return rectangle(-50, y, 50, y + 0.5);
      case 2:
      case 3:
      case 4: {  // a ring
        const Shape2D outer = rectangle(x, y, x + 6, y + 6),
                      inner = rectangle(x + 1, y + 1, x + 5, y + 5);
        return *Shape2D::boolean(BooleanOp::kDifference, {outer, inner});
      }
      case 5:
      case 6: {
        Shape2D::Loop star;
        for (int i = 0; i < (is_starry_ ? 5 : 3); ++i)
          star.push_back({x + part() * 4, y + part() * 4});
        return *Shape2D::from_outlines({star});
      }
      default:
        return rectangle(x, y, x + 1 + whole(0, 2), y + 1 + whole(0, 2));
    }
  }

 private:
  double part() {
    return is_coarse_ ? whole(0, 4) / 4.0 : std::uniform_real_distribution<double>(0, 1)(random_);
  }
  double place() { return is_coarse_ ? whole(-40, 40) : 80 * part() - 40; }
  static Shape2D rectangle(double x0, double y0, double x1, double y1) {
    return *Shape2D::from_outlines({{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}});
  }

  std::mt19937 random_;
  bool is_coarse_, is_starry_;
};

TEST(NearLoops, GiveWhatAllLoopsGive) {
  int near = 0, all = 0, nested = 0;
  for (int round = 0; round < 12; ++round) {
    Tools tools(3000 + static_cast<uint32_t>(round), round % 3 == 2, round % 4 == 3);
    Shape2D shape = tools.next();
    for (int step = 0; step < 100; ++step) {
      BooleanOp op = tools.whole(0, 2) ? BooleanOp::kUnion : BooleanOp::kDifference;
      if (tools.whole(0, round % 2 ? 99 : 9) == 0) op = BooleanOp::kSymmetricDifference;
      std::vector<Shape2D> operands{shape, tools.next()};
      if (tools.whole(0, 3) == 0) operands.push_back(tools.next());
      if (op != BooleanOp::kDifference && tools.whole(0, 1)) std::swap(operands[0], operands[1]);
      const auto expect_same = [&](BooleanOp of) {
        std::vector<Shape2D> unknown;
        for (const Shape2D& operand : operands) unknown.push_back(forgotten(operand));
        const auto quick = Shape2D::boolean(of, operands), slow = Shape2D::boolean(of, unknown);
        ASSERT_TRUE(quick && slow);
        expect_equal(*quick, *slow, step);
        shape = *quick;
      };
      // Whether it was quick: all operands are on the grid of this extent.
      const Grid2D grid = *Grid2D::for_extent(50);
      const std::function<bool(int32_t, int32_t)> inside = [](int32_t first, int32_t rest) {
        return first + rest > 0;
      };
      ++(boolean_of_near_loops({grid, operands, BooleanOp::kUnion, inside}) ? near : all);
      expect_same(BooleanOp::kIntersection);
      if (HasFatalFailure()) return;
      expect_same(op);
      if (HasFatalFailure()) return;
      for (const Shape2D::Region& region : shape.regions()) nested += region.holes.size() > 2;
    }
  }
  EXPECT_GT(near, 900);
  EXPECT_GT(all, 50);
  EXPECT_GT(nested, 500);
}

// A plate that is cut in two: each half keeps its holes.
TEST(NearLoops, HolesGoWithTheirHalf) {
  const auto rectangle = [](double x0, double y0, double x1, double y1) {
    return *Shape2D::from_outlines({{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}});
  };
  Shape2D plate = rectangle(0, 0, 100, 100);
  for (int i = 0; i < 16; ++i) {
    const double x = 5 + 6 * i;
    plate = *Shape2D::boolean(BooleanOp::kDifference, {plate, rectangle(x, 50, x + 2, 60)});
  }
  // Between the eighth hole and the ninth one.
  const Shape2D cut =
      *Shape2D::boolean(BooleanOp::kDifference, {plate, rectangle(50, -1, 52, 101)});
  ASSERT_EQ(cut.regions().size(), 2u);
  for (const Shape2D::Region& half : cut.regions()) {
    ASSERT_EQ(half.holes.size(), 8u);
    const double left = cut.loops()[half.outer][0].x;
    for (const uint32_t hole : half.holes) EXPECT_EQ(cut.loops()[hole][0].x > 50, left > 50);
  }
  EXPECT_DOUBLE_EQ(cut.area(), 100 * 98 - 16 * 20);
}

// An edge that is cut moves by a part of a step, all along, and so comes to meet tips that were
// beside it, far away.
TEST(NearLoops, TipsBesideAnEdgeThatIsCut) {
  const Grid2D grid = *Grid2D::for_extent(1000);
  std::mt19937 random(77);
  const auto whole = [&](int64_t low, int64_t high) {
    return std::uniform_int_distribution<int64_t>(low, high)(random);
  };
  int moved = 0;
  for (int round = 0; round < 40; ++round) {
    const Point2D a{0, 0}, b{6400000000 + whole(0, 1000000), 2100000000 + whole(0, 1000000)};
    std::vector<GridLoop> outlines{{a, b, {0, 6400000000}}};
    // Triangles below the edge from a to b, each with a tip a step or less below it.
    for (int i = 1; i <= 20; ++i) {
      const int64_t x = int64_t{300000000} * i;
      const auto rise = static_cast<int128>(x) * b.y;
      const auto y = static_cast<int64_t>(rise / b.x - (rise % b.x == 0 ? 1 : 0));
      outlines.push_back({{x, y}, {x - 40000000, y - 90000000}, {x + 40000000, y - 90000000}});
    }
    const Shape2D shape = of_grid(grid, outlines);
    ASSERT_EQ(shape.loops().size(), 21u);
    const Point2D at{100000000 + whole(0, 90000000), 1000000};
    const GridLoop square{at,
                          {at.x + 9000000 + whole(0, 99), at.y},
                          {at.x + 9000000, at.y + 200000000},
                          {at.x, at.y + 200000000 + whole(0, 99)}};
    const Shape2D tool = of_grid(grid, {square});
    for (const BooleanOp op : {BooleanOp::kDifference, BooleanOp::kUnion}) {
      const auto quick = Shape2D::boolean(op, {shape, tool}),
                 slow = Shape2D::boolean(op, {forgotten(shape), tool});
      ASSERT_TRUE(quick && slow);
      expect_equal(*quick, *slow, round);
      moved += slow->loops().size() != 22;
    }
  }
  EXPECT_GT(moved, 10);
}

}  // namespace
}  // namespace csgrun::near_loops_test
