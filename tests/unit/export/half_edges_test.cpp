// Twins of half-edges against the definition of a manifold by index, by ordered maps: surfaces with
// vertices joined and triangles turned over, left out or doubled at random.
#include "export/half_edges.h"

#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "tests/unit/export/torus.h"

namespace csgrun::half_edges_test {
namespace {

/// Nothing where the definition does not hold.
std::optional<std::vector<uint32_t>> twins_by_definition(const std::vector<Triangle>& triangles) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> half_edge;
  for (uint32_t h = 0; h < 3 * triangles.size(); ++h) {
    const Triangle& t = triangles[h / 3];
    const std::pair edge(t[h % 3], t[(h + 1) % 3]);
    if (edge.first == edge.second || !half_edge.emplace(edge, h).second) return {};
  }
  std::vector<uint32_t> twins(3 * triangles.size());
  std::map<uint32_t, std::set<uint32_t>> around;  // per vertex: the half-edges that leave it
  for (const auto& [edge, h] : half_edge) {
    const auto reverse = half_edge.find({edge.second, edge.first});
    if (reverse == half_edge.end()) return {};
    twins[h] = reverse->second;
    around[edge.first].insert(h);
  }
  for (const auto& [v, all] : around) {
    std::set<uint32_t> fan;
    for (uint32_t h = *all.begin(); fan.insert(h).second;) h = twins[previous_in_triangle(h)];
    if (fan != all) return {};
  }
  return twins;
}

TEST(ManifoldTwins, AreThoseOfTheDefinition) {
  std::mt19937_64 random(5);
  const auto below = [&](size_t n) { return static_cast<uint32_t>(random() % n); };
  size_t manifolds = 0, others = 0;
  for (int i = 0; i < 4000; ++i) {
    std::vector<Triangle> mesh = test::torus(3 + below(4), 3 + below(4));
    const size_t vertices = mesh.size() / 2;
    std::shuffle(mesh.begin(), mesh.end(), random);
    for (Triangle& t : mesh) std::rotate(t.begin(), t.begin() + below(3), t.end());
    switch (below(6)) {
      case 0: {  // two vertices are one
        const uint32_t v = below(vertices), w = below(vertices);
        for (Triangle& t : mesh) std::replace(t.begin(), t.end(), v, w);
        break;
      }
      case 1:
        std::swap(mesh[below(mesh.size())][0], mesh[below(mesh.size())][1]);
        break;
      case 2:
        mesh.pop_back();
        break;
      case 3:
        mesh.push_back(mesh[below(mesh.size())]);
        break;
      default:
        break;
    }
    const auto expected = twins_by_definition(mesh);
    const auto twins = manifold_twins(mesh, vertices);
    ASSERT_EQ(twins.has_value(), expected.has_value()) << i;
    if (expected) {
      ASSERT_EQ(*twins, *expected) << i;
    }
    ++(expected ? manifolds : others);
  }
  EXPECT_GT(manifolds, 1000u);
  EXPECT_GT(others, 1000u);
}

TEST(ManifoldTwins, NamesWhatIsWrong) {
  const std::vector<Triangle> tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_TRUE(manifold_twins(tetrahedron, 4));
  const auto message = [](std::vector<Triangle> mesh, size_t vertices) {
    const auto twins = manifold_twins(mesh, vertices);
    return twins ? std::string("manifold") : twins.error().message;
  };
  EXPECT_NE(message({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}}, 4).find("no reverse"), std::string::npos);
  EXPECT_NE(message({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}}, 4).find("occurs twice"),
            std::string::npos);
  EXPECT_NE(message(tetrahedron, 3).find("does not exist"), std::string::npos);
  EXPECT_NE(message({{0, 0, 1}}, 2).find("twice"), std::string::npos);
  // Two tetrahedra joined in vertex 0.
  std::vector<Triangle> pinched = tetrahedron;
  for (Triangle t : tetrahedron) {
    for (uint32_t& v : t) v = v == 0 ? 0 : v + 3;
    pinched.push_back(t);
  }
  EXPECT_NE(message(pinched, 7).find("several fans"), std::string::npos);
}

}  // namespace
}  // namespace csgrun::half_edges_test
