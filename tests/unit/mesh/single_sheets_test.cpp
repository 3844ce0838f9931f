// Faces that meet must be named, whatever else is; few others are.
#include "engine/mesh/single_sheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "engine/bsp/corner_walk.h"
#include "engine/mesh/leaf_check.h"
#include "engine/mesh/opposite_edges.h"

namespace csgrun::single_sheets_test {
namespace {

using Map = std::function<std::array<double, 3>(const std::array<double, 3>&)>;

/// Adds the surface of a cube, each side divided into size x size squares of two triangles, its
/// points p of [-1, 1]^3 mapped to map(p) and rounded.
void add_cube(LeafGeometry& leaf, int size, const Map& map) {
  std::map<IVec3, uint32_t> number;
  const auto vertex = [&](const IVec3& at) {
    const auto [known, is_new] = number.try_emplace(at, leaf.vertices.size());
    if (is_new) {
      std::array<double, 3> p{};
      for (size_t k = 0; k < 3; ++k) p[k] = 2.0 * static_cast<double>(at[k]) / size - 1;
      const auto q = map(p);
      leaf.vertices.push_back({std::lround(q[0]), std::lround(q[1]), std::lround(q[2])});
    }
    return known->second;
  };
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    leaf.corners.insert(leaf.corners.end(), {a, b, c});
    leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
  };
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const bool top : {false, true}) {
      const size_t u = top ? (axis + 1) % 3 : (axis + 2) % 3, v = 3 - axis - u;
      for (int i = 0; i < size; ++i) {
        for (int j = 0; j < size; ++j) {
          const auto at = [&](int x, int y) {
            IVec3 p{};
            p[axis] = top ? size : 0;
            p[u] = i + x;
            p[v] = j + y;
            return vertex(p);
          };
          add(at(0, 0), at(1, 0), at(1, 1));
          add(at(0, 0), at(1, 1), at(0, 1));
        }
      }
    }
  }
}

std::array<double, 3> on_sphere(const std::array<double, 3>& p, double radius) {
  const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  return {radius * p[0] / length, radius * p[1] / length, radius * p[2] / length};
}

/// Whether vertices are distinct and no face is degenerate, as is required.
bool is_sound(const LeafGeometry& leaf) {
  if (std::set<IVec3>(leaf.vertices.begin(), leaf.vertices.end()).size() != leaf.vertices.size()) {
    return false;
  }
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    std::array<IVec3, 3> p;
    for (size_t i = 0; i < 3; ++i) p[i] = leaf.vertices[leaf.corners[3 * f + i]];
    bool any = false;
    for (size_t k = 0; k < 3; ++k) {
      const size_t u = (k + 1) % 3, v = (k + 2) % 3;
      any = any ||
            (p[1][u] - p[0][u]) * (p[2][v] - p[0][v]) != (p[1][v] - p[0][v]) * (p[2][u] - p[0][u]);
    }
    if (!any) return false;
  }
  return true;
}

/// The number of faces that meet others. Each must be named.
size_t expect_named(const LeafGeometry& leaf) {
  const auto named = faces_off_single_sheets(leaf);
  const auto crossings = find_self_intersections(leaf);
  EXPECT_EQ(check_surface(leaf).crossings, crossings);
  std::set<uint32_t> met;
  for (const auto& pair : crossings) met.insert(pair.begin(), pair.end());
  if (named) {
    EXPECT_TRUE(std::is_sorted(named->begin(), named->end()));
    EXPECT_TRUE(std::includes(named->begin(), named->end(), met.begin(), met.end()));
  }
  return met.size();
}

