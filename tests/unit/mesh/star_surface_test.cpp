// What is said to be star-shaped crosses nothing; what is, is seen to be.
#include "engine/mesh/star_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "engine/base/parallel.h"
#include "engine/mesh/leaf_check.h"
#include "engine/mesh/opposite_edges.h"

namespace csgrun::star_surface_test {
namespace {

using Vector = std::array<double, 3>;

/// Adds a surface of quadrilaterals in rings from pole to pole, as triangles; `turns`: how often
/// the rings go around the axis before they close; `at`: the place of a longitude, 0 to 2 pi, and a
/// latitude, -pi/2 to pi/2.
void add_rings(LeafGeometry& leaf, int sides, int rings, int turns,
               const std::function<Vector(double, double)>& at) {
  const auto first = static_cast<uint32_t>(leaf.vertices.size());
  const auto add_vertex = [&](double longitude, double latitude) {
    const Vector p = at(longitude, latitude);
    leaf.vertices.push_back({std::llround(p[0]), std::llround(p[1]), std::llround(p[2])});
  };
  const double pi = std::acos(-1.0);
  add_vertex(0, -pi / 2);
  for (int r = 1; r < rings; ++r) {
    for (int s = 0; s < sides; ++s) {
      add_vertex(2 * pi * turns * s / sides, pi * r / rings - pi / 2);
    }
  }
  add_vertex(0, pi / 2);
  const auto last = static_cast<uint32_t>(leaf.vertices.size() - 1);
  const auto vertex = [&](int ring, int side) {
    if (ring == 0) return first;
    if (ring == rings) return last;
    return first + 1 + static_cast<uint32_t>((ring - 1) * sides + side % sides);
  };
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    leaf.corners.insert(leaf.corners.end(), {a, b, c});
    leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
  };
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < sides; ++s) {
      if (r > 0) add(vertex(r, s), vertex(r, s + 1), vertex(r + 1, s + 1));
      if (r + 1 < rings) add(vertex(r, s), vertex(r + 1, s + 1), vertex(r + 1, s));
    }
  }
}

Vector on_sphere(double longitude, double latitude, double radius) {
  return {radius * std::cos(latitude) * std::cos(longitude),
          radius * std::cos(latitude) * std::sin(longitude), radius * std::sin(latitude)};
}

LeafGeometry ball(double radius, const Vector& centre = {0, 0, 0}) {
  LeafGeometry leaf;
  add_rings(leaf, 24, 12, 1, [&](double a, double b) {
    Vector p = on_sphere(a, b, radius);
    for (size_t k = 0; k < 3; ++k) p[k] += centre[k];
    return p;
  });
  return leaf;
}

void turn_inside_out(LeafGeometry& leaf) {
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    std::swap(leaf.corners[3 * f], leaf.corners[3 * f + 1]);
  }
}

/// As required: distinct vertices, no degenerate face, balanced edges.
bool is_sound(const LeafGeometry& leaf) {
  if (std::set<IVec3>(leaf.vertices.begin(), leaf.vertices.end()).size() != leaf.vertices.size()) {
    return false;
  }
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    const IVec3 &a = leaf.vertices[leaf.corners[3 * f]],
                &b = leaf.vertices[leaf.corners[3 * f + 1]],
                &c = leaf.vertices[leaf.corners[3 * f + 2]];
    bool any = false;
    for (size_t k = 0; k < 3; ++k) {
      const size_t u = (k + 1) % 3, v = (k + 2) % 3;
      any |= (b[u] - a[u]) * (c[v] - a[v]) != (b[v] - a[v]) * (c[u] - a[u]);
    }
    if (!any) return false;
  }
  return pair_edges(leaf).is_balanced;
}

