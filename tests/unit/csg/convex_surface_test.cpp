// Convex surfaces, against all vertices on all planes.
#include "engine/mesh/convex_surface.h"

#include <vector>

#include <gtest/gtest.h>

#include "engine/csg/convex_hull.h"
#include "engine/mesh/face_normal.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/random_solids.h"

namespace csgrun::convex_surface_test {
namespace {

/// The faces of a leaf, from their first corner on, as triangles.
LeafGeometry in_triangles(const LeafGeometry& leaf) {
  LeafGeometry result;
  result.vertices = leaf.vertices;
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t first = leaf.face_starts[f];
    for (uint32_t c = first + 1; c + 1 < leaf.face_starts[f + 1]; ++c) {
      for (const uint32_t corner : {first, c, c + 1}) {
        result.corners.push_back(leaf.corners[corner]);
      }
      result.face_starts.push_back(static_cast<uint32_t>(result.corners.size()));
    }
  }
  result.opposite = pair_edges(result).opposite;
  return result;
}

/// How far a vertex is in front of a face.
__int128 height(const LeafGeometry& leaf, uint32_t face, uint32_t vertex) {
  const uint32_t first = 3 * face;
  const IVec3 normal = face_normal(leaf, first, first + 3),
              way = difference(leaf.vertices[vertex], leaf.vertices[leaf.corners[first]]);
  __int128 sum = 0;
  for (size_t k = 0; k < 3; ++k) sum += static_cast<__int128>(normal[k]) * way[k];
  return sum;
}

ConvexSurface expected(const LeafGeometry& leaf) {
  ConvexSurface result{true, false};
  for (uint32_t face = 0; face < leaf.face_count(); ++face) {
    for (uint32_t v = 0; v < leaf.vertices.size(); ++v) {
      result.is_convex = result.is_convex && height(leaf, face, v) <= 0;
    }
    for (uint32_t edge = 3 * face; edge < 3 * face + 3; ++edge) {
      const uint32_t back = leaf.opposite[edge];
      const uint32_t apex = leaf.corners[back / 3 * 3 + (back + 2) % 3];
      result.has_flat_edges |= height(leaf, face, apex) == 0;
    }
  }
  return result;
}

// Some vertices lie close together on a body that is large: doubles tell nothing of their faces.
TEST(ConvexSurface, IsToldExactly) {
  test::Random random(713);
  constexpr int64_t kFar = int64_t{1} << 28;
  int convex = 0, flat = 0, dented = 0;
  for (int round = 0; round < 600; ++round) {
    std::vector<IVec3> points{{-kFar, 0, 0}, {0, -kFar, 0}, {0, kFar, 0},
                              {0, 0, -kFar}, {0, 0, kFar},  {kFar / 2, 0, 0}};
    const int64_t reach = random.integer(1, 12);
    for (int i = 0; i < 12; ++i) {
      IVec3 p;
      for (int64_t& x : p) x = random.integer(-reach, reach);
      p[0] += kFar;
      points.push_back(p);
    }
    LeafGeometry leaf = in_triangles(convex_hull(points));
    if (round % 2 == 0) {  // one of those moves
      IVec3& vertex = leaf.vertices[static_cast<size_t>(
          random.integer(0, static_cast<int64_t>(leaf.vertices.size()) - 1))];
      vertex[static_cast<size_t>(random.integer(0, 2))] += random.integer(0, 1) * 2 - 1;
      bool any_degenerate = false;
      for (uint32_t f = 0; f < leaf.face_count(); ++f) {
        any_degenerate |= face_normal(leaf, 3 * f, 3 * f + 3) == IVec3{0, 0, 0};
      }
      if (any_degenerate) continue;
    }
    const ConvexSurface found = find_convex_surface(leaf, box_of_points(leaf.vertices)),
                        wanted = expected(leaf);
    ASSERT_EQ(found.is_convex, wanted.is_convex) << "round " << round;
    if (!wanted.is_convex) {
      ++dented;
      continue;
    }
    ASSERT_EQ(found.has_flat_edges, wanted.has_flat_edges) << "round " << round;
    ++(wanted.has_flat_edges ? flat : convex);
  }
  EXPECT_GT(convex, 20);
  EXPECT_GT(flat, 20);
  EXPECT_GT(dented, 20);
}

}  // namespace
}  // namespace csgrun::convex_surface_test
