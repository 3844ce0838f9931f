// Convex pieces of regions with many corners and holes: they fill the region, once, and a convex
// region stays as it is. In rationals.
#include "engine/bsp/convexify.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/bsp/regions.h"
#include "tests/support/exact_solid.h"
#include "tests/support/gmp_bridge.h"
#include "tests/support/rational_polygons.h"
#include "tests/support/seeded.h"

namespace csgrun::convexify_test {
namespace {

using test::Rational3;
using Loop2 = std::vector<std::array<int64_t, 2>>;

/// A plane with loops in it, in one of three turns, seen from either side.
class Region {
 public:
  Region(int axis, bool flipped, const std::vector<Loop2>& loops)
      : geometry_(planes_, nullptr), axis_(axis) {
    // Slanted: u + 2 v + 3 w = 0, w along the axis.
    support_ = PlaneId(planes_.intern(plane(1, 2, 3, 0)).index(), flipped);
    for (const Loop2& loop : loops) {
      const size_t n = loop.size();
      std::vector<uint32_t> edges, points;
      for (size_t i = 0; i < n; ++i) edges.push_back(edge_plane(loop[i], loop[(i + 1) % n]));
      for (size_t i = 0; i < n; ++i) {
        uint32_t other = edges[(i + n - 1) % n];
        if (other == edges[i]) {  // straight on: a plane across the line
          const bool is_along = loop[i][0] == loop[(i + 1) % n][0];
          other =
              planes_.intern(is_along ? plane(0, 1, 0, -loop[i][1]) : plane(1, 0, 0, -loop[i][0]))
                  .index();
        }
        points.push_back(geometry_.add_point({support_.index(), other, edges[i]}));
      }
      for (size_t i = 0; i < n; ++i) {
        const size_t next = (i + 1) % n;
        edges_.push_back(flipped ? BoundaryEdge{points[next], points[i], edges[i]}
                                 : BoundaryEdge{points[i], points[next], edges[i]});
      }
      if (flipped) std::reverse(edges_.end() - static_cast<std::ptrdiff_t>(n), edges_.end());
    }
  }

  /// `thirds`: how far walls are beside whole numbers.
  void run(int thirds = 1) {
    const auto wall = [this, thirds](int axis, int64_t m) { return wall_at(axis, m, thirds); };
    convexify(geometry_, planes_, support_, edges_, wall, pieces_);
  }

  /// The same in two steps, within a convex polygon: what is left after the first has the area of
  /// what the second makes of it. Returns whether anything was cut off.
  bool run_within(const Loop2& cell) {
    std::vector<uint32_t> planes, points;
    const size_t n = cell.size();
    for (size_t i = 0; i < n; ++i) planes.push_back(edge_plane(cell[i], cell[(i + 1) % n]));
    for (size_t i = 0; i < n; ++i) {
      points.push_back(geometry_.add_point({support_.index(), planes[(i + n - 1) % n], planes[i]}));
    }
    if (support_.flipped()) {
      std::reverse(points.begin(), points.end());
      std::reverse(planes.begin(), planes.end() - 1);
    }
    RegionRest rest;
    const auto wall = [this](int axis, int64_t m) { return wall_at(axis, m, 1); };
    if (!cut_off_within(geometry_, planes_, geometry_.make_fragment(support_, points, planes),
                        edges_, wall, pieces_, rest)) {
      return false;
    }
    std::vector<DirectedEdge> edges;
    Rational3 area{0, 0, 0};
    for (const BoundaryEdge& e : rest.is_cut_off ? rest.edges : edges_) {
      edges.push_back({e.from, e.to, e.plane});
      area = test::sum(area, test::cross(at(e.from), at(e.to)), 1);
    }
    RegionLoops loops;
    EXPECT_TRUE(RegionBuilder(geometry_, planes_).build_single(support_, edges, loops));
    rest.edges.clear();
    for (const DirectedEdge& e : loops.edges) rest.edges.push_back({e.from, e.to, e.plane});
    const size_t before = pieces_.size();
    convexify_within(geometry_, planes_, rest.cell, rest.edges, wall, pieces_);
    for (size_t f = before; f < pieces_.size(); ++f) {
      std::vector<Rational3> outline;
      for (uint32_t c = 0; c < pieces_[f].count; ++c) {
        outline.push_back(at(geometry_.corners(pieces_[f])[c]));
      }
      area = test::sum(area, test::area_of(outline), -1);
    }
    EXPECT_EQ(area, (Rational3{0, 0, 0}));
    EXPECT_EQ(rest.is_cut_off, before > 0);
    return rest.is_cut_off;
  }

