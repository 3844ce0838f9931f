// Sweeps of Minkowski sums, against the cells of the same sums and against hulls.
#include "engine/csg/sum_sweeps.h"

#include <random>

#include <gtest/gtest.h>

#include "engine/csg/sum_cells.h"
#include "sum_parts.h"

namespace csgrun::sum_sweeps_test {
namespace {

using namespace testing;

/// Triangles over the 26 directions of a cube's corners, edges and faces, each as far as it comes:
/// seen from 0 as from within, with convex and other edges, parallel ones, and flat ones.
PolygonMesh star(std::mt19937& random, uint32_t most) {
  PolygonMesh mesh;
  std::map<std::array<int, 3>, uint32_t> number;
  const auto vertex = [&](const std::array<int, 3>& d) {
    const auto [at, is_new] = number.try_emplace(d, static_cast<uint32_t>(mesh.points.size()));
    if (is_new) mesh.points.push_back(glm::dvec3(d[0], d[1], d[2]) * (1.0 + random() % most));
    return at->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      const auto at = [&](int x, int y) {
        std::array<int, 3> d{};
        d[axis] = side, d[(axis + 1) % 3] = x * side, d[(axis + 2) % 3] = y;
        return vertex(d);
      };
      const std::array<std::array<int, 2>, 8> rim{
          {{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}}};
      for (size_t i = 0; i < 8; ++i) {
        const auto &p = rim[i], &q = rim[(i + 1) % 8];
        mesh.add_face(std::vector<uint32_t>{at(0, 0), at(p[0], p[1]), at(q[0], q[1])});
      }
    }
  }
  return mesh;
}

PolygonMesh mesh_of(const LeafGeometry& leaf) {
  PolygonMesh mesh;
  for (const IVec3& p : leaf.vertices) mesh.points.emplace_back(p[0], p[1], p[2]);
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    mesh.add_face(std::vector<uint32_t>(leaf.corners.begin() + leaf.face_starts[f],
                                        leaf.corners.begin() + leaf.face_starts[f + 1]));
  }
  return mesh;
}

/// The value of the sum by its sweeps is that by its cells. Returns whether there were sweeps.
bool agree(const Summand& solid, const LeafGeometry& convex) {
  const auto sweeps = sum_sweeps(solid.boundary, convex);
  if (!sweeps) return false;
  const auto swept = sum_surface(solid.boundary, convex, *sweeps);
  const auto wrapped = sum_surface(solid.boundary, convex, sum_cells(solid.boundary, convex));
  EXPECT_TRUE(swept.has_value() && wrapped.has_value());
  EXPECT_TRUE(is_balanced(*swept));
  const GridStep step = *GridStep::parse("1");
  EXPECT_EQ(solid_of_parts({*swept}, step)->canonical_hash,
            solid_of_parts({*wrapped}, step)->canonical_hash);
  return true;
}

TEST(SumSweeps, OfStarsGiveWhatCellsGive) {
  std::mt19937 random(7);
  int tested = 0;
  for (int round = 0; round < 120 && !HasFailure(); ++round) {
    SCOPED_TRACE(round);
    const Summand solid = as_summand(star(random, 1 + round % 6));
    const LeafGeometry convex =
        random_hull(random, 4 + round % 15, std::array{4, 6, 12}[round % 3]);
    if (!solid.is_simple || convex.face_count() == 0) continue;
    tested += agree(solid, convex);
  }
  EXPECT_GT(tested, 60);
}

/// Of what surrounds a solid: the rest is what is left of it inwards.
TEST(SumSweeps, OfPitsGiveWhatCellsGive) {
  std::mt19937 random(11);
  int tested = 0;
  for (int round = 0; round < 120 && !HasFailure(); ++round) {
    SCOPED_TRACE(round);
    const LeafGeometry hole = random_hull(random, 4 + round % 30, std::array{6, 10, 40}[round % 3]);
    const LeafGeometry convex =
        random_hull(random, 4 + round % 15, std::array{4, 6, 12}[round % 3]);
    if (hole.face_count() == 0 || convex.face_count() == 0) continue;
    const Summand solid =
        as_summand(in_one(box_mesh({-50, -50, -50}, {50, 50, 50}), inverted(mesh_of(hole))));
    ASSERT_TRUE(solid.is_simple);
    tested += agree(solid, convex);
  }
  EXPECT_GT(tested, 60);
}

/// Of a convex one the surface has nothing inside, and the sum's points are those of the hull.
TEST(SumSweeps, OfConvexSolidsFillTheirSum) {
  std::mt19937 random(13);
  int tested = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    const LeafGeometry a = random_hull(random, 4 + round % 17, std::array{4, 8, 4000}[round % 3]);
    const LeafGeometry b = random_hull(random, 4 + round % 13, std::array{4, 8, 4000}[round % 3]);
    if (a.face_count() == 0 || b.face_count() == 0) continue;
    const auto sweeps = sum_sweeps(a, b);
    if (!sweeps) continue;
    ++tested;
    const auto surface = sum_surface(a, b, *sweeps);
    ASSERT_TRUE(surface.has_value());
    EXPECT_TRUE(is_balanced(*surface));
    std::vector<IVec3> sums;
    for (const IVec3& p : a.vertices) {
      for (const IVec3& q : b.vertices) sums.push_back({p[0] + q[0], p[1] + q[1], p[2] + q[2]});
    }
    const LeafGeometry truth = convex_hull(sums);
    // Where something is parallel, sweeps overlap.
    EXPECT_GE(six_volumes(*surface), six_volumes(truth));
    const LeafGeometry hull = convex_hull(surface->points);
    EXPECT_EQ(six_volumes(hull), six_volumes(truth));
    if (round % 3 == 2) {
      EXPECT_EQ(six_volumes(*surface), six_volumes(truth));
    }
  }
  EXPECT_GT(tested, 150);
}

/// No grid point is strictly inside of a unit cube: then there are none.
TEST(SumSweeps, NeedAMiddle) {
  const LeafGeometry unit = convex_hull(on_grid(box_mesh({0, 0, 0}, {1, 1, 1})));
  const Summand solid =
      as_summand(in_one(box_mesh({0, 0, 0}, {9, 9, 9}), inverted(box_mesh({3, 3, 3}, {6, 6, 6}))));
  EXPECT_FALSE(sum_sweeps(solid.boundary, unit).has_value());
}

}  // namespace
}  // namespace csgrun::sum_sweeps_test
