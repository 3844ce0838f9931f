// Labels of volumes from what cells say of them, by hand: what contradicts itself is noticed.
#include "engine/bsp/surface_volumes.h"

#include <gtest/gtest.h>

#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun::surface_volumes_test {
namespace {

/// Volumes of winding 0, 1, 2, -1 in one cell, and what is seen of patch 0 there.
std::vector<SurfaceCells> runs_with(const std::vector<std::array<uint32_t, 2>>& sides) {
  std::vector<SurfaceCells> runs(1);
  runs[0].windings = {0, 1, 2, -1};
  for (const auto& [front, back] : sides) runs[0].patches.push_back({0, front, back});
  return runs;
}

TEST(SurfaceVolumes, WindingsAreInsideByTheRule) {
  const auto inside = [](InsideRule rule) {
    return label_by_winding(runs_with({}), 0, rule)->volumes;
  };
  EXPECT_EQ(inside(InsideRule::kNonZero), (std::vector<std::vector<uint8_t>>{{0, 1, 1, 1}}));
  EXPECT_EQ(inside(InsideRule::kPositive), (std::vector<std::vector<uint8_t>>{{0, 1, 1, 0}}));
  EXPECT_EQ(inside(InsideRule::kEvenOdd), (std::vector<std::vector<uint8_t>>{{0, 1, 0, 1}}));
}

TEST(SurfaceVolumes, APatchHasOneLabelOnEachSide) {
  const auto labels = [](const std::vector<std::array<uint32_t, 2>>& sides) {
    return label_by_winding(runs_with(sides), 2, InsideRule::kNonZero);
  };
  const auto same = labels({{0, 1}, {0, 2}});
  ASSERT_TRUE(same);
  EXPECT_TRUE(same->patches[0].known);
  EXPECT_FALSE(same->patches[0].front);
  EXPECT_TRUE(same->patches[0].back);
  EXPECT_FALSE(same->patches[1].known);
  EXPECT_FALSE(labels({{0, 1}, {1, 1}}));
  EXPECT_FALSE(labels({{0, 1}, {0, 0}}));
  EXPECT_FALSE(labels({{0, 1}, {1, 0}}));
}

TEST(SurfaceVolumes, AReachThatStartsNowhereIsNone) {
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {4, 4, 4}))};
  const Job job(operands);
  std::vector<SurfaceCells> runs = runs_with({{0, 1}});
  EXPECT_FALSE(label_by_reach(job, runs, 1, 5, InsideRule::kOuterHull));
  runs[0].vertex_volumes.push_back({4, 0});  // another vertex
  EXPECT_FALSE(label_by_reach(job, runs, 1, 5, InsideRule::kOuterHull));
  runs[0].vertex_volumes.push_back({5, 0});
  const auto labels = label_by_reach(job, runs, 1, 5, InsideRule::kOuterHull);
  ASSERT_TRUE(labels);
  EXPECT_EQ(labels->volumes, (std::vector<std::vector<uint8_t>>{{0, 1, 1, 1}}));
  EXPECT_FALSE(labels->patches[0].front);
  EXPECT_TRUE(labels->patches[0].back);
}

// From the outside, through what faces away from one who comes.
TEST(SurfaceVolumes, AnOrientedHullIsEnteredFromBehind) {
  const std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {4, 4, 4}))};
  const Job job(operands);
  std::vector<SurfaceCells> runs = runs_with({});
  runs[0].vertex_volumes.push_back({5, 0});
  // 0 | 1 faces 0; 2 | 0 faces 2, so that 0 is behind it; 3 | 2 faces both ways.
  runs[0].sides = {{0, 1, true, false}, {2, 0, true, false}, {3, 2, true, true}};
  const auto inside = [&](InsideRule rule) {
    return label_by_reach(job, runs, 0, 5, rule)->volumes[0];
  };
  EXPECT_EQ(inside(InsideRule::kOuterHull), (std::vector<uint8_t>{0, 1, 1, 1}));
  EXPECT_EQ(inside(InsideRule::kOrientedHull), (std::vector<uint8_t>{0, 1, 0, 1}));
  runs[0].sides.push_back({2, 3, false, true});  // faces 3: entered from 2
  EXPECT_EQ(inside(InsideRule::kOrientedHull), (std::vector<uint8_t>{0, 1, 0, 0}));
  runs[0].sides.push_back({0, 2, true, false});  // and back again
  EXPECT_EQ(inside(InsideRule::kOrientedHull), (std::vector<uint8_t>{0, 1, 0, 0}));
}

