// Polygons that are said to be boundary of nothing are: cut or not, no result has a piece of them.
#include "engine/bsp/covered_polygons.h"

#include <array>
#include <set>

#include <gtest/gtest.h>

#include "engine/bsp/contact_table.h"
#include "engine/bsp/grid_planes.h"
#include "tests/support/convex_operand.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun::covered_polygons_test {
namespace {

using test::convex_operand;
using test::octahedron;

/// Whether a point is strictly inside an octahedron.
bool is_inside(const IVec3& middle, int64_t radius, const std::array<double, 3>& p) {
  double sum = 0;
  for (size_t k = 0; k < 3; ++k) sum += std::fabs(p[k] - static_cast<double>(middle[k]));
  return sum < static_cast<double>(radius);
}

/// Whether no point of a polygon but those of its rim is in a box: all corners are beyond a side,
/// or in it, but not all of them. (Or the box is flat, and the corners on either side.) Boxes of
/// turned polygons are a step larger on every side, and one of no more may be in the side.
bool is_beside(const Job& job, uint32_t p, const PolygonBox& box) {
  const PolygonBox& own = job.boxes()[p];
  const int32_t flat = job.has_grid_vertices(job.polygons()[p].operand) ? 0 : 4;
  bool beside = !box.meets(own);
  for (size_t k = 0; k < 3; ++k) {
    if (own.hi[k] - own.lo[k] <= flat) continue;
    const bool is_above = own.lo[k] >= box.hi[k] && own.hi[k] > box.hi[k];
    const bool is_below = own.hi[k] <= box.lo[k] && own.lo[k] < box.lo[k];
    const bool is_around = box.lo[k] == box.hi[k] && own.lo[k] < own.hi[k];
    beside = beside || is_above || is_below || is_around;
  }
  return beside;
}

/// Whether a triangle is outside of an octahedron, as points all over it are.
bool is_outside(const IVec3& middle, int64_t radius, const Job& job, const JobPolygon& triangle) {
  const auto corners = job.corners(triangle);
  constexpr int kParts = 16;
  bool outside = true;
  for (int i = 0; i <= kParts; ++i) {
    for (int j = 0; i + j <= kParts; ++j) {
      std::array<double, 3> p{};
      for (size_t k = 0; k < 3; ++k) {
        p[k] = (i * job.rounded(corners[0])[k] + j * job.rounded(corners[1])[k] +
                (kParts - i - j) * job.rounded(corners[2])[k]) /
               kParts;
      }
      outside &= !is_inside(middle, radius, p);
    }
  }
  return outside;
}

TEST(CoveredPolygons, AreInsideOfAnotherOrBesideTheFirst) {
  test::Random random(951);
  size_t covered = 0, left = 0, by_outside = 0;
  for (int round = 0; round < 60; ++round) {
    const BooleanOp op = round % 2 == 0 ? BooleanOp::kUnion : BooleanOp::kDifference;
    std::vector<Operand> operands;
    std::vector<std::pair<IVec3, int64_t>> made;
    for (int i = 0; i < 12; ++i) {
      IVec3 middle{};
      for (int64_t& c : middle) c = random.integer(-60, 60);
      made.emplace_back(middle, random.integer(5, 90));
      operands.push_back(octahedron(middle, made.back().second));
    }
    const Job job(operands);
    const auto found = find_plainly_covered(job, test::flat_expression(op, 12)).polygons;
    for (uint32_t p = 0; p < found.size(); ++p) {
      if (!found[p]) {
        ++left;
        continue;
      }
      ++covered;
      const JobPolygon& polygon = job.polygons()[p];
      bool is_in_one = false;
      for (uint32_t o = op == BooleanOp::kUnion ? 0 : 1; o < 12; ++o) {
        const auto corners = job.corners(polygon);
        is_in_one |=
            o != polygon.operand && std::all_of(corners.begin(), corners.end(), [&](uint32_t v) {
              return is_inside(made[o].first, made[o].second, job.rounded(v));
            });
      }
      const bool is_beside_first = op == BooleanOp::kDifference && polygon.operand > 0 &&
                                   is_beside(job, p, job.operand_box(0));
      const bool is_outside_first = op == BooleanOp::kDifference && polygon.operand > 0 &&
                                    is_outside(made[0].first, made[0].second, job, polygon);
      ASSERT_TRUE(is_in_one || is_beside_first || is_outside_first) << "round " << round;
      by_outside += !is_in_one && !is_beside_first ? 1 : 0;
    }
  }
  EXPECT_GT(by_outside, 30u);
  EXPECT_GT(covered, 300u);
  EXPECT_GT(left, 300u);
}

TEST(CoveredPolygons, AreNotLookedForWhereAllCount) {
  std::vector<Operand> operands{octahedron({0, 0, 0}, 50), octahedron({3, 0, 0}, 5)};
  const auto covered = [&](BooleanOp op) {
    const Job job(operands);
    const auto expression = test::flat_expression(op, static_cast<uint32_t>(operands.size()));
    const auto found = find_plainly_covered(job, expression).polygons;
    return std::count(found.begin(), found.end(), 1);
  };
  EXPECT_EQ(covered(BooleanOp::kUnion), 0);  // two that do not meet at all
  operands.push_back(octahedron({40, 0, 0}, 5));
  EXPECT_EQ(covered(BooleanOp::kUnion), 8);
  EXPECT_EQ(covered(BooleanOp::kDifference), 0);
  EXPECT_EQ(covered(BooleanOp::kSymmetricDifference), 0);
  // The last two have no box in common.
  EXPECT_EQ(covered(BooleanOp::kIntersection), 24);
}

IVec3 random_point(test::Random& random, int64_t reach) {
  return {random.integer(-reach, reach), random.integer(-reach, reach),
          random.integer(-reach, reach)};
}

/// A convex body of any shape, some of whose faces start with corners in line.
Operand random_convex(test::Random& random, int64_t reach) {
  std::vector<test::Loop> loops;
  if (random.integer(0, 2) == 0) {
    const IVec3 size = random_point(random, reach / 2);
    loops = test::box_loops({0, 0, 0}, {2 + std::abs(size[0]), 2 + std::abs(size[1]), 4});
    for (test::Loop& loop : loops) {
      // Even lengths have a middle.
      for (IVec3& p : loop) {
        for (int64_t& c : p) c *= 2;
      }
      IVec3 middle{};
      for (size_t k = 0; k < 3; ++k) middle[k] = (loop[0][k] + loop[1][k]) / 2;
      loop.insert(loop.begin() + 1, middle);
    }
  }
  while (loops.empty()) {
    std::vector<IVec3> points(static_cast<size_t>(random.integer(4, 9)));
    for (IVec3& p : points) p = random_point(random, reach);
    loops = test::hull_loops(points);
  }
  const IVec3 move = random_point(random, 12);
  for (test::Loop& loop : loops) {
    for (IVec3& p : loop) {
      for (size_t k = 0; k < 3; ++k) p[k] += move[k];
    }
  }
  return convex_operand(loops);
}

/// Some nodes over the operands, which may have several parents or none; a few are named at once.
Expression random_expression(test::Random& random, uint32_t operands) {
  Expression expression;
  for (uint32_t o = 0; o < operands; ++o) expression.nodes.emplace_back().operand = o;
  for (int64_t more = random.integer(1, 5); more > 0; --more) {
    Expression::Node node;
    node.is_operand = false;
    node.op = static_cast<BooleanOp>(random.integer(0, 3));
    node.first_child = static_cast<uint32_t>(expression.children.size());
    node.child_count = static_cast<uint32_t>(random.integer(1, 5));
    const auto last = static_cast<int64_t>(expression.nodes.size()) - 1;
    for (uint32_t c = 0; c < node.child_count; ++c) {
      const int64_t child = c == 0 ? last : random.integer(0, last);
      expression.children.push_back(static_cast<uint32_t>(child));
    }
    expression.nodes.push_back(node);
  }
  return expression;
}

const PolygonBox kEverywhere{
    {std::numeric_limits<int32_t>::min(), std::numeric_limits<int32_t>::min(),
     std::numeric_limits<int32_t>::min()},
    {std::numeric_limits<int32_t>::max(), std::numeric_limits<int32_t>::max(),
     std::numeric_limits<int32_t>::max()}};

/// The boxes of an expression, node by node and path by path.
struct Boxes {
  const Job& job;
  const Expression& expression;

