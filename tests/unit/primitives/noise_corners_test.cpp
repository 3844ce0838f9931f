// Corners that rounding leaves beside straight edges: what is made of a shape that was cut and
// joined again is what is made of the shape.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <csgrun/primitives/projection.h>
#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/shape_operations.h>
#include <csgrun/primitives/sweep.h>
#include <csgrun/primitives/trig.h>

#include "tests/unit/primitives/mesh_measures.h"

namespace csgrun::noise_corners_test {
namespace {

using testing::volume;

Affine turned(double degrees, double x = 0, double y = 0) {
  Affine map;
  map.m[0] = {cos_deg(degrees), -sin_deg(degrees), 0, x};
  map.m[1] = {sin_deg(degrees), cos_deg(degrees), 0, y};
  return map;
}

Affine scaled(double factor) {
  Affine map;
  map.m[0][0] = map.m[1][1] = factor;
  return map;
}

template <class T>
T good(Result<T> result) {
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? *std::move(result) : T();
}

/// A rectangle, and the same cut by another one and joined again.
struct Pair {
  Shape2D whole, joined;
};

std::vector<Pair> pairs() {
  std::vector<Pair> pairs;
  for (int i = 0; i < 120; ++i) {
    const Shape2D a = good(good(make_square({20, 12}, {true, true})).transformed(turned(3 * i)));
    const Shape2D b =
        good(good(make_square({30, 20})).transformed(turned(7 * i + 20, i % 5 - 2, 2)));
    const Shape2D parts[] = {good(Shape2D::boolean(BooleanOp::kDifference, {a, b})),
                             good(Shape2D::boolean(BooleanOp::kIntersection, {a, b}))};
    pairs.push_back({a, good(Shape2D::boolean(BooleanOp::kUnion, {parts[0], parts[1]}))});
  }
  return pairs;
}

size_t corners_of(const Shape2D& shape) {
  size_t count = 0;
  for (const Shape2D::Loop& loop : shape.loops()) count += loop.size();
  return count;
}

void expect_alike(const Shape2D& a, const Shape2D& b, const std::string& where) {
  ASSERT_EQ(a.loops().size(), b.loops().size()) << where;
  EXPECT_NEAR(a.area(), b.area(), 1e-5) << where;
  EXPECT_NEAR(perimeter_of(a), perimeter_of(b), 1e-5) << where;
  for (int end = 0; end < 2; ++end) {
    EXPECT_NEAR(a.bounds()[end].x, b.bounds()[end].x, 1e-6) << where;
    EXPECT_NEAR(a.bounds()[end].y, b.bounds()[end].y, 1e-6) << where;
  }
}

TEST(NoiseCorners, AreThere) {
  size_t noisy = 0;
  for (const Pair& pair : pairs()) noisy += corners_of(pair.joined) > 4;
  EXPECT_GT(noisy, 20u) << "the other tests say nothing";
}

TEST(NoiseCorners, LeaveNoHairsInOffsets) {
  const auto offset = [](const Shape2D& shape, double distance, OffsetJoin join) {
    return good(offset_shape(shape, {distance, join, {24, 12, 2}}));
  };
  size_t i = 0;
  for (const Pair& pair : pairs()) {
    const std::string where = std::to_string(i++);
    for (const OffsetJoin join : {OffsetJoin::kRound, OffsetJoin::kMitre, OffsetJoin::kChamfer}) {
      for (const double d : {-3, -1, 1, 3}) {
        const Shape2D a = offset(pair.whole, d, join), b = offset(pair.joined, d, join);
        expect_alike(a, b, where);
        expect_alike(offset(a, -d, join), offset(b, -d, join), where + " and back");
      }
    }
  }
}

TEST(NoiseCorners, LeaveNoHairsInSums) {
  const Shape2D disc = good(make_circle(2, {24, 12, 2}));
  const Shape2D angle =
      good(Shape2D::from_outlines({{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}}));
  for (const Pair& pair : pairs()) {
    for (const Shape2D& tool : {disc, angle}) {
      expect_alike(good(minkowski_of_shapes({pair.whole, tool})),
                   good(minkowski_of_shapes({pair.joined, tool})), "");
    }
  }
}

TEST(NoiseCorners, BendNoWalls) {
  const Shape2D top = good(make_circle(5, {24, 12, 2}));
  LinearExtrudeOptions twisted, large;
  twisted.height = 10;
  twisted.twist = 90;
  twisted.slices = 6;
  twisted.segments = 0;
  large = twisted;
  large.height = 300;
  large.segments.reset();
  SweepOptions uneven, upright;
  uneven.path = {{0, 0, 0}, {0, 0, 30}, {5, 0, 60}};
  uneven.scale = {0.3, 2};
  upright.path = {{0, 0, 0}, {30, 0, 10}, {40, 20, 30}};
  upright.upright = true;
  for (const Pair& pair : pairs()) {
    const auto expect_same = [&](double within, auto&& make) {
      EXPECT_NEAR(volume(good(make(pair.whole))), volume(good(make(pair.joined))), within);
    };
    expect_same(1e-4, [&](const Shape2D& s) { return linear_extrude(s, twisted); });
    expect_same(3, [&](const Shape2D& s) {  // of 72,000 and more; corners cost hundreds
      return linear_extrude(good(s.transformed(scaled(30))), large);
    });
    expect_same(1e-4, [&](const Shape2D& s) { return sweep_shape(s, uneven); });
    expect_same(1e-4, [&](const Shape2D& s) { return sweep_shape(s, upright); });
    expect_same(1e-4, [&](const Shape2D& s) { return loft_shapes({s, top}, {0, 10}); });
  }
}

TEST(NoiseCorners, OfShadowsBendNoWalls) {
  LinearExtrudeOptions straight, twisted;
  straight.height = 3;
  twisted.height = 10;
  twisted.twist = 90;
  Evaluator evaluator{EvaluateOptions{}};
  const auto twisted_shadow = [&](const Shape2D& shape) {
    const auto solid = evaluator.evaluate(Node::leaf(
        std::make_shared<PolygonMesh>(good(linear_extrude(shape, straight))), SourceRef{}));
    EXPECT_TRUE(solid);
    const Shape2D shadow = good(project_solid(**solid, evaluator.stats().grid_mm));
    return volume(good(linear_extrude(shadow, twisted)));
  };
  for (const Pair& pair : pairs())
    EXPECT_NEAR(twisted_shadow(pair.whole), twisted_shadow(pair.joined), 1e-3);
}

// No noise: walls over straight edges bulge all the same.
TEST(Sweep, WithTwoScalesIsDivided) {
  const Shape2D shape = good(good(make_square({20, 12}, {true, true})).transformed(turned(20)));
  SweepOptions options;
  options.path = {{0, 0, 0}, {0, 0, 30}};
  options.scale = {0.3, 2};
  // The integral of (1 - 0.7 t)(1 + t) over the height.
  const double truth = 240 * 30 * (1 + 0.15 - 0.7 / 3);
  EXPECT_NEAR(volume(good(sweep_shape(shape, options))), truth, 0.003 * truth);
  options.facets = {400, 12, 2};
  EXPECT_NEAR(volume(good(sweep_shape(shape, options))), truth, 1e-5 * truth);
}

}  // namespace
}  // namespace csgrun::noise_corners_test