/// Cells by hand: edges of pieces in walls, each of two volumes of its own.
class HandMade {
 public:
  HandMade() : operands_{test::operand_of(test::box_leaf({0, 0, 0}, {4, 4, 4}))}, job_(operands_) {}

  Job& job() { return job_; }
  const std::vector<SurfaceCells>& runs() const { return runs_; }
  uint32_t plane(const Plane& p) { return job_.planes().intern(p).index(); }

  /// The point of the line x_k = m + 1/p of a plane at which x_j = t + 1/p.
  FragmentSet::NamedPoint point(const Plane& plane, int k, int64_t m, int j, int64_t t) {
    const int64_t p = job_.prime();
    const int i = 3 - k - j;
    const std::array<int64_t, 3> n{static_cast<int64_t>(plane.a), static_cast<int64_t>(plane.b),
                                   static_cast<int64_t>(plane.c)};
    FragmentSet::NamedPoint point;
    point.rounded[k] = static_cast<double>(p * m + 1) / static_cast<double>(p);
    point.rounded[j] = static_cast<double>(p * t + 1) / static_cast<double>(p);
    point.rounded[i] = static_cast<double>(-p * static_cast<int64_t>(plane.d) - n[k] * (p * m + 1) -
                                           n[j] * (p * t + 1)) /
                       static_cast<double>(p * n[i]);
    point.planes = {this->plane(plane), job_.wall(k, m), job_.wall(j, t)};
    point.vertex = kNone;
    return point;
  }

  /// Adds an edge to a run and returns the number of its front; the back is the next one.
  uint32_t add(size_t run, uint32_t support, uint32_t wall, bool is_below,
               const FragmentSet::NamedPoint& from, const FragmentSet::NamedPoint& to) {
    SurfaceCells& cells = runs_[run];
    const auto front = static_cast<uint32_t>(cells.windings.size());
    cells.windings.resize(front + 2);
    const auto first = static_cast<uint32_t>(cells.set.points.size());
    cells.set.points.insert(cells.set.points.end(), {from, to});
    cells.wall_edges.push_back({support, wall, is_below, first, first + 1, front, front + 1});
    return front;
  }

  /// Which volumes are one with this one, by run.
  std::vector<std::vector<uint8_t>> joined_with(size_t run, uint32_t volume) {
    auto runs = runs_;
    runs[run].vertex_volumes.push_back({0, volume});
    auto inside = label_by_reach(job_, runs, 0, 0, InsideRule::kOuterHull)->volumes;
    for (auto& of_run : inside) {
      for (uint8_t& v : of_run) v = v ? 0 : 1;
    }
    return inside;
  }

 private:
  std::vector<Operand> operands_;
  Job job_;
  std::vector<SurfaceCells> runs_ = std::vector<SurfaceCells>(2);
};

/// An edge on a line, between two places, on one side of it.
struct OnLine {
  size_t line;
  bool is_below;
  int64_t from, to;
  size_t run;
  uint32_t front;
};

