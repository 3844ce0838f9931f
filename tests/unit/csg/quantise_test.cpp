// Leaves on the grid: closed, planar, convex faces, whatever rounding did to them.
#include "engine/csg/quantise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include "engine/csg/leaf_faces.h"
#include "test_meshes.h"

namespace csgrun::quantise_test {
namespace {

using namespace testing;
using Status = PreparedLeaf::Status;

std::vector<uint32_t> plain(const PolygonMesh& mesh) {
  return std::vector<uint32_t>(mesh.face_count(), 0);
}

/// Points as given, which are integers already.
std::vector<IVec3> whole_points(const PolygonMesh& mesh) {
  std::vector<IVec3> points;
  for (const auto& p : mesh.points) {
    points.push_back(
        {static_cast<int64_t>(p.x), static_cast<int64_t>(p.y), static_cast<int64_t>(p.z)});
  }
  return points;
}

PreparedLeaf prepare(const PolygonMesh& mesh) {
  return prepare_leaf(mesh, whole_points(mesh), false, plain(mesh));
}

/// LeafGeometry::opposite, against a map of all directed edges.
void expect_opposites(const LeafGeometry& leaf) {
  std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> uses;
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
    for (uint32_t c = begin; c < end; ++c) {
      uses[{leaf.corners[c], leaf.corners[c + 1 < end ? c + 1 : begin]}].push_back(c);
    }
  }
  std::vector<uint32_t> expected(leaf.corners.size());
  for (const auto& [ends, edges] : uses) {
    const auto reverse = uses.find({ends.second, ends.first});
    if (edges.size() != 1 || reverse == uses.end() || reverse->second.size() != 1) {
      EXPECT_TRUE(leaf.opposite.empty());
      return;
    }
    expected[edges[0]] = reverse->second[0];
  }
  EXPECT_EQ(leaf.opposite, expected);
}

/// The invariants of LeafGeometry, checked directly.
void expect_valid(const LeafGeometry& leaf) {
  expect_opposites(leaf);
  std::map<std::pair<uint32_t, uint32_t>, int> balance;
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t begin = leaf.face_starts[f], count = leaf.face_starts[f + 1] - begin;
    ASSERT_GE(count, 3u);
    CornerPlane plane;
    ASSERT_TRUE(corner_plane(leaf.vertices, &leaf.corners[begin], count, plane));
    for (uint32_t i = 0; i < count; ++i) {
      const uint32_t a = leaf.corners[begin + i], b = leaf.corners[begin + (i + 1) % count];
      EXPECT_EQ(plane.side(leaf.vertices[a]), 0) << "face " << f << " is not planar";
      ++balance[{a, b}];
      --balance[{b, a}];
    }
  }
  for (const auto& [edge, sum] : balance) EXPECT_EQ(sum, 0) << edge.first << "-" << edge.second;
}

double volume6(const LeafGeometry& leaf) {
  double sum = 0;
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    for (uint32_t c = leaf.face_starts[f] + 1; c + 1 < leaf.face_starts[f + 1]; ++c) {
      const IVec3 &p = leaf.vertices[leaf.corners[leaf.face_starts[f]]],
                  &q = leaf.vertices[leaf.corners[c]], &r = leaf.vertices[leaf.corners[c + 1]];
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += static_cast<double>(p[i]) * static_cast<double>(q[j] * r[k] - q[k] * r[j]);
      }
    }
  }
  return sum;
}

PolygonMesh mesh_of(std::vector<glm::dvec3> points,
                    const std::vector<std::vector<uint32_t>>& faces) {
  PolygonMesh mesh;
  mesh.points = std::move(points);
  for (const auto& face : faces) mesh.add_face(face);
  mesh.kind = "test";
  return mesh;
}

TEST(PrepareLeaf, ABoxStaysSixPolygons) {
  const auto leaf = prepare(box_mesh({0, 0, 0}, {100, 200, 300}));
  ASSERT_EQ(leaf.status, Status::kGood);
  EXPECT_EQ(leaf.geometry->face_count(), 6u);
  EXPECT_EQ(leaf.geometry->vertices.size(), 8u);
  EXPECT_TRUE(leaf.geometry->convex);
  expect_valid(*leaf.geometry);
  EXPECT_EQ(volume6(*leaf.geometry), 6.0 * 100 * 200 * 300);
  EXPECT_EQ(leaf.box.hi, (IVec3{100, 200, 300}));
}

