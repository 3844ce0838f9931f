// Cells of Minkowski sums and their surface, against exact volumes and hulls of all sums.
#include "engine/csg/sum_cells.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "engine/csg/convex_hull.h"
#include "sum_parts.h"

namespace csgrun::sum_cells_test {
namespace {

using namespace testing;

std::vector<IVec3> all_sums(const std::vector<IVec3>& a, const std::vector<IVec3>& b) {
  std::vector<IVec3> result;
  for (const IVec3& p : a) {
    for (const IVec3& q : b) result.push_back({p[0] + q[0], p[1] + q[1], p[2] + q[2]});
  }
  return result;
}

/// The extreme points, sorted.
std::vector<IVec3> extreme(const std::vector<IVec3>& points) {
  std::vector<IVec3> result = convex_hull(points).vertices;
  std::sort(result.begin(), result.end());
  return result;
}

int64_t prism_volumes(const LeafGeometry& edges, const LeafGeometry& faces,
                      const std::vector<SumPrism>& prisms) {
  int64_t sum = 0;
  for (const SumPrism& prism : prisms) {
    std::vector<IVec3> face;
    for (uint32_t c = faces.face_starts[prism.face]; c < faces.face_starts[prism.face + 1]; ++c) {
      face.push_back(faces.vertices[faces.corners[c]]);
    }
    EXPECT_LT(edges.vertices[prism.low], edges.vertices[prism.high]);
    const int64_t volume = six_volumes(
        convex_hull(all_sums(face, {edges.vertices[prism.low], edges.vertices[prism.high]})));
    EXPECT_GT(volume, 0);
    sum += volume;
  }
  return sum;
}

/// Convex solids: the cells do not overlap and fill the hull of all sums, and of their surface
/// nothing but its boundary is left. Small sizes are full of parallel edges and faces.
TEST(SumCells, TileTheSumOfConvexSolids) {
  std::mt19937 random(5);
  int tested = 0;
  for (int round = 0; round < 300; ++round) {
    const int size = std::array{2, 3, 4, 8, 100, 4000}[round % 6];
    const LeafGeometry a = random_hull(random, 4 + round % 17, size);
    const LeafGeometry b = random_hull(random, 4 + round % 13, size);
    if (a.face_count() == 0 || b.face_count() == 0) continue;
    ++tested;
    const SumCells cells = sum_cells(a, b);
    ASSERT_EQ(cells.peaks.size(), 1u);
    ASSERT_EQ(cells.pits.size(), 1u);
    const LeafGeometry truth = convex_hull(all_sums(a.vertices, b.vertices));
    EXPECT_EQ(six_volumes(a) + six_volumes(b) + prism_volumes(a, b, cells.a_edges) +
                  prism_volumes(b, a, cells.b_edges),
              six_volumes(truth))
        << "round " << round;
    const auto surface = sum_surface(a, b, cells);
    ASSERT_TRUE(surface.has_value());
    EXPECT_TRUE(is_balanced(*surface)) << "round " << round;
    EXPECT_EQ(six_volumes(*surface), six_volumes(truth)) << "round " << round;
    EXPECT_EQ(extreme(surface->points), extreme(truth.vertices)) << "round " << round;
    // All of it lies on the boundary.
    for (const IVec3& p : surface->points) {
      bool is_on_boundary = false;
      for (uint32_t f = 0; f < truth.face_count() && !is_on_boundary; ++f) {
        const uint32_t* c = truth.corners.data() + truth.face_starts[f];
        const auto at = [&](int i) { return truth.vertices[c[i]]; };
        IVec3 u, v, w;
        for (int i = 0; i < 3; ++i) {
          u[i] = at(1)[i] - at(0)[i], v[i] = at(2)[i] - at(0)[i], w[i] = p[i] - at(0)[i];
        }
        is_on_boundary = w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
                             w[2] * (u[0] * v[1] - u[1] * v[0]) ==
                         0;
      }
      EXPECT_TRUE(is_on_boundary) << "round " << round;
    }
  }
  EXPECT_GT(tested, 200);
}

/// Two directions by neighbours of Fibonacci numbers turn by 1 in 2^73: no double can tell.
TEST(SumCells, OfNearlyParallelSides) {
  std::array<int64_t, 56> fibonacci{0, 1};
  for (size_t i = 2; i < fibonacci.size(); ++i) fibonacci[i] = fibonacci[i - 1] + fibonacci[i - 2];
  const auto wedge = [&](size_t i, int axis) {
    std::vector<IVec3> points;
    for (const int64_t high : {0, 5}) {
      for (const auto& [x, y] : std::array<std::array<int64_t, 2>, 3>{
               {{0, 0}, {fibonacci[i], fibonacci[i - 1]}, {0, fibonacci[40]}}}) {
        IVec3& p = points.emplace_back();
        p[axis] = x, p[(axis + 1) % 3] = y, p[(axis + 2) % 3] = high;
      }
    }
    return convex_hull(points);
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (size_t i = 50; i < 55; ++i) {
      const LeafGeometry a = wedge(i, axis), b = wedge(i + 1, axis);
      const auto surface = sum_surface(a, b, sum_cells(a, b));
      ASSERT_TRUE(surface.has_value());
      EXPECT_TRUE(is_balanced(*surface));
      EXPECT_EQ(extreme(surface->points), extreme(all_sums(a.vertices, b.vertices)));
    }
  }
}

/// Coordinates near 2^39.
TEST(SumCells, OfHugeBoxesNearlyAlike) {
  constexpr int64_t kHuge = int64_t{1} << 38;
  std::mt19937 random(9);
  const auto nearly_box = [&] {
    std::vector<IVec3> points;
    for (int i = 0; i < 8; ++i) {
      IVec3& p = points.emplace_back();
      for (int k = 0; k < 3; ++k) {
        p[k] = (i >> k & 1 ? kHuge : -kHuge) + static_cast<int64_t>(random() % 5) - 2;
      }
    }
    return convex_hull(points);
  };
  for (int round = 0; round < 50; ++round) {
    const LeafGeometry a = nearly_box(), b = nearly_box();
    const auto surface = sum_surface(a, b, sum_cells(a, b));
    ASSERT_TRUE(surface.has_value());
    EXPECT_TRUE(is_balanced(*surface));
    EXPECT_EQ(extreme(surface->points), extreme(all_sums(a.vertices, b.vertices)))
        << "round " << round;
  }
}

/// A void that is filled: its top is a peak, too, and what cells overlap in is wrapped twice.
TEST(SumCells, WrapWhatOverlapsMoreThanOnce) {
  const Summand hollow =
      as_summand(in_one(box_mesh({0, 0, 0}, {9, 9, 3}), inverted(box_mesh({3, 3, 1}, {6, 6, 2}))));
  ASSERT_TRUE(hollow.is_simple);
  const Summand cube = convex_summand(on_grid(box_mesh({0, 0, 0}, {1, 1, 1})));
  const SumCells cells = sum_cells(hollow.boundary, cube.boundary);
  EXPECT_EQ(cells.peaks.size(), 2u);
  EXPECT_EQ(cells.pits.size(), 1u);
  const auto surface = sum_surface(hollow.boundary, cube.boundary, cells);
  ASSERT_TRUE(surface.has_value());
  EXPECT_TRUE(is_balanced(*surface));
  EXPECT_GT(six_volumes(*surface), 6 * 10 * 10 * 4);
}

/// A surface that crosses itself, and one that is pressed flat, have no cells: sums of faces.
TEST(MinkowskiSum, OfWhatHasNoCells) {
  const GridStep step = *GridStep::parse("1");
  const auto part = [](glm::dvec3 lo, glm::dvec3 hi) {
    return convex_summand(on_grid(box_mesh(lo, hi)));
  };
  const auto sum = [&](std::vector<std::vector<Summand>> operands) {
    const auto parts = minkowski_sum(std::move(operands), step);
    EXPECT_TRUE(parts.has_value());
    return solid_of_parts(*parts, step)->canonical_hash;
  };
  const Summand crossed =
      as_summand(in_one(box_mesh({0, 0, 0}, {9, 4, 4}), box_mesh({2, 1, -5}, {7, 3, 9})));
  EXPECT_FALSE(crossed.is_simple);
  const std::vector<Summand> bodies{part({0, 0, 0}, {9, 4, 4}), part({2, 1, -5}, {7, 3, 9})};
  const Summand elbow = as_summand(in_one(box_mesh({0, 0, 0}, {2, 2, 20}), {}));
  const Summand hollow =
      as_summand(in_one(box_mesh({0, 0, 0}, {9, 9, 3}), inverted(box_mesh({3, 3, 1}, {6, 6, 2}))));
  const std::vector<Summand> walls{part({0, 0, 0}, {9, 9, 1}), part({0, 0, 2}, {9, 9, 3}),
                                   part({0, 0, 0}, {3, 9, 3}), part({6, 0, 0}, {9, 9, 3}),
                                   part({0, 0, 0}, {9, 3, 3}), part({0, 6, 0}, {9, 9, 3})};
  const Summand cube = part({-1, -1, -1}, {2, 1, 1});
  EXPECT_EQ(sum({{crossed}, {cube}}), sum({bodies, {cube}}));
  EXPECT_EQ(sum({{elbow}, {crossed}}), sum({{elbow}, bodies}));
  EXPECT_EQ(sum({{crossed}, {hollow}}), sum({bodies, walls}));
  EXPECT_EQ(sum({{crossed}, {crossed}}), sum({bodies, bodies}));
  // More operands: cells of sums, too, are summed one by one.
  EXPECT_EQ(sum({{hollow}, {hollow}, {crossed}}), sum({walls, walls, bodies}));
  EXPECT_EQ(sum({{hollow}, {hollow}, {hollow}}), sum({walls, walls, walls}));
  // In one plane: with a solid it makes one that has a volume, with itself what is as flat.
  const Summand plate = convex_summand({{0, 0, 0}, {5, 0, 0}, {0, 5, 0}, {5, 5, 0}});
  EXPECT_FALSE(plate.is_simple);
  EXPECT_EQ(sum({{hollow}, {plate}}), sum({walls, {plate}}));
  EXPECT_EQ(sum({{plate}, {cube}}),
            sum({{part({-1, -1, -1}, {7, 6, 1})}, {convex_summand({{0, 0, 0}})}}));
  const auto flat = minkowski_sum({{plate}, {plate}}, step);
  ASSERT_EQ(flat->size(), 1u);
  EXPECT_TRUE(convex_hull(std::get<std::vector<IVec3>>(flat->front())).vertices.empty());
  EXPECT_EQ(sum({{plate}, {plate}, {cube}}),
            sum({{part({-1, -1, -1}, {12, 11, 1})}, {convex_summand({{0, 0, 0}})}}));
}

}  // namespace
}  // namespace csgrun::sum_cells_test
