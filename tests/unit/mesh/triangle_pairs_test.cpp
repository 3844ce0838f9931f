// What must not go to the slow tests: neighbours of ordinary surfaces, and triangles that are
// apart.
#include "engine/mesh/triangle_pairs.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace csgrun {
namespace {

void add_triangle(LeafGeometry& leaf, uint32_t a, uint32_t b, uint32_t c) {
  leaf.corners.insert(leaf.corners.end(), {a, b, c});
  leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
}

/// An octahedron whose apexes are pushed along a diagonal, so that nothing is parallel to the axes.
LeafGeometry octahedron() {
  LeafGeometry leaf;
  leaf.vertices = {{100, 7, 3}, {-100, 5, 9}, {2, 90, -4}, {4, -95, 6}, {8, 3, 110}, {1, -2, -105}};
  for (const uint32_t apex : {4u, 5u}) {
    const std::array<uint32_t, 4> ring{0, 2, 1, 3};
    for (size_t i = 0; i < 4; ++i) {
      const uint32_t a = ring[i], b = ring[(i + 1) % 4];
      if (apex == 4) {
        add_triangle(leaf, a, b, apex);
      } else {
        add_triangle(leaf, b, a, apex);
      }
    }
  }
  return leaf;
}

/// A height field of so many squares, each of two triangles; plane for no height.
LeafGeometry terrain(uint32_t size, int64_t height) {
  std::mt19937 random(4);
  LeafGeometry leaf;
  for (uint32_t y = 0; y <= size; ++y) {
    for (uint32_t x = 0; x <= size; ++x) {
      const int64_t z = height > 0 ? static_cast<int64_t>(random()) % height : 0;
      leaf.vertices.push_back({100 * int64_t{x} + 3 * int64_t{y}, 100 * int64_t{y}, z});
    }
  }
  for (uint32_t y = 0; y < size; ++y) {
    for (uint32_t x = 0; x < size; ++x) {
      const uint32_t a = y * (size + 1) + x, b = a + 1, c = a + size + 1, d = c + 1;
      add_triangle(leaf, a, b, d);
      add_triangle(leaf, a, d, c);
    }
  }
  return leaf;
}

bool share_a_corner(const LeafGeometry& leaf, uint32_t f, uint32_t g) {
  bool any = false;
  for (uint32_t i = 0; i < 9; ++i) {
    any = any || leaf.corners[3 * f + i / 3] == leaf.corners[3 * g + i % 3];
  }
  return any;
}

std::vector<uint32_t> any_order(const LeafGeometry& leaf) {
  std::vector<uint32_t> order(leaf.face_count());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(7));
  return order;
}

TEST(TrianglePairs, VerticesOfAClosedSurfaceAreSpread) {
  const LeafGeometry leaf = octahedron();
  ASSERT_TRUE(TrianglePairs::covers(leaf));
  const std::vector<uint32_t> order = any_order(leaf);
  const TrianglePairs known(leaf, order, true), unknown(leaf, order, false);
  for (uint32_t place = 0; place < order.size(); ++place) {
    const uint32_t neighbours = known.spread_neighbours(place, 0);
    EXPECT_EQ(unknown.spread_neighbours(place, 0), 0u);
    for (uint32_t other = 0; other < order.size(); ++other) {
      EXPECT_EQ((neighbours >> other & 1) != 0, share_a_corner(leaf, order[place], order[other]));
      EXPECT_EQ(known.apart(order[place], order[other]), place != other);
    }
  }
}

TEST(TrianglePairs, InnerVerticesOfAHeightFieldAreSpread) {
  // Its rim is not closed, so that its vertices are surrounded less than once.
  const uint32_t size = 9;
  const LeafGeometry leaf = terrain(size, 90);
  const std::vector<uint32_t> order = any_order(leaf);
  const TrianglePairs pairs(leaf, order, true);
  const auto is_inner = [&](uint32_t v) {
    const uint32_t x = v % (size + 1), y = v / (size + 1);
    return x > 0 && y > 0 && x < size && y < size;
  };
  size_t inner = 0;
  for (uint32_t place = 0; place < order.size(); ++place) {
    for (uint32_t other = 0; other < order.size(); ++other) {
      const uint32_t f = order[place], g = order[other];
      bool expected = false;
      for (uint32_t i = 0; i < 9; ++i) {
        const uint32_t v = leaf.corners[3 * f + i / 3];
        expected = expected || (v == leaf.corners[3 * g + i % 3] && is_inner(v));
      }
      const bool found = (pairs.spread_neighbours(place, other / 8) >> other % 8 & 1) != 0;
      EXPECT_TRUE(found || !expected) << f << ", " << g;
      inner += expected;
    }
  }
  EXPECT_GT(inner, 1000u);
}

TEST(TrianglePairs, TrianglesOfAPlaneAreApartBySides) {
  const LeafGeometry leaf = terrain(5, 0);
  const TrianglePairs pairs(leaf, any_order(leaf), false);
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    for (uint32_t g = 0; g < leaf.face_count(); ++g) {
      EXPECT_EQ(pairs.apart(f, g), !share_a_corner(leaf, f, g)) << f << ", " << g;
    }
  }
}

TEST(TrianglePairs, PolygonsAndFarTrianglesAreNotCovered) {
  LeafGeometry leaf = octahedron();
  EXPECT_TRUE(TrianglePairs::covers(leaf));
  leaf.vertices[0][2] += int64_t{1} << 30;
  EXPECT_FALSE(TrianglePairs::covers(leaf));
  leaf = octahedron();
  leaf.face_starts.erase(leaf.face_starts.begin() + 3);
  EXPECT_FALSE(TrianglePairs::covers(leaf));
}

}  // namespace
}  // namespace csgrun
