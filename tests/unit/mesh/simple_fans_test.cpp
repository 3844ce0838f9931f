// Vertices of surfaces without crowded edges, beside fans joined pair by pair.
#include "engine/mesh/simple_fans.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/base/parallel.h"

namespace csgrun::simple_fans_test {
namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

/// A closed surface: a ring of `sides` points, and two that see all of it.
void add_bipyramid(Triangles& triangles, const std::vector<uint32_t>& ring, uint32_t top,
                   uint32_t bottom) {
  for (size_t i = 0; i < ring.size(); ++i) {
    const uint32_t a = ring[i], b = ring[(i + 1) % ring.size()];
    triangles.push_back({a, b, top});
    triangles.push_back({b, a, bottom});
  }
}

/// In another order, with other first corners.
void shuffle(Triangles& triangles, std::mt19937& random) {
  std::shuffle(triangles.begin(), triangles.end(), random);
  for (auto& t : triangles) std::rotate(t.begin(), t.begin() + random() % 3, t.end());
}

struct Made {
  bool is_simple = false;
  VertexFans fans;
};

Made make(const Triangles& triangles, size_t points) {
  const TriangleSet set{triangles, std::vector<uint32_t>(triangles.size(), 0)};
  PlaneTable planes;
  const CellGeometry geometry(planes, nullptr);
  const BoundaryMesh nothing_untouched;
  const WholeOrder whole(nothing_untouched, geometry);
  CountingOrder by_point;
  by_point.sort(3 * triangles.size(), points, [&](size_t c) { return triangles[c / 3][c % 3]; });
  Made made;
  made.is_simple = make_simple_fans(set, by_point, whole, made.fans);
  return made;
}

/// Corners of one point are of one vertex if an edge joins their triangles, or a chain of such.
VertexFans joined_pair_by_pair(const Triangles& triangles) {
  const auto count = static_cast<uint32_t>(3 * triangles.size());
  std::vector<uint32_t> parent(count);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t c) {
    while (parent[c] != c) c = parent[c];
    return c;
  };
  const auto point = [&](uint32_t c) { return triangles[c / 3][c % 3]; };
  const auto next = [](uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; };
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> leaving;  // corners by their edges' ends
  for (uint32_t c = 0; c < count; ++c) leaving[{point(c), point(next(c))}] = c;
  for (uint32_t c = 0; c < count; ++c) {
    const uint32_t back = leaving.at({point(next(c)), point(c)});
    // The lower root stands for the vertex: its first corner.
    const uint32_t a = root(c), b = root(next(back));
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::array<uint32_t, 2>> vertices;  // points and first corners
  for (uint32_t c = 0; c < count; ++c) {
    if (root(c) == c) vertices.push_back({point(c), c});
  }
  std::sort(vertices.begin(), vertices.end());
  VertexFans fans;
  std::vector<uint32_t> vertex(count);
  for (const auto& [p, c] : vertices) {
    vertex[c] = static_cast<uint32_t>(fans.point_of_vertex.size());
    fans.point_of_vertex.push_back(p);
  }
  for (uint32_t c = 0; c < count; ++c) fans.vertex_of_corner.push_back(vertex[root(c)]);
  return fans;
}

void expect_same(const Triangles& triangles, size_t points) {
  const Made made = make(triangles, points);
  ASSERT_TRUE(made.is_simple);
  const VertexFans expected = joined_pair_by_pair(triangles);
  EXPECT_EQ(made.fans.point_of_vertex, expected.point_of_vertex);
  EXPECT_EQ(made.fans.vertex_of_corner, expected.vertex_of_corner);
}

/// Bipyramids on rings of their own, with tips from a few points: several fans at these.
Triangles with_common_tips(int solids, uint32_t tips, std::mt19937& random, size_t& points) {
  Triangles triangles;
  auto next = tips;
  for (int s = 0; s < solids; ++s) {
    std::vector<uint32_t> ring(3 + random() % (s % 5 == 0 ? 60 : 6));
    std::iota(ring.begin(), ring.end(), next);
    next += static_cast<uint32_t>(ring.size());
    const auto top = static_cast<uint32_t>(random() % tips);
    add_bipyramid(triangles, ring, top, (top + 1) % tips);
  }
  points = next;
  shuffle(triangles, random);
  return triangles;
}

TEST(SimpleFans, AreThoseJoinedPairByPair) {
  std::mt19937 random(5);
  for (int round = 0; round < 60; ++round) {
    size_t points = 0;
    const Triangles triangles = with_common_tips(1 + round % 12, 2 + round % 4, random, points);
    expect_same(triangles, points);
    if (HasFailure()) FAIL() << "round " << round;
  }
}

TEST(SimpleFans, AreTheSameOnSeveralThreads) {
  std::mt19937 random(6);
  size_t points = 0;
  const Triangles triangles = with_common_tips(4000, 300, random, points);
  ASSERT_GT(points, 2 * kFewForThreads);
  const auto before = ThreadsFrame::alone_time();
  ThreadsFrame::set_alone_time(std::chrono::nanoseconds(0));
  with_threads(4, [&] {
    expect_same(triangles, points);
    return 0;
  });
  ThreadsFrame::set_alone_time(before);
}

TEST(SimpleFans, AreNotMadeWhereAnEdgeIsOpenOrCrowded) {
  std::mt19937 random(7);
  for (const uint32_t sides : {3u, 8u, 40u}) {
    std::vector<uint32_t> ring(sides);
    std::iota(ring.begin(), ring.end(), 0u);
    Triangles closed;
    add_bipyramid(closed, ring, sides, sides + 1);
    const size_t points = 2 * sides + 4;
    EXPECT_TRUE(make(closed, points).is_simple);
    for (size_t t = 0; t < closed.size(); ++t) {
      Triangles open = closed, doubled = closed, turned = closed;
      open.erase(open.begin() + static_cast<std::ptrdiff_t>(t));
      doubled.push_back(closed[t]);
      std::swap(turned[t][0], turned[t][1]);
      for (Triangles* wrong : {&open, &doubled, &turned}) {
        shuffle(*wrong, random);
        EXPECT_FALSE(make(*wrong, points).is_simple) << sides << " sides, triangle " << t;
      }
    }
    // Two solids that have an edge in common, and one that goes round twice.
    Triangles crowded = closed;
    std::vector<uint32_t> other{0, 1};
    for (uint32_t p = sides + 4; p < 2 * sides + 2; ++p) other.push_back(p);
    add_bipyramid(crowded, other, sides + 2, sides + 3);
    EXPECT_FALSE(make(crowded, points).is_simple);
    Triangles twice = closed;
    twice.insert(twice.end(), closed.begin(), closed.end());
    EXPECT_FALSE(make(twice, points).is_simple);
  }
}

/// The lower half of an octahedron, the upper half of which is untouched, but for `cut_off` faces
/// that are not there.
struct HalfOctahedron {
  static constexpr uint32_t kBottom = 2;
  static constexpr std::array<uint32_t, 4> kRing{0, 1, 4, 3};  ///< counter-clockwise from above

