// Solids cut by planes of any direction: volumes that are known, and parts that fit one another.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/solid_parts.h>
#include <csgrun/primitives/solids.h>

namespace csgrun {
namespace {

NodePtr cube(double side) {
  auto mesh = std::make_shared<PolygonMesh>();
  for (int i = 0; i < 8; ++i) {
    mesh->points.emplace_back(i & 1 ? side : 0, i & 2 ? side : 0, i & 4 ? side : 0);
  }
  mesh->hull_of_points = true;
  return Node::leaf(std::move(mesh));
}

/// What is in front of the plane, and behind it.
std::array<SolidPtr, 2> split(const NodePtr& solid, const glm::dvec3& normal,
                              const glm::dvec3& point,
                              const EvaluateOptions& options = EvaluateOptions()) {
  Evaluator evaluator{options};
  const auto plane = make_cut_plane(normal, point);
  EXPECT_TRUE(plane);
  const auto front = half_space(evaluator, solid, *plane, {});
  EXPECT_TRUE(front);
  std::array<SolidPtr, 2> parts;
  for (const size_t i : {0, 1}) {
    const auto part = evaluator.evaluate(
        Node::boolean(i == 0 ? BooleanOp::kIntersection : BooleanOp::kDifference, {solid, *front}));
    EXPECT_TRUE(part);
    parts[i] = *part;
  }
  return parts;
}

TEST(HalfSpace, ThroughTheMiddleOfACube) {
  for (const glm::dvec3& normal :
       {glm::dvec3(1, 0, 0), glm::dvec3(0, -3, 0), glm::dvec3(1, 0, 1), glm::dvec3(-1, 1, 0),
        glm::dvec3(1, 1, 1), glm::dvec3(1, 2, 3), glm::dvec3(-5, 2, 0), glm::dvec3(123, 457, -991),
        glm::dvec3(0.1, 0.2, 0.3), glm::dvec3(0.5, -0.375, 1), glm::dvec3(100, 0, 300),
        glm::dvec3(2, 2, 1) / 1024.0}) {
    for (const double side : {10.0, 0.5, 4000.0}) {
      if (normal.x > 100 && side < 1) continue;  // no such lattice is as small
      const auto [front, back] = split(cube(side), normal, glm::dvec3(side / 2));
      const double half = side * side * side / 2;
      EXPECT_EQ(front->measures.volume, half) << normal.x << " " << normal.y << " " << normal.z;
      EXPECT_EQ(back->measures.volume, half) << normal.x << " " << normal.y << " " << normal.z;
    }
  }
}

TEST(HalfSpace, CornersOfACube) {
  for (int i = 1; i < 40; ++i) {
    const double at = i / 4.0;
    const auto [edge, rest] = split(cube(10), {-1, 0, -1}, {0, 3, at});
    EXPECT_EQ(edge->measures.volume, at * at * 5);
    EXPECT_EQ(rest->measures.volume, 1000 - at * at * 5);
    const auto [corner, others] = split(cube(10), {-1, -1, -1}, {at, 0, 0});
    EXPECT_NEAR(corner->measures.volume, at * at * at / 6, 1e-13 * at * at * at);
    EXPECT_EQ(others->triangles.size(), 16u);
  }
}

/// Directions that no small whole numbers have, and points that are on no grid: parts of it all.
TEST(HalfSpace, OfAnyDirection) {
  for (const glm::dvec3& normal :
       {glm::dvec3(std::sqrt(2.0), 1, 0), glm::dvec3(0.123456789, 0.4, 0.9), glm::dvec3(1e7, 1, 3),
        glm::dvec3(1, 2, 2)}) {
    const auto [front, back] = split(cube(10), normal, {5, 5, 16 / 3.0});
    EXPECT_NEAR(front->measures.volume + back->measures.volume, 1000, 1e-12 * 1000);
    for (const glm::dvec3& p : front->positions) {
      EXPECT_GT(glm::dot(p - glm::dvec3(5, 5, 16 / 3.0), glm::normalize(normal)), -1e-6);
    }
    EXPECT_TRUE(front->measures.closed);
    EXPECT_TRUE(back->measures.closed);
  }
}

/// On a grid that has not the points that the plane would need the cut is flat all the same.
TEST(HalfSpace, OnACoarseGrid) {
  EvaluateOptions options;
  options.grid = *GridStep::parse("0.003");
  for (const glm::dvec3& normal :
       {glm::dvec3(1, 0, 1), glm::dvec3(1, 2, 3), glm::dvec3(-3, 1, 7), glm::dvec3(0.3, 0.7, 0)}) {
    for (const double side : {0.06, 0.4, 10.0, 1000.0}) {
      for (const SolidPtr& part : split(cube(side), normal, glm::dvec3(side / 3), options)) {
        const auto slanting =
            std::count_if(part->face_normals.begin(), part->face_normals.end(),
                          [](const auto& n) { return (n.x != 0) + (n.y != 0) + (n.z != 0) > 1; });
        EXPECT_EQ(slanting, 1) << normal.x << " " << normal.y << " " << normal.z << ", " << side;
      }
    }
  }
}

TEST(HalfSpace, BesideTheSolid) {
  for (const glm::dvec3& normal : {glm::dvec3(1, 0, 1), glm::dvec3(0, 0, 1)}) {
    EXPECT_TRUE(split(cube(10), normal, {0, 0, 25})[0]->empty());
    EXPECT_EQ(split(cube(10), normal, {0, 0, -5})[0]->measures.volume, 1000);
    EXPECT_TRUE(split(cube(10), normal, {0, 0, -5})[1]->empty());
  }
}

}  // namespace
}  // namespace csgrun
