#include <csgrun/engine/topology.h>

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace csgrun::test::openmesh_bridge_test {
namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

/// A torus of n times m quads, cut in two triangles each; its vertices start at `base`.
Triangles torus(uint32_t n, uint32_t m, uint32_t base) {
  Triangles out;
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < m; ++j) {
      const auto v = [&](uint32_t a, uint32_t b) { return base + (a % n) * m + b % m; };
      out.push_back({v(i, j), v(i + 1, j), v(i + 1, j + 1)});
      out.push_back({v(i, j), v(i + 1, j + 1), v(i, j + 1)});
    }
  }
  return out;
}

Triangles tetrahedron(uint32_t base) {
  return {{base, base + 2, base + 1},
          {base, base + 1, base + 3},
          {base + 1, base + 2, base + 3},
          {base + 2, base, base + 3}};
}

void append(Triangles& to, const Triangles& from) { to.insert(to.end(), from.begin(), from.end()); }

TEST(Topology, Empty) {
  const auto r = analyse_topology({}, 5);
  ASSERT_TRUE(r);
  EXPECT_EQ(r->components, 0u);
  EXPECT_EQ(r->genus, 0);
  EXPECT_TRUE(r->closed);
}

TEST(Topology, SphereAndTori) {
  Triangles all = tetrahedron(0);
  append(all, torus(5, 7, 10));
  append(all, torus(40, 30, 100));
  const auto r = analyse_topology(all, 2000);
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_EQ(r->components, 3u);
  EXPECT_EQ(r->genus, 2);
  EXPECT_TRUE(r->closed);
  EXPECT_EQ(r->component_of_triangle.front(), 0u);
  EXPECT_EQ(r->component_of_triangle[4], 1u);
  EXPECT_EQ(r->component_of_triangle.back(), 2u);
}

TEST(Topology, ConnectedSumAddsGenus) {
  // Two tori, a triangle taken out of each, glued along the holes.
  Triangles all = torus(6, 6, 0), other = torus(6, 6, 100);
  const auto hole = all.back(), hole2 = other.back();
  all.pop_back(), other.pop_back();
  for (auto& t : other) {
    for (auto& v : t) {
      for (int k = 0; k < 3; ++k) {
        if (v == hole2[k]) {
          v = hole[(3 - k) % 3];  // the other way round
          break;
        }
      }
    }
  }
  append(all, other);
  const auto r = analyse_topology(all, 200);
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_EQ(r->components, 1u);
  EXPECT_EQ(r->genus, 2);
}

TEST(Topology, OrderOfTrianglesDoesNotMatter) {
  std::mt19937 random(1);
  for (int round = 0; round < 50; ++round) {
    Triangles all = torus(9, 8, 3);
    append(all, tetrahedron(200));
    std::shuffle(all.begin(), all.end(), random);
    for (auto& t : all) std::rotate(t.begin(), t.begin() + random() % 3, t.end());
    const auto r = analyse_topology(all, 300);
    ASSERT_TRUE(r) << r.error().message;
    EXPECT_EQ(r->components, 2u);
    EXPECT_EQ(r->genus, 1);
    EXPECT_EQ(r->component_of_triangle[0], 0u);
  }
}

TEST(Topology, Boundaries) {
  Triangles all = torus(9, 8, 0);
  all.pop_back();  // a hole of one triangle
  all.erase(all.begin() + 6 * 16, all.begin() + 6 * 16 + 1);
  const auto r = analyse_topology(all, 72);
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_FALSE(r->closed);
  EXPECT_EQ(r->boundary_edges, 6u);
  EXPECT_EQ(r->genus, 1);
  EXPECT_EQ(r->components, 1u);
}

TEST(Topology, RefusesWhatIsNoManifold) {
  const auto refused = [](const Triangles& triangles, size_t vertices) {
    const auto r = analyse_topology(triangles, vertices);
    return !r && r.error().code == ErrorCode::kInvalidMesh;
  };
  EXPECT_TRUE(refused({{0, 1, 1}}, 3));             // repeats a vertex
  EXPECT_TRUE(refused({{0, 1, 7}}, 3));             // out of range
  EXPECT_TRUE(refused({{0, 1, 2}, {0, 1, 3}}, 4));  // same direction
  EXPECT_TRUE(refused({{0, 1, 2}, {0, 3, 4}}, 5));  // two open fans
  Triangles pinched = tetrahedron(0);
  for (auto t : tetrahedron(3)) pinched.push_back(t);
  EXPECT_TRUE(refused(pinched, 7));  // two tetrahedra with one vertex
  EXPECT_FALSE(refused(tetrahedron(3), 7));
}

}  // namespace
}  // namespace csgrun::test::openmesh_bridge_test
