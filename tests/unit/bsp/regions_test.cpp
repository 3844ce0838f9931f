// Regions of a plane from the edges of pieces: squares of a grid, whose union is known by counting.
#include "engine/bsp/regions.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "engine/bsp/grid_planes.h"
#include "tests/support/random_solids.h"
#include "tests/support/seeded.h"

namespace csgrun::regions_test {
namespace {

using Point2 = std::array<int64_t, 2>;
using Segment = std::array<Point2, 2>;

/// Points and lines of the grid in the plane z = 0, seen from above or from below.
class Grid {
 public:
  explicit Grid(bool flipped = false)
      : geometry_(planes_, nullptr),
        support_(PlaneId(planes_.intern({0, 0, 1, 0}).index(), flipped)),
        builder_(geometry_, planes_) {}

  /// An edge along an axis or aslant.
  DirectedEdge edge(Point2 p, Point2 q) {
    if (support_.flipped()) std::swap(p, q);
    const int64_t a = q[1] - p[1], b = p[0] - q[0];
    const uint32_t plane = planes_.intern({a, b, 0, -(a * p[0] + b * p[1])}).index();
    return {point(p), point(q), plane};
  }
  /// The edges of a polygon that turns left, seen from above.
  void add(const std::vector<Point2>& loop) {
    for (size_t i = 0; i < loop.size(); ++i) {
      edges.push_back(edge(loop[i], loop[(i + 1) % loop.size()]));
    }
  }
  void add_square(int64_t x, int64_t y, int64_t size = 1) {
    add({{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}});
  }

  bool build() { return builder_.build(support_, edges, loops); }
  bool build_single() { return builder_.build_single(support_, edges, loops); }

  /// Of the result, as seen from above.
  [[nodiscard]] std::vector<Segment> boundary() const {
    std::vector<Segment> result;
    for (const DirectedEdge& e : loops.edges) {
      const Point2 p = at_.at(e.from), q = at_.at(e.to);
      result.push_back(support_.flipped() ? Segment{q, p} : Segment{p, q});
    }
    std::sort(result.begin(), result.end());
    return result;
  }
  /// Whether each edge ends where its loop's next one starts, turns there, and lies in its plane.
  [[nodiscard]] bool is_sound() {
    for (size_t l = 0; l + 1 < loops.starts.size(); ++l) {
      const uint32_t begin = loops.starts[l], end = loops.starts[l + 1];
      if (end - begin < 3) return false;
      for (uint32_t i = begin; i < end; ++i) {
        const DirectedEdge &e = loops.edges[i], &next = loops.edges[i + 1 < end ? i + 1 : begin];
        if (e.to != next.from) return false;
        if (geometry_.side(e.plane, e.from) != 0 || geometry_.side(e.plane, e.to) != 0)
          return false;
        if (geometry_.side(e.plane, next.to) == 0) return false;
      }
    }
    return true;
  }

  std::vector<DirectedEdge> edges;
  RegionLoops loops;

 private:
  uint32_t point(const Point2& p) {
    const auto [entry, is_new] = number_.try_emplace(p, 0);
    if (is_new) {
      const uint32_t u = planes_.intern({1, 0, 0, -p[0]}).index(),
                     v = planes_.intern({0, 1, 0, -p[1]}).index();
      entry->second = geometry_.add_point({support_.index(), u, v});
      at_[entry->second] = p;
    }
    return entry->second;
  }