  [[nodiscard]] std::vector<uint32_t> children(uint32_t n) const {
    const Expression::Node& node = expression.nodes[n];
    const auto first = expression.children.begin() + node.first_child;
    return {first, first + node.child_count};
  }
  [[nodiscard]] PolygonBox around(uint32_t n) const {
    const Expression::Node& node = expression.nodes[n];
    if (node.is_operand) return job.operand_box(node.operand);
    const auto of = children(n);
    PolygonBox box = around(of[0]);
    if (node.op == BooleanOp::kDifference) return box;
    for (const uint32_t c : of) {
      node.op == BooleanOp::kIntersection ? box.clip(around(c)) : box.include(around(c));
    }
    return box;
  }
  /// Adds where operand `o` counts, on all ways down from a node.
  void add_live(uint32_t n, const PolygonBox& within, uint32_t o, PolygonBox& live) const {
    const Expression::Node& node = expression.nodes[n];
    if (node.is_operand) {
      if (node.operand == o) live.include(within);
      return;
    }
    const auto of = children(n);
    for (size_t i = 0; i < of.size(); ++i) {
      PolygonBox box = within;
      if (node.op == BooleanOp::kIntersection) {
        for (const uint32_t sibling : of) box.clip(around(sibling));
      }
      if (node.op == BooleanOp::kDifference && i > 0) box.clip(around(of[0]));
      add_live(of[i], box, o, live);
    }
  }
};

/// The operands inside of which each node is full, and those inside of which it is empty, from the
/// first node to the root.
std::vector<std::array<std::set<uint32_t>, 2>> deciders(const Expression& expression) {
  std::vector<std::array<std::set<uint32_t>, 2>> of_node;
  for (const Expression::Node& node : expression.nodes) {
    auto& [empty, full] = of_node.emplace_back();
    if (node.is_operand) full = {node.operand};
    for (uint32_t c = 0; c < node.child_count; ++c) {
      const auto child = of_node[expression.children[node.first_child + c]];
      if (node.op == BooleanOp::kUnion) full.insert(child[1].begin(), child[1].end());
      if (node.op == BooleanOp::kIntersection) empty.insert(child[0].begin(), child[0].end());
      const auto& emptying = child[c > 0 ? 1 : 0];
      if (node.op == BooleanOp::kDifference) empty.insert(emptying.begin(), emptying.end());
    }
  }
  return of_node;
}

/// Convex operands inside of which the root is the same everywhere.
std::vector<uint32_t> removers(const std::vector<Operand>& operands, const Expression& expression) {
  std::vector<uint32_t> found;
  const auto [empty, full] = deciders(expression).back();
  for (uint32_t o = 0; o < operands.size(); ++o) {
    if (operands[o].leaf->convex && (empty.count(o) || full.count(o))) found.push_back(o);
  }
  return found;
}

/// Convex operands outside of which the root is empty.
std::vector<uint32_t> confiners(const std::vector<Operand>& operands,
                                const Expression& expression) {
  std::vector<std::set<uint32_t>> of_node;
  for (const Expression::Node& node : expression.nodes) {
    std::set<uint32_t>& empty = of_node.emplace_back();
    if (node.is_operand) empty = {node.operand};
    for (uint32_t c = 0; c < node.child_count; ++c) {
      const auto child = of_node[expression.children[node.first_child + c]];
      if (node.op == BooleanOp::kIntersection || (node.op == BooleanOp::kDifference && c == 0)) {
        empty.insert(child.begin(), child.end());
      }
    }
  }
  std::vector<uint32_t> found;
  for (const uint32_t o : of_node.back()) {
    if (operands[o].leaf->convex) found.push_back(o);
  }
  return found;
}

Plane plane_of(const test::Loop& loop) {
  return support_of_loop(static_cast<uint32_t>(loop.size()),
                         [&](uint32_t i) { return loop[i % loop.size()]; });
}

double length(const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); }