// The surface runs on where edges on either side of a line overlap.
TEST(SurfaceVolumes, EdgesOnBothSidesOfAWallAreJoined) {
  test::Random random(971);
  size_t joined = 0, apart = 0;
  for (int round = 0; round < 60; ++round) {
    HandMade cells;
    std::vector<OnLine> edges;
    for (size_t line = 0; line < 3; ++line) {
      const int k = static_cast<int>(random.integer(0, 2)), j = (k + (line % 2 ? 1 : 2)) % 3;
      std::array<int64_t, 3> n{};
      n[k] = random.integer(-3, 3), n[j] = random.integer(-3, 3);
      n[3 - k - j] = random.integer(1, 3) * (random.integer(0, 1) ? 1 : -1);
      const Plane plane{n[0], n[1], n[2], random.integer(-9, 9) * 10 + static_cast<int>(line)};
      const int64_t m = random.integer(-5, 5);
      const uint32_t support = cells.plane(plane), wall = cells.job().wall(k, m);
      for (const bool is_below : {true, false}) {
        for (int64_t t = random.integer(-9, -4); t < 6;) {
          const int64_t from = t + random.integer(0, 2), to = from + random.integer(1, 4);
          t = to;
          const auto a = cells.point(plane, k, m, j, from), b = cells.point(plane, k, m, j, to);
          const bool turned = random.integer(0, 1) != 0;
          const auto run = static_cast<size_t>(random.integer(0, 1));
          const uint32_t front =
              cells.add(run, support, wall, is_below, turned ? b : a, turned ? a : b);
          edges.push_back({line, is_below, from, to, run, front});
        }
      }
    }
    ASSERT_FALSE(crosses_in_wall(cells.job(), cells.runs()));
    for (const OnLine& start : edges) {
      // All that hang together with it.
      std::vector<uint8_t> reached(edges.size(), 0);
      for (bool grows = true; grows;) {
        grows = false;
        for (size_t a = 0; a < edges.size(); ++a) {
          if (reached[a]) continue;
          for (size_t b = 0; b < edges.size(); ++b) {
            const OnLine &x = edges[a], &y = edges[b];
            if (&x == &start || (reached[b] && x.line == y.line && x.is_below != y.is_below &&
                                 x.from < y.to && y.from < x.to)) {
              reached[a] = 1, grows = true;
            }
          }
        }
      }
      const auto front = cells.joined_with(start.run, start.front),
                 back = cells.joined_with(start.run, start.front + 1);
      for (size_t e = 0; e < edges.size(); ++e) {
        const OnLine& edge = edges[e];
        ASSERT_EQ(front[edge.run][edge.front], reached[e]) << "round " << round;
        ASSERT_EQ(front[edge.run][edge.front + 1], 0);
        ASSERT_EQ(back[edge.run][edge.front + 1], reached[e]);
        ASSERT_EQ(back[edge.run][edge.front], 0);
        ++(reached[e] ? joined : apart);
      }
    }
  }
  EXPECT_GT(joined, 1000u);
  EXPECT_GT(apart, 1000u);
}

// In a line where two walls meet, either of them may be named.
TEST(SurfaceVolumes, EdgesWhereTwoWallsMeetAreJoinedWhicheverIsNamed) {
  for (int along = 0; along < 3; ++along) {
    const int k = (along + 1) % 3, l = (along + 2) % 3;
    // With walls at thirds: a / 3 + b / 3 is whole.
    for (const auto& [a, b] : {std::pair{1, -1}, {-1, 1}, {1, 2}, {2, 1}, {-2, -1}, {4, -1}}) {
      const int64_t m = 5, o = -2;
      std::array<int64_t, 3> n{};
      n[k] = a, n[l] = b;
      const Plane plane{n[0], n[1], n[2], -(a * m + b * o + (a + b) / 3)};
      const bool rises = a * b < 0;  // from below both to above both
      for (int names = 0; names < 8; ++names) {
        HandMade cells;
        ASSERT_EQ(cells.job().prime(), 3);
        const uint32_t support = cells.plane(plane);
        const uint32_t walls[2] = {cells.job().wall(k, m), cells.job().wall(l, o)};
        const auto from = cells.point(plane, k, m, along, 0),
                   to = cells.point(plane, k, m, along, 3);
        // Below the wall across k, or above it; then the same of another piece.
        const bool is_below_k[2] = {true, (names & 4) != 0};
        for (const int piece : {0, 1}) {
          const int name = names >> piece & 1;
          const bool is_below = name == 0 || rises ? is_below_k[piece] : !is_below_k[piece];
          cells.add(static_cast<size_t>(piece), support, walls[name], is_below, from, to);
        }
        EXPECT_FALSE(crosses_in_wall(cells.job(), cells.runs()));
        const uint8_t runs_on = is_below_k[0] != is_below_k[1];
        EXPECT_EQ(cells.joined_with(0, 0),
                  (std::vector<std::vector<uint8_t>>{{1, 0}, {runs_on, 0}}))
            << "along " << along << ", " << a << ' ' << b << ", names " << names;
      }
    }
  }
}