// Two spheres that share a vertex have two fans there.
TEST(SingleSheets, PinchedVerticesAreSeen) {
  constexpr int64_t kRadius = 1 << 24;
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const int64_t apart : {0, 1}) {
      LeafGeometry leaf;
      add_cube(leaf, 40, [](const auto& p) { return on_sphere(p, kRadius); });
      add_cube(leaf, 20, [&](const auto& p) {
        auto q = on_sphere(p, kRadius);
        q[axis] += static_cast<double>(2 * kRadius + apart);
        return q;
      });
      IVec3 pole{0, 0, 0};
      pole[axis] = kRadius;
      std::vector<uint32_t> there;
      for (uint32_t v = 0; v < leaf.vertices.size(); ++v) {
        if (leaf.vertices[v] == pole) there.push_back(v);
      }
      ASSERT_EQ(there.size(), apart == 0 ? 2u : 1u);
      std::replace(leaf.corners.begin(), leaf.corners.end(), there.back(), there.front());
      leaf.opposite = pair_edges(leaf).opposite;
      ASSERT_FALSE(leaf.opposite.empty());
      EXPECT_TRUE(faces_off_single_sheets(leaf));
      const SurfaceCheck check = check_surface(leaf);
      EXPECT_TRUE(check.crossings.empty());
      EXPECT_TRUE(check.bounds_solid);
      EXPECT_FALSE(check.connected);
      EXPECT_EQ(check.has_single_fans, apart == 1);
      EXPECT_EQ(find_vertices_of_fans(leaf).empty(), apart == 1);
    }
  }
}

TEST(SingleSheets, MostOfASphereIsOne) {
  LeafGeometry leaf;
  add_cube(leaf, 40, [](const auto& p) { return on_sphere(p, 1 << 24); });
  const auto named = faces_off_single_sheets(leaf);
  ASSERT_TRUE(named);
  EXPECT_LT(named->size(), leaf.face_count() / 4);
  EXPECT_EQ(expect_named(leaf), 0u);
  EXPECT_TRUE(check_surface(leaf).bounds_solid);
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    std::swap(leaf.corners[3 * f], leaf.corners[3 * f + 1]);
  }
  EXPECT_EQ(faces_off_single_sheets(leaf), named);
  EXPECT_FALSE(check_surface(leaf).bounds_solid);
}

TEST(SingleSheets, FacesOfCrumpledSpheresAreNamed) {
  std::mt19937 random(3);
  size_t tried = 0, crossed = 0, plain = 0, some = 0;
  for (int round = 0; round < 60; ++round) {
    const double radius = round % 3 == 0 ? 300 : 1 << 20, edge = 2 * radius / 40;
    const double noise = edge * (round % 10) / 20;
    std::uniform_real_distribution<double> shift(-noise, noise);
    LeafGeometry leaf;
    add_cube(leaf, 40, [&](const auto& p) {
      auto q = on_sphere(p, radius);
      for (double& x : q) x += shift(random);
      return q;
    });
    if (!is_sound(leaf)) continue;
    ++tried;
    (expect_named(leaf) > 0 ? crossed : plain) += 1;
    const auto named = faces_off_single_sheets(leaf);
    some += named && named->size() < leaf.face_count();
  }
  EXPECT_GT(tried, 40u);
  EXPECT_GT(crossed, 10u);
  EXPECT_GT(plain, 10u);
  EXPECT_GT(some, 20u);
}

TEST(SingleSheets, FacesOfBodiesInEachOtherAreNamed) {
  // Beside each other, one in the other facing the same way or not, through each other, by less
  // than a face or by more; in small coordinates also touching.
  std::mt19937 random(8);
  size_t crossed = 0, plain = 0, some = 0;
  for (int round = 0; round < 60; ++round) {
    const double radius = round % 2 == 0 ? 300 : 1 << 20;
    std::uniform_real_distribution<double> unit(-1, 1);
    const double other = radius * (1 + unit(random) * unit(random) / 4);
    const double reach = round % 4 < 2 ? 0.1 : 2.2;
    const std::array<double, 3> to{reach * radius * unit(random), reach * radius * unit(random),
                                   reach * radius * unit(random)};
    LeafGeometry leaf;
    add_cube(leaf, 36, [&](const auto& p) { return on_sphere(p, radius); });
    add_cube(leaf, 36, [&](const auto& p) {
      const auto q = on_sphere(p, round % 8 == 5 ? -other : other);
      return std::array<double, 3>{q[0] + to[0], q[1] + to[1], q[2] + to[2]};
    });
    if (!is_sound(leaf)) continue;
    (expect_named(leaf) > 0 ? crossed : plain) += 1;
    const auto named = faces_off_single_sheets(leaf);
    some += named && named->size() < leaf.face_count();
  }
  EXPECT_GT(crossed, 10u);
  EXPECT_GT(plain, 10u);
  EXPECT_GT(some, 25u);
}