  /// Divides one loop by itself.
  bool run_loop() { return LoopPieces(geometry_, planes_, support_).add(edges_, pieces_); }

  [[nodiscard]] const std::vector<BoundaryEdge>& edges() const { return edges_; }
  /// Gives corners in one place one point.
  void join_points() {
    for (const BoundaryEdge& one : std::vector(edges_)) {
      for (BoundaryEdge& e : edges_) {
        if (at(e.from) == at(one.from)) e.from = one.from;
        if (at(e.to) == at(one.from)) e.to = one.from;
      }
    }
  }
  [[nodiscard]] const std::vector<Fragment>& pieces() const { return pieces_; }
  CellGeometry& geometry() { return geometry_; }
  Rational3 at(uint32_t point) {
    const test::GmpPoint p = test::to_gmp(geometry_.exact(point));
    return {mpq_class(p.x) / p.w, mpq_class(p.y) / p.w, mpq_class(p.z) / p.w};
  }

  /// Pieces are convex polygons of the plane, turn left, and fill the region without overlap.
  void check() {
    const Plane plane = planes_.oriented(support_);
    const Rational3 normal{test::to_gmp(plane.a), test::to_gmp(plane.b), test::to_gmp(plane.c)};
    const Rational3 origin{0, 0, 0};
    Rational3 area{0, 0, 0};
    for (const BoundaryEdge& e : edges_) {
      area = test::sum(area, test::cross(at(e.from), at(e.to)), 1);
    }
    std::vector<std::vector<Rational3>> outlines;
    std::vector<Rational3> middles;
    for (const Fragment& f : pieces_) {
      ASSERT_EQ(f.support, support_);
      auto& outline = outlines.emplace_back();
      Rational3& middle = middles.emplace_back(origin);
      for (uint32_t c = 0; c < f.count; ++c) {
        outline.push_back(at(geometry_.corners(f)[c]));
        middle = test::sum(middle, outline.back(), mpq_class(1, f.count));
      }
      for (uint32_t c = 0; c < f.count; ++c) {
        const Rational3 &p = outline[c], &q = outline[(c + 1) % f.count],
                        &r = outline[(c + 2) % f.count];
        ASSERT_GE(test::dot(normal, test::cross(test::minus(q, p), test::minus(r, q))), 0);
        const uint32_t edge = geometry_.edges(f)[c];
        ASSERT_NE(edge, support_.index());
        ASSERT_EQ(geometry_.side(edge, geometry_.corners(f)[c]), 0);
        ASSERT_EQ(geometry_.side(edge, geometry_.corners(f)[(c + 1) % f.count]), 0);
      }
      const Rational3 own = test::area_of(outline);
      ASSERT_GT(test::dot(normal, own), 0);
      area = test::sum(area, own, -1);
    }
    EXPECT_EQ(area, origin);
    for (size_t i = 0; i < outlines.size(); ++i) {
      for (size_t j = 0; j < outlines.size(); ++j) {
        ASSERT_EQ(test::covers(outlines[i], middles[j]), i == j);
      }
    }
  }

 private:
  uint32_t wall_at(int axis, int64_t m, int thirds) {
    Plane p{0, 0, 0, -(3 * static_cast<Int128>(m) + thirds)};
    (axis == 0 ? p.a : axis == 1 ? p.b : p.c) = 3;
    return planes_.intern(p).index();
  }

  uint32_t edge_plane(const std::array<int64_t, 2>& p, const std::array<int64_t, 2>& q) {
    const int64_t a = q[1] - p[1], b = p[0] - q[0];
    return planes_.intern(plane(a, b, 0, -(a * p[0] + b * p[1]))).index();
  }

  /// With coefficients of u, v and w, where w is along the axis.
  [[nodiscard]] Plane plane(int64_t u, int64_t v, int64_t w, int64_t d) const {
    std::array<Int128, 3> n{};
    n[(axis_ + 1) % 3] = u, n[(axis_ + 2) % 3] = v, n[axis_] = w;
    return {n[0], n[1], n[2], d};
  }

