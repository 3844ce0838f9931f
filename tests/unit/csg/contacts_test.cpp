// Solids that touch in edges and vertices, kept apart or joined: components and genus known by
// hand.
#include <functional>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>

#include "test_meshes.h"

namespace csgrun::contacts_test {
namespace {

using namespace testing;

/// Every directed edge once, its reverse once, one fan of triangles around each vertex.
void expect_manifold(const Solid& solid) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t>
      next;  // (vertex, corner before) -> corner after
  std::vector<uint32_t> degree(solid.positions.size(), 0);
  for (const auto& t : solid.triangles) {
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      EXPECT_TRUE(next.emplace(std::pair(a, b), c).second) << "an edge twice";
      ++degree[a];
    }
  }
  for (const auto& [edge, corner] : next) EXPECT_TRUE(next.contains({edge.second, edge.first}));
  for (const auto& [edge, corner] : next) {
    uint32_t steps = 1, at = corner;
    for (; at != edge.second && steps <= degree[edge.first]; ++steps) at = next[{edge.first, at}];
    EXPECT_EQ(steps, degree[edge.first]) << "a vertex of several fans";
  }
}

struct Counts {
  int64_t components, genus;
};

void expect_counts(const NodePtr& root, Counts apart, Counts joined, const std::string& what) {
  const SolidPtr a = solid_of(root, false), b = solid_of(root, true);
  expect_manifold(*a);
  expect_manifold(*b);
  EXPECT_EQ(a->measures.components, apart.components) << what;
  EXPECT_EQ(a->measures.genus, apart.genus) << what;
  EXPECT_EQ(b->measures.components, joined.components) << what;
  EXPECT_EQ(b->measures.genus, joined.genus) << what;
  EXPECT_EQ(a->measures.volume, b->measures.volume) << what;
  EXPECT_EQ(a->measures.area, b->measures.area) << what;
  EXPECT_EQ(a->canonical_hash, b->canonical_hash) << what;
}

/// Unit cubes with their lowest corners at these places.
NodePtr cubes(const std::vector<std::array<int, 3>>& places) {
  std::vector<NodePtr> all;
  for (const auto& p : places) {
    all.push_back(box({p[0], p[1], p[2]}, {p[0] + 1, p[1] + 1, p[2] + 1}));
  }
  return unite(all);
}

TEST(Contacts, TwoCubes) {
  expect_counts(cubes({{0, 0, 0}, {1, 1, 0}}), {2, 0}, {1, 0}, "one edge");
  expect_counts(cubes({{0, 0, 0}, {1, 1, 1}}), {2, 0}, {2, 0}, "one vertex");
  expect_counts(cubes({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}), {3, 0}, {1, 0}, "two edges");
  // Part of an edge, and edges of a different length.
  expect_counts(unite({cube(1), box({1, 1, 0.25}, {2, 2, 0.75})}), {2, 0}, {1, 0}, "inner part");
  expect_counts(unite({cube(1), box({1, 1, 0.25}, {2, 2, 7})}), {2, 0}, {1, 0}, "overlapping part");
  // Two parts of one edge are two joints.
  expect_counts(unite({cube(10), box({10, 10, 1}, {12, 12, 3}), box({10, 10, 5}, {12, 12, 6})}),
                {3, 0}, {1, 0}, "two on one edge");
  // On a vertex and on an edge that runs on: the joint between the two ends of the longer edge.
  const SolidPtr joined = solid_of(cubes({{0, 0, 0}, {1, 1, 0}}), true);
  EXPECT_EQ(joined->positions.size(), 16u);  // 14 and the middle of the joint twice
  EXPECT_EQ(joined->triangles.size(), 28u);
}

TEST(Contacts, RingsAndBoards) {
  expect_counts(cubes({{1, 0, 0}, {0, 1, 0}, {1, 2, 0}, {2, 1, 0}}), {4, 0}, {1, 1}, "ring");
  // Joints of a checkerboard: as many as there are inner corners.
  for (const int n : {3, 4, 5}) {
    std::vector<std::array<int, 3>> places;
    for (int x = 0; x < n; ++x) {
      for (int y = 0; y < n; ++y) {
        if ((x + y) % 2 == 0) places.push_back({x, y, 0});
      }
    }
    const auto count = static_cast<int64_t>(places.size());
    const int64_t joints = (n - 1) * (n - 1);
    expect_counts(cubes(places), {count, 0}, {1, joints - count + 1}, "board");
  }
  // Four cubes of eight: six edges that meet in one point, around which all is one ball.
  const NodePtr eighths = cubes({{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}});
  expect_counts(eighths, {4, 0}, {1, 0}, "four of eight");
  expect_counts(subtract({box({0, 0, 0}, {2, 2, 2}), eighths}), {4, 0}, {1, 0}, "the other four");
}

TEST(Contacts, WithinOneSolid) {
  const NodePtr legs = cubes({{0, 0, 0}, {1, 1, 0}});
  expect_counts(unite({legs, box({0, 0, 1}, {2, 2, 2})}), {1, 0}, {1, 0}, "two legs");
  // Two posts between plates, connected around both ends of their contact: a manifold by index has
  // no two edges with the same ends, so the gap is closed either way.
  expect_counts(unite({legs, box({0, 0, 1}, {2, 2, 2}), box({0, 0, -1}, {2, 2, 0})}), {1, 0},
                {1, 0}, "two posts");
  // Voids that touch in an edge: joined is the material, so that the voids part.
  const NodePtr voids = subtract({box({-1, -1, -1}, {3, 3, 3}), legs});
  expect_counts(voids, {3, 0}, {3, 0}, "voids");
}