std::vector<PolygonBox> boxes_of(const Job& job) {
  std::vector<PolygonBox> boxes;
  for (size_t o = 0; o < job.operand_count(); ++o) boxes.push_back(job.operand_box(o));
  return boxes;
}

std::array<double, 3> middle_of(const PolygonBox& box) {
  std::array<double, 3> middle{};
  for (size_t k = 0; k < 3; ++k) middle[k] = (box.lo[k] + box.hi[k]) / 2.0;
  return middle;
}

/// The radius of the ball around the middle of an operand's box in all planes; a step is left.
double inner_radius(const Job& job, uint32_t o, const Operand& operand) {
  const auto middle = middle_of(job.operand_box(o));
  double radius = HUGE_VAL;
  for (const test::Loop& loop : test::loops_of(*operand.leaf)) {
    const Plane p = plane_of(loop);
    const std::array<double, 3> n{static_cast<double>(p.a), static_cast<double>(p.b),
                                  static_cast<double>(p.c)};
    double above = static_cast<double>(p.d);
    for (size_t k = 0; k < 3; ++k) {
      above += n[k] * (middle[k] - static_cast<double>(operand.translation[k]));
    }
    radius = std::min(radius, -above / length(n));
  }
  return std::max(radius - 1, 0.0);
}

/// How far a polygon's box is beyond the ball that has all corners of an operand in it, a step
/// away, from its middle; nothing if that ball has all of its box in it, or there is none inside.
double beside_ball(const Job& job, uint32_t o, const Operand& operand, const PolygonBox& box) {
  const PolygonBox& own = job.operand_box(o);
  const auto middle = middle_of(own);
  double radius = 0;
  for (const IVec3& v : operand.leaf->vertices) {
    std::array<double, 3> away{};
    for (size_t k = 0; k < 3; ++k) {
      away[k] = static_cast<double>(v[k] + operand.translation[k]) - middle[k];
    }
    radius = std::max(radius, length(away));
  }
  const double to_corner =
      length({own.hi[0] - middle[0], own.hi[1] - middle[1], own.hi[2] - middle[2]});
  if (to_corner <= radius + 1 || inner_radius(job, o, operand) <= 0) return -1;
  std::array<double, 3> away{};
  for (size_t k = 0; k < 3; ++k) {
    const double nearest = std::clamp(middle[k], double(box.lo[k]), double(box.hi[k]));
    away[k] = nearest - middle[k];
  }
  return length(away) - radius - 1;
}

