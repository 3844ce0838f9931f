// Equal points get one number, whatever names them; points that merely round alike do not.
#include "engine/bsp/point_index.h"

#include <gtest/gtest.h>

#include "engine/base/parallel.h"
#include "tests/support/exact_solid.h"
#include "tests/support/random_solids.h"

namespace csgrun::point_index_test {
namespace {

constexpr Int128 kThird = Int128{1} << 61;

/// The wall x_axis = (2^61 + more) / (3 * 2^61): 1/3 to a double.
uint32_t near_third(PlaneTable& planes, int axis, int more) {
  Plane p{0, 0, 0, -(kThird + more)};
  (axis == 0 ? p.a : axis == 1 ? p.b : p.c) = 3 * kThird;
  return planes.intern(p).index();
}

TEST(PointIndex, TellsPointsApartThatDoublesCannot) {
  PlaneTable planes;
  CellGeometry geometry(planes, nullptr);
  PointIndex index(geometry);
  std::vector<uint32_t> corners;
  for (int c = 0; c < 8; ++c) {
    const uint32_t x = near_third(planes, 0, c & 1), y = near_third(planes, 1, c >> 1 & 1),
                   z = near_third(planes, 2, c >> 2);
    corners.push_back(geometry.add_point({x, y, z}));
    ASSERT_EQ(geometry.point(corners[c]).rounded, geometry.point(corners[0]).rounded);
    EXPECT_EQ(index.unique(corners[c]), corners[c]);
    // Again, the planes in another order, or one that joins two of them.
    EXPECT_EQ(index.unique(geometry.add_point({z, x, y})), corners[c]);
    const Plane &p = planes.plane(x), &q = planes.plane(y);
    const uint32_t slanted = planes.intern({p.a, q.b, 0, p.d + q.d}).index();
    EXPECT_EQ(index.unique(geometry.add_point({slanted, y, z})), corners[c]);
    EXPECT_EQ(index.unique(geometry.add_point({x, slanted, z})), corners[c]);
  }
}

Frame frame_of(const std::array<std::array<int64_t, 3>, 3>& low) {
  Frame f;
  f.is_identity = false;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) f.matrix[i][j] = low[i][j] + (i == j ? int64_t{1} << 40 : 0);
  }
  return f;
}

// Vertices of leaves: of one grid, of two frames in which they round alike, against points of
// planes.
TEST(PointIndex, ComparesVerticesByValue) {
  const auto box = test::box_leaf({0, 1, 1}, {5, 5, 5});
  std::vector<Operand> operands(4);
  for (Operand& o : operands) o.leaf = box;
  operands[1].leaf = test::box_leaf({0, 5, 1}, {5, 9, 5});
  // World points (-q1 e, q1, q2) and (-q1 e K, q1 K, q2) for q0 = 0, e = 2^-40, K = 1 / (1 - e^2).
  operands[2].frame = frame_of({{{0, 1, 0}, {0, 0, 0}, {0, 0, 0}}});
  operands[3].frame = frame_of({{{0, 1, 0}, {1, 0, 0}, {0, 0, 0}}});
  Job job(operands);
  const auto vertex = [&](uint32_t o, const IVec3& q) {
    const auto& all = operands[o].leaf->vertices;
    for (uint32_t p = job.polygon_start(o); p < job.polygon_start(o + 1); ++p) {
      for (const uint32_t v : job.corners(job.polygons()[p])) {
        if (all[v - 8 * o] == q) return v;
      }
    }
    ADD_FAILURE() << "no such vertex";
    return 0u;
  };
  std::array<uint32_t, 3> walls{};
  for (int k = 0; k < 3; ++k) {
    walls[k] = job.planes().intern({k == 0, k == 1, k == 2, k == 0 ? 0 : k == 1 ? -5 : -1}).index();
  }
  for (const bool planes_first : {false, true}) {
    CellGeometry geometry(job.planes(), &job);
    PointIndex index(geometry);
    const uint32_t by_planes = geometry.add_point(walls);
    if (planes_first) index.unique(by_planes);
    const uint32_t a = geometry.vertex_point(vertex(0, {0, 5, 1}));
    const uint32_t b = geometry.vertex_point(vertex(1, {0, 5, 1}));
    ASSERT_NE(a, b);
    const uint32_t first = index.unique(a);
    EXPECT_EQ(first, planes_first ? by_planes : a);
    EXPECT_EQ(index.unique(a), first);
    EXPECT_EQ(index.unique(b), first);
    EXPECT_EQ(index.unique(by_planes), first);
    const uint32_t c = geometry.vertex_point(vertex(2, {0, 5, 1}));
    const uint32_t d = geometry.vertex_point(vertex(3, {0, 5, 1}));
    ASSERT_EQ(geometry.point(c).rounded, geometry.point(d).rounded);
    const Point at_c = geometry.exact(c), at_d = geometry.exact(d);
    ASSERT_NE(compare(at_c, at_d), 0);
    EXPECT_EQ(index.unique(c), c);
    EXPECT_EQ(index.unique(d), d);
    EXPECT_EQ(index.unique(c), c);
  }
}