  PlaneTable planes_;
  CellGeometry geometry_;
  const int axis_;
  PlaneId support_;
  std::vector<BoundaryEdge> edges_;
  std::vector<Fragment> pieces_;
};

/// Corners around the origin, at random distances; no three follow each other in a line.
Loop2 star(test::Random& random, int corners) {
  for (;;) {
    Loop2 loop;
    for (int i = 0; i < corners; ++i) {
      const double angle = (i + 0.8 * random.unit()) * 6.28318 / corners;
      const double radius = 40 + 400 * random.unit();
      loop.push_back(
          {std::llround(radius * std::cos(angle)), std::llround(radius * std::sin(angle))});
    }
    bool is_good = true;
    for (int i = 0; i < corners; ++i) {
      const auto &p = loop[i], &q = loop[(i + 1) % corners], &r = loop[(i + 2) % corners];
      is_good = is_good && p[0] * q[1] - p[1] * q[0] > 0 &&
                (q[0] - p[0]) * (r[1] - q[1]) != (q[1] - p[1]) * (r[0] - q[0]);
    }
    if (is_good) return loop;
  }
}

TEST(Convexify, PiecesFillTheRegion) {
  test::Random random(91);
  for (int i = 0; i < 60 && !testing::Test::HasFailure(); ++i) {
    const Loop2 outer = star(random, static_cast<int>(random.integer(4, i % 4 ? 11 : 40)));
    std::vector<Loop2> loops{outer};
    if (random.integer(0, 1)) {
      // The same with a third of the size is a hole; with a ninth, an island in it.
      for (auto& p : loops[0]) p = {9 * p[0], 9 * p[1]};
      Loop2 hole = outer;
      for (auto& p : hole) p = {3 * p[0], 3 * p[1]};
      std::reverse(hole.begin(), hole.end());
      loops.push_back(hole);
      if (random.integer(0, 1)) loops.push_back(outer);
    }
    Region region(i % 3, i / 3 % 2 != 0, loops);
    region.run();
    region.check();
    EXPECT_LE(region.pieces().size(), 3 * region.edges().size()) << "case " << i;
  }
}

// A hole in a plate, or a notch in its rim, small beside it or not.
TEST(Convexify, WhatIsCutOffAndTheRestFillTheRegion) {
  test::Random random(92);
  int cut_off = 0, all = 0;
  for (int i = 0; i < 120 && !testing::Test::HasFailure(); ++i) {
    const int64_t size = i % 2 ? 20000 : 1500;
    Loop2 cell{{-size, -size}, {size + 3, -size}, {size, size}, {-size, size + 7}};
    if (i % 5 == 0) cell.pop_back();
    std::rotate(cell.begin(), cell.begin() + random.integer(0, 2), cell.end());
    std::vector<Loop2> loops{cell};
    if (i % 3 == 0) {
      // In the side along -size.
      const auto side = std::find(cell.begin(), cell.end(), std::array<int64_t, 2>{-size, -size});
      const auto at = side - cell.begin() + 1;
      const int64_t left = random.integer(-900, 0), right = left + random.integer(30, 300);
      loops[0].insert(loops[0].begin() + at, {{left, -size},
                                              {left + random.integer(-9, 9), 90 - size},
                                              {right, 40 - size},
                                              {right + 1, -size}});
    } else {
      Loop2 hole = star(random, static_cast<int>(random.integer(4, 14)));
      for (auto& p : hole) p = {p[0] + 500, p[1] - 500};
      std::reverse(hole.begin(), hole.end());
      loops.push_back(hole);
    }
    Region region(i % 3, i / 3 % 2 != 0, loops);
    cut_off += region.run_within(cell);
    ++all;
    region.check();
  }
  EXPECT_GT(cut_off, 30);
  EXPECT_LT(cut_off, all - 20);
}

TEST(Convexify, ConvexLoopsStayAsTheyAre) {
  for (int turn = 0; turn < 6; ++turn) {
    for (const Loop2& loop : {Loop2{{0, 0}, {7, 1}, {2, 9}}, Loop2{{0, 0}, {7, 1}, {8, 6}, {1, 4}},
                              Loop2{{0, 0}, {3, 0}, {5, 1}, {6, 3}, {6, 6}, {3, 8}, {0, 5}}}) {
      Region region(turn % 3, turn / 3 != 0, {loop});
      region.run();
      ASSERT_EQ(region.pieces().size(), 1u);
      const Fragment& f = region.pieces()[0];
      ASSERT_EQ(f.count, region.edges().size());
      for (uint32_t c = 0; c < f.count; ++c) {
        EXPECT_EQ(region.geometry().corners(f)[c], region.edges()[c].from);
        EXPECT_EQ(region.geometry().edges(f)[c], region.edges()[c].plane);
      }
    }
    // One corner turns right, whichever is the first; two triangles.
    const Loop2 dart{{0, 0}, {9, -4}, {3, 1}, {2, 8}};
    for (int first = 0; first < 4; ++first) {
      Loop2 loop = dart;
      std::rotate(loop.begin(), loop.begin() + first, loop.end());
      Region region(turn % 3, turn / 3 != 0, {loop});
      region.run();
      EXPECT_GT(region.pieces().size(), 1u);
      region.check();
    }
    Region region(turn % 3, turn / 3 != 0,
                  {{{0, 0}, {7, 1}, {2, 9}}, {{20, 20}, {27, 21}, {22, 29}}});
    region.run();
    EXPECT_EQ(region.pieces().size(), 2u);
    region.check();
  }
}

/// The number of corners that turn right.
size_t count_reflex(const Loop2& loop) {
  size_t count = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    const auto &p = loop[i], &q = loop[(i + 1) % loop.size()], &r = loop[(i + 2) % loop.size()];
    count += (q[0] - p[0]) * (r[1] - q[1]) < (q[1] - p[1]) * (r[0] - q[0]);
  }
  return count;
}

TEST(LoopPieces, FillTheLoopWithAPieceForEachCornerThatTurnsRight) {
  test::Random random(92);
  for (int i = 0; i < 90 && !testing::Test::HasFailure(); ++i) {
    const Loop2 loop = star(random, static_cast<int>(random.integer(4, i % 4 ? 9 : 30)));
    Region region(i % 3, i / 3 % 2 != 0, {loop});
    ASSERT_TRUE(region.run_loop());
    region.check();
    EXPECT_LE(region.pieces().size(), 1 + count_reflex(loop)) << "case " << i;
  }
}

TEST(LoopPieces, LinesThatEndInCorners) {
  // From the corners of a cross, a comb and stairs on small numbers, lines end in others.
  const Loop2 cross{{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2},
                    {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
  const Loop2 comb{{0, 0}, {7, 0}, {7, 3}, {6, 3}, {6, 1}, {5, 1},
                   {5, 3}, {3, 3}, {3, 1}, {2, 1}, {2, 3}, {0, 3}};
  const Loop2 stairs{{0, 0}, {4, 0}, {4, 1}, {3, 1}, {3, 2},
                     {2, 2}, {2, 3}, {1, 3}, {1, 4}, {0, 4}};
  const Loop2 hourglass{{0, 0}, {6, 0}, {4, 3}, {6, 6}, {0, 6}, {2, 3}};
  // The line from (2, 5) ends in the tip of a spike, and on one side of it the tip still turns
  // right.
  const Loop2 spike_above{{0, 10}, {0, 5}, {2, 5},  {2, 0},  {10, 0},
                          {10, 7}, {5, 5}, {10, 8}, {10, 10}},
      spike_below{{0, 10}, {0, 5}, {2, 5}, {2, 0}, {10, 0}, {10, 2}, {5, 5}, {10, 3}, {10, 10}};
  for (const Loop2& loop : {cross, comb, stairs, hourglass, spike_above, spike_below}) {
    for (size_t first = 0; first < loop.size(); ++first) {
      for (int turn = 0; turn < 6; ++turn) {
        Loop2 turned = loop;
        std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first),
                    turned.end());
        Region region(turn % 3, turn / 3 != 0, {turned});
        ASSERT_TRUE(region.run_loop());
        region.check();
        EXPECT_LE(region.pieces().size(), 1 + count_reflex(loop));
      }
    }
  }
}

TEST(LoopPieces, StraightCornersAreLeftOut) {
  for (int turn = 0; turn < 6; ++turn) {
    for (size_t first = 0; first < 6; ++first) {
      Loop2 loop{{0, 0}, {3, 0}, {7, 0}, {7, 5}, {7, 9}, {0, 9}};
      std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(first), loop.end());
      Region region(turn % 3, turn / 3 != 0, {loop});
      ASSERT_TRUE(region.run_loop());
      ASSERT_EQ(region.pieces().size(), 1u);
      EXPECT_EQ(region.pieces()[0].count, 4u);
      region.check();
    }
    // Of two lines in one, the nearer edge ends the one that is drawn on.
    Region region(
        turn % 3, turn / 3 != 0,
        {{{0, 0}, {9, 0}, {9, 2}, {8, 2}, {8, 4}, {6, 4}, {6, 2}, {4, 2}, {4, 5}, {0, 5}}});
    ASSERT_TRUE(region.run_loop());
    region.check();
  }
}