TEST(SurfaceVolumes, PolygonsThatCrossInAWallAreFound) {
  const Plane rising{1, -1, 0, 0}, falling{1, 2, 0, -1}, other{1, -1, 0, 4};  // x = y = 1/3
  const auto crosses = [&](const std::vector<std::pair<Plane, int>>& planes) {
    HandMade cells;
    for (const auto& [plane, wall] : planes) {
      const auto at = cells.point(rising, 0, 0, 2, 0);
      cells.add(0, cells.plane(plane), cells.job().wall(wall, 0), true, at, at);
    }
    return crosses_in_wall(cells.job(), cells.runs());
  };
  EXPECT_FALSE(crosses({{rising, 0}, {rising, 0}}));
  EXPECT_FALSE(crosses({{rising, 0}, {rising, 1}}));
  EXPECT_TRUE(crosses({{rising, 0}, {falling, 0}}));
  EXPECT_TRUE(crosses({{other, 0}, {rising, 0}, {falling, 1}}));
  EXPECT_FALSE(crosses({{rising, 0}, {other, 0}, {other, 1}}));
}

// A set of volumes is outside if what is below its lowest point is the set itself.
TEST(SurfaceVolumes, FillingAsksForTheLowestPoints) {
  test::Random random(972);
  size_t filled = 0, open = 0, unknown = 0;
  for (int round = 0; round < 400; ++round) {
    HandMade cells;
    std::vector<SurfaceCells> runs(static_cast<size_t>(random.integer(1, 2)));
    struct Lowest {
      IVec3 at{};
      uint32_t below = kNone;
      bool any = false;
    };
    std::vector<std::vector<Lowest>> lowest;
    for (SurfaceCells& run : runs) {
      const auto volumes = static_cast<uint32_t>(random.integer(2, 5));
      run.windings.assign(volumes, 0);
      std::vector<Lowest> of_run(volumes);
      std::vector<IVec3> places;
      for (int64_t p = random.integer(4, 9); p > 0; --p) {
        const IVec3 at{random.integer(0, 1), random.integer(0, 1), random.integer(0, 2)};
        if (std::find(places.begin(), places.end(), at) != places.end()) continue;
        places.push_back(at);
        FragmentSet::NamedPoint point{{}, {}, kNone};
        for (int k = 0; k < 3; ++k) {
          point.rounded[k] = static_cast<double>(3 * at[k] + 1) / 3;
          point.planes[k] = cells.job().wall(k, at[k]);
        }
        run.set.points.push_back(point);
        run.below_point.push_back(random.integer(0, 9) == 0
                                      ? kNone
                                      : static_cast<uint32_t>(random.integer(0, volumes - 1)));
      }
      for (int64_t piece = random.integer(1, 4); piece > 0; --piece) {
        const auto front = static_cast<uint32_t>(random.integer(0, volumes - 1)),
                   back = static_cast<uint32_t>(random.integer(0, volumes - 1));
        run.sides.push_back({front, back, true, false});
        run.set.pieces.push_back(
            {PlaneId{}, 0, static_cast<uint32_t>(run.set.corner_point.size()), 3});
        for (int c = 0; c < 3; ++c) {
          const auto point =
              static_cast<uint32_t>(random.integer(0, static_cast<int64_t>(places.size()) - 1));
          run.set.corner_point.push_back(point);
          for (const uint32_t v : {front, back}) {
            if (of_run[v].any && of_run[v].at <= places[point]) continue;
            of_run[v] = {places[point], run.below_point[point], true};
          }
        }
      }
      lowest.push_back(of_run);
    }
    bool is_known = true;
    std::vector<std::vector<uint8_t>> expected;
    for (const auto& of_run : lowest) {
      expected.emplace_back();
      for (uint32_t v = 0; v < of_run.size(); ++v) {
        is_known = is_known && (!of_run[v].any || of_run[v].below != kNone);
        expected.back().push_back(!of_run[v].any || of_run[v].below != v);
      }
    }
    const auto labels = label_by_filling(cells.job(), runs);
    ASSERT_EQ(labels.has_value(), is_known) << "round " << round;
    if (!labels) {
      ++unknown;
      continue;
    }
    ASSERT_EQ(labels->volumes, expected) << "round " << round;
    for (const auto& of_run : expected) {
      for (const uint8_t v : of_run) ++(v ? filled : open);
    }
  }
  EXPECT_GT(filled, 100u);
  EXPECT_GT(open, 100u);
  EXPECT_GT(unknown, 20u);
}

}  // namespace
}  // namespace csgrun::surface_volumes_test
