// Solids cut by planes of any direction: volumes that are known, and parts that fit one another.
// Solids taken apart: each component by itself, in order.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/solid_parts.h>
#include <csgrun/primitives/solids.h>

#include "primitives/solids/box_gap.h"
#include "primitives/solids/box_search.h"
#include "tests/support/seeded.h"

namespace csgrun::solid_parts_test {
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

NodePtr moved(double x, double y, double z, const NodePtr& solid) {
  Affine map;
  map.m[0][3] = x;
  map.m[1][3] = y;
  map.m[2][3] = z;
  return Node::transformed(map, solid);
}

NodePtr less(const NodePtr& a, const NodePtr& b) {
  return Node::boolean(BooleanOp::kDifference, {a, b});
}

/// Components in order, hollow ones and plain ones, some within others, of sizes that tell them
/// apart, cut by one long bar: far more than are evaluated as parts of the whole.
TEST(Decompose, ManyComponentsAreTreesOfTheirOwn) {
  constexpr int kCount = 60;
  std::vector<NodePtr> bodies;
  for (int i = 0; i < kCount; ++i) {
    NodePtr body = cube(4 + i / 64.0);
    if (i % 3 != 0) body = less(body, moved(1, 1, 2, cube(2)));
    if (i % 3 == 2) body = Node::boolean(BooleanOp::kUnion, {body, moved(1.5, 1.5, 2.5, cube(1))});
    bodies.insert(bodies.begin() + i / 2, moved(10 * i, i % 7, i % 5, body));
  }
  const NodePtr bar = moved(-1, -1, -1, cube(1));
  const NodePtr whole = less(Node::boolean(BooleanOp::kUnion, bodies),
                             Node::boolean(BooleanOp::kUnion, {bar, moved(0, 0, -3, cube(2))}));
  Evaluator evaluator{EvaluateOptions()};
  const auto pieces = decompose_solid(evaluator, whole, {});
  ASSERT_TRUE(pieces);
  size_t next = 0;
  for (int i = 0; i < kCount; ++i) {
    const double side = 4 + i / 64.0;
    ASSERT_LT(next, pieces->parts.size());
    const NodePtr& piece = pieces->parts[next++];
    // One with another in its void, whose box meets the other's, is made of its corners, as all of
    // these are on the grid.
    const bool has_inner = i % 3 == 2;
    if (has_inner) {
      EXPECT_EQ(piece->kind(), NodeKind::kLeaf);
    } else {
      ASSERT_TRUE(piece->same_solid()) << i;
      EXPECT_EQ(piece->children()[0], whole);
    }
    const auto solid = evaluator.evaluate(moved(0.1, 0.2, 0.3, piece));
    ASSERT_TRUE(solid);
    EXPECT_NEAR((*solid)->measures.volume, side * side * side - (i % 3 != 0 ? 8 : 0), 1e-3) << i;
    EXPECT_NEAR((*solid)->measures.bbox[0].x, 10 * i + 0.1, 1e-5);
    EXPECT_NEAR((*solid)->measures.bbox[1].x, 10 * i + side + 0.1, 1e-5);
    if (!has_inner) continue;
    ASSERT_LT(next, pieces->parts.size());
    const auto inner = evaluator.evaluate(pieces->parts[next++]);
    ASSERT_TRUE(inner);
    EXPECT_NEAR((*inner)->measures.volume, 1, 1e-6);
  }
  EXPECT_EQ(next, pieces->parts.size());
}

/// Bodies of one mesh, a few steps apart on a coarse grid, and on one that joins some.
TEST(Decompose, BodiesOfOneMeshOnCoarseGrids) {
  constexpr int kCount = 40;
  auto mesh = std::make_shared<PolygonMesh>();
  for (int i = 0; i < kCount; ++i) {
    const double low = 1.03 * i;
    const auto first = static_cast<uint32_t>(mesh->points.size());
    for (int k = 0; k < 8; ++k) {
      mesh->points.emplace_back(k & 1 ? low + 1 : low, k & 2 ? 1 : 0, k & 4 ? 1 : 0);
    }
    for (const std::array<uint32_t, 4>& face : std::initializer_list<std::array<uint32_t, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
      mesh->add_face(std::array{face[0] + first, face[1] + first, face[2] + first,  //
                                face[3] + first});
    }
  }
  const NodePtr whole = Node::leaf(mesh);
  for (const char* step : {"2^-20mm", "0.01mm", "0.02mm", "0.05mm"}) {
    EvaluateOptions options;
    options.grid = *GridStep::parse(step);
    Evaluator evaluator{options};
    const auto all = evaluator.evaluate(whole);
    const auto pieces = decompose_solid(evaluator, whole, {});
    ASSERT_TRUE(all && pieces) << step;
    EXPECT_EQ(static_cast<int64_t>(pieces->parts.size()), (*all)->measures.components) << step;
    double volume = 0;
    for (const NodePtr& piece : pieces->parts) {
      const auto solid = evaluator.evaluate(piece);
      ASSERT_TRUE(solid);
      EXPECT_EQ((*solid)->measures.components, 1) << step;
      volume += (*solid)->measures.volume;
    }
    EXPECT_NEAR(volume, (*all)->measures.volume, 1e-9) << step;
  }
}

NodePtr turned(const NodePtr& solid) {  // about two axes
  const double c = 0.8, n = 0.6;
  Affine z, x;
  z.m[0] = {c, -n, 0, 0};
  z.m[1] = {n, c, 0, 0};
  x.m[1] = {0, c, -n, 0};
  x.m[2] = {0, n, c, 0};
  return Node::transformed(x, Node::transformed(z, solid));
}

/// The whole is its components, with all of their corners where they were: cut off the grid.
void expect_exact(const NodePtr& whole, size_t count) {
  Evaluator evaluator{EvaluateOptions()};
  const auto pieces = decompose_solid(evaluator, whole, {});
  ASSERT_TRUE(pieces);
  EXPECT_EQ(pieces->parts.size(), count);
  EXPECT_EQ(pieces->rounded_corners, 0u);
  const NodePtr all = Node::boolean(BooleanOp::kUnion, pieces->parts);
  const auto rest =
      evaluator.evaluate(Node::boolean(BooleanOp::kSymmetricDifference, {whole, all}));
  ASSERT_TRUE(rest);
  EXPECT_TRUE((*rest)->empty());
  int64_t surfaces = 0;  // with those of voids
  for (const NodePtr& piece : pieces->parts) {
    const auto solid = evaluator.evaluate(piece);
    ASSERT_TRUE(solid);
    surfaces += (*solid)->measures.components;
  }
  EXPECT_EQ(surfaces, (*evaluator.evaluate(whole))->measures.components);
}

TEST(Decompose, ComponentsWithinTheBoxesOfOthersAreExact) {
  const NodePtr corner = turned(moved(0.3, 0.2, 0.1, cube(3)));  // what makes corners off the grid
  const NodePtr ring = less(less(cube(20), moved(3, 3, -1, cube(14))), corner);
  const NodePtr pin = less(moved(8, 8, 0, cube(4)), turned(moved(10, 3, 0, cube(3))));
  const NodePtr both = Node::boolean(BooleanOp::kUnion, {ring, pin});
  expect_exact(both, 2);
  expect_exact(turned(both), 2);
  // One in the void of another one, which is in that of a third.
  const NodePtr shell = less(cube(20), moved(1, 1, 1, cube(18)));
  const NodePtr inner = moved(3, 4, 5, less(cube(9), moved(1, 1, 1, cube(7))));
  expect_exact(less(Node::boolean(BooleanOp::kUnion, {shell, inner, moved(6, 7, 8, cube(2))}),
                    turned(moved(1, 2, -4, cube(3)))),
               3);
}

TEST(Decompose, ComponentsThatNoBoxesPartAreOfTheirCorners) {
  // Two links of a chain: squares of 10 with holes of 6, the second upright.
  const auto block = [](double x, double y, double z) {
    Affine sides;
    sides.m[0][0] = x, sides.m[1][1] = y, sides.m[2][2] = z;
    return Node::transformed(sides, cube(1));
  };
  const NodePtr first = less(block(10, 10, 2), moved(2, 2, -1, block(6, 6, 4)));
  const NodePtr second = moved(5, 4, -4, less(block(10, 2, 10), moved(2, -1, 2, block(6, 4, 6))));
  const NodePtr whole =
      less(turned(Node::boolean(BooleanOp::kUnion, {first, second})), moved(-1, 0, 0, cube(1.5)));
  Evaluator evaluator{EvaluateOptions()};
  const auto pieces = decompose_solid(evaluator, whole, {});
  ASSERT_TRUE(pieces);
  ASSERT_EQ(pieces->parts.size(), 2u);
  EXPECT_GT(pieces->rounded_corners, 0u);
  double volume = 0;
  for (const NodePtr& piece : pieces->parts) {
    volume += (*evaluator.evaluate(piece))->measures.volume;
  }
  EXPECT_NEAR(volume, (*evaluator.evaluate(whole))->measures.volume, 1e-4);
}

// Points of a triangle and of a box are never nearer than what is told; and nothing is told to be
// apart that is not.
TEST(BoxGap, IsNoMoreThanTheDistance) {
  test::Random random(11);
  const auto point = [&](int64_t room) {
    return glm::dvec3(static_cast<double>(random.integer(-room, room)),
                      static_cast<double>(random.integer(-room, room)),
                      static_cast<double>(random.integer(-room, room)));
  };
  int apart = 0, meeting = 0;
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec3 low = point(6), high = low + glm::dvec3(1, 2, 3);
    const std::array<glm::dvec3, 3> corners{point(9), point(9), point(9)};
    const double gap = box_gap({low, high}, corners);
    double nearest = std::numeric_limits<double>::infinity();
    constexpr int kParts = 24;
    for (int a = 0; a <= kParts; ++a) {
      for (int b = 0; a + b <= kParts; ++b) {
        const double u = 1.0 * a / kParts, v = 1.0 * b / kParts;
        const glm::dvec3 p = corners[0] * (1 - u - v) + corners[1] * u + corners[2] * v;
        nearest = std::min(nearest, glm::length(p - glm::clamp(p, low, high)));
      }
    }
    EXPECT_LE(gap, nearest + 1e-9) << i;
    // It is more than none where there is much.
    if (nearest > 1.5) {
      EXPECT_GT(gap, 0) << i;
    }
    ++(gap > 0 ? apart : meeting);
  }
  EXPECT_GT(apart, 500);
  EXPECT_GT(meeting, 100);
}

