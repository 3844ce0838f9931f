// Caps and needles, of the kind that rounding makes along an edge of a model, are taken out.
#include "export/thin_triangles.h"

#include <numeric>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "export/defects.h"
#include "export/edge_flips.h"
#include "tests/unit/export/rounded_meshes.h"

namespace csgrun::testing::thin_triangles_test {
namespace {

std::vector<uint32_t> all_of(const RoundedMesh& mesh) {
  std::vector<uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

double height_of(const RoundedMesh& mesh, uint32_t t) {
  const auto& [i, j, k] = mesh.triangles[t];
  const glm::dvec3 &p = mesh.positions[i], &q = mesh.positions[j], &r = mesh.positions[k];
  const double longest = std::max({glm::distance(p, q), glm::distance(q, r), glm::distance(r, p)});
  return glm::length(glm::cross(q - p, r - p)) / longest;
}

constexpr double kOff = 0x1p-18;

/// A beam `count + 1` long and 1 wide and high. Along its upper front edge lie `count` corners,
/// each off it by up to kOff, and between them and the edge a fan of caps around the edge's first
/// end, a face each, which look anywhere. Each corner is behind the edge, or all alternate.
MadeMesh beam(uint32_t count, bool alternate) {
  MadeMesh made;
  const double length = count + 1;
  made.mesh.positions = {{0, 0, 0}, {length, 0, 0}, {length, 1, 0}, {0, 1, 0},
                         {0, 0, 1}, {length, 0, 1}, {length, 1, 1}, {0, 1, 1}};
  std::mt19937 random(7);
  for (uint32_t i = 1; i <= count; ++i) {
    const double side = alternate && i % 2 == 0 ? -1 : 1;
    made.mesh.positions.emplace_back(i, side * kOff * (1 + random() % 4) / 4,
                                     1 - kOff * static_cast<double>(random() % 4) / 4);
  }
  const auto on_edge = [count](uint32_t i) { return i == 0 ? 4 : i > count ? 5 : 7 + i; };
  made.face({0, 0, -1}, {{0, 3, 2}, {0, 2, 1}});
  made.face({0, -1, 0}, {{0, 1, 5}, {0, 5, 4}});
  made.face({1, 0, 0}, {{1, 2, 6}, {1, 6, 5}});
  made.face({0, 1, 0}, {{2, 3, 7}, {2, 7, 6}});
  made.face({-1, 0, 0}, {{3, 0, 4}, {3, 4, 7}});
  std::vector<Triangle> top{{4, 6, 7}};
  for (uint32_t i = 0; i <= count; ++i) top.push_back({on_edge(i), on_edge(i + 1), 6});
  made.face({0, 0, 1}, top);
  for (uint32_t i = 1; i <= count; ++i) {
    const Triangle cap{4, on_edge(i + 1), on_edge(i)};
    const glm::dvec3 &p = made.mesh.positions[cap[0]], &q = made.mesh.positions[cap[1]],
                     &r = made.mesh.positions[cap[2]];
    made.face(glm::cross(q - p, r - p), {cap});
  }
  pair_up(made.mesh);
  return made;
}

double volume_of(const RoundedMesh& mesh) { return exact_volume({mesh.positions, mesh.triangles}); }

TEST(ThinTriangles, FansOfCapsAreTurnedFromTheirLastOn) {
  for (const bool alternate : {false, true}) {
    for (const uint32_t count : {1u, 2u, 7u, 300u}) {
      MadeMesh made = beam(count, alternate);
      const size_t triangles = made.mesh.triangles.size();
      const double volume = volume_of(made.mesh);
      const size_t wrong = find_defects(made.mesh, made.directions).count();
      if (alternate && count > 2) {
        EXPECT_GT(wrong, 0u);
      }
      const auto thinned = take_out_thin(made.mesh, all_of(made.mesh), 4 * kOff, made.directions);
      ASSERT_TRUE(thinned);
      EXPECT_EQ(thinned->turned, count);
      EXPECT_EQ(thinned->merged, 0u);
      EXPECT_LE(thinned->farthest, 2 * kOff * count);
      EXPECT_GT(thinned->farthest, 0);
      EXPECT_EQ(made.mesh.triangles.size(), triangles);
      expect_manifold(made.mesh);
      for (const uint32_t t : all_of(made.mesh)) EXPECT_GT(height_of(made.mesh, t), 100 * kOff);
      EXPECT_TRUE(find_defects(made.mesh, made.directions).none());
      EXPECT_NEAR(volume_of(made.mesh), volume, 2 * kOff * (count + 1));
    }
  }
}

TEST(ThinTriangles, WhatIsWiderStays) {
  MadeMesh made = beam(5, true);
  const std::vector<Triangle> before = made.mesh.triangles;
  const auto thinned = take_out_thin(made.mesh, all_of(made.mesh), kOff / 64, made.directions);
  ASSERT_TRUE(thinned);
  EXPECT_EQ(thinned->turned + thinned->merged, 0u);
  EXPECT_EQ(made.mesh.triangles, before);
}

/// The upper end of a double pyramid is an edge of kOff, with a needle on either side of it.
MadeMesh double_pyramid() {
  MadeMesh made;
  made.mesh.positions = {{1, 0, 0},  {0, 1, 0}, {-1, 0, 0},  {0, -1, 0},
                         {0, 0, -1}, {0, 0, 1}, {kOff, 0, 1}};
  for (const Triangle& t : {Triangle{1, 0, 4},
                            {2, 1, 4},
                            {3, 2, 4},
                            {0, 3, 4},
                            {0, 1, 6},
                            {1, 2, 5},
                            {2, 3, 5},
                            {3, 0, 6},
                            {1, 5, 6},
                            {3, 6, 5}}) {
    const glm::dvec3 &p = made.mesh.positions[t[0]], &q = made.mesh.positions[t[1]],
                     &r = made.mesh.positions[t[2]];
    made.face(glm::cross(q - p, r - p), {t});
  }
  pair_up(made.mesh);
  return made;
}

TEST(ThinTriangles, NeedlesGoByMergingTheirEnds) {
  MadeMesh made = double_pyramid();
  // The needles alone are named; both name the one short edge.
  const auto thinned =
      take_out_thin(made.mesh, std::vector<uint32_t>{8, 9}, 2 * kOff, made.directions);
  ASSERT_TRUE(thinned);
  EXPECT_EQ(thinned->turned, 0u);
  EXPECT_EQ(thinned->merged, 1u);
  EXPECT_EQ(thinned->farthest, kOff);
  EXPECT_EQ(made.mesh.triangles.size(), 8u);
  EXPECT_EQ(made.mesh.positions.size(), 6u);
  EXPECT_EQ(made.mesh.dropped, 2u);
  expect_manifold(made.mesh);
  EXPECT_EQ(volume_of(made.mesh), 4.0 / 3);
}

TEST(ThinTriangles, NeedlesAreNoCaps) {
  MadeMesh made = double_pyramid();
  const Turned turned = turn_caps(made.mesh, all_of(made.mesh), 2 * kOff, made.directions);
  EXPECT_EQ(turned.count, 0u);
}

}  // namespace
}  // namespace csgrun::testing::thin_triangles_test