TEST(PrepareLeaf, PermutedLeavesKeepTheirOrientation) {
  const auto leaf = prepare(box_mesh({0, 0, 0}, {100, 200, 300}));
  SignedPermutation mirror;
  mirror.sign = {-1, 1, 1};
  SignedPermutation turn;
  turn.axis = {1, 0, 2};
  turn.sign = {-1, 1, 1};
  for (const auto& p : {mirror, turn}) {
    const LeafGeometry other = permuted(*leaf.geometry, p);
    expect_valid(other);
    EXPECT_EQ(volume6(other), 6.0 * 100 * 200 * 300);
  }
}

TEST(PrepareLeaf, EdgesOfManyFacesHaveNoOpposite) {
  // Two boxes that have an edge in common, and two that have a corner.
  const auto box = box_mesh({0, 0, 0}, {100, 100, 100});
  const auto at_edge = prepare(in_one(box, box_mesh({100, 100, 0}, {200, 200, 100})));
  ASSERT_EQ(at_edge.status, Status::kGood);
  expect_valid(*at_edge.geometry);
  EXPECT_TRUE(at_edge.geometry->opposite.empty());
  const auto at_corner = prepare(in_one(box, box_mesh({100, 100, 100}, {200, 200, 200})));
  ASSERT_EQ(at_corner.status, Status::kGood);
  expect_valid(*at_corner.geometry);
  EXPECT_EQ(at_corner.geometry->opposite.size(), 48u);
}

TEST(PrepareLeaf, BentQuadrilateralsOfAConvexMeshBulgeOutwards) {
  auto mesh = box_mesh({0, 0, 0}, {1000, 1000, 1000});
  mesh.points[7].z = 1001;  // the top and two sides stay quadrilaterals, the top is bent
  const auto leaf = prepare(mesh);
  ASSERT_EQ(leaf.status, Status::kGood);
  expect_valid(*leaf.geometry);
  EXPECT_EQ(leaf.geometry->face_count(), 7u);
  EXPECT_TRUE(leaf.geometry->convex);

  mesh.points[7].z = 999;
  const auto dented = prepare(mesh);
  ASSERT_EQ(dented.status, Status::kGood);
  expect_valid(*dented.geometry);
  EXPECT_TRUE(dented.geometry->convex);
}

// A hole whose corner lies less than a step inside the outline: rounded, it lies outside. The caps
// must not be covered by anything that lies far from them.
TEST(PrepareLeaf, LoopsThatCrossByRoundingAreTriangulatedAsTheyWere) {
  const std::vector<glm::dvec2> outline{{0, 0}, {1000, 7}, {1000, 1000}, {0, 1000}};
  const std::vector<glm::dvec2> hole{{214, 1.499}, {300, 800}, {700, 600}};
  PolygonMesh mesh;
  for (const double z : {0.0, 100.0}) {
    for (const auto& p : outline) mesh.points.emplace_back(p.x, p.y, z);
    for (const auto& p : hole) mesh.points.emplace_back(p.x, p.y, z);
  }
  const auto add_face = [&](const std::vector<std::vector<uint32_t>>& loops) {
    for (const auto& loop : loops) {
      mesh.corners.insert(mesh.corners.end(), loop.begin(), loop.end());
      mesh.loop_starts.push_back(static_cast<uint32_t>(mesh.corners.size()));
    }
    mesh.face_starts.push_back(static_cast<uint32_t>(mesh.loop_starts.size() - 1));
  };
  add_face({{3, 2, 1, 0}, {6, 5, 4}});
  add_face({{7, 8, 9, 10}, {11, 12, 13}});
  for (uint32_t i = 0; i < 4; ++i) add_face({{i, (i + 1) % 4, (i + 1) % 4 + 7, i + 7}});
  for (uint32_t i = 4; i < 7; ++i) {
    const uint32_t next = i < 6 ? i + 1 : 4;
    add_face({{i, next, next + 7, i + 7}});
  }
  const auto leaf = prepare(mesh);
  ASSERT_EQ(leaf.status, Status::kTangled);
  EXPECT_TRUE(leaf.by_rounding);
  EXPECT_LT(leaf.crossings.size(), 30u);
  double caps = 0;
  const LeafGeometry& geometry = *leaf.geometry;
  for (size_t f = 0; f < geometry.face_count(); ++f) {
    const uint32_t begin = geometry.face_starts[f], end = geometry.face_starts[f + 1];
    const auto at = [&](uint32_t c) { return geometry.vertices[geometry.corners[c]]; };
    if (at(begin)[2] != at(begin + 1)[2] || at(begin)[2] != at(begin + 2)[2]) continue;
    double twice = 0;
    for (uint32_t c = begin; c < end; ++c) {
      const IVec3 p = at(c), q = at(c + 1 < end ? c + 1 : begin);
      twice += static_cast<double>(p[0] * q[1] - p[1] * q[0]);
    }
    caps += std::fabs(twice) / 2;
  }
  // Twice the outline less the hole, but for slivers of a step along 1000 steps.
  EXPECT_NEAR(caps, 2 * (1e6 - 3500 - 168300), 3000);
}

