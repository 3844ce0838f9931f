#include "export/edge_splits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace csgrun::testing {
namespace {

void add_tetrahedron(RoundedMesh& mesh, const std::array<glm::dvec3, 4>& corners) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
  const bool is_right = glm::dot(glm::cross(corners[1] - corners[0], corners[2] - corners[0]),
                                 corners[3] - corners[0]) > 0;
  for (Triangle t : {Triangle{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
    if (!is_right) std::swap(t[1], t[2]);
    mesh.triangle_face.push_back(static_cast<uint32_t>(mesh.triangles.size()));
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

void pair_up(RoundedMesh& mesh) {
  auto twins = manifold_twins(mesh.triangles, mesh.positions.size());
  ASSERT_TRUE(twins);
  mesh.twins = *std::move(twins);
}

std::vector<uint32_t> all_of(const RoundedMesh& mesh) {
  std::vector<uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

double volume_of(const RoundedMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += glm::dot(mesh.positions[a], glm::cross(mesh.positions[b], mesh.positions[c]));
  }
  return sum / 6;
}

double area_of(const RoundedMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const glm::dvec3 &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
    sum += glm::length(glm::cross(q - p, r - p));
  }
  return sum / 2;
}

/// Divides, and looks at what must be so in any case.
uint64_t divided(RoundedMesh& mesh, std::span<const uint32_t> triangles, double tolerance) {
  const RoundedMesh before = mesh;
  const uint64_t count = divide_at_near_corners(mesh, triangles, tolerance);
  const auto twins = manifold_twins(mesh.triangles, mesh.positions.size());
  EXPECT_TRUE(twins);
  if (twins) {
    EXPECT_EQ(mesh.twins, *twins);
  }
  EXPECT_EQ(mesh.positions.size(), before.positions.size() + count);
  EXPECT_EQ(mesh.triangles.size(), before.triangles.size() + 2 * count);
  EXPECT_EQ(mesh.triangle_face.size(), mesh.triangles.size());
  for (size_t v = before.positions.size(); v < mesh.positions.size(); ++v) {
    EXPECT_NE(std::find(before.positions.begin(), before.positions.end(), mesh.positions[v]),
              before.positions.end());
  }
  EXPECT_LE(std::fabs(volume_of(mesh) - volume_of(before)),
            kGenerations * tolerance * std::max(area_of(mesh), area_of(before)));
  return count;
}

TEST(EdgeSplits, AnEdgeIsBentToTheCornerBesideIt) {
  RoundedMesh mesh;
  add_tetrahedron(mesh, {{{0, 0, 0}, {10, 0, 0}, {5, 8, -4}, {5, 8, 4}}});
  add_tetrahedron(mesh, {{{4, -0.01, 0}, {4, -5, -1}, {3, -5, 1}, {5, -5, 1}}});
  pair_up(mesh);
  RoundedMesh apart = mesh;
  EXPECT_EQ(divided(apart, all_of(mesh), 0.005), 0u);
  EXPECT_EQ(apart.triangles, mesh.triangles);
  EXPECT_EQ(divided(mesh, all_of(mesh), 0.02), 1u);
  EXPECT_EQ(mesh.positions.back(), glm::dvec3(4, -0.01, 0));
  // Both triangles of the edge are two now, each with the face of the whole.
  EXPECT_EQ(std::count(mesh.triangle_face.begin(), mesh.triangle_face.end(), 0u) +
                std::count(mesh.triangle_face.begin(), mesh.triangle_face.end(), 1u) +
                std::count(mesh.triangle_face.begin(), mesh.triangle_face.end(), 2u) +
                std::count(mesh.triangle_face.begin(), mesh.triangle_face.end(), 3u),
            6);
}

TEST(EdgeSplits, ATriangleIsBentToTheCornerOverIt) {
  RoundedMesh mesh;
  add_tetrahedron(mesh, {{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {1, 1, -5}}});
  add_tetrahedron(mesh, {{{3, 3, 0.01}, {2, 3, 5}, {3, 2, 5}, {4, 4, 5}}});
  pair_up(mesh);
  EXPECT_EQ(divided(mesh, all_of(mesh), 0.02), 1u);
  EXPECT_EQ(mesh.positions.back(), glm::dvec3(3, 3, 0.01));
}

TEST(EdgeSplits, OnlyCornersOfTheTrianglesCount) {
  RoundedMesh mesh;
  add_tetrahedron(mesh, {{{0, 0, 0}, {10, 0, 0}, {5, 8, -4}, {5, 8, 4}}});
  add_tetrahedron(mesh, {{{4, -0.01, 0}, {4, -5, -1}, {3, -5, 1}, {5, -5, 1}}});
  pair_up(mesh);
  EXPECT_EQ(divided(mesh, std::vector<uint32_t>{0, 1, 2, 3}, 0.02), 0u);
}

TEST(EdgeSplits, CornersNextToCornersAndThinTrianglesAreLeft) {
  RoundedMesh beside;
  add_tetrahedron(beside, {{{0, 0, 0}, {10, 0, 0}, {5, 8, -4}, {5, 8, 4}}});
  add_tetrahedron(beside, {{{0.01, -0.01, 0}, {4, -5, -1}, {3, -5, 1}, {5, -5, 1}}});
  pair_up(beside);
  EXPECT_EQ(divided(beside, all_of(beside), 0.02), 0u);
  RoundedMesh thin;
  add_tetrahedron(thin, {{{0, 0, 0}, {10, 0, 0}, {5, 0.01, 0}, {5, 3, 9}}});
  pair_up(thin);
  EXPECT_EQ(divided(thin, all_of(thin), 0.02), 0u);
}

TEST(EdgeSplits, CrowdsOfThinThingsComeToAnEnd) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1, 1);
  uint64_t all = 0;
  for (int round = 0; round < 20; ++round) {
    RoundedMesh mesh;
    for (int i = 0; i < 12; ++i) {
      std::array<glm::dvec3, 4> corners;
      for (glm::dvec3& p : corners) p = {10 * unit(random), unit(random), 0.01 * unit(random)};
      add_tetrahedron(mesh, corners);
    }
    pair_up(mesh);
    all += divided(mesh, all_of(mesh), 0.05);
  }
  EXPECT_GT(all, 200u);
}

}  // namespace
}  // namespace csgrun::testing