TEST(LoopPieces, RefusesWhatIsNoOutline) {
  for (int turn = 0; turn < 6; ++turn) {
    const Loop2 clockwise{{0, 0}, {0, 4}, {1, 1}, {4, 0}};
    // One that passes a point twice, and one that goes back where it came from.
    const Loop2 pinched{{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}, {2, 2}};
    const Loop2 slit{{0, 0}, {8, 0}, {8, 6}, {4, 6}, {4, 2}, {4, 6}, {0, 6}};
    for (const Loop2& loop : {clockwise, slit}) {
      Region region(turn % 3, turn / 3 != 0, {loop});
      EXPECT_FALSE(region.run_loop());
      EXPECT_TRUE(region.pieces().empty());
    }
    Region region(turn % 3, turn / 3 != 0, {pinched});
    region.join_points();
    EXPECT_FALSE(region.run_loop());
    EXPECT_TRUE(region.pieces().empty());
  }
}

// Wherever a loop starts, and whichever corners are as low as the lowest, it is an outline; and it
// is none the other way round.
TEST(LoopPieces, AnyCornerMayBeTheFirst) {
  test::Random random(93);
  std::vector<Loop2> loops{
      {{0, 0}, {7, 0}, {7, 9}, {0, 9}, {0, 5}, {0, 2}},
      {{0, 0}, {2, 0}, {5, 0}, {7, 0}, {7, 9}, {0, 9}},
      {{0, 0}, {2, 3}, {4, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 6}, {3, 5}, {0, 4}}};
  for (int i = 0; i < 30; ++i)
    loops.push_back(star(random, static_cast<int>(random.integer(4, 9))));
  for (const Loop2& loop : loops) {
    for (size_t first = 0; first < loop.size(); ++first) {
      const int turn = static_cast<int>(random.integer(0, 5));
      Loop2 turned = loop;
      std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first),
                  turned.end());
      Region region(turn % 3, turn / 3 != 0, {turned});
      ASSERT_TRUE(region.run_loop());
      region.check();
      std::reverse(turned.begin(), turned.end());
      Region clockwise(turn % 3, turn / 3 != 0, {turned});
      EXPECT_FALSE(clockwise.run_loop());
      EXPECT_TRUE(clockwise.pieces().empty());
    }
  }
}

