// The quick way to a leaf against the general one (tests/support/leaf_ways.h), on small meshes that
// collapse, fold, touch and cross themselves.
#include "engine/csg/convex_leaf.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "engine/csg/convex_hull.h"
#include "engine/csg/leaf_faces.h"
#include "engine/csg/quantise.h"
#include "engine/mesh/convex_surface.h"
#include "engine/mesh/leaf_check.h"
#include "test_meshes.h"
#include "tests/support/leaf_ways.h"

namespace csgrun::convex_leaf_test {
namespace {

using namespace testing;
using namespace test;
using Status = PreparedLeaf::Status;

/// A mesh, not looked at, with points that are whole.
struct WholeMesh {
  PolygonMesh mesh;
  std::vector<IVec3> points;
};

/// A ball of so many rings and sides whose points are moved by up to `noise`; of triangles, or of
/// quadrilaterals where it can be, with its axis aslant.
WholeMesh ball(int rings, int sides, double radius, int noise, std::mt19937& random,
               bool quads = false) {
  WholeMesh result;
  PolygonMesh& mesh = result.mesh;
  const double aslant = quads ? static_cast<double>(random() % 7) / 5 : 0;
  const auto add = [&](double x, double y, double z) {
    y = std::exchange(x, x * std::cos(aslant) - y * std::sin(aslant)) * std::sin(aslant) +
        y * std::cos(aslant);
    z = std::exchange(y, y * std::cos(aslant) - z * std::sin(aslant)) * std::sin(aslant) +
        z * std::cos(aslant);
    IVec3 p{std::lround(x), std::lround(y), std::lround(z)};
    for (int64_t& c : p) {
      if (noise > 0) c += static_cast<int64_t>(random() % (2 * noise + 1)) - noise;
    }
    result.points.push_back(p);
  };
  add(0, 0, radius);
  for (int r = 1; r < rings; ++r) {
    const double phi = 3.14159265358979 * r / rings;
    for (int s = 0; s < sides; ++s) {
      const double t = 2 * 3.14159265358979 * s / sides;
      add(radius * std::sin(phi) * std::cos(t), radius * std::sin(phi) * std::sin(t),
          radius * std::cos(phi));
    }
  }
  add(0, 0, -radius);
  const auto at = [&](int r, int s) {
    return static_cast<uint32_t>(1 + (r - 1) * sides + s % sides);
  };
  const auto last = static_cast<uint32_t>(result.points.size() - 1);
  for (int s = 0; s < sides; ++s) {
    mesh.add_face(std::array<uint32_t, 3>{0, at(1, s), at(1, s + 1)});
    mesh.add_face(std::array<uint32_t, 3>{last, at(rings - 1, s + 1), at(rings - 1, s)});
    for (int r = 1; r + 1 < rings; ++r) {
      if (quads) {
        mesh.add_face(
            std::array<uint32_t, 4>{at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s + 1)});
        continue;
      }
      mesh.add_face(std::array<uint32_t, 3>{at(r, s), at(r + 1, s), at(r + 1, s + 1)});
      mesh.add_face(std::array<uint32_t, 3>{at(r, s), at(r + 1, s + 1), at(r, s + 1)});
    }
  }
  mesh.points.resize(result.points.size());
  return result;
}

WholeMesh both(const WholeMesh& a, const WholeMesh& b, const IVec3& by) {
  WholeMesh result{in_one(a.mesh, b.mesh), a.points};
  for (const IVec3& p : b.points) {
    result.points.push_back({p[0] + by[0], p[1] + by[1], p[2] + by[2]});
  }
  return result;
}

/// The faces with such numbers only, and those with such turned over.
template <class Keep, class Turn>
WholeMesh changed(const WholeMesh& whole, Keep keep, Turn turn) {
  WholeMesh result;
  result.points = whole.points;
  result.mesh.points = whole.mesh.points;
  for (uint32_t f = 0; f < whole.mesh.face_count(); ++f) {
    std::array<uint32_t, 3> t;
    for (uint32_t i = 0; i < 3; ++i) t[i] = whole.mesh.corners[3 * f + i];
    if (turn(f)) std::swap(t[0], t[1]);
    if (keep(f)) result.mesh.add_face(t);
  }
  return result;
}

TEST(ConvexLeaf, BallsOfAllSizesAgreeWithTheGeneralWay) {
  std::mt19937 random(5);
  Tally tally;
  for (int round = 0; round < 300; ++round) {
    // From balls of a few steps, where edges and triangles collapse in all ways, to large ones;
    // noise folds them and makes them cross themselves.
    const double radius = std::exp2(static_cast<double>(random() % 90) / 10);
    const int noise = random() % 3 == 0 ? 0 : static_cast<int>(random() % 3);
    WholeMesh whole = ball(2 + static_cast<int>(random() % 9), 3 + static_cast<int>(random() % 12),
                           radius, noise, random);
    whole.mesh.keep_facets = random() % 2 != 0;
    whole.mesh.convex = noise == 0 && random() % 2 != 0;
    expect_same_both_ways(whole.mesh, whole.points, random() % 4 == 0, tally);
    if (HasFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(tally.good, 40u);
  EXPECT_GT(tally.tangled, 40u);
  EXPECT_GT(tally.quick, 100u);
  EXPECT_GT(tally.merged, 10u);
  EXPECT_GT(tally.crossings, 1000u);
  EXPECT_GT(tally.convex, 5u);
  EXPECT_GT(tally.sharp, 5u);
}

TEST(ConvexLeaf, BentQuadrilateralsAgreeWithTheGeneralWay) {
  std::mt19937 random(11);
  Tally tally;
  size_t split = 0, all_split = 0, refused = 0;
  for (int round = 0; round < 400; ++round) {
    const int log_radius = static_cast<int>(random() % 17);
    const double radius = std::exp2(log_radius + static_cast<double>(random() % 8) / 8);
    const int noise = random() % 4 == 0 ? static_cast<int>(random() % 3) : 0;
    WholeMesh whole = ball(2 + static_cast<int>(random() % 9), 3 + static_cast<int>(random() % 12),
                           radius, noise, random, true);
    PolygonMesh& mesh = whole.mesh;
    mesh.keep_facets = random() % 2 != 0;
    if (random() % 2 != 0) {
      for (uint32_t f = 0; f < mesh.face_count(); ++f) mesh.surface.push_back(f / 5);
    }
    mesh.convex = random() % 5 != 0;
    const bool turn = random() % 4 == 0;
    expect_same_both_ways(mesh, whole.points, turn, tally,
                          int64_t{1} << (37 - std::max(7, log_radius)));
    if (HasFailure()) FAIL() << "round " << round;
    const auto taken = take_convex_faces(mesh, whole.points, turn, FaceNumbers());
    refused += taken ? 0 : 1;
    if (!taken) continue;
    const size_t faces = taken->leaf.face_count();
    split += faces > mesh.face_count() && mesh.convex;
    all_split += faces > mesh.face_count() && 3 * faces == taken->leaf.corners.size();
    EXPECT_TRUE(faces <= mesh.face_count() || mesh.convex);
  }
  EXPECT_GT(tally.good, 250u);
  EXPECT_GT(tally.quick, 200u);
  EXPECT_GT(split, 200u);
  EXPECT_GT(all_split, 30u);
  EXPECT_GT(refused, 60u);
}

TEST(ConvexLeaf, PairsOfBallsAgreeWithTheGeneralWay) {
  // Touching in vertices, edges and faces, crossing, one in the other, open, with a turned face.
  std::mt19937 random(6);
  Tally tally;
  for (int round = 0; round < 300; ++round) {
    const auto one = [&] {
      return ball(2 + static_cast<int>(random() % 3), 4, 1.0 + static_cast<double>(random() % 9), 0,
                  random);
    };
    const WholeMesh a = one(), b = random() % 3 == 0 ? a : one();
    const auto shift = [&] { return static_cast<int64_t>(random() % 21) - 10; };
    WholeMesh whole = both(a, b, {shift(), shift(), random() % 2 ? 0 : shift()});
    const auto faces = static_cast<uint32_t>(whole.mesh.face_count());
    const uint32_t left_out = random() % 6 == 0 ? random() % faces : faces;
    const uint32_t turned = random() % 6 == 0 ? random() % faces : faces;
    const bool invert_second = random() % 3 == 0;
    const auto first_faces = static_cast<uint32_t>(a.mesh.face_count());
    whole = changed(
        whole, [&](uint32_t f) { return f != left_out; },
        [&](uint32_t f) { return f == turned || (invert_second && f >= first_faces); });
    expect_same_both_ways(whole.mesh, whole.points, false, tally);
    if (HasFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(tally.good, 20u);
  EXPECT_GT(tally.tangled, 50u);
  EXPECT_GT(tally.open, 20u);
  EXPECT_GT(tally.quick, 100u);
}

TEST(ConvexLeaf, ReversedCopiesGoAwayBothWays) {
  // A surface and its reverse at one place: all that is left of the two encloses nothing.
  std::mt19937 random(8);
  Tally tally;
  const WholeMesh a = ball(4, 6, 50, 0, random);
  WholeMesh whole = both(a, a, {0, 0, 0});
  const auto half = static_cast<uint32_t>(a.mesh.face_count());
  whole = changed(
      whole, [](uint32_t) { return true; }, [&](uint32_t f) { return f >= half; });
  expect_same_both_ways(whole.mesh, whole.points, false, tally);
  EXPECT_EQ(tally.flat, 1u);
  // A triangle and its reverse beside a ball, of points of their own: the pair goes.
  whole = a;
  const auto first = static_cast<uint32_t>(whole.points.size());
  whole.points.insert(whole.points.end(), {{90, 0, 0}, {99, 0, 0}, {90, 9, 0}});
  whole.points.insert(whole.points.end(), {{90, 0, 0}, {99, 0, 0}, {90, 9, 0}});
  whole.mesh.points.resize(whole.points.size());
  whole.mesh.add_face(std::array<uint32_t, 3>{first, first + 1, first + 2});
  whole.mesh.add_face(std::array<uint32_t, 3>{first + 4, first + 3, first + 5});
  expect_same_both_ways(whole.mesh, whole.points, false, tally);
  EXPECT_EQ(tally.good, 1u);
  // Of the same points they were meant: a crossing.
  uint32_t* const back = &whole.mesh.corners[whole.mesh.corners.size() - 3];
  for (const uint32_t i : {0u, 1u, 2u}) back[i] -= 3;
  expect_same_both_ways(whole.mesh, whole.points, false, tally);
  EXPECT_EQ(tally.tangled, 1u);
}

/// Divides the edge of a triangle's neighbour by its middle, and closes what is between the two by
/// a triangle on a line. Nothing if they are in the same sense, or the middle is no whole point.
void put_on_edge(WholeMesh& whole, uint32_t face, uint32_t side) {
  std::vector<uint32_t>& corners = whole.mesh.corners;
  const uint32_t a = corners[3 * face + side], b = corners[3 * face + (side + 1) % 3];
  IVec3 middle = whole.points[a];
  for (size_t k = 0; k < 3; ++k) {
    middle[k] += whole.points[b][k];
    if (middle[k] % 2 != 0) return;
    middle[k] /= 2;
  }
  for (uint32_t f = 0; f < whole.mesh.face_count(); ++f) {
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t c = 3 * f + i, next = 3 * f + (i + 1) % 3, last = 3 * f + (i + 2) % 3;
      if (f == face || corners[c] != b || corners[next] != a) continue;
      const auto m = static_cast<uint32_t>(whole.points.size());
      whole.points.push_back(middle);
      whole.mesh.points.resize(whole.points.size());
      const uint32_t d = corners[last];
      corners[next] = m;  // b m d
      whole.mesh.add_face(std::array<uint32_t, 3>{m, a, d});
      whole.mesh.add_face(std::array<uint32_t, 3>{b, a, m});
      return;
    }
  }
}

TEST(ConvexLeaf, TrianglesOnALineAgreeWithTheGeneralWay) {
  // Some, in rows and fans, among others; and as many points and faces beside them as come to be.
  std::mt19937 random(12);
  Tally tally;
  size_t longer = 0;
  for (int round = 0; round < 300; ++round) {
    WholeMesh whole = ball(2 + static_cast<int>(random() % 9), 3 + static_cast<int>(random() % 12),
                           std::exp2(static_cast<double>(random() % 60 + 20) / 10),
                           static_cast<int>(random() % 2), random);
    whole.points = stretched(whole.points, 64);
    for (uint32_t n = random() % 8; n > 0; --n) {
      // On a face that was made before, often: then they lie beside each other.
      const auto faces = static_cast<uint32_t>(whole.mesh.face_count());
      const uint32_t face = random() % 2 != 0 ? random() % faces : faces - 1 - random() % 2;
      put_on_edge(whole, face, random() % 3);
    }
    std::vector<uint32_t> order(whole.mesh.face_count());
    for (uint32_t f = 0; f < order.size(); ++f) order[f] = f;
    std::shuffle(order.begin(), order.end(), random);
    WholeMesh shuffled;
    shuffled.points = whole.points;
    shuffled.mesh.points = whole.mesh.points;
    for (const uint32_t f : order) {
      const uint32_t* const c = &whole.mesh.corners[3 * f];
      shuffled.mesh.add_face(std::array<uint32_t, 3>{c[0], c[1], c[2]});
    }
    shuffled.mesh.keep_facets = random() % 2 != 0;
    expect_same_both_ways(shuffled.mesh, shuffled.points, random() % 4 == 0, tally,
                          int64_t{1} << 22);
    if (HasFailure()) FAIL() << "round " << round;
    const auto taken =
        take_convex_faces(shuffled.mesh, shuffled.points, false, FaceNumbers::all(0));
    longer += taken && taken->leaf.corners.size() > 3 * taken->leaf.face_count();
  }
  EXPECT_GT(tally.good, 100u);
  EXPECT_GT(tally.tangled, 50u);
  EXPECT_GT(tally.quick, 280u);
  EXPECT_GT(longer, 150u);
}

TEST(ConvexLeaf, PolygonsAgreeWithTheGeneralWay) {
  // Prisms over regular polygons on coarse grids: caps that stay planar, sides that bend.
  std::mt19937 random(11);
  Tally tally;
  for (int round = 0; round < 200; ++round) {
    const int sides = 3 + static_cast<int>(random() % 30);
    const NodePtr node = prism(sides, std::exp2(static_cast<double>(random() % 120) / 10),
                               1 + static_cast<double>(random() % 100));
    PolygonMesh mesh = *node->mesh();
    mesh.convex = random() % 2 != 0;
    std::vector<IVec3> points;
    const bool slanted = random() % 2 != 0;
    for (const glm::dvec3& p : mesh.points) {
      points.push_back({std::lround(p.x), std::lround(p.y),
                        std::lround(p.z) + (slanted ? std::lround(p.x) : 0)});
    }
    expect_same_both_ways(mesh, points, random() % 4 == 0, tally);
    if (HasFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(tally.good, 100u);
  EXPECT_GT(tally.quick, 50u);
}

/// A double cone over a ring of points at such angles, in degrees, each less than half a turn from
/// the one before. About a coordinate axis, or about the diagonal (3).
WholeMesh double_cone(const std::vector<int>& degrees, int64_t height, int axis) {
  WholeMesh whole;
  whole.points = {{0, 0, height}, {0, 0, -1000}};
  const auto sides = static_cast<uint32_t>(degrees.size());
  for (uint32_t s = 0; s < sides; ++s) {
    const double t = 3.14159265358979 * degrees[s] / 180;
    whole.points.push_back({std::lround(100 * std::cos(t)), std::lround(100 * std::sin(t)), s});
    const uint32_t a = 2 + s, b = 2 + (s + 1) % sides;
    whole.mesh.add_face(std::array<uint32_t, 3>{0, a, b});
    whole.mesh.add_face(std::array<uint32_t, 3>{1, b, a});
  }
  for (IVec3& p : whole.points) {
    if (axis < 3) {
      p = {p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]};
    } else {
      const int64_t across = std::lround(static_cast<double>(p[1]) / std::sqrt(3));
      p = {p[0] + across + p[2], -p[0] + across + p[2], -2 * across + p[2]};
    }
  }
  whole.mesh.points.resize(whole.points.size());
  return whole;
}

TEST(ConvexLeaf, ManyTrianglesAtAVertex) {
  // Around the axis once, twice, and twice with every other turn through the coordinate axes.
  const std::vector<int> once{0, 90, 180, 270}, evenly{0, 51, 103, 154, 206, 257, 309},
      twice{0, 60, 120, 180, 240, 300, 370, 430, 490, 550, 610, 670},
      mixed{0, 90, 180, 270, 405, 495, 585, 675}, mixed_back{45, 135, 225, 315, 450, 540, 630, 720};
  for (int axis = 0; axis < 4; ++axis) {
    for (const int64_t height : {0, 20, -20, 300}) {
      for (const auto* ring : {&once, &evenly, &twice, &mixed, &mixed_back}) {
        Tally tally;
        const WholeMesh whole = double_cone(*ring, height, axis);
        expect_same_both_ways(whole.mesh, whole.points, false, tally);
        EXPECT_EQ(tally.tangled, ring->back() > 360 ? 1u : 0u) << ring->back() << ", " << height;
      }
    }
  }
}

/// The icosahedron, or the great icosahedron, whose triangles join vertices that are not next to
/// each other: convex along every edge, and with as many vertices, edges and faces.
WholeMesh icosahedron(bool great, bool inside_out) {
  constexpr int64_t kOne = 1000000, kGolden = 1618034;
  WholeMesh whole;
  for (const int64_t a : {-kOne, kOne}) {
    for (const int64_t b : {-kGolden, kGolden}) {
      for (size_t k = 0; k < 3; ++k) {
        IVec3 p{0, 0, 0};
        p[(k + 1) % 3] = a;
        p[(k + 2) % 3] = b;
        whole.points.push_back(p);
      }
    }
  }
  const auto dot = [&](uint32_t i, uint32_t j) {
    const IVec3 &p = whole.points[i], &q = whole.points[j];
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  };
  const auto joined = [&](uint32_t i, uint32_t j) {
    const int64_t product = dot(i, j);
    return std::abs(product) < 2 * kOne * kOne && (product < 0) == great;
  };
  for (uint32_t i = 0; i < 12; ++i) {
    for (uint32_t j = i + 1; j < 12; ++j) {
      for (uint32_t k = j + 1; k < 12; ++k) {
        if (!joined(i, j) || !joined(j, k) || !joined(k, i)) continue;
        const IVec3 &p = whole.points[i], &q = whole.points[j], &r = whole.points[k];
        const double volume =
            static_cast<double>(p[0]) * static_cast<double>(q[1] * r[2] - q[2] * r[1]) +
            static_cast<double>(p[1]) * static_cast<double>(q[2] * r[0] - q[0] * r[2]) +
            static_cast<double>(p[2]) * static_cast<double>(q[0] * r[1] - q[1] * r[0]);
        if ((volume > 0) != inside_out) {
          whole.mesh.add_face(std::array<uint32_t, 3>{i, j, k});
        } else {
          whole.mesh.add_face(std::array<uint32_t, 3>{i, k, j});
        }
      }
    }
  }
  whole.mesh.points.resize(whole.points.size());
  return whole;
}

TEST(ConvexLeaf, WhatIsConvexNearItselfMayStillWindAroundItself) {
  const auto prepared = [](const WholeMesh& whole) {
    return prepare_leaf(whole.mesh, whole.points, false,
                        std::vector<uint32_t>(whole.mesh.face_count(), 0));
  };
  const PreparedLeaf plain = prepared(icosahedron(false, false));
  ASSERT_EQ(plain.status, Status::kGood);
  EXPECT_EQ(plain.geometry->face_count(), 20u);
  EXPECT_TRUE(plain.geometry->convex);
  EXPECT_EQ(prepared(icosahedron(false, true)).status, Status::kTangled);

  const WholeMesh great = icosahedron(true, false);
  const PreparedLeaf wound = prepared(great);
  ASSERT_EQ(wound.status, Status::kTangled);
  EXPECT_EQ(wound.geometry->face_count(), 20u);
  EXPECT_EQ(wound.geometry->opposite.size(), 60u);
  EXPECT_FALSE(find_convex_surface(*wound.geometry, wound.box).is_convex);
  EXPECT_FALSE(wound.crossings.empty());

  // Two bodies, each of them convex.
  const WholeMesh one = icosahedron(false, false);
  const PreparedLeaf two = prepared(both(one, one, {9000000, 0, 0}));
  ASSERT_EQ(two.status, Status::kGood);
  EXPECT_FALSE(two.geometry->convex);
  EXPECT_FALSE(two.connected);
  EXPECT_EQ(prepared(both(one, one, {100, 0, 0})).status, Status::kTangled);
}

TEST(ConvexLeaf, TheMiddleOfTheBoxNeedNotBeWithin) {
  // The hull of a tetrahedron with rounded corners, which is the corner of its box.
  constexpr int64_t kSize = 1000000, kRadius = 150000;
  std::mt19937 random(3);
  std::vector<IVec3> points;
  for (int n = 0; n < 2000; ++n) {
    IVec3 p;
    double square = 0;
    for (int64_t& c : p) {
      c = static_cast<int64_t>(random() % (2 * kRadius)) - kRadius;
      square += static_cast<double>(c) * static_cast<double>(c);
    }
    if (square > static_cast<double>(kRadius * kRadius)) continue;
    if (n % 4 > 0) p[n % 4 - 1] += kSize;
    points.push_back(p);
  }
  const LeafGeometry hull = convex_hull(points);
  WholeMesh whole;
  whole.points = hull.vertices;
  whole.mesh.points.resize(whole.points.size());
  for (size_t f = 0; f < hull.face_count(); ++f) {
    whole.mesh.add_face(
        std::span(hull.corners)
            .subspan(hull.face_starts[f], hull.face_starts[f + 1] - hull.face_starts[f]));
  }
  const auto convex = [&] {
    const PreparedLeaf leaf = prepare_leaf(whole.mesh, whole.points, false,
                                           std::vector<uint32_t>(whole.mesh.face_count(), 0));
    EXPECT_EQ(leaf.status, Status::kGood);
    int64_t reach = 0;
    for (size_t k = 0; k < 3; ++k) reach += leaf.box.lo[k] + leaf.box.hi[k];
    EXPECT_GT(reach, 2 * kSize + 4 * kRadius);  // the middle is above x + y + z = 1 + sqrt(3) r
    EXPECT_EQ(find_convex_surface(*leaf.geometry, leaf.box).is_convex, leaf.geometry->convex);
    return leaf.geometry->convex;
  };
  EXPECT_TRUE(convex());
  for (int64_t& c : whole.points[0]) c = c * 9 / 10 + kSize / 50;  // towards what is within
  EXPECT_FALSE(convex());
}

TEST(ConvexLeaf, SpreadVerticesHideNoCrossing) {
  // With the reverse of the surface added every directed edge is balanced, whatever the mesh: what
  // vertices are taken for spread then, and all crossings must be there as without that knowledge.
  std::mt19937 random(12);
  size_t crossings = 0;
  for (int round = 0; round < 100; ++round) {
    const WholeMesh whole =
        ball(3 + static_cast<int>(random() % 4), 4 + static_cast<int>(random() % 5), 20,
             static_cast<int>(random() % 8), random);
    const std::vector<uint32_t> appearance(whole.mesh.face_count(), 0);
    const PreparedLeaf leaf = prepare_leaf(whole.mesh, whole.points, false, appearance);
    if (!leaf.geometry) continue;
    EXPECT_EQ(check_surface(*leaf.geometry).crossings, find_self_intersections(*leaf.geometry));
    LeafGeometry twice = *leaf.geometry;
    twice.opposite.clear();
    const size_t faces = twice.face_count();
    for (size_t f = 0; f < faces; ++f) {
      for (uint32_t c = twice.face_starts[f + 1]; c-- > twice.face_starts[f];) {
        twice.corners.push_back(twice.corners[c]);
      }
      twice.face_starts.push_back(static_cast<uint32_t>(twice.corners.size()));
    }
    const auto found = check_surface(twice).crossings;
    EXPECT_EQ(found, find_self_intersections(twice));
    EXPECT_GE(found.size(), faces);
    crossings += found.size();
  }
  EXPECT_GT(crossings, 4000u);
}

}  // namespace
}  // namespace csgrun::convex_leaf_test
