// Solids that touch in parts of edges and within faces: the written triangles meet in corners and
// edges that both have, by coordinates, or nowhere.
#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/engine/exact_triangles.h>

#include "engine/mesh/box_frame.h"
#include "test_meshes.h"

namespace csgrun::conform_test {
namespace {

using namespace testing;

/// Pairs of triangles that meet other than in corners and edges with equal coordinates.
size_t crossings_by_place(const Solid& solid) {
  const auto before = [](const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::map<glm::dvec3, uint32_t, decltype(before)> first(before);
  for (uint32_t v = 0; v < solid.positions.size(); ++v) first.try_emplace(solid.positions[v], v);
  std::vector<std::array<uint32_t, 3>> triangles = solid.triangles;
  for (auto& t : triangles) {
    for (uint32_t& v : t) v = first.at(solid.positions[v]);
  }
  return find_crossings({solid.positions, triangles}, 1000).size();
}

void expect_complex(const NodePtr& root, double volume, int64_t components,
                    const std::string& what) {
  for (const bool join : {false, true}) {
    const SolidPtr solid = solid_of(root, join);
    EXPECT_EQ(crossings_by_place(*solid), 0u) << what;
    EXPECT_NEAR(solid->measures.volume, volume, 1e-12 * volume) << what;
    if (join) continue;
    EXPECT_EQ(solid->measures.components, components) << what;
  }
}

struct Tetrahedron {
  NodePtr solid;
  double volume;
};

/// Turned outwards if need be.
Tetrahedron tetrahedron(std::array<glm::dvec3, 4> p) {
  PolygonMesh mesh;
  mesh.points.assign(p.begin(), p.end());
  const glm::dvec3 u = p[1] - p[0], v = p[2] - p[0], w = p[3] - p[0];
  const double det =
      u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) + u.z * (v.x * w.y - v.y * w.x);
  for (std::array<uint32_t, 3> face :
       std::initializer_list<std::array<uint32_t, 3>>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    if (det < 0) std::swap(face[0], face[1]);
    mesh.add_face(face);
  }
  return {leaf(mesh, FillRule::kNonZero), std::abs(det) / 6};
}

TEST(Conform, PartsOfEdges) {
  expect_complex(unite({cube(1), box({1, 1, -1}, {2, 2, 2})}), 4, 2, "a longer edge");
  expect_complex(unite({cube(1), box({1, 1, 0.5}, {2, 2, 1.5})}), 2, 2, "overlapping edges");
  expect_complex(unite({box({0, 0, 0}, {1, 1, 2}), box({1, 0, 2}, {4, 3, 3})}), 11, 2,
                 "crossing ends");
}

TEST(Conform, CornersAndEdgesWithinFaces) {
  const NodePtr base = cube(12);
  const auto stands = [&](const std::vector<Tetrahedron>& on, const std::string& what) {
    std::vector<NodePtr> parts{base};
    double volume = 1728;
    for (const Tetrahedron& t : on) parts.push_back(t.solid), volume += t.volume;
    expect_complex(unite(parts), volume, static_cast<int64_t>(parts.size()), what);
  };
  const Tetrahedron apex = tetrahedron({{{4, 4, 12}, {3, 3, 15}, {6, 3, 15}, {3, 6, 15}}});
  stands({apex}, "an apex on a face");
  const Tetrahedron ridge = tetrahedron({{{7, 7, 12}, {11, 8, 12}, {7, 11, 15}, {9, 6, 15}}});
  stands({ridge}, "an edge on a face");
  stands({apex, ridge}, "both");
  stands({tetrahedron({{{4, 4, 12}, {20, 5, 12}, {4, 8, 15}, {6, 3, 15}}})}, "over the rim");
  stands({tetrahedron({{{-3, 5, 12}, {15, 5, 12}, {2, 9, 15}, {2, 2, 15}}})}, "from rim to rim");
  stands({tetrahedron({{{-4, 4, 12}, {4, -4, 12}, {9, 9, 15}, {2, 2, 15}}})}, "through a corner");
}

TEST(Conform, EdgesThatCross) {
  // Two ridges, one upside down, crosswise.
  const Tetrahedron lower = tetrahedron({{{-4, 0, 0}, {4, 0, 0}, {0, 3, -5}, {0, -3, -5}}});
  const Tetrahedron upper = tetrahedron({{{1, -4, 0}, {1, 4, 0}, {4, 0, 5}, {-2, 0, 5}}});
  const double volume = lower.volume + upper.volume;
  expect_complex(unite({lower.solid, upper.solid}), volume, 2, "two ridges");
  const NodePtr block = box({-9, -9, -9}, {9, 9, 9});
  expect_complex(subtract({block, lower.solid, upper.solid}), 5832 - volume, 3, "two voids");
}

TEST(Conform, VoidsThatTouchTheSurface) {
  expect_complex(subtract({cube(10), box({2, 2, 2}, {4, 4, 4}), box({4, 4, 3}, {7, 7, 6})}), 965, 3,
                 "voids with a common edge");
  const Tetrahedron below = tetrahedron({{{3, 3, 10}, {6, 4, 10}, {4, 6, 6}, {6, 2, 6}}});
  expect_complex(subtract({cube(10), below.solid}), 1000 - below.volume, 2, "an edge below a face");
}

/// Long, and aslant: the directions are (2, 14, 5), (10, -5, 10) and (11, 2, -10).
glm::dvec3 aslant(const glm::dvec3& p) {
  const double x = 12 * p.x;
  return {2 * x + 10 * p.y + 11 * p.z, 14 * x - 5 * p.y + 2 * p.z, 5 * x + 10 * p.y - 10 * p.z};
}

Tetrahedron tetrahedron_aslant(std::array<glm::dvec3, 4> p) {
  for (glm::dvec3& q : p) q = aslant(q);
  return tetrahedron(p);
}

NodePtr block_aslant(double size) {
  PolygonMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.points.push_back(aslant({size * (i & 1), size * (i >> 1 & 1), size * (i >> 2)}));
  }
  for (const std::array<uint32_t, 4>& face : std::initializer_list<std::array<uint32_t, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.add_face(face);
  }
  return leaf(mesh, FillRule::kNonZero);
}

TEST(Conform, LongPartsAslant) {
  const double volume = 12.0 * 3375 * 1728;
  const auto stands = [&](const std::vector<Tetrahedron>& on, const std::string& what) {
    std::vector<NodePtr> parts{block_aslant(12)};
    double all = volume;
    for (const Tetrahedron& t : on) parts.push_back(t.solid), all += t.volume;
    const NodePtr root = unite(parts);
    expect_complex(root, all, static_cast<int64_t>(parts.size()), what);
    std::vector<std::array<Vec3d, 3>> triangles;
    const SolidPtr solid = solid_of(root, false);
    for (const auto& t : solid->triangles) {
      auto& corners = triangles.emplace_back();
      for (size_t i = 0; i < 3; ++i) {
        const glm::dvec3& p = solid->positions[t[i]];
        corners[i] = {p.x, p.y, p.z};
      }
    }
    EXPECT_TRUE(find_box_frame(triangles)) << what;
  };
  const Tetrahedron apex = tetrahedron_aslant({{{4, 4, 12}, {3, 3, 15}, {6, 3, 15}, {3, 6, 15}}});
  stands({apex}, "an apex on a face");
  const Tetrahedron ridge =
      tetrahedron_aslant({{{7, 7, 12}, {11, 8, 12}, {7, 11, 15}, {9, 6, 15}}});
  stands({ridge}, "an edge on a face");
  stands({apex, ridge}, "both");
  stands({tetrahedron_aslant({{{4, 4, 12}, {20, 5, 12}, {4, 8, 15}, {6, 3, 15}}})}, "over the rim");
  stands({tetrahedron_aslant({{{-3, 5, 12}, {15, 5, 12}, {2, 9, 15}, {2, 2, 15}}})},
         "from rim to rim");
  stands({tetrahedron_aslant({{{-4, 4, 12}, {4, -4, 12}, {9, 9, 15}, {2, 2, 15}}})},
         "through a corner");
  const Tetrahedron below = tetrahedron_aslant({{{3, 3, 12}, {6, 4, 12}, {4, 6, 6}, {6, 2, 6}}});
  expect_complex(subtract({block_aslant(12), below.solid}), volume - below.volume, 2,
                 "an edge below a face");
}

/// The surface of some cells of a lattice, as one mesh of squares: where cells touch along an edge
/// it has edges of four faces.
PolygonMesh surface_of(const std::set<std::array<int, 3>>& cells) {
  PolygonMesh mesh;
  std::map<std::array<int, 3>, uint32_t> number;
  for (const auto& cell : cells) {
    for (size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        std::array<int, 3> beyond = cell;
        beyond[axis] += 2 * side - 1;
        if (cells.contains(beyond)) continue;
        std::vector<uint32_t> corners;
        for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
          std::array<int, 3> p = cell;
          p[axis] += side;
          p[(axis + 1) % 3] += u;
          p[(axis + 2) % 3] += v;
          const auto [known, is_new] = number.try_emplace(p, number.size());
          if (is_new) mesh.points.emplace_back(p[0], p[1], p[2]);
          corners.push_back(known->second);
        }
        if (side == 0) std::reverse(corners.begin(), corners.end());
        mesh.add_face(corners);
      }
    }
  }
  return mesh;
}