TEST(Contacts, FacesThatRunThrough) {
  // A wedge that stands on the diagonal of a face, whichever way that face is divided.
  for (const bool other : {false, true}) {
    PolygonMesh wedge;
    wedge.points = {{0, 0, 1}, {2, 2, 1}, {0, 2, 3}, {2, 0, 3}};
    if (other) wedge.points = {{2, 0, 1}, {0, 2, 1}, {0, 0, 3}, {2, 2, 3}};
    for (const auto& face : std::initializer_list<std::array<uint32_t, 3>>{
             {0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
      wedge.add_face(face);
    }
    const NodePtr both = unite({box({0, 0, 0}, {2, 2, 1}), leaf(wedge, FillRule::kNonZero)});
    expect_counts(both, {2, 0}, {2, 0}, "diagonal");
  }
}

/// Cubes of a lattice, and the topology of their joined surface, counted square by square.
struct Lattice {
  static constexpr int kSize = 4;
  std::set<std::array<int, 3>> full;

  [[nodiscard]] bool at(const std::array<int, 3>& p) const { return full.contains(p); }

  /// A unit square: across `axis`, below the cell `cell`.
  using Square = std::pair<int, std::array<int, 3>>;
  /// Calls join(s, t) for each pair of squares that are neighbours across a unit edge: along `axis`
  /// from the lowest corner of `cell`.
  template <class Join>
  void around(const std::array<int, 3>& cell, int axis, Join join) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<std::array<int, 3>, 4> quadrant{cell, cell, cell, cell};  // counter-clockwise
    --quadrant[1][u], --quadrant[2][u], --quadrant[2][v], --quadrant[3][v];
    // Between quadrants i and i + 1.
    const std::array<Square, 4> squares{Square{u, quadrant[0]}, Square{v, quadrant[1]},
                                        Square{u, quadrant[3]}, Square{v, quadrant[0]}};
    std::vector<int> real;
    for (int i = 0; i < 4; ++i) {
      if (at(quadrant[i]) != at(quadrant[(i + 1) % 4])) real.push_back(i);
    }
    if (real.size() == 2) join(squares[real[0]], squares[real[1]]);
    if (real.size() != 4) return;
    for (int i = 0; i < 4; ++i) {
      if (!at(quadrant[i])) join(squares[(i + 3) % 4], squares[i]);
    }
  }

  [[nodiscard]] Counts joined() const {
    std::map<Square, Square> parent;
    const std::function<Square(Square)> root = [&](const Square& s) {
      const Square p = parent.try_emplace(s, s).first->second;
      return p == s ? s : parent[s] = root(p);
    };
    int64_t faces = 0, edges = 0, vertices = 0;
    const auto each = [&](auto visit) {
      for (int x = -1; x <= kSize + 1; ++x) {
        for (int y = -1; y <= kSize + 1; ++y) {
          for (int z = -1; z <= kSize + 1; ++z) visit(std::array<int, 3>{x, y, z});
        }
      }
    };
    each([&](const std::array<int, 3>& cell) {
      for (int axis = 0; axis < 3; ++axis) {
        std::array<int, 3> below = cell;
        --below[axis];
        if (at(cell) != at(below)) ++faces, root({axis, cell});
        around(cell, axis, [&](const Square& s, const Square& t) {
          ++edges;
          parent[root(s)] = root(t);
        });
      }
      // The fans around the lowest corner of the cell.
      std::map<Square, std::vector<Square>> next;
      for (int axis = 0; axis < 3; ++axis) {
        for (int step = -1; step <= 0; ++step) {
          std::array<int, 3> from = cell;
          from[axis] += step;
          around(from, axis, [&](const Square& s, const Square& t) {
            next[s].push_back(t);
            next[t].push_back(s);
          });
        }
      }
      std::set<Square> seen;
      for (const auto& [start, neighbours] : next) {
        if (seen.contains(start)) continue;
        ++vertices;
        std::vector<Square> stack{start};
        while (!stack.empty()) {
          const Square s = stack.back();
          stack.pop_back();
          if (!seen.insert(s).second) continue;
          for (const Square& t : next[s]) stack.push_back(t);
        }
      }
    });
    int64_t components = 0;
    for (const auto& [s, p] : parent) components += s == p;
    return {components, components - (vertices - edges + faces) / 2};
  }
};

TEST(Contacts, RandomComplexesAgreeWithTheLattice) {
  std::mt19937 random(5);
  for (int round = 0; round < 60; ++round) {
    Lattice lattice;
    std::vector<std::array<int, 3>> places;
    for (int x = 0; x < Lattice::kSize; ++x) {
      for (int y = 0; y < Lattice::kSize; ++y) {
        for (int z = 0; z < 3; ++z) {
          if (random() % 5 < 2) places.push_back({x, y, z});
        }
      }
    }
    if (places.empty()) continue;
    lattice.full.insert(places.begin(), places.end());
    const SolidPtr joined = solid_of(cubes(places), true);
    expect_manifold(*joined);
    const Counts expected = lattice.joined();
    EXPECT_EQ(joined->measures.components, expected.components) << "round " << round;
    EXPECT_EQ(joined->measures.genus, expected.genus) << "round " << round;
    std::shuffle(places.begin(), places.end(), random);
    const SolidPtr again = solid_of(cubes(places), true);
    EXPECT_EQ(joined->triangles, again->triangles);
    EXPECT_EQ(joined->positions, again->positions);
  }
}

}  // namespace
}  // namespace csgrun::contacts_test