  PlaneTable planes_;
  CellGeometry geometry_;
  PlaneId support_;
  RegionBuilder builder_;
  std::map<Point2, uint32_t> number_;
  std::map<uint32_t, Point2> at_;
};

/// Unit steps of the boundary of a set of unit squares, the set on their left.
std::set<Segment> steps_around(const std::set<Point2>& squares) {
  std::set<Segment> steps;
  for (const auto& [x, y] : squares) {
    if (!squares.count({x, y - 1})) steps.insert({{{x, y}, {x + 1, y}}});
    if (!squares.count({x + 1, y})) steps.insert({{{x + 1, y}, {x + 1, y + 1}}});
    if (!squares.count({x, y + 1})) steps.insert({{{x + 1, y + 1}, {x, y + 1}}});
    if (!squares.count({x - 1, y})) steps.insert({{{x, y + 1}, {x, y}}});
  }
  return steps;
}

std::set<Segment> steps_of(const std::vector<Segment>& boundary) {
  std::set<Segment> steps;
  for (const auto& [p, q] : boundary) {
    const int64_t dx = (q[0] > p[0]) - (q[0] < p[0]), dy = (q[1] > p[1]) - (q[1] < p[1]);
    for (Point2 at = p; at != q; at = {at[0] + dx, at[1] + dy}) {
      EXPECT_TRUE(steps.insert({at, {at[0] + dx, at[1] + dy}}).second) << "twice";
      if (std::abs(at[0]) > 100 || std::abs(at[1]) > 100) return {};
    }
  }
  return steps;
}

TEST(Regions, OfRandomSquaresAreTheirUnion) {
  test::Random random(81);
  size_t touching = 0, holes = 0;
  for (int i = 0; i < 300; ++i) {
    // Squares of one, two or three steps, no two over each other; few, or many.
    Grid grid(i % 2 != 0);
    std::set<Point2> covered;
    const int64_t size = random.integer(2, 7);
    for (int64_t k = random.integer(1, 3 * size); k > 0; --k) {
      const int64_t x = random.integer(0, size), y = random.integer(0, size),
                    side = random.integer(1, 3);
      std::set<Point2> own;
      for (int64_t u = x; u < x + side; ++u) {
        for (int64_t v = y; v < y + side; ++v) own.insert({u, v});
      }
      if (std::any_of(own.begin(), own.end(), [&](const Point2& p) { return covered.count(p); })) {
        continue;
      }
      covered.insert(own.begin(), own.end());
      grid.add_square(x, y, side);
    }
    // In any order.
    for (size_t k = grid.edges.size(); k > 1; --k) {
      std::swap(grid.edges[k - 1], grid.edges[random.bits() % k]);
    }
    ASSERT_TRUE(grid.build());
    ASSERT_TRUE(grid.is_sound());
    const auto steps = steps_around(covered);
    ASSERT_EQ(steps_of(grid.boundary()), steps) << "case " << i;
    std::map<Point2, int> starts;
    for (const Segment& s : steps) touching += ++starts[s[0]] == 2;
    holes += grid.loops.loop_count() > 1;
    // Each step of a region of before, in any order: loops as they were.
    const auto before = grid.boundary();
    const size_t count = grid.loops.loop_count();
    grid.edges = grid.loops.edges;
    ASSERT_TRUE(grid.build_single());
    ASSERT_TRUE(grid.is_sound());
    ASSERT_EQ(grid.boundary(), before);
    ASSERT_EQ(grid.loops.loop_count(), count);
  }
  EXPECT_GT(touching, 100u);
  EXPECT_GT(holes, 50u);
}

// Where regions touch in a point, each wedge of them is a corner of its own loop.
TEST(Regions, WedgesThatTouchAreCornersEach) {
  for (const bool flipped : {false, true}) {
    Grid grid(flipped);
    grid.add({{0, 0}, {4, 0}, {3, 1}});
    grid.add({{0, 0}, {1, 3}, {-1, 4}});
    grid.add({{0, 0}, {-5, 0}, {-2, -3}});
    ASSERT_TRUE(grid.build());
    EXPECT_EQ(grid.loops.loop_count(), 3u);
    EXPECT_TRUE(grid.is_sound());
    EXPECT_EQ(grid.loops.edges.size(), 9u);
    // A wedge of a straight angle has no corner there.
    grid.edges.clear();
    grid.add({{-4, 0}, {0, 0}, {4, 0}, {0, 5}});
    grid.add({{0, 0}, {-3, -2}, {-1, -4}});
    grid.add({{0, 0}, {2, -4}, {3, -1}});
    ASSERT_TRUE(grid.build());
    EXPECT_EQ(grid.loops.loop_count(), 3u);
    EXPECT_TRUE(grid.is_sound());
    EXPECT_EQ(grid.loops.edges.size(), 9u);
  }
}

// Edges count with their signs: once more one way than the other is a boundary; twice is none.
TEST(Regions, EdgesThatBoundNothingAreRefused) {
  for (const int many : {0, 8}) {  // squares apart, so that lines are looked up by keys
    for (const bool flipped : {false, true}) {
      const auto refused = [&](const auto& spoil) {
        Grid grid(flipped);
        for (int i = 0; i < many; ++i) grid.add_square(3 * i, 20 + 5 * i, 2);
        grid.add_square(0, 0, 2);
        spoil(grid);
        return !grid.build();
      };
      EXPECT_FALSE(refused([](Grid&) {}));
      EXPECT_TRUE(refused([](Grid& g) { g.add_square(0, 0, 2); }));
      EXPECT_TRUE(refused([](Grid& g) { g.add_square(1, 0, 2); }));
      EXPECT_TRUE(refused([](Grid& g) { g.edges.pop_back(); }));
      EXPECT_TRUE(refused([](Grid& g) { g.edges.push_back(g.edge({9, 9}, {10, 9})); }));
      // Turned over, they bound the outside: twice.
      EXPECT_TRUE(refused([](Grid& g) {
        for (int k = 0; k < 2; ++k) g.add({{10, 0}, {10, 3}, {13, 3}, {13, 0}});
      }));
      EXPECT_TRUE(refused([](Grid& g) {
        g.add({{10, 0}, {10, 3}, {13, 3}, {13, 0}});
        g.add({{11, 0}, {11, 3}, {14, 3}, {14, 0}});
      }));
      // Twice one way and once the other is once.
      EXPECT_FALSE(refused([](Grid& g) {
        g.add_square(0, 0, 2);
        g.add({{0, 0}, {0, 2}, {2, 2}, {2, 0}});
      }));
      EXPECT_FALSE(refused([](Grid& g) {
        g.add({{0, 0}, {0, 2}, {2, 2}, {2, 0}});
        g.add({{0, 0}, {0, 2}, {2, 2}, {2, 0}});
        g.add_square(0, 0, 2);
      }));
    }
  }
}

// Twice the same edge and nothing else: nothing of it is a boundary, and still it is refused.
TEST(Regions, EdgesThatAreThereTwiceAreRefused) {
  for (const bool flipped : {false, true}) {
    for (const auto& [p, q] : {std::pair<Point2, Point2>{{0, 0}, {3, 1}}, {{3, 1}, {0, 0}}}) {
      Grid grid(flipped);
      grid.edges = {grid.edge(p, q), grid.edge(p, q)};
      EXPECT_FALSE(grid.build());
    }
  }
}

// One piece by itself comes in the order of its edges; any other order is the general case.
TEST(Regions, OfOnePieceAreTheSameInAnyOrder) {
  const std::vector<std::vector<Point2>> loops{
      {{0, 0}, {4, 0}, {4, 4}, {0, 4}},
      {{0, 0}, {2, 0}, {4, 0}, {4, 2}, {4, 4}, {2, 4}, {1, 4}, {0, 4}},  // with straight corners
      {{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}, {2, 2}},                  // passes a point twice
      {{0, 0},
       {9, 0},
       {9, 2},
       {8, 1},
       {7, 2},
       {6, 1},
       {5, 2},
       {4, 1},
       {3, 2},
       {2, 1},
       {1, 2},
       {0, 1},
       {-1, 2},
       {-1, 0}}};  // more corners than are few
  test::Random random(83);
  for (const bool flipped : {false, true}) {
    for (const auto& loop : loops) {
      Grid grid(flipped);
      grid.add(loop);
      if (flipped) std::reverse(grid.edges.begin(), grid.edges.end());
      ASSERT_TRUE(grid.build_single());
      EXPECT_TRUE(grid.is_sound());
      const auto expected = grid.boundary();
      const size_t count = grid.loops.loop_count();
      for (int i = 0; i < 20; ++i) {
        const auto first = random.integer(0, static_cast<int64_t>(grid.edges.size()) - 1);
        std::rotate(grid.edges.begin(), grid.edges.begin() + first, grid.edges.end());
        if (i % 2 != 0) std::swap(grid.edges.front(), grid.edges.back());
        ASSERT_TRUE(grid.build_single());
        EXPECT_TRUE(grid.is_sound());
        EXPECT_EQ(grid.boundary(), expected);
        EXPECT_EQ(grid.loops.loop_count(), count);
      }
    }
  }
}

// A triangle with one edge the wrong way round, whatever comes first.
TEST(Regions, LoopsThatDoNotCloseAreRefused) {
  const std::vector<Point2> corners{{0, 0}, {4, 1}, {1, 3}};
  std::array<size_t, 3> order{0, 1, 2};
  do {
    for (size_t turned = 0; turned <= 3; ++turned) {
      Grid grid;
      for (const size_t i : order) {
        const Point2 &p = corners[i], &q = corners[(i + 1) % 3];
        grid.edges.push_back(i == turned ? grid.edge(q, p) : grid.edge(p, q));
      }
      EXPECT_EQ(grid.build_single(), turned == 3);
      EXPECT_EQ(grid.build(), turned == 3);
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

// Two edges of a plane that nearly go one way: by as little as whole numbers allow.
TEST(Regions, TurnsBetweenEdgesThatAreNearlyParallel) {
  test::Random random(82);
  std::array<int, 2> turns{};
  for (int i = 0; i < 3000; ++i) {
    const auto step = [&] {
      return IVec3{random.integer(-2, 2), random.integer(-2, 2), random.integer(-2, 2)};
    };
    const IVec3 u = step(), v = step(), off = step();
    const IVec3 normal = test::cross_of(u, v);
    if (test::dot_of(normal, off) == 0) continue;
    // p u + q v and r u + s v, of the determinant 1 or -1.
    int64_t p = 1, q = 0, r = 0, s = 1;
    int determinant = 1;
    const int64_t enough = int64_t{1} << random.integer(14, 32);
    while (p < enough) {
      const int64_t times = random.integer(1, 9);
      std::tie(p, q, r, s) = std::tuple(times * p + r, times * q + s, p, q);
      determinant = -determinant;
    }
    IVec3 from{}, a{}, b{}, above_a{}, above_b{};
    for (size_t k = 0; k < 3; ++k) {
      from[k] = random.integer(-99, 99);
      a[k] = from[k] + p * u[k] + q * v[k];
      b[k] = from[k] + r * u[k] + s * v[k];
      above_a[k] = from[k] + (i % 3 + 1) * off[k];
      above_b[k] = from[k] + (i % 5 + 1) * off[k];
    }
    PlaneTable planes;
    CellGeometry geometry(planes, nullptr);
    const auto point = [&](const IVec3& at) {
      std::array<uint32_t, 3> walls{};
      for (int k = 0; k < 3; ++k) {
        walls[k] = planes.intern({k == 0, k == 1, k == 2, -at[k]}).index();
      }
      return geometry.add_point(walls);
    };
    // Counter-clockwise around the normal; or seen from the other side.
    const IVec3 third{from[0] + u[0], from[1] + u[1], from[2] + u[2]},
        fourth{from[0] + v[0], from[1] + v[1], from[2] + v[2]};
    PlaneId support = planes.intern(plane_through(from, third, fourth));
    bool is_left = determinant > 0;
    if (random.integer(0, 1)) support = support.flip(), is_left = !is_left;
    const uint32_t start = point(from);
    DirectedEdge first{start, point(a), planes.intern(plane_through(from, a, above_a)).index()},
        second{start, point(b), planes.intern(plane_through(from, b, above_b)).index()};
    for (DirectedEdge* e : {&first, &second}) {
      if (random.integer(0, 1)) std::swap(e->from, e->to), is_left = !is_left;
    }
    ASSERT_EQ(turn_between(geometry, planes, support, first, second), is_left ? 1 : -1) << i;
    ++turns[is_left];
  }
  for (const int n : turns) EXPECT_GT(n, 500);
}

}  // namespace
}  // namespace csgrun::regions_test