/// About a third of those of a cube.
std::set<std::array<int, 3>> random_cells(std::mt19937& random, int size) {
  std::set<std::array<int, 3>> cells;
  for (int i = 0; i < size * size * size; ++i) {
    if (random() % 3 == 0) cells.insert({i % size, i / size % size, i / size / size});
  }
  return cells;
}

TEST(Conform, SurfacesThatTouchThemselvesAgainstTurnedCopies) {
  std::mt19937 random(5);
  for (int round = 0; round < 40; ++round) {
    const int size = 3 + round % 3;
    const auto cells = random_cells(random, size);
    if (cells.empty()) continue;
    PolygonMesh mesh = surface_of(cells);
    mesh.keep_facets = round % 2 == 0;
    const double middle = size / 2.0, volume = static_cast<double>(cells.size());
    const NodePtr one = leaf(mesh, FillRule::kNonZero);
    const NodePtr other =
        moved(middle, middle, middle,
              turned(40, {0, 0, 1}, turned(20, {1, 0, 0}, moved(-middle, -middle, -middle, one))));
    for (const bool join : {false, true}) {
      const SolidPtr both = solid_of(unite({one, other}), join);
      const SolidPtr common = solid_of(intersect({one, other}), join);
      EXPECT_NEAR(both->measures.volume + common->measures.volume, 2 * volume, 1e-9 * volume);
    }
  }
}

