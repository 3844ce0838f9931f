// Repair step by step: what it leaves is held against distances between points of both surfaces.
#include "export/small_steps.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "export/defects.h"
#include "export/edge_flips.h"
#include "tests/unit/export/rounded_meshes.h"

namespace csgrun::testing::small_steps_test {
namespace {

std::vector<uint32_t> offenders(const Defects& defects) {
  std::vector<uint32_t> wrong = defects.flipped;
  wrong.insert(wrong.end(), defects.degenerate.begin(), defects.degenerate.end());
  for (const TriangleCrossing& c : defects.crossings) {
    wrong.insert(wrong.end(), c.triangles.begin(), c.triangles.end());
  }
  std::sort(wrong.begin(), wrong.end());
  wrong.erase(std::unique(wrong.begin(), wrong.end()), wrong.end());
  return wrong;
}

double distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 ab = b - a;
  const double squared = glm::dot(ab, ab);
  const double at = squared > 0 ? std::clamp(glm::dot(p - a, ab) / squared, 0.0, 1.0) : 0;
  return glm::distance(p, a + at * ab);
}

double distance_to_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                            const glm::dvec3& c) {
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const bool is_above = glm::dot(glm::cross(b - a, p - a), n) >= 0 &&
                        glm::dot(glm::cross(c - b, p - b), n) >= 0 &&
                        glm::dot(glm::cross(a - c, p - c), n) >= 0;
  const double to_sides = std::min(
      {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  if (!is_above || glm::length(n) == 0) return to_sides;
  return std::min(to_sides, std::abs(glm::dot(p - a, n)) / glm::length(n));
}

/// The largest distance from points of one surface to the other.
double one_way_distance(const RoundedMesh& from, const RoundedMesh& to) {
  double largest = 0;
  constexpr int kParts = 6;
  for (const auto& [i, j, k] : from.triangles) {
    for (int u = 0; u <= kParts; ++u) {
      for (int v = 0; u + v <= kParts; ++v) {
        const glm::dvec3 p = (static_cast<double>(u) * from.positions[i] +
                              static_cast<double>(v) * from.positions[j] +
                              static_cast<double>(kParts - u - v) * from.positions[k]) /
                             static_cast<double>(kParts);
        double nearest = HUGE_VAL;
        for (const auto& [a, b, c] : to.triangles) {
          nearest = std::min(
              nearest, distance_to_triangle(p, to.positions[a], to.positions[b], to.positions[c]));
        }
        largest = std::max(largest, nearest);
      }
    }
  }
  return largest;
}

constexpr double kOff = 0x1p-18;

/// A beam 1024 long whose upper front edge has a corner 1 before its end, which rounding put behind
/// that edge and as many as `past` of the thin triangles behind it, which run to the edge's end,
/// and a little below them. So the triangle between this corner and the edge is turned over.
MadeMesh beam_with_a_corner_past(uint32_t past) {
  MadeMesh made;
  const double length = 1024;
  made.mesh.positions = {
      {0, 0, 0},      {length, 0, 0}, {length, 1, 0},
      {0, 1, 0},      {0, 0, 1},      {length, 0, 1},
      {length, 1, 1}, {0, 1, 1},      {length - 1, kOff * (past + 0.5), 1 - kOff}};
  std::vector<uint32_t> side{4};
  for (uint32_t i = 1; i <= past + 3; ++i) {
    side.push_back(static_cast<uint32_t>(made.mesh.positions.size()));
    made.mesh.positions.emplace_back(0, kOff * length * i, 1);
  }
  made.face({0, 0, -1}, {{0, 3, 2}, {0, 2, 1}});
  made.face({0, -1, 0}, {{0, 1, 8}, {0, 8, 4}, {1, 5, 8}});
  made.face({1, 0, 0}, {{1, 2, 6}, {1, 6, 5}});
  made.face({0, 1, 0}, {{2, 3, 7}, {2, 7, 6}});
  std::vector<Triangle> left{{3, 0, 4}}, top{{4, 8, 5}, {side.back(), 6, 7}, {side.back(), 5, 6}};
  for (size_t i = 0; i + 1 < side.size(); ++i) {
    left.push_back({3, side[i], side[i + 1]});
    top.push_back({side[i], 5, side[i + 1]});
  }
  left.push_back({3, side.back(), 7});
  made.face({-1, 0, 0}, left);
  made.face({0, 0, 1}, top);
  pair_up(made.mesh);
  return made;
}

TEST(SmallSteps, CornersPassThinTrianglesOneAfterAnother) {
  for (const uint32_t past : {1u, 2u, 9u}) {
    MadeMesh made = beam_with_a_corner_past(past);
    const Defects before = find_defects(made.mesh, made.directions);
    ASSERT_EQ(before.count(), 1u);
    ASSERT_EQ(before.flipped.size(), 1u);
    const RoundedMesh old = made.mesh;
    // One turn makes another triangle that is turned over.
    EXPECT_EQ(turn_longest_edges(made.mesh, before.flipped, made.directions), 0u);
    const auto steps = take_small_steps(made.mesh, offenders(before), 4 * kOff,
                                        kOff * (2 * past + 4), made.directions);
    ASSERT_TRUE(steps) << steps.error().message;
    EXPECT_EQ(steps->turned, past + 1);
    EXPECT_EQ(steps->merged, 0u);
    expect_manifold(made.mesh);
    EXPECT_TRUE(find_defects(made.mesh, made.directions).none());
    EXPECT_LE(one_way_distance(old, made.mesh), steps->farthest);
    EXPECT_LE(one_way_distance(made.mesh, old), steps->farthest);
    EXPECT_LE(steps->farthest, (past + 1) * (past + 2) * kOff);
  }
}

/// A cube whose upper front edge ends in a spike without width, that lies along the next part of
/// this edge: its three triangles cross what is beside it.
MadeMesh cube_with_a_spike() {
  MadeMesh made;
  made.mesh.positions = {{0, 0, 0},
                         {1, 0, 0},
                         {1, 1, 0},
                         {0, 1, 0},
                         {0, 0, 1},
                         {1, 0, 1},
                         {1, 1, 1},
                         {0, 1, 1},
                         {0.5, 0, 1},
                         {0.75, 0, 1},
                         {0.5 - 4 * kOff, kOff / 64, 1 + kOff / 64}};
  made.face({0, 0, -1}, {{0, 3, 2}, {0, 2, 1}});
  made.face({0, -1, 0}, {{0, 1, 8}, {0, 8, 4}, {1, 9, 8}, {1, 5, 9}});
  made.face({1, 0, 0}, {{1, 2, 6}, {1, 6, 5}});
  made.face({0, 1, 0}, {{2, 3, 7}, {2, 7, 6}});
  made.face({-1, 0, 0}, {{3, 0, 4}, {3, 4, 7}});
  made.face({0, 0, 1}, {{4, 8, 7}, {8, 6, 7}, {9, 5, 6}});
  made.face({0, 0, 1}, {{8, 9, 10}});
  made.face({0, 0, 1}, {{9, 6, 10}});
  made.face({0, 0, 1}, {{6, 8, 10}});
  pair_up(made.mesh);
  return made;
}

TEST(SmallSteps, SpikesGo) {
  MadeMesh made = cube_with_a_spike();
  const RoundedMesh old = made.mesh;
  const Defects before = find_defects(made.mesh, made.directions);
  ASSERT_GT(before.count(), 0u);
  const auto steps =
      take_small_steps(made.mesh, offenders(before), kOff, 8 * kOff, made.directions);
  ASSERT_TRUE(steps) << steps.error().message;
  expect_manifold(made.mesh);
  EXPECT_TRUE(find_defects(made.mesh, made.directions).none());
  EXPECT_LE(one_way_distance(old, made.mesh), steps->farthest);
  EXPECT_LE(one_way_distance(made.mesh, old), steps->farthest);
  EXPECT_LE(steps->farthest, 8 * kOff);
}

/// A square plate of n x n cells, 1 apart, and 1 thick, of which corners have been moved.
MadeMesh plate(uint32_t n, double by, std::mt19937& random) {
  MadeMesh made;
  const auto moved = [&] { return by * (static_cast<double>(random() % 201) - 100) / 100; };
  for (int z = 0; z < 2; ++z) {
    for (uint32_t y = 0; y <= n; ++y) {
      for (uint32_t x = 0; x <= n; ++x) {
        // Columns come in twos that are near one another.
        const double at = x % 2 == 0 ? x : x - 1 + by / 4;
        made.mesh.positions.emplace_back(at + moved(), y + moved(), z + moved());
      }
    }
  }
  const uint32_t row = n + 1, level = row * row;
  const auto sheet = [&](uint32_t from, bool reversed) {
    std::vector<Triangle> triangles;
    for (uint32_t y = 0; y < n; ++y) {
      for (uint32_t x = 0; x < n; ++x) {
        const uint32_t a = from + y * row + x, b = a + 1, c = b + row, d = a + row;
        for (Triangle t : {Triangle{a, b, c}, Triangle{a, c, d}}) {
          if (reversed) std::swap(t[1], t[2]);
          triangles.push_back(t);
        }
      }
    }
    return triangles;
  };
  made.face({0, 0, -1}, sheet(0, true));
  made.face({0, 0, 1}, sheet(level, false));
  const auto wall = [&](const glm::dvec3& direction, uint32_t first, uint32_t step) {
    std::vector<Triangle> triangles;
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t a = first + i * step, b = a + step;
      triangles.push_back({a, b, b + level});
      triangles.push_back({a, b + level, a + level});
    }
    made.face(direction, triangles);
  };
  wall({0, -1, 0}, 0, 1);
  wall({1, 0, 0}, n, row);
  wall({0, 1, 0}, level - 1, UINT32_MAX);     // backwards
  wall({-1, 0, 0}, n * row, UINT32_MAX - n);  // by n + 1
  pair_up(made.mesh);
  return made;
}

TEST(SmallSteps, LeaveLessAndTellHowFarTheyMoved) {
  std::mt19937 random(5);
  size_t wrong = 0, left = 0;
  uint64_t turned = 0, merged = 0;
  for (int round = 0; round < 40; ++round) {
    MadeMesh made = plate(5, 0.01 * (1 + round % 5), random);
    const RoundedMesh old = made.mesh;
    const Defects before = find_defects(made.mesh, made.directions);
    const auto steps = take_small_steps(made.mesh, offenders(before), 0.01, 0.16, made.directions);
    ASSERT_TRUE(steps) << steps.error().message;
    const Defects after = find_defects(made.mesh, made.directions);
    expect_manifold(made.mesh);
    EXPECT_LE(after.count(), before.count());
    EXPECT_EQ(made.mesh.triangles.size() + 2 * steps->merged, old.triangles.size());
    EXPECT_EQ(made.mesh.dropped, 2 * steps->merged);
    EXPECT_LE(one_way_distance(old, made.mesh), steps->farthest);
    EXPECT_LE(one_way_distance(made.mesh, old), steps->farthest);
    wrong += before.count();
    left += after.count();
    turned += steps->turned;
    merged += steps->merged;
  }
  EXPECT_GT(wrong, 500u);
  EXPECT_LT(left, wrong / 20);
  EXPECT_GT(turned, 50u);
  EXPECT_GT(merged, 50u);
}

}  // namespace
}  // namespace csgrun::testing::small_steps_test
