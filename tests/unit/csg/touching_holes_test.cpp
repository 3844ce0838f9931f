// Holes of one face that touch in a corner are one loop, and stay holes whichever way they lie.
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>

#include "test_meshes.h"

namespace csgrun::touching_holes_test {
namespace {

using namespace testing;

/// A prism over the triangle of the origin, p and q, from z = -3 to 3.
NodePtr wedge(glm::dvec2 p, glm::dvec2 q) {
  PolygonMesh mesh;
  for (const double z : {-3.0, 3.0}) {
    for (const glm::dvec2& c : {glm::dvec2(0), p, q}) mesh.points.push_back({c.x, c.y, z});
  }
  for (const auto& face : std::vector<std::vector<uint32_t>>{
           {2, 1, 0}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}) {
    mesh.add_face(face);
  }
  mesh.kind = "wedge";
  return leaf(std::move(mesh), FillRule::kNonZero);
}

TEST(TouchingHoles, StayHolesInEveryPosition) {
  const NodePtr wedges = unite({wedge({5, 1}, {5, 3}), wedge({4, 5}, {2, 5})});
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (const double mirror : {1.0, -1.0}) {
      const NodePtr lying =
          Node::transformed(scaling(mirror, 1, 1), turned(90 * quarter, {0, 0, 1}, wedges));
      const NodePtr body = subtract({box({-7, -7, -7}, {7, 7, 7}), moved(0, 0, 7, lying)});
      for (const std::array<double, 3>& axis :
           {std::array<double, 3>{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}, {-1, 1, 1}}) {
        const double degrees = axis[0] * axis[1] != 0 ? 120 : 90;
        Evaluator evaluator({});
        const auto solid = evaluator.evaluate(turned(degrees, axis, body));
        ASSERT_TRUE(solid) << solid.error().message << " quarter " << quarter;
        EXPECT_NEAR((*solid)->measures.volume, 14 * 14 * 14 - 3 * (5 + 5), 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace csgrun::touching_holes_test
