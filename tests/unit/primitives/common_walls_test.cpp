// Solids that have a bent wall in common: it is divided alike from both sides.
#include <array>
#include <random>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/shape2d.h>

namespace csgrun::common_walls_test {
namespace {

SolidPtr solid_of(const NodePtr& node) {
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options);
  const auto solid = evaluator.evaluate(node);
  EXPECT_TRUE(solid) << (solid ? "" : solid.error().message);
  return solid ? *solid : std::make_shared<Solid>();
}

NodePtr turned(const std::vector<glm::dvec2>& profile, double angle, int fragments) {
  const auto shape = make_polygon(profile, {});
  EXPECT_TRUE(shape);
  RotateExtrudeOptions options;
  options.angle = angle;
  options.facets.fn = fragments;
  const auto solid = rotate_extrude_solid(*shape, options, {});
  EXPECT_TRUE(solid);
  return *solid;
}

/// A plug and its socket, which have a conical wall in common, are a whole without a gap. Facets of
/// cones are bent by rounding, over one diagonal or the other.
TEST(CommonWalls, OfPlugAndSocketLeaveNoGap) {
  std::mt19937 random(20261201);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  for (int i = 0; i < 40; ++i) {
    const double bottom = draw(2, 7), top = draw(2, 7), height = draw(2, 12), outer = 8;
    const int fragments = 3 + static_cast<int>(random() % 38);
    for (const double angle : {360.0, 100.0}) {
      const NodePtr plug =
          turned({{0, 0}, {bottom, 0}, {top, height}, {0, height}}, angle, fragments);
      const NodePtr socket =
          turned({{bottom, 0}, {outer, 0}, {outer, height}, {top, height}}, angle, fragments);
      const SolidPtr whole =
          solid_of(turned({{0, 0}, {outer, 0}, {outer, height}, {0, height}}, angle, fragments));
      const SolidPtr both = solid_of(Node::boolean(BooleanOp::kUnion, {plug, socket}));
      EXPECT_EQ(both->measures.components, 1) << fragments;
      EXPECT_EQ(both->measures.genus, 0) << fragments;
      EXPECT_NEAR(both->measures.volume, whole->measures.volume, 1e-4);
      EXPECT_NEAR(both->measures.area, whole->measures.area, 1e-4);
      const SolidPtr common = solid_of(Node::boolean(BooleanOp::kIntersection, {plug, socket}));
      EXPECT_TRUE(common->empty()) << fragments;
    }
  }
}

}  // namespace
}  // namespace csgrun::common_walls_test
