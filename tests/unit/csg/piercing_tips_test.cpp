// Fans whose tips pierce each other: hundreds of long triangles cross in a very small place.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>

#include "test_meshes.h"

namespace csgrun::piercing_tips_test {
namespace {

using namespace testing;

constexpr int kFacets = 200;
constexpr double kTurn = 2 * std::numbers::pi / kFacets;

/// What is left of a drum with a hollow cone in each end, whose tips pierce each other by `depth`.
PolygonMesh hollow_drum(double depth) {
  PolygonMesh mesh;
  mesh.points = {{0, 0, -depth}, {0, 0, 0}};
  for (int i = 0; i < kFacets; ++i) {
    for (const double z : {3.0, -3.0}) {
      mesh.points.push_back({10 * std::cos(i * kTurn), 10 * std::sin(i * kTurn), z});
    }
  }
  for (uint32_t i = 0; i < kFacets; ++i) {
    const uint32_t a = 2 + 2 * i, c = 2 + 2 * ((i + 1) % kFacets);
    mesh.add_face(std::array<uint32_t, 3>{0, a, c});
    mesh.add_face(std::array<uint32_t, 3>{1, c + 1, a + 1});
    mesh.add_face(std::array<uint32_t, 4>{a, a + 1, c + 1, c});
  }
  mesh.kind = "drum";
  return mesh;
}

/// The volume, resolved at a cost that does not grow with the cube of the facets. (Signs asked for:
/// a single cell with all facets takes 17 million and half a gigabyte, division down to the
/// tips 9; facets that are cut whole, 4000.)
double volume(double depth, FillRule rule, bool whole_faces) {
  EvaluateOptions options;
  options.threads = 1;
  options.whole_faces = whole_faces;
  Evaluator evaluator(options);
  const auto solid = evaluator.evaluate(leaf(hollow_drum(depth), rule));
  EXPECT_TRUE(solid) << solid.error().message;
  EXPECT_LT(evaluator.stats().sign_filter, whole_faces ? 40'000u : 12'000'000u)
      << "depth " << depth;
  EXPECT_GT(evaluator.stats().sign_filter, whole_faces ? 1'000u : 100'000u) << "not resolved?";
  return solid ? (*solid)->measures.volume : 0;
}

TEST(PiercingTips, AreResolvedWhereTheyAre) {
  for (const double depth : {0.01, 0.0001}) {
    // Turned inside out where the cones overlap: inside by one rule, outside by the other.
    std::array<double, 2> lenses{};
    for (const bool whole : {false, true}) {
      lenses[whole ? 1 : 0] =
          volume(depth, FillRule::kNonZero, whole) - volume(depth, FillRule::kPositive, whole);
    }
    const double lens = lenses[0];
    EXPECT_EQ(lens, lenses[1]);
    const double radius = 10 * depth / (6 + depth);  // where the cones' sides meet, nearly
    const double expected = kFacets * radius * radius * std::sin(kTurn) / 2 * depth / 3;
    EXPECT_NEAR(lens, expected, 0.02 * expected + 1e-11) << "depth " << depth;
  }
}

}  // namespace
}  // namespace csgrun::piercing_tips_test