TEST(SingleSheets, SheetsThatTouchAreNamed) {
  // A slot between flat walls, one of which has a pin that ends before the other one, at it, or
  // behind it. Walls in planes between cubes and lines through edges are common here.
  for (const int tip : {-1, 0, 1}) {
    for (const bool is_turned : {false, true}) {
      LeafGeometry leaf;
      add_cube(leaf, 32, [&](const auto& p) {
        std::array<double, 3> q{320 * p[0], 320 * p[1], 40 * p[2]};
        if (std::fabs(p[0] - 0.5) < 0.01 && std::fabs(p[1]) < 0.01 && p[2] == 1) q[2] += 60 + tip;
        return is_turned ? std::array<double, 3>{q[1], q[2], q[0]} : q;
      });
      add_cube(leaf, 32, [&](const auto& p) {
        const std::array<double, 3> q{320 * p[0] + 7, 320 * p[1] + 4, 130 + 30 * p[2]};
        return is_turned ? std::array<double, 3>{q[1], q[2], q[0]} : q;
      });
      ASSERT_TRUE(is_sound(leaf));
      EXPECT_EQ(expect_named(leaf) > 0, tip >= 0) << tip;
    }
  }
}

TEST(SingleSheets, FacesThatNoLineCrossesAreNamed) {
  // A step whose wall is folded: seen from above it is a line.
  for (const int up : {1, -1}) {
    LeafGeometry leaf;
    add_cube(leaf, 40, [&](const auto& p) {
      const auto i = static_cast<int>(std::lround(20 * (p[0] + 1)));
      if (p[2] * up < 1) return std::array<double, 3>{16.0 * i + 5, 320 * p[1], 100 * p[2]};
      const double wall = i == 21 ? 130 : i == 22 ? 115 : 150;
      return std::array<double, 3>{16.0 * (i <= 20 ? i : std::max(20, i - 3)), 320 * p[1],
                                   up * (i <= 20 ? 100 : wall)};
    });
    ASSERT_TRUE(is_sound(leaf));
    EXPECT_GT(expect_named(leaf), 80u);
    EXPECT_LT(faces_off_single_sheets(leaf)->size(), leaf.face_count() / 3);
  }
}

TEST(SingleSheets, AreTheSameForAnyNumberOfThreads) {
  LeafGeometry leaf;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-20000, 20000);
  add_cube(leaf, 80, [&](const auto& p) {
    auto q = on_sphere(p, 1 << 20);
    for (double& x : q) x += shift(random);
    return q;
  });
  ASSERT_GT(leaf.face_count(), 4u * 16384);
  const auto expected = faces_off_single_sheets(leaf);
  ASSERT_TRUE(expected);
  EXPECT_GT(expected->size(), 0u);
  EXPECT_LT(expected->size(), leaf.face_count());
  for (const int threads : {1, 2, 5}) {
    tbb::task_arena arena(threads);
    EXPECT_EQ(arena.execute([&] { return faces_off_single_sheets(leaf); }), expected);
  }
}

TEST(SingleSheets, LeavesOfLongOrFewFacesAreLeftToOthers) {
  LeafGeometry few, unequal;
  add_cube(few, 12, [](const auto& p) { return on_sphere(p, 1 << 20); });
  EXPECT_FALSE(faces_off_single_sheets(few));
  // A small body beside a large one, each of whose faces reaches too many cubes.
  add_cube(unequal, 40, [](const auto& p) { return on_sphere(p, 1 << 20); });
  add_cube(unequal, 1, [](const auto& p) {
    const double unit = 1 << 26;
    return std::array<double, 3>{unit * (p[0] - p[1]), unit * (p[0] + p[1] - p[2]),
                                 unit * (p[2] + p[0] + 4)};
  });
  ASSERT_TRUE(is_sound(unequal));
  EXPECT_FALSE(faces_off_single_sheets(unequal));
  EXPECT_EQ(expect_named(unequal), 0u);
}

}  // namespace
}  // namespace csgrun::single_sheets_test
