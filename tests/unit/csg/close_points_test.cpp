// Corners of one face that are nearer to each other than doubles tell.
#include <random>

#include <gtest/gtest.h>

#include "test_meshes.h"

namespace csgrun::close_points_test {
namespace {

using namespace testing;

/// A square frustum on its tip's side, its diagonals along X and Y.
NodePtr frustum(double low, double high, double height) {
  PolygonMesh mesh;
  for (const auto& [radius, z] : {std::pair{low, 0.0}, {high, height}}) {
    for (const auto& [x, y] : {std::pair{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
      mesh.points.push_back({radius * x, radius * y, z});
    }
  }
  mesh.add_face(std::array<uint32_t, 4>{3, 2, 1, 0});
  mesh.add_face(std::array<uint32_t, 4>{4, 5, 6, 7});
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t next = (i + 1) % 4;
    mesh.add_face(std::array<uint32_t, 4>{i, next, next + 4, i + 4});
  }
  mesh.convex = true;
  mesh.kind = "frustum";
  return Node::leaf(std::make_shared<PolygonMesh>(std::move(mesh)));
}

TEST(ClosePoints, OfAFaceAreInTheirExactOrder) {
  // A corner of the frustum lies a hundred-thousandth of a step beside the box's bottom, in which
  // its three faces leave corners with equal doubles along x.
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> factor(0.05, 2);
  const NodePtr block = box({0, 0, 0}, {1.5, 5, 2});
  for (int trial = 0; trial < 100; ++trial) {
    Affine map;
    map.m[0][0] = trial == 0 ? 5 / 16.4 : factor(random);
    map.m[0][1] = -map.m[0][0];
    map.m[1][0] = 1;
    map.m[2][1] = 0.0001;
    const NodePtr other = Node::transformed(map, frustum(3, 8, 10));
    const double both = solid_of(unite({block, other}))->measures.volume;
    const double common = solid_of(intersect({block, other}))->measures.volume;
    EXPECT_NEAR(both + common, 15 + solid_of(other)->measures.volume, 1e-9) << "trial " << trial;
  }
}

}  // namespace
}  // namespace csgrun::close_points_test
