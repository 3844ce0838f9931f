// The distance of two meshes against that of all pairs of their triangles.
#include "lua_bindings/measure/triangle_distance.h"

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace csgrun::testing::triangle_distance_test {
namespace {

struct Mesh {
  std::vector<glm::dvec3> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  [[nodiscard]] TriangleView view() const { return {points, triangles}; }
};

double by_pairs(const Mesh& a, const Mesh& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : a.triangles) {
    for (const auto& u : b.triangles) {
      const Distance d = surface_distance({a.points, {&t, 1}}, {b.points, {&u, 1}});
      EXPECT_NEAR(glm::distance(d.from, d.to), d.length, 1e-12);
      least = std::min(least, d.length);
    }
  }
  return least;
}

/// Triangles anywhere in a ball, or all over it.
Mesh cloud(std::mt19937& random, size_t count, bool on_ball, const glm::dvec3& middle) {
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
  };
  Mesh mesh;
  for (uint32_t t = 0; t < count; ++t) {
    const glm::dvec3 at = direction() * (on_ball ? 1.0 : std::fabs(normal(random)));
    for (int i = 0; i < 3; ++i) {
      glm::dvec3 corner = at + 0.2 * direction();
      if (on_ball) corner = glm::normalize(corner);
      mesh.points.push_back(middle + corner);
    }
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

TEST(TriangleDistance, IsThatOfTheNearestPair) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> way(-6, 6);
  for (int n = 0; n < 60; ++n) {
    const glm::dvec3 at{way(random), way(random), way(random)};
    const Mesh a = cloud(random, 1 + random() % 60, n % 2 == 0, {}),
               b = cloud(random, 1 + random() % 60, n % 3 == 0, at);
    const Distance d = surface_distance(a.view(), b.view());
    EXPECT_EQ(d.length, by_pairs(a, b)) << n;
    EXPECT_EQ(surface_distance(b.view(), a.view()).length, by_pairs(b, a)) << n;
  }
}

/// Squares that face each other: all pairs are as near.
TEST(TriangleDistance, OfWhatIsNearAllOver) {
  const auto grid = [](double z) {
    Mesh mesh;
    constexpr uint32_t kSide = 9;
    for (uint32_t i = 0; i < kSide * kSide; ++i) mesh.points.emplace_back(i / kSide, i % kSide, z);
    for (uint32_t i = 0; i + kSide + 1 < kSide * kSide; ++i) {
      if (i % kSide + 1 == kSide) continue;
      mesh.triangles.push_back({i, i + kSide, i + kSide + 1});
      mesh.triangles.push_back({i, i + kSide + 1, i + 1});
    }
    return mesh;
  };
  EXPECT_EQ(surface_distance(grid(0).view(), grid(2.5).view()).length, 2.5);
  EXPECT_EQ(surface_distance(grid(1).view(), grid(1).view()).length, 0);
}

}  // namespace
}  // namespace csgrun::testing::triangle_distance_test
