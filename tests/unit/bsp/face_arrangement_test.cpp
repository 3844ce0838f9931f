// Polygons cut by all that meets them: the loops fill the polygon, and what is said of a region is
// what an oracle says of points in front of it and behind it, beside each of its edges.
#include "engine/bsp/face_arrangement.h"

#include <gtest/gtest.h>

#include "engine/base/parallel.h"
#include "engine/bsp/contact_table.h"
#include "engine/bsp/point_index.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/oracle.h"
#include "tests/support/random_solids.h"

namespace csgrun::face_arrangement_test {
namespace {

using test::Query;

Query minus(const Query& a, const Query& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Query cross(const Query& a, const Query& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Query& a, const Query& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Query unit(const Query& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}
Query along(const Query& a, const Query& way, double length) {
  return {a[0] + way[0] * length, a[1] + way[1] * length, a[2] + way[2] * length};
}

/// Twice the area that points go round.
Query area_vector(const std::vector<Query>& points) {
  Query sum{};
  for (size_t i = 2; i < points.size(); ++i) {
    sum = along(sum, cross(minus(points[i - 1], points[0]), minus(points[i], points[0])), 1);
  }
  return sum;
}

struct Count {
  size_t cut = 0, by_names = 0, left = 0, facts = 0, coplanar = 0;
  std::vector<Query> corners;  ///< of all loops
  size_t bare = 0;             ///< edges of loops that are, each with another operand
};

class Cuts {
 public:
  explicit Cuts(const std::vector<Operand>& operands)
      : job_(operands),
        contacts_(find_contacts(job_, {}, {}, stats_), job_.polygons().size()),
        shared_(job_.planes(), &job_),
        index_(shared_),
        ends_(contacts_, job_, shared_, index_),
        geometry_(job_.planes(), &job_) {
    for (const Operand& o : operands) oracles_.emplace_back(test::exact_solid(o));
    for (uint32_t p = 0; p < job_.polygons().size(); ++p) job_.ensure_planes(p);
    ends_.ask(numbers_where(contacts_.all().size(),
                            [&](uint32_t i) { return !contacts_[i].is_coplanar; }));
    ends_.make();
  }

  void check(Count& count) {
    const std::vector<uint8_t> is_open(job_.operand_count(), 0);
    OwnPoints points(shared_, index_, geometry_);
    FaceArrangement arrangement(job_, geometry_, points, contacts_.touched(), is_open);
    PolygonCutter cutter(job_, geometry_, is_open);
    for (uint32_t p = 0; p < job_.polygons().size(); ++p) {
      geometry_.clear();
      points.clear();
      const bool is_plain = list(p, points);
      if (sheets_.empty() && coplanar_.empty()) continue;
      CutLoops loops;
      if (is_plain && cutter.cut(p, segments_, loops)) {
        ++count.by_names;
        ASSERT_NO_FATAL_FAILURE(check_loops(p, loops, count));
      }
      loops = {};
      if (!arrangement.build(p, sheets_, coplanar_, loops)) {
        ASSERT_TRUE(loops.loops.empty() && loops.corner_point.empty() && loops.facts.empty());
        ++count.left;
        continue;
      }
      ++count.cut;
      count.coplanar += !coplanar_.empty();
      ASSERT_NO_FATAL_FAILURE(check_loops(p, loops, count));
    }
  }

 private:
  /// What meets a polygon; whether nothing touches it.
  bool list(uint32_t polygon, OwnPoints& points) {
    sheets_.clear();
    segments_.clear();
    coplanar_.clear();
    bool is_plain = true;
    std::vector<uint8_t> is_flat(job_.operand_count(), 0);
    const auto other_of = [&](const Contact& c) { return c.p == polygon ? c.q : c.p; };
    for (const uint32_t i : contacts_.of(polygon)) {
      const Contact& c = contacts_[i];
      is_plain = is_plain && c.is_plain;
      if (!c.is_coplanar) continue;
      coplanar_.push_back(other_of(c));
      const uint32_t o = job_.polygons()[coplanar_.back()].operand;
      is_flat[o] = job_.is_convex(o);
    }
    for (const uint32_t i : contacts_.of(polygon)) {
      const Contact& c = contacts_[i];
      if (c.is_coplanar || is_flat[job_.polygons()[other_of(c)].operand]) continue;
      const bool is_p = c.p == polygon;
      const auto& [lower, upper] = ends_.of(i);
      if (lower == upper) continue;
      const auto edge = [&](const Contact::End& e) { return e.on_p == is_p ? e.edge : kNone; };
      const uint32_t from = points.of(is_p ? lower : upper), to = points.of(is_p ? upper : lower);
      sheets_.push_back(
          {from, to, other_of(c), is_p ? c.q_front : c.p_front, is_p ? c.q_back : c.p_back});
      segments_.push_back(
          {from, to, other_of(c), edge(is_p ? c.lower : c.upper), edge(is_p ? c.upper : c.lower)});
    }
    return is_plain;
  }

  void check_loops(uint32_t polygon, const CutLoops& loops, Count& count) {
    const uint32_t own = job_.polygons()[polygon].operand;
    std::vector<Query> outline;
    for (const uint32_t v : job_.corners(job_.polygons()[polygon])) {
      outline.push_back(job_.rounded(v));
    }
    const Query area = area_vector(outline), normal = unit(area);
    double filled = 0;
    for (const CutLoops::Loop& loop : loops.loops) {
      std::vector<Query> points;
      for (uint32_t c = loop.first_corner; c < loop.first_corner + loop.corner_count; ++c) {
        points.push_back(geometry_.point(loops.corner_point[c]).rounded);
      }
      filled += dot(area_vector(points), normal);
      count.corners.insert(count.corners.end(), points.begin(), points.end());
      if (loop.vertex != kNone) {
        ASSERT_NE(std::find(points.begin(), points.end(), job_.rounded(loop.vertex)), points.end());
      }
      for (size_t i = 0; i < points.size(); ++i) {
        const Query &a = points[i], &b = points[(i + 1) % points.size()];
        // Not the middle, which is in line with too much.
        const Query between = along(a, minus(b, a), 0.4296875);
        const Query within = along(between, unit(cross(normal, minus(b, a))), 0x1p-24);
        const Query before = along(within, normal, 0x1p-44),
                    behind = along(within, normal, -0x1p-44);
        for (uint32_t f = loop.first_fact; f < loop.first_fact + loop.fact_count; ++f) {
          const CutLoops::Fact& fact = loops.facts[f];
          const auto front = oracles_[fact.operand].winding(before),
                     back = oracles_[fact.operand].winding(behind);
          if (!front || !back) continue;  // in line with an edge
          ASSERT_EQ(fact.front, *front == 1) << "polygon " << polygon;
          ASSERT_EQ(fact.back, *back == 1) << "polygon " << polygon;
          ++count.facts;
        }
        // Of what has surface here, a fact says so.
        for (uint32_t o = 0; o < oracles_.size(); ++o) {
          const auto begin = loops.facts.begin() + loop.first_fact, end = begin + loop.fact_count;
          if (o == own || std::any_of(begin, end, [&](const auto& f) { return f.operand == o; })) {
            continue;
          }
          const auto front = oracles_[o].winding(before), back = oracles_[o].winding(behind);
          ASSERT_TRUE(!front || !back || *front == *back) << "polygon " << polygon;
        }
        if (!loop.is_bare) continue;
        // Beyond an edge of a bare loop all is as it is within.
        const Query beyond = along(between, minus(between, within), 1);
        for (uint32_t o = 0; o < oracles_.size(); ++o) {
          if (o == own) continue;
          for (const double side : {0x1p-44, -0x1p-44}) {
            const auto here = oracles_[o].winding(along(within, normal, side)),
                       there = oracles_[o].winding(along(beyond, normal, side));
            ASSERT_TRUE(!here || !there || *here == *there) << "polygon " << polygon;
          }
          ++count.bare;
        }
      }
    }
    ASSERT_NEAR(filled, dot(area, normal), 1e-9 * dot(area, normal));
  }

  Job job_;
  EvaluateStats stats_;
  ContactTable contacts_;
  CellGeometry shared_;
  PointIndex index_;
  ContactEnds ends_;
  CellGeometry geometry_;  ///< of the polygon at hand
  std::vector<test::Oracle> oracles_;
  std::vector<SheetSegment> sheets_;
  std::vector<CutSegment> segments_;
  std::vector<uint32_t> coplanar_;
};

Operand known(const std::vector<test::Loop>& loops, bool is_convex) {
  auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(loops));
  leaf->opposite = pair_edges(*leaf).opposite;
  leaf->may_touch = false;
  leaf->convex = is_convex;
  return test::operand_of(std::move(leaf));
}

Operand random_box(test::Random& random, bool is_convex) {
  IVec3 lo{}, hi{};
  for (size_t k = 0; k < 3; ++k) {
    lo[k] = random.integer(-4, 2);
    hi[k] = lo[k] + random.integer(1, 5);
  }
  return known(test::box_loops(lo, hi), is_convex);
}

Operand random_hull(test::Random& random, bool is_convex) {
  std::vector<test::Loop> loops;
  while (loops.empty()) {
    std::vector<IVec3> points(static_cast<size_t>(random.integer(4, 8)));
    for (IVec3& p : points) {
      for (int64_t& c : p) c = random.integer(-4, 4);
    }
    loops = test::hull_loops(points);
  }
  return known(loops, is_convex);
}

/// Counts are those of when this was written. Where they change, look why: fewer polygons left to
/// others are fine, and more facts.
void expect_same(const Count& count, const Count& limit) {
  EXPECT_EQ(count.cut, limit.cut);
  EXPECT_EQ(count.by_names, limit.by_names);
  EXPECT_EQ(count.left, limit.left);
  EXPECT_EQ(count.facts, limit.facts);
  EXPECT_EQ(count.coplanar, limit.coplanar);
}

/// The same bodies on the other side of the origin.
std::vector<Operand> mirrored(std::vector<Operand> operands) {
  for (Operand& operand : operands) {
    auto loops = test::loops_of(*operand.leaf);
    test::turn_over(loops);
    for (test::Loop& loop : loops) {
      for (IVec3& p : loop) p = {-p[0], -p[1], -p[2]};
    }
    auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(loops));
    leaf->may_touch = operand.leaf->may_touch;
    leaf->convex = operand.leaf->convex;
    if (!operand.leaf->opposite.empty()) leaf->opposite = pair_edges(*leaf).opposite;
    operand.leaf = leaf;
    for (int64_t& t : operand.translation) t = -t;
  }
  return operands;
}

TEST(FaceArrangement, OfConvexBodies) {
  test::Random random(981);
  Count count, mirror_count;
  for (int i = 0; i < 60; ++i) {
    std::vector<Operand> operands;
    for (int64_t o = random.integer(2, 4); o > 0; --o) {
      operands.push_back(random.integer(0, 1) ? random_box(random, i % 3 != 0)
                                              : random_hull(random, i % 3 != 0));
    }
    ASSERT_NO_FATAL_FAILURE(Cuts(operands).check(count)) << "case " << i;
    ASSERT_NO_FATAL_FAILURE(Cuts(mirrored(operands)).check(mirror_count)) << "case " << i;
  }
  expect_same(count, {749, 243, 0, 20261, 74, {}});
  expect_same(mirror_count, count);
  EXPECT_GT(count.bare, 30u);
}

// Of any bodies on a small grid, which may touch themselves as far as anybody knows, or do not.
TEST(FaceArrangement, OfAnyBodies) {
  test::Random random(982);
  Count count, mirror_count;
  for (int i = 0; i < 40; ++i) {
    std::vector<Operand> operands;
    for (int64_t o = random.integer(2, 3); o > 0; --o) {
      Operand operand = test::operand_of(test::random_leaf(random));
      if (i % 2) operand = known(test::loops_of(*operand.leaf), false);
      if (i % 4 == 0 && random.integer(0, 1)) {  // an edge of four faces
        auto loops = test::box_loops({-2, -2, -3}, {0, 0, 3});
        const auto more = test::box_loops({0, 0, -3}, {3, 3, 3});
        loops.insert(loops.end(), more.begin(), more.end());
        operand = test::operand_of(test::make_leaf(loops));
        for (int64_t& t : operand.translation) t = random.integer(-2, 2);
      }
      operands.push_back(operand);
    }
    ASSERT_NO_FATAL_FAILURE(Cuts(operands).check(count)) << "case " << i;
    ASSERT_NO_FATAL_FAILURE(Cuts(mirrored(operands)).check(mirror_count)) << "case " << i;
  }
  expect_same(count, {1103, 70, 77, 14826, 307, {}});
  expect_same(mirror_count, count);
  EXPECT_GT(count.bare, 30u);
}

Operand box(const IVec3& lo, const IVec3& hi) { return known(test::box_loops(lo, hi), true); }

/// A double cone around a part of the plane z = 0.
std::vector<test::Loop> double_cone(const std::vector<test::Point2>& base, const IVec3& middle) {
  return test::cone_loops(base, 0, {middle[0], middle[1], 5}, IVec3{middle[0], middle[1], -5});
}

/// As far as anybody knows, they may touch themselves.
Operand boxes(const std::vector<std::pair<IVec3, IVec3>>& all) {
  std::vector<test::Loop> loops;
  for (const auto& [lo, hi] : all) {
    const auto more = test::box_loops(lo, hi);
    loops.insert(loops.end(), more.begin(), more.end());
  }
  return test::operand_of(test::make_leaf(loops));
}

// A face tells what is on both sides of an equal one; not so if the operand has a face there that
// looks the other way, or if another operand meets it.
TEST(FaceArrangement, OfEqualFaces) {
  const Operand upper = boxes({{{0, 0, 0}, {4, 4, 3}}});
  Count flush;
  Cuts({upper, boxes({{{0, 0, -5}, {4, 4, 0}}})}).check(flush);
  EXPECT_EQ(flush.left, 0u);
  EXPECT_EQ(flush.cut, 10u);
  EXPECT_EQ(flush.facts, 40u);
  Count inside;
  Cuts({upper, boxes({{{0, 0, 0}, {4, 4, 2}}})}).check(inside);
  EXPECT_EQ(inside.left, 0u);
  Count both_sides;
  Cuts({upper, boxes({{{0, 0, -5}, {4, 4, 0}}, {{0, 0, 0}, {4, 4, 1}}})}).check(both_sides);
  EXPECT_EQ(both_sides.cut, 11u);
  EXPECT_EQ(both_sides.left, 5u);  // at edges of four faces
  Count of_three;
  Cuts({upper, boxes({{{0, 0, -5}, {4, 4, 0}}}), boxes({{{1, 1, -1}, {3, 3, 1}}})}).check(of_three);
  EXPECT_EQ(of_three.left, 0u);
}

// The edge of one operand, all of whose corners are on edges of another's face, which covers what
// is within: by no corner that can be told.
TEST(FaceArrangement, LeavesWhatIsInscribedInAFace) {
  Count count;
  Cuts({box({-20, -20, -20}, {20, 20, 0}), box({-8, -8, -8}, {8, 8, 0}),
        known(double_cone({{8, 0}, {0, 8}, {-8, 0}, {0, -8}}, {0, 0, 0}), true)})
      .check(count);
  EXPECT_EQ(count.left, 1u);
  EXPECT_GT(count.cut, 10u);
}

// The same of one operand alone, which touches itself in corners: its edge tells what is within.
TEST(FaceArrangement, OfASimpleOperandThatTouchesItselfInCorners) {
  auto loops = double_cone({{0, 0}, {12, 0}, {0, 12}}, {4, 4, 0});
  for (const std::vector<IVec3>& wing :
       {std::vector<IVec3>{{0, 0, 0}, {-6, -1, 0}, {-1, -6, 0}, {-3, -3, -6}},
        std::vector<IVec3>{{12, 0, 0}, {18, 1, 0}, {18, -3, 0}, {17, -1, -6}},
        std::vector<IVec3>{{0, 12, 0}, {-3, 18, 0}, {1, 18, 0}, {-1, 17, -6}}}) {
    const auto more = test::hull_loops(wing);
    loops.insert(loops.end(), more.begin(), more.end());
  }
  const Operand winged = known(loops, false);
  ASSERT_FALSE(winged.leaf->opposite.empty());
  Count count;
  Cuts({box({-40, -40, -10}, {40, 40, 0}), winged}).check(count);
  EXPECT_EQ(count.left, 0u);
  EXPECT_GT(count.coplanar, 3u);
}

// What stands beside a body touches the top of it along one of two edges in a line.
TEST(FaceArrangement, OfAStraightAngle) {
  std::vector<test::Loop> loops(2);
  const std::vector<std::array<int64_t, 2>> base{{0, 0}, {4, 0}, {8, 0}, {8, 8}, {0, 8}};
  for (size_t i = 0; i < base.size(); ++i) {
    const auto [x, y] = base[i];
    const auto [u, v] = base[(i + 1) % base.size()];
    loops[0].push_back({x, y, 4});
    loops[1].insert(loops[1].begin(), {x, y, 0});
    loops.push_back({{x, y, 0}, {u, v, 0}, {u, v, 4}, {x, y, 4}});
  }
  const Operand block = known(loops, true);
  ASSERT_EQ(block.leaf->face_count(), 7u);
  for (const auto& [from, to] : {std::pair<int64_t, int64_t>{5, 7}, {1, 3}}) {
    Count count;
    Cuts({block, box({from, -4, 0}, {to, 0, 4})}).check(count);
    for (const int64_t x : {from, to}) {
      const Query corner{static_cast<double>(x), 0, 4};
      // The block has it in its top and twice in a side, of which the box covers a part; three
      // faces of the box have it.
      EXPECT_EQ(std::count(count.corners.begin(), count.corners.end(), corner), 6);
    }
  }
}

// A void that touches a face from within says nothing of what that face covers.
TEST(FaceArrangement, OfAFaceThatIsTouchedFromBehind) {
  auto loops = test::box_loops({-8, -8, -8}, {8, 8, 0});
  auto inner = test::hull_loops({{-2, 0, 0}, {2, 0, 0}, {0, -2, -4}, {0, 2, -4}});
  test::turn_over(inner);
  loops.insert(loops.end(), inner.begin(), inner.end());
  Count count;
  Cuts({box({-20, -20, -20}, {20, 20, 0}), test::operand_of(test::make_leaf(loops))}).check(count);
  EXPECT_EQ(count.left, 0u);
  EXPECT_GT(count.coplanar, 1u);
}

// Convex, but nobody knows which of its edges are opposite: around such a face it is outside, as
// one knows without them.
TEST(FaceArrangement, OfAConvexOperandWithoutOpposites) {
  auto leaf = std::make_shared<LeafGeometry>(
      *test::make_leaf(test::prism_loops({{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}, 0, 5)));
  leaf->convex = true;
  ASSERT_EQ(leaf->face_count(), 8u);  // top and bottom are two triangles each
  for (const IVec3& lo : {IVec3{-20, -20, -20}, {-20, -20, 0}, {-20, -20, -5}, {0, -20, -20}}) {
    Count count;
    Cuts({box(lo, {20, 20, lo[2] < 0 ? 0 : 9}), test::operand_of(leaf)}).check(count);
    EXPECT_EQ(count.left, 0u);
    EXPECT_GT(count.coplanar, 0u);
  }
}

}  // namespace
}  // namespace csgrun::face_arrangement_test