TEST(LoopPieces, TurnsTooSmallForDoubles) {
  // A corner that is off the line by less than a step at coordinates of 26 bits.
  const int64_t far = int64_t{1} << 25;
  for (int turn = 0; turn < 6; ++turn) {
    for (const int64_t off : {-1, 1}) {
      Region region(turn % 3, turn / 3 != 0,
                    {{{-far, -far}, {far - 1, -far - 1}, {off, far / 2}, {-far + 1, 2 * far}}});
      ASSERT_TRUE(region.run_loop());
      region.check();
    }
  }
}

// Corners at large coordinates that doubles round, of edges that are straight on but for angles of
// 2^-30 to 2^-50: the turn is that of the exact points.
TEST(LoopPieces, TurnsAreThoseOfExactPoints) {
  test::Random random(94);
  size_t left = 0, right = 0;
  for (int i = 0; i < 4000; ++i) {
    PlaneTable planes;
    CellGeometry geometry(planes, nullptr);
    const int axis = i % 3, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto plane = [&](Int128 a, Int128 b, Int128 c, Int128 d) {
      std::array<Int128, 3> n{};
      n[u] = a, n[v] = b, n[axis] = c;
      return planes.intern({n[0], n[1], n[2], d}).index();
    };
    // Seen along the axis: the plane is u + 2 v + 3 w = 0.
    const uint32_t support = plane(1, 2, 3, 0);
    const int64_t reach = int64_t{1} << random.integer(4, 25);
    const int64_t qu = 3 * random.integer(-reach, reach), qv = 3 * random.integer(-reach, reach);
    // A line through that point along (b, -a), and one with nearly the same direction.
    const int64_t size = int64_t{1} << random.integer(15, 25);
    const int64_t a = random.integer(-size, size), b = random.integer(-size, size);
    int64_t s = 0, t = 0;  // with a t - b s = 1 or so
    for (int64_t x = a, y = b, s0 = 1, t0 = 0, s1 = 0, t1 = 1; y != 0;) {
      const int64_t quotient = x / y, rest = x % y;
      const int64_t s2 = s0 - quotient * s1, t2 = t0 - quotient * t1;
      x = y, y = rest, s0 = s1, t0 = t1, s1 = s2, t1 = t2;
      s = -t0, t = s0;
    }
    if (a == 0 || b == 0 || (s == 0 && t == 0)) continue;
    const int64_t times = random.integer(0, 3), sign = random.integer(0, 1) ? 1 : -1;
    const int64_t a2 = a * times + sign * s, b2 = b * times + sign * t;
    if (a2 == 0 && b2 == 0) continue;
    const auto line = [&](int64_t m, int64_t n) {
      return plane(m, n, 0, -(static_cast<Int128>(m) * qu + static_cast<Int128>(n) * qv));
    };
    const uint32_t one = line(a, b), two = line(a2, b2);
    if (one == two) continue;
    // Points on the two, a third of a step off the grid along one axis.
    const auto across = [&](bool along_u, int64_t away) {
      return along_u ? plane(3, 0, 0, -(3 * static_cast<Int128>(qu + away) + 1))
                     : plane(0, 3, 0, -(3 * static_cast<Int128>(qv + away) + 1));
    };
    const auto point_on = [&](uint32_t of, int64_t m, int64_t n) {
      const int64_t most = random.integer(0, 1) ? 3 : 5000;
      const int64_t away = random.integer(1, most) * (random.integer(0, 1) ? 1 : -1);
      return geometry.add_point({support, of, across(std::abs(m) < std::abs(n), away)});
    };
    uint32_t p = point_on(one, a, b), r = point_on(two, a2, b2);
    const uint32_t q = geometry.add_point({support, one, two});
    const auto at = [&](uint32_t point) {
      const test::GmpPoint x = test::to_gmp(geometry.exact(point));
      const std::array<mpq_class, 3> c{mpq_class(x.x) / x.w, mpq_class(x.y) / x.w,
                                       mpq_class(x.z) / x.w};
      return std::array<mpq_class, 2>{c[u], c[v]};
    };
    const auto cross = [&](const auto& x, const auto& y, const auto& z) {
      return mpq_class((y[0] - x[0]) * (z[1] - y[1]) - (y[1] - x[1]) * (z[0] - y[0]));
    };
    const int expected = sgn(cross(at(p), at(q), at(r)));
    for (const bool flipped : {false, true}) {
      LoopPieces loops(geometry, planes, PlaneId(support, flipped));
      ASSERT_EQ(loops.turn({p, q, one}, {q, r, two}), flipped ? -expected : expected)
          << "case " << i;
      ASSERT_EQ(loops.turn({r, q, two}, {q, p, one}), flipped ? expected : -expected);
    }
    ++(expected > 0 ? left : right);
  }
  EXPECT_GT(left, 1000u);
  EXPECT_GT(right, 1000u);
}

// Most edges begin in one line, in which there is a wall: the others are all on one side of it.
TEST(Convexify, NothingIsDividedByAWallThatHoldsEdges) {
  for (int turn = 0; turn < 6; ++turn) {
    for (const bool mirrored : {false, true}) {
      std::vector<Loop2> loops{{{300, 0}, {400, 0}, {400, 50}, {300, 50}},
                               {{310, 10}, {310, 20}, {320, 20}, {320, 10}}};
      for (int64_t i = 0; i < 20; ++i) {
        loops.push_back({{0, 12 * i}, {7, 12 * i + 4}, {0, 12 * i + 9}});
      }
      if (mirrored) {
        for (Loop2& loop : loops) {
          for (auto& p : loop) p[0] = -p[0];
          std::reverse(loop.begin(), loop.end());
        }
      }
      Region region(turn % 3, turn / 3 != 0, loops);
      region.run(0);
      region.check();
    }
  }
}

TEST(Convexify, OfNothingIsNothing) {
  Region region(0, false, {});
  region.run();
  EXPECT_TRUE(region.pieces().empty());
}

}  // namespace
}  // namespace csgrun::convexify_test