/// How far the corner of a polygon that is farthest from the middle of an operand's box is from
/// there, less the radius of the ball in it.
double beyond_ball(const Job& job, uint32_t o, const Operand& operand, const JobPolygon& polygon) {
  const auto middle = middle_of(job.operand_box(o));
  double farthest = 0;
  for (const uint32_t v : job.corners(polygon)) {
    const auto& p = job.rounded(v);
    farthest = std::max(farthest, length({p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]}));
  }
  return farthest - inner_radius(job, o, operand);
}

TEST(CoveredPolygons, AreThoseInBallsAndBesideBoxes) {
  test::Random random(952);
  size_t in_balls = 0, outside = 0, beside = 0, left = 0, seen_only = 0;
  for (int round = 0; round < 900; ++round) {
    std::vector<Operand> operands;
    const auto count = static_cast<uint32_t>(random.integer(2, 9));
    for (uint32_t o = 0; o < count; ++o) {
      operands.push_back(random_convex(random, o % 2 == 0 ? 90 : 6));
      operands.back().translation = random_point(random, round % 3 * 6);
      if (random.integer(0, 3) == 0) {
        operands.back() = octahedron(random_point(random, 20), random.integer(5, 60));
      }
      if (random.integer(0, 5) == 0) operands.back() = test::operand_of(test::random_leaf(random));
      if (random.integer(0, 9) == 0) {  // a turn that changes no number, which nobody knows
        operands.back().frame.is_identity = false;
        for (size_t k = 0; k < 3; ++k) {
          operands.back().frame.matrix[k][k] = int64_t{1} << Frame::kShift;
        }
      }
    }
    const Expression expression =
        round % 2 ? random_expression(random, count)
                  : test::flat_expression(static_cast<BooleanOp>(round / 2 % 4), count);
    const Job job(operands);
    const PlainlyCovered plainly = find_plainly_covered(job, expression);
    const auto& found = plainly.polygons;
    const Boxes boxes{job, expression};
    const auto root = static_cast<uint32_t>(expression.nodes.size() - 1);
    const PolygonBox result = boxes.around(root);
    size_t covered = 0, hidden = 0;
    for (uint32_t o = 0; o < count; ++o) {
      bool is_open = false, may_be_open = false;
      const bool may_hide =
          plainly.dead->balls().has(o) || job.polygon_start(o + 1) - job.polygon_start(o) <= 64;
      PolygonBox live = PolygonBox::none();
      boxes.add_live(root, kEverywhere, o, live);
      for (uint32_t p = job.polygon_start(o); p < job.polygon_start(o + 1); ++p) {
        bool expected = live.is_empty() || is_beside(job, p, live), is_close = false;
        bool is_held = count > 2 && !result.meets(job.boxes()[p]);
        beside += expected;
        for (const uint32_t r : removers(operands, expression)) {
          if (count < 3 || !job.has_grid_vertices(r)) continue;
          const double beyond = beyond_ball(job, r, operands[r], job.polygons()[p]);
          is_close |= std::fabs(beyond) < 1e-6;
          in_balls += !expected && beyond < 0;
          is_held |= beyond < 0;
        }
        for (const uint32_t r : confiners(operands, expression)) {
          if (count < 3 || !job.has_grid_vertices(r)) continue;
          const double beyond = beside_ball(job, r, operands[r], job.boxes()[p]);
          is_close |= std::fabs(beyond) < 1e-6;
          outside += !expected && !is_held && beyond > 0;
          is_held |= beyond > 0;
        }
        expected |= is_held;
        const bool is_hidden = is_held && may_hide;
        seen_only += is_held && !may_hide;
        covered += expected;
        hidden += is_hidden;
        may_be_open |= is_close;
        is_open |= is_hidden;
        if (is_close) continue;
        ASSERT_EQ(!found.empty() && found[p], expected) << "round " << round << ", polygon " << p;
        ASSERT_EQ(!plainly.hidden.empty() && plainly.hidden[p], is_hidden) << "polygon " << p;
        left += !expected;
      }
      if (!may_be_open) {
        const bool meets_within = !plainly.meets_within.empty() && plainly.meets_within[o] != 0;
        ASSERT_EQ(plainly.is_open[o] != 0, is_open || meets_within) << "operand " << o;
      }
    }
    if (covered == 0) {
      ASSERT_TRUE(found.empty());
    }
    if (hidden == 0) {
      ASSERT_TRUE(plainly.hidden.empty());
    }
  }
  EXPECT_GT(in_balls, 200u);
  EXPECT_GT(outside, 20u);
  EXPECT_GT(beside, 1000u);
  EXPECT_GT(seen_only, 10u);
  EXPECT_GT(left, 1000u);
}

