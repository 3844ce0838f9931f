// What must not go to the slow tests: neighbours of ordinary surfaces, and triangles that are
// apart.
#include "engine/mesh/triangle_pairs.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "engine/mesh/spread_vertices.h"

namespace csgrun::triangle_pairs_test {
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
  const TrianglePairs known(leaf, order, find_spread_vertices(leaf), true),
      unknown(leaf, order, {}, true);
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
  const TrianglePairs pairs(leaf, order, find_spread_vertices(leaf, order), false);
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
  const TrianglePairs pairs(leaf, any_order(leaf), {}, false);
  size_t neighbours = 0;
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    EXPECT_FALSE(pairs.apart(f, f));
    for (uint32_t g = 0; g < leaf.face_count(); ++g) {
      const bool apart = pairs.apart(f, g);
      // Opposite ones at a vertex may have their sides on one line.
      EXPECT_TRUE(f == g || apart || share_a_corner(leaf, f, g)) << f << ", " << g;
      neighbours += apart && share_a_corner(leaf, f, g);
    }
  }
  EXPECT_GT(neighbours, 200u);
}

TEST(TrianglePairs, TrianglesThatRestOnAPlaneBesideATriangle) {
  // Against the triangle (0, 0), (10, 0), (0, 10) of the plane z = 0: with one corner in the plane,
  // with an edge, from above and through the plane.
  std::array<IVec3, 3> base{{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}};
  const auto is_apart = [&](const std::array<IVec3, 3>& t) {
    LeafGeometry leaf;
    leaf.vertices = {base[0], base[1], base[2], t[0], t[1], t[2]};
    add_triangle(leaf, 0, 1, 2);
    add_triangle(leaf, 3, 4, 5);
    const TrianglePairs pairs(leaf, std::vector<uint32_t>{0, 1}, {}, false);
    EXPECT_EQ(pairs.apart(0, 1), pairs.apart(1, 0));
    return pairs.apart(0, 1);
  };
  EXPECT_TRUE(is_apart({{{6, 5, 0}, {1, 1, 5}, {2, 1, 5}}}));
  EXPECT_FALSE(is_apart({{{5, 5, 0}, {1, 1, 5}, {2, 1, 5}}}));
  EXPECT_FALSE(is_apart({{{4, 5, 0}, {1, 1, 5}, {2, 1, 5}}}));
  EXPECT_TRUE(is_apart({{{6, 5, 0}, {10, 1, 0}, {2, 1, 5}}}));
  EXPECT_FALSE(is_apart({{{6, 5, 0}, {10, 0, 0}, {2, 1, 5}}}));
  EXPECT_FALSE(is_apart({{{6, 5, 0}, {1, 1, 5}, {2, 1, -5}}}));
  EXPECT_TRUE(is_apart({{{2, 2, 1}, {1, 1, 5}, {2, 1, 5}}}));
  EXPECT_FALSE(is_apart({{{2, 2, 1}, {1, 1, 5}, {2, 1, -5}}}));
  // A corner so near to a large triangle that doubles do not tell its side.
  constexpr int64_t kBig = int64_t{1} << 27;
  base = {{{0, 0, 0}, {4 * kBig, 0, 2}, {0, 4 * kBig, 2}}};
  const IVec3 p{kBig, kBig, 1000}, q{kBig + 5, kBig, 1000};
  EXPECT_TRUE(is_apart({{{kBig, kBig - 1, 1}, p, q}}));
  EXPECT_FALSE(is_apart({{{kBig, kBig, 1}, p, q}}));
  EXPECT_FALSE(is_apart({{{kBig, kBig + 1, 1}, p, q}}));
}

// A stack of triangles, of which one in four is a quadrilateral, far from the origin.
TEST(TrianglePairs, ManyOfAGroupAreTestedAtOnce) {
  LeafGeometry leaf;
  constexpr int64_t kFar = (int64_t{1} << 35) + (int64_t{1} << 30);
  for (int64_t i = 0; i < 24; ++i) {
    const int64_t z = kFar + 100 * i;
    const auto first = static_cast<uint32_t>(leaf.vertices.size());
    leaf.vertices.insert(leaf.vertices.end(),
                         {{0, kFar, z}, {1000, kFar, z + 3}, {0, kFar + 1000, z}});
    add_triangle(leaf, first, first + 1, first + 2);
    if (i % 4 != 3) continue;
    leaf.vertices.push_back({-1000, kFar, z - 3});
    leaf.corners.push_back(first + 3);
    ++leaf.face_starts.back();
  }
  std::vector<uint32_t> order(leaf.face_count());
  std::iota(order.begin(), order.end(), 0u);
  const TrianglePairs pairs(leaf, order, {}, true), plain(leaf, order, {}, false);
  constexpr uint32_t kTriangles = 0b01110111;
  for (uint32_t place = 0; place < 24; ++place) {
    const uint32_t expected = place % 4 == 3 ? 0 : kTriangles;
    for (const uint32_t group : {0u, 1u, 2u}) {
      const uint32_t others = place / 8 == group ? expected & ~(1u << place % 8) : expected;
      EXPECT_EQ(pairs.plainly_apart(place, group, 0xff), others);
      EXPECT_EQ(pairs.plainly_apart(place, group, 0b01100101), others & 0b01100101);
      EXPECT_EQ(plain.plainly_apart(place, group, 0xff), 0u);
    }
  }
}

TEST(TrianglePairs, PolygonsAreLeftToOthersAndFarLeavesToo) {
  LeafGeometry leaf = octahedron();
  EXPECT_TRUE(TrianglePairs::covers(leaf));
  leaf.vertices[0][2] += int64_t{1} << 30;
  EXPECT_FALSE(TrianglePairs::covers(leaf));
  // A square pyramid: its base is no triangle, and its vertices are spread all the same.
  LeafGeometry pyramid;
  pyramid.vertices = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {4, 4, 9}};
  pyramid.corners = {0, 3, 2, 1};
  pyramid.face_starts = {0, 4};
  for (uint32_t i = 0; i < 4; ++i) add_triangle(pyramid, i, (i + 1) % 4, 4);
  const TrianglePairs pairs(pyramid, std::vector<uint32_t>{0, 1, 2, 3, 4},
                            find_spread_vertices(pyramid), true);
  EXPECT_EQ(pairs.spread_neighbours(0, 0), 0u);
  for (uint32_t place = 1; place < 5; ++place) {
    EXPECT_EQ(pairs.spread_neighbours(place, 0), 0b11110u);
    EXPECT_FALSE(pairs.apart(place, 0));
  }
}

}  // namespace
}  // namespace csgrun::triangle_pairs_test