// Squares that become one face lose corners that others, which touch there, keep.
TEST(Conform, SurfacesThatTouchThemselves) {
  std::mt19937 random(6);
  for (int round = 0; round < 66; ++round) {
    const int size = round < 60 ? 2 + round % 3 : 9;  // of which faces have more than sixteen edges
    const auto cells = random_cells(random, size);
    if (cells.empty()) continue;
    PolygonMesh mesh = surface_of(cells);
    mesh.keep_facets = round % 2 == 0;
    const NodePtr one = leaf(mesh, FillRule::kNonZero);
    for (const bool join : {false, true}) {
      for (const NodePtr& root : {one, unite({one, box({9, 9, 9}, {10, 10, 10})})}) {
        const SolidPtr solid = solid_of(root, join);
        EXPECT_EQ(crossings_by_place(*solid), 0u) << round;
        const size_t beside = root == one ? 0 : 1;
        EXPECT_EQ(solid->measures.volume, static_cast<double>(cells.size() + beside)) << round;
      }
    }
  }
}

// The apex of a tetrahedron is a corner in the middle of an edge of a box; all edges have two
// faces.
TEST(Conform, AnApexOnAnEdgeOfTheSameLeaf) {
  PolygonMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2},
                 {2, 2, 2}, {0, 2, 2}, {2, 2, 1}, {4, 4, 0}, {5, 4, 0}, {4, 5, 0}};
  for (const std::vector<uint32_t>& face : std::vector<std::vector<uint32_t>>{{3, 2, 1, 0},
                                                                              {4, 5, 6, 7},
                                                                              {0, 1, 5, 4},
                                                                              {1, 2, 8, 6, 5},
                                                                              {2, 3, 7, 6, 8},
                                                                              {3, 0, 4, 7},
                                                                              {11, 10, 9},
                                                                              {9, 10, 8},
                                                                              {10, 11, 8},
                                                                              {11, 9, 8}}) {
    mesh.add_face(face);
  }
  for (const bool keep_facets : {false, true}) {
    mesh.keep_facets = keep_facets;
    expect_complex(leaf(mesh, FillRule::kNonZero), 8 + 1.0 / 6, 2, "apex on an edge");
  }
}