TEST(StarSurface, IsSeenWithACentreFarFromTheMiddle) {
  EXPECT_TRUE(is_star_surface(ball(1000)));
  EXPECT_TRUE(is_star_surface(ball(1 << 24, {1e7, -2e7, 3e7})));
  // Spikes of up to fifteen times the radius, in a part of all directions.
  LeafGeometry leaf;
  add_rings(leaf, 60, 40, 1, [](double a, double b) {
    const double spike = std::max(0.0, std::cos(a) * std::cos(b) - 0.8);
    return on_sphere(a, b, 1e5 * (1 + 350 * spike * spike + 0.1 * std::sin(7 * a) * std::cos(b)));
  });
  ASSERT_TRUE(is_sound(leaf));
  EXPECT_TRUE(is_star_surface(leaf));
  turn_inside_out(leaf);
  EXPECT_FALSE(is_star_surface(leaf));
}

TEST(StarSurface, IsNotWhatWindsTwice) {
  // All faces look away from the middle, every edge is paired, yet the surface goes around twice.
  LeafGeometry twice;
  add_rings(twice, 25, 12, 2, [](double a, double b) { return on_sphere(a, b, 1e6); });
  ASSERT_TRUE(is_sound(twice));
  EXPECT_FALSE(find_self_intersections(twice).empty());
  EXPECT_FALSE(is_star_surface(twice));
  LeafGeometry nested = ball(1000);
  add_rings(nested, 24, 12, 1, [](double a, double b) { return on_sphere(a, b, 2000); });
  ASSERT_TRUE(is_sound(nested));
  EXPECT_TRUE(find_self_intersections(nested).empty());
  EXPECT_FALSE(is_star_surface(nested));
  EXPECT_FALSE(check_surface(nested).bounds_solid);
}

TEST(StarSurface, IsNotTwoBodies) {
  LeafGeometry leaf = ball(1000);
  add_rings(leaf, 24, 12, 1, [](double a, double b) {
    Vector p = on_sphere(a, b, 1000);
    p[0] += 2500;
    return p;
  });
  EXPECT_FALSE(is_star_surface(leaf));
}

TEST(StarSurface, RaysThroughEdgesCrossOnce) {
  // The middle of the box is half a step off planes of symmetry that have edges.
  for (const int sides : {20, 24, 32}) {
    for (const double radius : {97.0, 1000.0, 4096.0}) {
      LeafGeometry leaf;
      add_rings(leaf, sides, 8, 1, [&](double a, double b) { return on_sphere(a, b, radius); });
      ASSERT_TRUE(is_sound(leaf));
      EXPECT_TRUE(is_star_surface(leaf));
      for (IVec3& p : leaf.vertices) std::swap(p[0], p[2]);
      turn_inside_out(leaf);
      EXPECT_TRUE(is_star_surface(leaf));
    }
  }
}

TEST(StarSurface, CrossesNothing) {
  // Crumpled more and more; in small coordinates faces also touch.
  std::mt19937 random(5);
  size_t stars = 0, crossed = 0;
  for (int round = 0; round < 400; ++round) {
    const double radius = round % 2 == 0 ? 60 : 1 << 22;
    std::uniform_real_distribution<double> factor(1 - 0.003 * (round % 100), 1);
    LeafGeometry leaf;
    add_rings(leaf, 16, 10, round % 7 == 0 ? 2 : 1,
              [&](double a, double b) { return on_sphere(a, b, radius * factor(random)); });
    const double push = radius * (round % 5) / 60;
    std::uniform_real_distribution<double> shift(-push, push);
    for (IVec3& p : leaf.vertices) {
      for (int64_t& x : p) x += std::llround(shift(random));
    }
    if (!is_sound(leaf)) continue;
    const bool crosses = !find_self_intersections(leaf).empty();
    crossed += crosses ? 1 : 0;
    const bool is_star = is_star_surface(leaf);
    stars += is_star ? 1 : 0;
    EXPECT_EQ(with_threads(2, [&] { return is_star_surface(leaf); }), is_star);
    EXPECT_FALSE(is_star && crosses);
  }
  EXPECT_GT(stars, 60u);
  EXPECT_GT(crossed, 40u);
}

}  // namespace
}  // namespace csgrun::star_surface_test