// A ball of radius 11 in a box, less a step: what is as far away as that is not in it.
TEST(CoveredPolygons, AreNotThoseOnTheBallItself) {
  const Operand box = convex_operand(test::box_loops({-11, -11, -11}, {11, 11, 11}));
  const auto covered = [&](const IVec3& far) {
    const std::vector<Operand> operands{
        box, test::operand_of(test::make_leaf({{{0, 0, 0}, {1, 0, 0}, far}})),
        test::operand_of(test::box_leaf({50, 0, 0}, {60, 9, 9}))};
    const auto expression = test::flat_expression(BooleanOp::kUnion, 3);
    return find_plainly_covered(Job(operands), expression).polygons;
  };
  EXPECT_TRUE(covered({6, 8, 0}).empty());
  EXPECT_TRUE(covered({0, 6, -8}).empty());
  const auto in = covered({-6, 7, 3});
  ASSERT_FALSE(in.empty());
  EXPECT_EQ(std::count(in.begin(), in.end(), 1), 1);
  EXPECT_EQ(in[6], 1);
}

// Of nothing, and of bodies without faces.
TEST(CoveredPolygons, OfNothing) {
  const std::vector<Operand> none;
  EXPECT_TRUE(find_plainly_covered(Job(none), {}).polygons.empty());
  EXPECT_TRUE(find_covered(Job(none), {}, ContactTable()).empty());
  auto empty = std::make_shared<LeafGeometry>();
  empty->convex = true;
  const std::vector<Operand> operands{test::operand_of(empty), octahedron({0, 0, 0}, 9),
                                      octahedron({0, 0, 0}, 5)};
  const auto expression = test::flat_expression(BooleanOp::kUnion, 3);
  EXPECT_TRUE(find_plainly_covered(Job(operands), expression).polygons.empty());
}