  explicit HalfOctahedron(uint32_t cut_off) {
    // Explicit points are in their order.
    const std::vector<IVec3> points{{-2, 0, 0}, {0, -2, 0}, {0, 0, -2}, {0, 2, 0}, {2, 0, 0}};
    for (const IVec3& p : points) {
      std::array<uint32_t, 3> named{};
      for (int k = 0; k < 3; ++k) {
        Plane plane{0, 0, 0, -p[static_cast<size_t>(k)]};
        (k == 0 ? plane.a : k == 1 ? plane.b : plane.c) = 1;
        named[static_cast<size_t>(k)] = planes.intern(plane).index();
      }
      boundary.point_planes.push_back(named);
      boundary.point_rounded.push_back(
          {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
      geometry.add_point(named);
    }
    auto leaf = std::make_shared<LeafGeometry>();
    leaf->vertices = points;
    leaf->vertices.push_back({0, 0, 2});
    UntouchedPart part;
    for (uint32_t i = 0; i < 4; ++i) {
      const uint32_t a = kRing[i], b = kRing[(i + 1) % 4];
      leaf->corners.insert(leaf->corners.end(), {a, b, 5});
      leaf->face_starts.push_back(static_cast<uint32_t>(leaf->corners.size()));
      if (i >= cut_off) part.faces.push_back(i);
      lower.push_back({b, a, kBottom});
    }
    for (const uint32_t p : {0u, 1u, 3u, 4u}) part.shared.push_back({p, p});
    part.leaf = std::move(leaf);
    boundary.parts.push_back(std::move(part));
  }

  Made make(const Triangles& triangles) const {
    const TriangleSet set{triangles, std::vector<uint32_t>(triangles.size(), 0)};
    const WholeOrder whole(boundary, geometry);
    CountingOrder by_point;
    by_point.sort(3 * triangles.size(), boundary.point_planes.size(),
                  [&](size_t c) { return triangles[c / 3][c % 3]; });
    Made made;
    made.is_simple = make_simple_fans(set, by_point, whole, made.fans);
    return made;
  }

  PlaneTable planes;
  CellGeometry geometry{planes, nullptr};
  BoundaryMesh boundary;
  Triangles lower;
};

TEST(SimpleFans, EndAtTheRimOfWhatIsUntouched) {
  const HalfOctahedron whole(0);
  const Made made = whole.make(whole.lower);
  ASSERT_TRUE(made.is_simple);
  EXPECT_EQ(made.fans.point_of_vertex, (std::vector<uint32_t>{0, 1, 2, 3, 4}));
  for (size_t c = 0; c < 12; ++c) {
    EXPECT_EQ(made.fans.vertex_of_corner[c], whole.lower[c / 3][c % 3]) << c;
  }
  for (size_t t = 0; t < 4; ++t) {
    Triangles open = whole.lower, doubled = whole.lower;
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(t));
    doubled.push_back(doubled[t]);
    EXPECT_FALSE(whole.make(open).is_simple) << t;
    EXPECT_FALSE(whole.make(doubled).is_simple) << t;
  }
  // One face above is not there: nothing comes back along an edge.
  const HalfOctahedron without(1);
  EXPECT_FALSE(without.make(whole.lower).is_simple);
  Triangles turned = whole.lower;
  std::swap(turned[0][0], turned[0][1]);
  EXPECT_FALSE(whole.make(turned).is_simple);
}

}  // namespace
}  // namespace csgrun::simple_fans_test