// Grooves from above and, across them, from below: each wall of one has a notch at all the others,
// and passes through the planes of all their walls.
TEST(Conform, WallsOfManyNotches) {
  for (const int grooves : {3, 12}) {
    const double size = 2 * grooves + 1;
    std::vector<NodePtr> parts{box({0, 0, 0}, {size, size, 3})};
    for (int i = 0; i < grooves; ++i) {
      const double from = 2 * i + 1, to = from + 1;
      parts.push_back(box({-1, from, 1}, {size + 1, to, 4}));
      parts.push_back(box({from, -1, -1}, {to, size + 1, 2}));
    }
    // A column of one by one has 3, 1 where one groove is, and nothing where they cross.
    const double ridges = grooves + 1;
    const double volume = 3 * ridges * ridges + 2 * grooves * ridges;
    const NodePtr root = subtract(parts);
    expect_complex(root, volume, 1, "grooves");
    const SolidPtr solid = solid_of(root, false);
    // Each crossing is a hole through the plate.
    EXPECT_EQ(solid->measures.genus, int64_t{grooves} * grooves);
  }
}

TEST(Conform, RandomBoxes) {
  std::mt19937 random(11);
  const auto number = [&](int n) {
    return static_cast<double>(random() % static_cast<uint32_t>(n));
  };
  size_t more = 0;
  for (int round = 0; round < 150; ++round) {
    std::vector<NodePtr> parts;
    for (int i = 0; i < 5; ++i) {
      const glm::dvec3 lo(number(4), number(4), number(4));
      parts.push_back(box(lo, lo + glm::dvec3(1 + number(3), 1 + number(3), 1 + number(3))));
      if (i % 2 == 1) {
        parts = {round % 3 == 0   ? unite(parts)
                 : round % 3 == 1 ? subtract(parts)
                                  : symmetric(parts)};
      }
    }
    const NodePtr root = symmetric(parts);
    const SolidPtr apart = solid_of(root, false), joined = solid_of(root, true);
    EXPECT_EQ(crossings_by_place(*apart), 0u) << round;
    EXPECT_EQ(crossings_by_place(*joined), 0u) << round;
    EXPECT_EQ(apart->measures.volume, joined->measures.volume);
    more += apart->positions.size() > joined->positions.size();
  }
  EXPECT_GT(more, 20u) << "hardly any contacts";
}

}  // namespace
}  // namespace csgrun::conform_test