TEST(PointIndex, FindsAllAfterItGrew) {
  PlaneTable planes;
  CellGeometry geometry(planes, nullptr);
  PointIndex index(geometry);
  constexpr int kSide = 17;
  std::vector<uint32_t> wall[3];
  for (int axis = 0; axis < 3; ++axis) {
    for (int64_t at = -kSide / 2; at <= kSide / 2; ++at) {
      wall[axis].push_back(planes.intern({axis == 0, axis == 1, axis == 2, -at}).index());
    }
  }
  for (int round = 0; round < 2; ++round) {
    uint32_t expected = 0;
    for (const uint32_t x : wall[0]) {
      for (const uint32_t y : wall[1]) {
        for (const uint32_t z : wall[2]) {
          ASSERT_EQ(index.unique(geometry.add_point({z, y, x})), expected++);
        }
      }
    }
    ASSERT_EQ(expected, 4913u);  // many more than the table began with
  }
}

// Many at once, on any number of threads: what asking one after another says, for points that were
// there before, twice in the list, under other names, or only round alike.
TEST(PointIndex, SaysTheSameOfManyAtOnce) {
  constexpr int kSide = 32;
  PlaneTable planes;
  std::vector<uint32_t> wall[3];
  for (int axis = 0; axis < 3; ++axis) {
    for (int64_t at = -kSide / 2; at < kSide / 2; ++at) {
      wall[axis].push_back(planes.intern({axis == 0, axis == 1, axis == 2, -at}).index());
    }
    wall[axis][0] = near_third(planes, axis, 0);
    wall[axis][1] = near_third(planes, axis, 1);
  }
  const auto add_points = [&](CellGeometry& geometry) {
    std::vector<uint32_t> points;
    for (int round = 0; round < 2; ++round) {
      for (const uint32_t x : wall[0]) {
        for (const uint32_t y : wall[1]) {
          for (const uint32_t z : wall[2]) {
            if ((x + y + z) % 3 == 0 || round == 0) points.push_back(geometry.add_point({z, y, x}));
            if (points.size() % 7 == 0) points.push_back(points[points.size() / 2]);
          }
        }
      }
    }
    return points;
  };
  CellGeometry geometry(planes, nullptr);
  PointIndex index(geometry);
  std::vector<uint32_t> expected;
  for (const uint32_t p : add_points(geometry)) expected.push_back(index.unique(p));
  ASSERT_GT(expected.size(), kFewForThreads);
  size_t distinct = 0;
  for (uint32_t p = 0; p < geometry.point_count(); ++p) distinct += index.unique(p) == p;
  EXPECT_EQ(distinct, size_t{kSide} * kSide * kSide);
  for (const unsigned threads : {1u, 2u, 4u}) {
    CellGeometry own(planes, nullptr);
    PointIndex many(own);
    const std::vector<uint32_t> points = add_points(own);
    // Some are known before, others come after.
    const std::span<const uint32_t> all(points);
    const size_t first = 100, last = points.size() - 100;
    for (const uint32_t p : all.first(first)) many.unique(p);
    with_threads(threads, [&] { many.make_unique(all.subspan(first, last - first)); });
    for (size_t i = 0; i < last; ++i) ASSERT_EQ(many.known(points[i]), expected[i]) << i;
    for (size_t i = last; i < points.size(); ++i) ASSERT_EQ(many.unique(points[i]), expected[i]);
  }
}

// Zero has two doubles, which are one coordinate.
TEST(PointIndex, KnowsZeroByEitherSign) {
  PlaneTable planes;
  CellGeometry geometry(planes, nullptr);
  PointIndex index(geometry);
  std::array<uint32_t, 3> walls{};
  for (int k = 0; k < 3; ++k) walls[k] = planes.intern({k == 0, k == 1, k == 2, 0}).index();
  const uint32_t first = index.unique(geometry.add_point(walls, {0.0, 0.0, 0.0}));
  for (int signs = 0; signs < 8; ++signs) {
    const auto zero = [&](int k) { return signs >> k & 1 ? -0.0 : 0.0; };
    EXPECT_EQ(index.unique(geometry.add_point(walls, {zero(0), zero(1), zero(2)})), first);
  }
}

}  // namespace
}  // namespace csgrun::point_index_test