/// The sides of a polygon's corners on the planes of a leaf.
struct SidesOfLeaf {
  bool in_front = false, on = false, in_plane = false;
};
SidesOfLeaf sides_of(const Job& job, const JobPolygon& polygon, const Operand& operand) {
  SidesOfLeaf sides;
  for (const test::Loop& loop : test::loops_of(*operand.leaf)) {
    const Plane p = plane_of(loop);
    bool all_on = true;
    for (const uint32_t v : job.corners(polygon)) {
      IVec3 at{};
      for (size_t k = 0; k < 3; ++k) {
        at[k] = static_cast<int64_t>(job.rounded(v)[k]) - operand.translation[k];
      }
      const Int128 above = p.a * at[0] + p.b * at[1] + p.c * at[2] + p.d;
      sides.in_front |= above > 0;
      sides.on |= above == 0;
      all_on &= above == 0;
    }
    sides.in_plane |= all_on;
  }
  return sides;
}

// Polygons that touch a convex body from within, but for those in its planes.
TEST(CoveredPolygons, TouchFromWithin) {
  test::Random random(953);
  size_t covered = 0, in_plane = 0, apart = 0;
  for (int round = 0; round < 400; ++round) {
    std::vector<Operand> operands;
    const auto count = static_cast<uint32_t>(random.integer(2, 5));
    for (uint32_t o = 0; o < count; ++o) {
      if (random.integer(0, 1)) {
        operands.push_back(octahedron({0, 0, 0}, random.integer(1, 5)));
      } else {
        const int64_t x = random.integer(1, 4), y = random.integer(1, 4);
        operands.push_back(convex_operand(test::box_loops({-x, -y, -2}, {x, y, 2})));
      }
      operands.back().translation = random_point(random, 2);
      if (random.integer(0, 3) == 0) operands.back() = test::operand_of(test::random_leaf(random));
    }
    const Expression expression =
        round % 3 == 0 ? random_expression(random, count)
                       : test::flat_expression(static_cast<BooleanOp>(round % 4), count);
    Job job(operands);
    EvaluateStats stats;
    const ContactTable contacts(find_contacts(job, {}, {}, stats), job.polygons().size());
    PlainlyCovered plainly;
    plainly.dead = std::make_shared<DeadSpace>(operands, expression, boxes_of(job));
    plainly.is_open.assign(count, 0);
    const bool is_one_open = round % 4 == 3;
    if (is_one_open) plainly.is_open[1] = 1;
    const auto found = find_covered(job, plainly, contacts);
    ASSERT_EQ(found.size(), job.polygons().size());
    for (uint32_t p = 0; p < found.size(); ++p) {
      bool expected = false;
      for (const uint32_t r : removers(operands, expression)) {
        const JobPolygon& polygon = job.polygons()[p];
        if (r == polygon.operand || (is_one_open && r == 1)) continue;
        const SidesOfLeaf sides = sides_of(job, polygon, operands[r]);
        expected |= !sides.in_front && sides.on && !sides.in_plane;
        in_plane += !sides.in_front && sides.in_plane;
        apart += !sides.in_front && !sides.on;
      }
      ASSERT_EQ(found[p] != 0, expected) << "round " << round << ", polygon " << p;
      covered += expected;
    }
  }
  EXPECT_GT(covered, 300u);
  EXPECT_GT(in_plane, 50u);
  EXPECT_GT(apart, 50u);
}

}  // namespace
}  // namespace csgrun::covered_polygons_test