TEST(PrepareLeaf, AFalsePromiseOfConvexityIsNotBelieved) {
  // A prism over an L.
  auto mesh = mesh_of({{0, 0, 0},
                       {200, 0, 0},
                       {200, 100, 0},
                       {100, 100, 0},
                       {100, 200, 0},
                       {0, 200, 0},
                       {0, 0, 100},
                       {200, 0, 100},
                       {200, 100, 100},
                       {100, 100, 100},
                       {100, 200, 100},
                       {0, 200, 100}},
                      {{5, 4, 3, 2, 1, 0},
                       {6, 7, 8, 9, 10, 11},
                       {0, 1, 7, 6},
                       {1, 2, 8, 7},
                       {2, 3, 9, 8},
                       {3, 4, 10, 9},
                       {4, 5, 11, 10},
                       {5, 0, 6, 11}});
  mesh.convex = true;
  const auto leaf = prepare(mesh);
  ASSERT_EQ(leaf.status, Status::kGood);
  EXPECT_FALSE(leaf.geometry->convex);
  expect_valid(*leaf.geometry);
  EXPECT_EQ(leaf.geometry->face_count(), 6u + 2 * 4) << "the two L faces are triangles";
  EXPECT_EQ(volume6(*leaf.geometry), 6.0 * 30000 * 100);
}