TEST(BoxSearch, AgreesWithALookAtAllOfThem) {
  test::Random random(7);
  for (const int count : {1, 2, 3, 17, 200}) {
    for (const int64_t room : {6, 30, 200}) {
      std::vector<BoxSearch::Box> boxes;
      for (int i = 0; i < count; ++i) {
        glm::dvec3 low, size;
        for (int k = 0; k < 3; ++k) {
          low[k] = static_cast<double>(random.integer(0, room)) / 3;
          size[k] = static_cast<double>(random.integer(1, 9)) / 3;
        }
        boxes.push_back({low, low + size});
      }
      const BoxSearch search(boxes);
      for (uint32_t i = 0; i < boxes.size(); ++i) {
        std::vector<uint32_t> around;
        for (uint32_t k = 0; k < boxes.size(); ++k) {
          bool holds = true;
          for (int axis = 0; axis < 3; ++axis) {
            holds &=
                boxes[k][0][axis] <= boxes[i][0][axis] && boxes[k][1][axis] >= boxes[i][1][axis];
          }
          if (holds) around.push_back(k);
        }
        for (const double distance : {0.0, 0.5, 4.0}) {
          double least = std::numeric_limits<double>::infinity();
          std::vector<uint32_t> near;
          for (uint32_t k = 0; k < boxes.size(); ++k) {
            if (k == i) continue;
            const double gap = BoxSearch::gap(boxes[i], boxes[k]);
            if (gap <= distance) near.push_back(k);
            if (gap > distance) least = std::min(least, gap);
          }
          EXPECT_EQ(search.least_gap(i, distance), least);
          EXPECT_EQ(search.near(i, distance), near);
        }
        EXPECT_EQ(search.holding(boxes[i]), around);
      }
    }
  }
}

}  // namespace
}  // namespace csgrun::solid_parts_test