TEST(PrepareLeaf, APinchedBodyIsNotConvex) {
  // Two square pyramids with one apex, as rounding may leave a thin body: every edge is convex.
  auto mesh = mesh_of({{0, 0, 0},
                       {-100, -100, -200},
                       {100, -100, -200},
                       {100, 100, -200},
                       {-100, 100, -200},
                       {-100, -100, 200},
                       {100, -100, 200},
                       {100, 100, 200},
                       {-100, 100, 200}},
                      {{4, 3, 2, 1},
                       {0, 1, 2},
                       {0, 2, 3},
                       {0, 3, 4},
                       {0, 4, 1},
                       {5, 6, 7, 8},
                       {0, 6, 5},
                       {0, 7, 6},
                       {0, 8, 7},
                       {0, 5, 8}});
  mesh.convex = true;
  const auto leaf = prepare(mesh);
  ASSERT_EQ(leaf.status, Status::kGood);
  EXPECT_FALSE(leaf.geometry->convex);
  EXPECT_FALSE(leaf.geometry->has_single_fans);
  EXPECT_TRUE(leaf.geometry->may_touch);
  EXPECT_FALSE(leaf.connected);
  // One of the two is, although a side of it is no triangle.
  mesh = mesh_of(
      {{0, 0, 0}, {-100, -100, -200}, {100, -100, -200}, {100, 100, -200}, {-100, 100, -200}},
      {{4, 3, 2, 1}, {0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
  mesh.convex = true;
  EXPECT_TRUE(prepare(mesh).geometry->convex);
  EXPECT_TRUE(prepare(mesh).geometry->has_single_fans);
}

TEST(PrepareLeaf, FacesWithHoles) {
  // A square frame: outer 0..3, inner 4..7 at the bottom, 8..15 at the top.
  PolygonMesh mesh;
  for (double z : {0.0, 100.0}) {
    for (auto [lo, hi] : {std::pair{0.0, 300.0}, std::pair{100.0, 200.0}}) {
      mesh.points.insert(mesh.points.end(), {{lo, lo, z}, {hi, lo, z}, {hi, hi, z}, {lo, hi, z}});
    }
  }
  const auto ring = [&](std::vector<uint32_t> outer, std::vector<uint32_t> hole) {
    for (const auto& loop : {outer, hole}) {
      mesh.corners.insert(mesh.corners.end(), loop.begin(), loop.end());
      mesh.loop_starts.push_back(static_cast<uint32_t>(mesh.corners.size()));
    }
    mesh.face_starts.push_back(static_cast<uint32_t>(mesh.loop_count()));
    mesh.surface.push_back(0);
  };
  ring({8, 9, 10, 11}, {15, 14, 13, 12});
  ring({3, 2, 1, 0}, {4, 5, 6, 7});
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t j = (i + 1) % 4;
    mesh.add_face(std::array<uint32_t, 4>{i, j, 8 + j, 8 + i});
    mesh.add_face(std::array<uint32_t, 4>{4 + j, 4 + i, 12 + i, 12 + j});
  }
  const auto leaf = prepare(mesh);
  ASSERT_EQ(leaf.status, Status::kGood);
  expect_valid(*leaf.geometry);
  EXPECT_EQ(volume6(*leaf.geometry), 6.0 * (90000 - 10000) * 100);
}

TEST(PrepareLeaf, CollapsedEdgesAndFacesGo) {
  // The top of the box shrinks to an edge: a wedge.
  auto mesh = box_mesh({0, 0, 0}, {100, 100, 100});
  mesh.points[6] = mesh.points[4];
  mesh.points[7] = mesh.points[5];
  const auto leaf = prepare(mesh);
  ASSERT_EQ(leaf.status, Status::kGood);
  expect_valid(*leaf.geometry);
  EXPECT_EQ(leaf.geometry->face_count(), 5u);
  EXPECT_EQ(volume6(*leaf.geometry), 3e6);
}

TEST(PrepareLeaf, AFaceThatBecameASegmentSplitsItsNeighbour) {
  // A tetrahedron with the sliver (0, 1, 4) on one edge: 4 is in the middle of edge 0-1.
  const auto mesh = mesh_of({{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {0, 0, 100}, {50, 0, 0}},
                            {{0, 2, 1}, {0, 1, 4}, {0, 4, 3}, {4, 1, 3}, {1, 2, 3}, {0, 3, 2}});
  const auto leaf = prepare(mesh);
  ASSERT_EQ(leaf.status, Status::kGood);
  expect_valid(*leaf.geometry);
  EXPECT_EQ(volume6(*leaf.geometry), 1e6);
}

TEST(PrepareLeaf, ALoopThatFoldsBackOverItsCornerLeavesNoFlatTriangle) {
  // A prism over the loop (0, 0), (10, 0), (10, 10), (50, 0): it returns over (10, 0).
  const auto mesh =
      mesh_of({{0, 0, 0},
               {10, 0, 0},
               {10, 10, 0},
               {50, 0, 0},
               {0, 0, 9},
               {10, 0, 9},
               {10, 10, 9},
               {50, 0, 9}},
              {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
  const auto leaf = prepare(mesh);
  ASSERT_EQ(leaf.status, Status::kTangled);
  expect_valid(*leaf.geometry);
  EXPECT_EQ(volume6(*leaf.geometry), 3 * -10.0 * 40 * 9);
}

TEST(PrepareLeaf, WhatIsThinnerThanTheGridIsFlat) {
  EXPECT_EQ(prepare(box_mesh({0, 0, 0}, {100, 100, 0})).status, Status::kFlat);
  EXPECT_EQ(prepare(box_mesh({0, 0, 0}, {0, 0, 0})).status, Status::kFlat);
  EXPECT_EQ(prepare(PolygonMesh{}).status, Status::kFlat);
}

TEST(PrepareLeaf, WhatIsPressedFlatIsFlat) {
  // The faces of a frustum that is lower than a step are two sheets that are not each other's
  // reverse, face by face; in a plane across an axis, and in one that is not.
  for (const bool slanted : {false, true}) {
    PolygonMesh frustum = box_mesh({-50, -50, 0}, {50, 50, 1});
    for (const int corner : {4, 5, 6, 7}) frustum.points[corner] *= glm::dvec3(0.1, 0.1, 0);
    if (slanted) {
      for (glm::dvec3& p : frustum.points) p.z = p.x + 2 * p.y;
    }
    const PreparedLeaf leaf = prepare(frustum);
    EXPECT_EQ(leaf.status, slanted ? Status::kTangled : Status::kFlat);
    if (leaf.geometry) {
      EXPECT_FALSE(leaf.geometry->convex);
    }
  }
}

TEST(PrepareLeaf, FaultsAreFound) {
  auto open = mesh_of(box_mesh({0, 0, 0}, {100, 100, 100}).points,
                      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}});
  EXPECT_EQ(prepare(open).status, Status::kOpen);

  auto inside_out = box_mesh({0, 0, 0}, {100, 100, 100});
  EXPECT_EQ(prepare_leaf(inside_out, whole_points(inside_out), true, plain(inside_out)).status,
            Status::kTangled);

  auto crossing = box_mesh({0, 0, 0}, {100, 100, 100});
  crossing.points[7] = {-50, -50, 50};
  const auto leaf = prepare(crossing);
  EXPECT_EQ(leaf.status, Status::kTangled);
  EXPECT_FALSE(leaf.crossings.empty());
}

TEST(PrepareLeaf, FacesTooManyOrTurnedAreFoundWhereverTheyStand) {
  // A tetrahedron with one face more: the same again, or one turned over. Some edges are then run
  // through three times, or twice one way.
  const std::vector<glm::dvec3> points{{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {0, 0, 100}};
  const std::vector<std::vector<uint32_t>> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  ASSERT_EQ(prepare(mesh_of(points, faces)).status, Status::kGood);
  for (size_t which = 0; which < faces.size(); ++which) {
    for (size_t where = 0; where <= faces.size(); ++where) {
      auto more = faces;
      more.insert(more.begin() + static_cast<std::ptrdiff_t>(where), faces[which]);
      EXPECT_EQ(prepare(mesh_of(points, more)).status, Status::kOpen) << which << ", " << where;
    }
    auto turned = faces;
    std::reverse(turned[which].begin(), turned[which].end());
    EXPECT_EQ(prepare(mesh_of(points, turned)).status, Status::kOpen) << which;
  }
}

TEST(PrepareLeaf, FacetsOfImportsAreKeptApart) {
  auto mesh = box_mesh({0, 0, 0}, {100, 100, 100});
  EXPECT_EQ(prepare(mesh).geometry->facet.list(6), std::vector<uint32_t>(6, 0));
  mesh.keep_facets = true;
  EXPECT_EQ(prepare(mesh).geometry->facet.list(6), (std::vector<uint32_t>{1, 2, 3, 4, 5, 6}));
}

TEST(PrepareLeaf, RandomPointsOnCoarseGridsStayClosed) {
  // A finely tessellated ball on ever coarser grids: edges and faces collapse in all ways.
  const int rings = 24, sides = 40;
  for (double radius : {200.0, 20.0, 8.0, 3.0, 1.5, 0.7}) {
    PolygonMesh mesh;
    for (int r = 0; r < rings; ++r) {
      const double phi = 3.14159265358979 * (r + 0.5) / rings;
      for (int s = 0; s < sides; ++s) {
        const double t = 2 * 3.14159265358979 * s / sides;
        mesh.points.push_back({radius * std::sin(phi) * std::cos(t),
                               radius * std::sin(phi) * std::sin(t), radius * std::cos(phi)});
      }
    }
    std::vector<uint32_t> top, bottom;
    for (uint32_t s = 0; s < sides; ++s) {
      top.push_back(s);
      bottom.insert(bottom.begin(), (rings - 1) * sides + s);
    }
    mesh.add_face(top);
    mesh.add_face(bottom);
    for (uint32_t r = 0; r + 1 < rings; ++r) {
      for (uint32_t s = 0; s < sides; ++s) {
        const uint32_t n = (s + 1) % sides;
        mesh.add_face(std::array<uint32_t, 4>{r * sides + s, (r + 1) * sides + s,
                                              (r + 1) * sides + n, r * sides + n});
      }
    }
    LeafRounding rounding;
    const auto points = round_points(mesh, rounding, Quantiser(*GridStep::parse("1")));
    ASSERT_TRUE(points.has_value());
    const auto leaf = prepare_leaf(mesh, *points, false, plain(mesh));
    EXPECT_NE(leaf.status, Status::kOpen) << radius;
    if (leaf.status == Status::kGood) expect_valid(*leaf.geometry);
    if (radius > 50) {
      ASSERT_EQ(leaf.status, Status::kGood);
      EXPECT_NEAR(volume6(*leaf.geometry) / 6 / (4.18879 * radius * radius * radius), 1, 0.02);
    }
  }
}

TEST(RoundPoints, FramesAgreeOnTies) {
  // A half-step coordinate is rounded in the frame's direction, also for leaves that look
  // backwards.
  const auto mesh = box_mesh({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  const Quantiser one(*GridStep::parse("1"));
  LeafRounding straight, turned_back;
  turned_back.permutation.sign = {-1, -1, 1};
  const auto a = round_points(mesh, straight, one), b = round_points(mesh, turned_back, one);
  EXPECT_EQ((*a)[0], (IVec3{0, 0, 0}));
  EXPECT_EQ((*a)[7], (IVec3{1, 1, 1}));
  for (size_t i = 0; i < a->size(); ++i) {
    // The vertex that stands at a's place i in the frame is the opposite one of the turned leaf.
    EXPECT_EQ(turned_back.permutation.apply((*b)[i ^ 3]), (*a)[i]);
  }
}

TEST(RoundPoints, TooFarIsSaid) {
  const auto mesh = box_mesh({0, 0, 0}, {2e12, 1, 1});
  EXPECT_FALSE(round_points(mesh, LeafRounding{}, Quantiser(*GridStep::parse("1"))).has_value());
}

// Caps of stacked extrusions are divided in the same way, seen from above or from below: slivers of
// one that cross those of the other would be as many pairs as there are.
TEST(PrepareLeaf, CapsOfPrismsAreDividedAlike) {
  std::mt19937 random(7);  // NOLINT: the same on every run
  for (int round = 0; round < 40; ++round) {
    constexpr uint32_t kCorners = 24;
    PolygonMesh mesh;
    const size_t up = round % 3;  // the axis of the prism
    for (const double z : {-50.0, 70.0}) {
      std::mt19937 same(static_cast<uint32_t>(round));  // NOLINT: the same at both ends
      for (uint32_t i = 0; i < kCorners; ++i) {
        const double angle = 2 * M_PI * i / kCorners;
        const double radius = i % 2 ? 1000 + same() % 500 : 300 + same() % 500;
        std::array<double, 3> p{};
        p[up] = z;
        p[(up + 1) % 3] = std::round(radius * std::cos(angle));
        p[(up + 2) % 3] = std::round(radius * std::sin(angle));
        mesh.points.push_back({p[0], p[1], p[2]});
      }
    }
    std::vector<uint32_t> bottom, top;
    for (uint32_t i = 0; i < kCorners; ++i) {
      bottom.push_back(kCorners - 1 - i);
      top.push_back(kCorners + i);
      const uint32_t j = (i + 1) % kCorners;
      mesh.add_face(std::vector<uint32_t>{i, j, kCorners + j, kCorners + i});
    }
    std::rotate(top.begin(), top.begin() + static_cast<long>(random() % kCorners), top.end());
    mesh.add_face(bottom);
    mesh.add_face(top);
    const PreparedLeaf leaf = prepare(mesh);
    ASSERT_EQ(leaf.status, Status::kGood);
    std::set<std::set<std::array<int64_t, 2>>> low, high;
    for (uint32_t f = 0; f < leaf.geometry->face_count(); ++f) {
      std::set<std::array<int64_t, 2>> corners;
      std::set<int64_t> levels;
      for (uint32_t c = leaf.geometry->face_starts[f]; c < leaf.geometry->face_starts[f + 1]; ++c) {
        const IVec3& p = leaf.geometry->vertices[leaf.geometry->corners[c]];
        corners.insert({p[(up + 1) % 3], p[(up + 2) % 3]});
        levels.insert(p[up]);
      }
      if (levels.size() == 1) (*levels.begin() < 0 ? low : high).insert(corners);
    }
    EXPECT_EQ(low.size(), kCorners - 2);
    EXPECT_EQ(low, high);
  }
}

}  // namespace
}  // namespace csgrun::quantise_test
