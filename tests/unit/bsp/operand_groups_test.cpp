// Operands that are evaluated in groups against one job over all of them.
#include "engine/bsp/operand_groups.h"

#include <array>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "engine/bsp/group_cover.h"
#include "engine/bsp/kernel.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/convex_operand.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_trees.h"

namespace csgrun::operand_groups_test {
namespace {

using test::convex_operand;

/// A bar through the origin.
Operand spoke(double angle, int64_t length, int64_t width, int64_t low, int64_t high) {
  const double x = std::cos(angle), y = std::sin(angle);
  std::vector<IVec3> points;
  for (const int64_t along : {-length, length}) {
    for (const int64_t across : {-width, width}) {
      for (const int64_t z : {low, high}) {
        const auto u = static_cast<double>(along), v = static_cast<double>(across);
        points.push_back({std::llround(u * x - v * y), std::llround(u * y + v * x), z});
      }
    }
  }
  return convex_operand(test::hull_loops(points));
}

std::vector<Operand> wheel(int spokes) {
  std::vector<Operand> operands;
  for (int i = 0; i < spokes; ++i) {
    operands.push_back(spoke(3.14159 * i / spokes, 4000, 150, i % 5 == 0 ? -100 : 0, 300));
    operands.back().first_source = static_cast<uint32_t>(i);
  }
  return operands;
}

uint64_t signs_of(const EvaluateStats& stats) {
  uint64_t total = stats.sign_filter + stats.sign_symbolic;
  for (const uint64_t n : stats.sign_exact) total += n;
  return total;
}

Result<std::shared_ptr<const BoundaryMesh>> evaluate(const std::vector<Operand>& operands,
                                                     const Expression& expression, bool may_group,
                                                     uint64_t& signs) {
  KernelOptions options;
  options.may_group = may_group;
  EvaluateStats stats;
  auto result = evaluate_boolean(operands, expression, test::region_of(operands), options, stats);
  signs = signs_of(stats);
  return result;
}

/// How many signs were asked for in groups and in one job, which must give the same, of `faces` at
/// least.
std::array<uint64_t, 2> signs_of_both(const std::vector<Operand>& operands,
                                      const Expression& expression, size_t faces) {
  std::array<uint64_t, 2> signs{};
  const auto grouped = evaluate(operands, expression, true, signs[0]);
  const auto whole = evaluate(operands, expression, false, signs[1]);
  EXPECT_TRUE(grouped && whole);
  if (!grouped || !whole) return signs;
  EXPECT_EQ(test::first_difference(**grouped, **whole), "");
  EXPECT_GE((*whole)->faces.size(), faces);
  return signs;
}

TEST(OperandGroups, SpokesAreEvaluatedInGroups) {
  for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kDifference, BooleanOp::kIntersection}) {
    std::vector<Operand> operands = wheel(24);
    // What is taken from, or the first of what is common: a plate with the spokes' top.
    const bool is_plate_first = op != BooleanOp::kUnion;
    if (is_plate_first) operands[0] = spoke(0.3, 3000, 3000, -200, 300);
    const Expression expression = test::flat_expression(op, static_cast<uint32_t>(operands.size()));
    const auto [grouped, whole] = signs_of_both(operands, expression, 9);
    if (op == BooleanOp::kUnion) {
      EXPECT_LT(8 * grouped, whole);
    }
  }
}

/// The hull of points that are spread evenly over a ball around the origin, turned at random.
Operand ball(test::Random& random, double radius, int corners) {
  const double first = 7 * random.unit(), second = 7 * random.unit();
  std::vector<IVec3> points;
  for (int i = 0; i < corners; ++i) {
    const double z = (2 * i + 1.) / corners - 1, around = std::sqrt(1 - z * z);
    const double x = around * std::cos(2.39996 * i + first);
    const double y = around * std::sin(2.39996 * i + first);
    const double c = std::cos(second), s = std::sin(second);
    points.push_back({std::llround(radius * x), std::llround(radius * (c * y - s * z)),
                      std::llround(radius * (s * y + c * z))});
  }
  return convex_operand(test::hull_loops(points));
}

// Thin shells that all go through one another.
TEST(OperandGroups, BallsAboutOneCentreAreEvaluatedInGroups) {
  test::Random random(981);
  std::vector<Operand> operands;
  for (uint32_t o = 0; o < 13; ++o) {
    operands.push_back(ball(random, 20'000, 80));
    operands.back().first_source = o;
  }
  for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kDifference, BooleanOp::kIntersection}) {
    operands[0] = op == BooleanOp::kDifference ? spoke(0.3, 30'000, 30'000, -30'000, 19'000)
                                               : ball(random, 20'000, 80);
    const Expression expression = test::flat_expression(op, static_cast<uint32_t>(operands.size()));
    EXPECT_GT(cover_in_groups(Job(operands), expression), 0.5);
    const auto [grouped, whole] = signs_of_both(operands, expression, 101);
    EXPECT_NE(grouped, whole) << "it was done in one job";
  }
}

/// A cuboid whose middle is so far along X, turned at random about the origin, and all that so many
/// times as large.
Operand turned_cuboid(test::Random& random, const std::array<double, 3>& half, int64_t scale,
                      double distance = 0) {
  std::array<double, 3> cosine{}, sine{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const double angle = 7 * random.unit();
    cosine[axis] = std::cos(angle), sine[axis] = std::sin(angle);
  }
  std::vector<test::Loop> loops = [&] {
    std::vector<IVec3> points;
    for (unsigned corner = 0; corner < 8; ++corner) {
      std::array<double, 3> p{};
      for (size_t k = 0; k < 3; ++k) p[k] = (corner >> k & 1) != 0 ? half[k] : -half[k];
      p[0] += distance;
      for (size_t axis = 0; axis < 3; ++axis) {
        double &u = p[(axis + 1) % 3], &v = p[(axis + 2) % 3];
        const double turned = cosine[axis] * u - sine[axis] * v;
        v = sine[axis] * u + cosine[axis] * v;
        u = turned;
      }
      points.push_back({std::llround(p[0]), std::llround(p[1]), std::llround(p[2])});
    }
    return test::hull_loops(points);
  }();
  for (test::Loop& loop : loops) {
    for (IVec3& p : loop) {
      for (int64_t& x : p) x *= scale;
    }
  }
  return convex_operand(loops);
}

std::vector<Operand> turned_cuboids(uint32_t count, const std::array<double, 3>& half,
                                    uint64_t seed, int64_t scale = 1) {
  test::Random random(seed);
  std::vector<Operand> operands;
  for (uint32_t o = 0; o < count; ++o) {
    operands.push_back(turned_cuboid(random, half, scale));
    operands.back().first_source = o;
  }
  return operands;
}

/// How many signs are asked for in one job and in groups, of operands that reach beyond the grid,
/// where the result does not. Both must give the same, of `faces` at least.
std::array<uint64_t, 2> signs_beyond_grid(const std::vector<Operand>& operands, BooleanOp op,
                                          size_t faces) {
  constexpr int64_t kGridLimit = int64_t{1} << 27, kReach = kGridLimit - 2;
  const Job job(operands);
  int off_grid = 0;
  for (size_t o = 0; o < operands.size(); ++o) {
    off_grid += job.operand_box(o).hi[0] > kGridLimit ? 1 : 0;
  }
  EXPECT_GT(off_grid, 3);
  const Expression expression = test::flat_expression(op, static_cast<uint32_t>(operands.size()));
  const GridBox region{{-kReach, -kReach, -kReach}, {kReach, kReach, kReach}};
  std::array<std::shared_ptr<const BoundaryMesh>, 2> results;
  std::array<uint64_t, 2> signs{};
  for (const bool may_group : {false, true}) {
    KernelOptions options;
    options.may_group = may_group;
    EvaluateStats stats;
    auto result = evaluate_boolean(operands, expression, region, options, stats);
    EXPECT_TRUE(result) << result.error().message;
    if (!result) return signs;
    results[may_group] = *result;
    signs[may_group] = signs_of(stats);
  }
  EXPECT_EQ(test::first_difference(*results[1], *results[0]), "");
  EXPECT_GE(results[0]->faces.size(), faces);
  return signs;
}

TEST(OperandGroups, WhatIsCommonToOperandsOffTheGrid) {
  const std::vector<Operand> operands = turned_cuboids(24, {22e3, 22e3, 22e3}, 4071, 4096);
  const auto [whole, grouped] = signs_beyond_grid(operands, BooleanOp::kIntersection, 50);
  EXPECT_NE(whole, grouped) << "it was done in one job";
}

// Their union is off the grid.
TEST(OperandGroups, WhatToolsOffTheGridLeave) {
  test::Random random(7734);
  std::vector<Operand> operands{turned_cuboid(random, {15e3, 14e3, 13e3}, 4096)};
  for (uint32_t o = 1; o <= 150; ++o) {
    operands.push_back(turned_cuboid(random, {22e3, 22e3, 22e3}, 4096, 30e3));
    operands.back().first_source = o;
  }
  const auto [whole, grouped] = signs_beyond_grid(operands, BooleanOp::kDifference, 20);
  EXPECT_NE(whole, grouped) << "it was done in one job";
}

std::vector<Contact> contacts_of(const Job& job) {
  std::vector<Contact> contacts;
  PairTest test(job);
  for (uint32_t p = 0; p < job.polygons().size(); ++p) {
    for (uint32_t q = p + 1; q < job.polygons().size(); ++q) {
      Contact contact{};
      if (job.polygons()[p].operand != job.polygons()[q].operand &&
          test.run(p, q, nullptr, contact) == Meeting::kContact) {
        contacts.push_back(contact);
      }
    }
  }
  return contacts;
}

// Two boxes that go through one another, and a third one around them, or beside them.
TEST(OperandGroups, ContactsAreHiddenByOthers) {
  const auto box = [](const IVec3& lo, const IVec3& hi) {
    return convex_operand(test::box_loops(lo, hi));
  };
  const Operand a = box({0, 0, 0}, {50, 20, 20}), b = box({20, -10, 5}, {30, 40, 15});
  const Job inside({a, b, box({-90, -90, -90}, {90, 90, 90})}),
      beside({a, b, box({60, 60, 60}, {90, 90, 90})});
  const auto hidden = [](const Job& job, BooleanOp op) {
    return hidden_contacts(job, test::flat_expression(op, 3), contacts_of(job));
  };
  EXPECT_EQ(hidden(inside, BooleanOp::kUnion), 1);
  EXPECT_EQ(hidden(inside, BooleanOp::kIntersection), 0);
  EXPECT_EQ(hidden(inside, BooleanOp::kDifference), 1);  // a less all
  EXPECT_EQ(hidden(inside, BooleanOp::kSymmetricDifference), 0);
  EXPECT_EQ(hidden(beside, BooleanOp::kUnion), 0);
  EXPECT_EQ(hidden(beside, BooleanOp::kIntersection), 1);
  EXPECT_EQ(hidden(beside, BooleanOp::kDifference), 0);
  EXPECT_EQ(hidden_contacts(beside, test::flat_expression(BooleanOp::kIntersection, 3), {}), 0);
}

// Nearly all of their surface is outside of the others, and nearly all that cuts it inside.
TEST(OperandGroups, RodsThroughOnePlaceAreEvaluatedInGroups) {
  const std::vector<Operand> rods = turned_cuboids(40, {30'000, 200, 200}, 5512);
  const Job job(rods);
  const std::vector<Contact> contacts = contacts_of(job);
  for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kDifference}) {
    const Expression expression = test::flat_expression(op, 40);
    EXPECT_LT(cover_in_groups(job, expression), 0.25);
    EXPECT_GT(contact_cover_in_groups(job, expression, contacts), 0.5);
    EXPECT_EQ(contact_cover_in_groups(job, expression, {}), 0);
    EXPECT_GE(hidden_contacts(job, expression, contacts),
              contact_cover_in_groups(job, expression, contacts));
    const auto [grouped, whole] =
        signs_of_both(rods, expression, op == BooleanOp::kUnion ? 240 : 7);
    if (op == BooleanOp::kUnion) {
      EXPECT_LT(grouped, whole);
    }
  }
}

// What balls in one crowd hide of one another is hidden though the root has more to say.
TEST(OperandGroups, OfAnOperatorBelowTheRootAreOne) {
  test::Random random(5511);
  std::vector<Operand> operands;
  for (uint32_t o = 0; o < 60; ++o) {
    operands.push_back(ball(random, 4000, 40));
    for (int64_t& t : operands.back().translation) t = random.integer(-6000, 6000);
    operands.back().first_source = o;
  }
  const auto balls = static_cast<uint32_t>(operands.size());
  operands.push_back(spoke(0.3, 30'000, 30'000, -30'000, -3000));
  operands.back().first_source = balls;
  for (const BooleanOp op : {BooleanOp::kDifference, BooleanOp::kIntersection}) {
    // op(union of the balls, slab)
    Expression expression = test::flat_expression(BooleanOp::kUnion, balls);
    Expression::Node slab;
    slab.operand = balls;
    Expression::Node root;
    root.is_operand = false;
    root.op = op;
    root.first_child = static_cast<uint32_t>(expression.children.size());
    root.child_count = 2;
    const auto whole_union = static_cast<uint32_t>(expression.nodes.size() - 1);
    expression.nodes.insert(expression.nodes.end(), {slab, root});
    expression.children.insert(expression.children.end(), {whole_union, whole_union + 1});
    EXPECT_EQ(most_groupable(expression).size, balls);
    const auto [grouped, whole] = signs_of_both(operands, expression, 200);
    EXPECT_LT(3 * grouped, whole);
  }
}

// A face of a box meets five of one that is the same.
TEST(OperandGroups, BoxesThatMeet) {
  std::vector<Operand> same, beside;
  for (int64_t o = 0; o < 7; ++o) {
    same.push_back(convex_operand(test::box_loops({0, 0, 0}, {9, 9, 9})));
    beside.push_back(convex_operand(test::box_loops({10 * o, 0, 0}, {10 * o + 9, 9, 9})));
  }
  EXPECT_EQ(meeting_boxes(Job(same)), 6 * 5);
  EXPECT_EQ(meeting_boxes(Job(beside)), 0);
  EXPECT_EQ(meeting_boxes(Job(std::vector<Operand>())), 0);
}

TEST(OperandGroups, BoxesOfGroupsHoldWhatTheyLeave) {
  const auto box = [](int64_t lo, int64_t hi) { return GridBox{{lo, lo, lo}, {hi, hi, hi}}; };
  const std::vector<GridBox> boxes{box(0, 10), box(5, 20), box(8, 30), box(40, 50)};
  const auto of = [&](BooleanOp op) {
    std::vector<std::array<int64_t, 2>> ends;
    for (const GridBox& group :
         boxes_of_groups(test::flat_expression(op, 4), GroupWay::kAlone, boxes)) {
      ends.push_back({group.lo[2], group.hi[2]});
    }
    return ends;
  };
  using Ends = std::vector<std::array<int64_t, 2>>;
  EXPECT_EQ(of(BooleanOp::kUnion), (Ends{{0, 20}, {8, 50}}));
  EXPECT_EQ(of(BooleanOp::kDifference), (Ends{{5, 30}, {40, 50}}));  // of what is taken away
  const auto common =
      boxes_of_groups(test::flat_expression(BooleanOp::kIntersection, 4), GroupWay::kAlone, boxes);
  ASSERT_EQ(common.size(), 2u);
  EXPECT_EQ(common[0].lo[0], 5);
  EXPECT_EQ(common[0].hi[0], 10);
  EXPECT_TRUE(common[1].empty());
}

// Of boxes within boxes all but the largest of each group are inside of it, all but the smallest
// have outside of themselves what all have in common.
TEST(OperandGroups, CoverIsWhatIsDroppedWithinAGroup) {
  std::vector<Operand> nested, beside;
  for (int64_t o = 0; o < 16; ++o) {
    const int64_t half = 100 + (o * 5) % 16;  // in no order
    nested.push_back(convex_operand(test::box_loops({-half, -half, -half}, {half, half, half})));
    beside.push_back(convex_operand(test::box_loops({9 * o, 0, 0}, {9 * o + 7, 7, 7})));
  }
  const auto of = [](BooleanOp op) { return test::flat_expression(op, 16); };
  const Job in(nested), out(beside);
  EXPECT_EQ(cover_in_groups(in, of(BooleanOp::kUnion)), 14. / 16);  // in halves
  EXPECT_EQ(cover_in_groups(in, of(BooleanOp::kIntersection)), 14. / 16);
  EXPECT_EQ(cover_in_groups(out, of(BooleanOp::kUnion)), 0);
  EXPECT_EQ(cover_in_groups(out, of(BooleanOp::kIntersection)), 1);
  EXPECT_EQ(cover_in_groups(in, of(BooleanOp::kSymmetricDifference)), 0);
  EXPECT_EQ(cover_in_groups(in, Expression()), 0);
  // Of 15 that are taken away two groups of eight and seven.
  EXPECT_GT(cover_in_groups(in, of(BooleanOp::kDifference)), 0.8);
  // An operator among the operands.
  Expression with_operator = of(BooleanOp::kUnion);
  Expression::Node pair;
  pair.is_operand = false;
  pair.op = BooleanOp::kIntersection;
  pair.first_child = static_cast<uint32_t>(with_operator.children.size());
  pair.child_count = 2;
  with_operator.children.insert(with_operator.children.end(), {0, 1});
  const Expression::Node root = with_operator.nodes.back();
  with_operator.nodes.back() = pair;
  with_operator.nodes.push_back(root);
  with_operator.children[root.first_child] = static_cast<uint32_t>(with_operator.nodes.size() - 2);
  EXPECT_EQ(cover_in_groups(in, with_operator), 0);
}

// Of what is the same the first of each group leaves all; where boxes touch neither leaves
// anything.
TEST(OperandGroups, CoverCountsWhatIsInOnePlane) {
  std::vector<Operand> same, touching;
  for (int64_t o = 0; o < 16; ++o) {
    same.push_back(convex_operand(test::box_loops({0, 0, 0}, {90, 90, 90})));
    touching.push_back(convex_operand(test::box_loops({90 * o, 0, 0}, {90 * o + 90, 90, 90})));
  }
  const auto of = [](BooleanOp op) { return test::flat_expression(op, 16); };
  EXPECT_EQ(cover_in_groups(Job(same), of(BooleanOp::kUnion)), 14. / 16);
  EXPECT_EQ(cover_in_groups(Job(same), of(BooleanOp::kIntersection)), 14. / 16);
  const double walls = cover_in_groups(Job(touching), of(BooleanOp::kUnion));
  EXPECT_GT(walls, 0.2);  // 14 of 48 in a group
  EXPECT_LT(walls, 0.4);
}

/// A cylinder about the Z axis; its caps are fans about their middles.
Operand fan_cylinder(double radius, double angle, int sides) {
  std::vector<IVec3> rim;
  for (int i = 0; i < sides; ++i) {
    const double at = angle + 2 * 3.14159265 * i / sides;
    rim.push_back({std::llround(radius * std::cos(at)), std::llround(radius * std::sin(at)), 0});
  }
  const auto raised = [](IVec3 p) { return IVec3{p[0], p[1], 1000}; };
  const IVec3 middle{0, 0, 0};
  std::vector<test::Loop> loops;
  for (size_t i = 0; i < rim.size(); ++i) {
    const IVec3 a = rim[i], b = rim[(i + 1) % rim.size()];
    loops.push_back({middle, b, a});
    loops.push_back({raised(middle), raised(a), raised(b)});
    loops.push_back({a, b, raised(b)});
    loops.push_back({a, raised(b), raised(a)});
  }
  return convex_operand(loops);
}

// Each of their facets meets those of all others at the axis at least.
TEST(OperandGroups, FansInOnePlaneAreEvaluatedInGroups) {
  std::vector<Operand> operands;
  for (uint32_t o = 0; o < 20; ++o) {
    operands.push_back(fan_cylinder(10'000 + 7. * o, 0.7 * o, 24));
    operands.back().first_source = 100 * o;
  }
  for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kIntersection}) {
    const Expression expression = test::flat_expression(op, static_cast<uint32_t>(operands.size()));
    EXPECT_GT(cover_in_groups(Job(operands), expression), 0.5);
    const auto [grouped, whole] = signs_of_both(operands, expression, 26);
    EXPECT_NE(grouped, whole) << "it was done in one job";
  }
}

// Bars side by side, aslant, on the bottom of a plate: the boxes of each one's edges meet those of
// many others, but no two edges meet, so that the plate has no more regions than there are bars.
TEST(OperandGroups, BarsThatAreParallelAreNot) {
  std::vector<Operand> operands;
  for (uint32_t o = 0; o < 120; ++o) {
    const int64_t x = 600 * int64_t{o};
    const std::vector<IVec3> rim{
        {x, -x, 0}, {x + 60, -x, 0}, {x + 20'060, -x + 20'000, 0}, {x + 20'000, -x + 20'000, 0}};
    std::vector<IVec3> points = rim;
    for (IVec3 p : rim) points.push_back({p[0], p[1], 300});
    operands.push_back(convex_operand(test::hull_loops(points)));
    operands.back().first_source = o;
  }
  operands.push_back(convex_operand(test::box_loops({-100, -71'500, 0}, {91'600, 20'100, 90})));
  operands.back().first_source = 120;
  const Expression expression = test::flat_expression(BooleanOp::kUnion, 121);
  const auto [grouped, whole] = signs_of_both(operands, expression, 120 * 6 + 5);
  EXPECT_EQ(grouped, whole) << "it was done in groups";
}

TEST(OperandGroups, FewOperandsAreNot) {
  EXPECT_FALSE(can_be_grouped(Expression()));
  EXPECT_FALSE(can_be_grouped(test::flat_expression(BooleanOp::kUnion, 2)));
  EXPECT_FALSE(can_be_grouped(test::flat_expression(BooleanOp::kDifference, 3)));
  EXPECT_FALSE(can_be_grouped(test::flat_expression(BooleanOp::kSymmetricDifference, 9)));
  EXPECT_TRUE(can_be_grouped(test::flat_expression(BooleanOp::kUnion, 3)));
  EXPECT_TRUE(can_be_grouped(test::flat_expression(BooleanOp::kDifference, 4)));
}

// The groups of any expression, down to operators of two operands.
TEST(OperandGroups, OfRandomTreesAreEvaluatedAsOneJob) {
  test::Random random(77120);
  test::TreeMaker maker(random);
  int grouped = 0, firsts = 0;
  for (int round = 0; round < 60; ++round) {
    test::TreeShape shape;
    shape.operands = 7;
    shape.depth = 1 + round % 2;
    shape.frames = round % 3 == 0;
    const test::RandomTree tree = maker.make(shape);
    uint64_t signs = 0;
    const auto whole = evaluate(tree.operands, tree.expression, false, signs);
    ASSERT_TRUE(whole) << whole.error().message;
    GroupedJob job{tree.operands, tree.expression};
    for (; can_be_grouped(job.expression); ++grouped) {
      const std::vector<GridBox> boxes(job.operands.size(), tree.region);
      const bool with_first = round % 5 > 1 && are_taken_away(job.expression);
      firsts += with_first ? 1 : 0;
      auto next = evaluate_groups(
          job.operands, job.expression, with_first ? GroupWay::kWithFirst : GroupWay::kAlone, boxes,
          [&](const std::vector<Operand>& operands, const Expression& part, const GridBox& around) {
            EXPECT_LT(part.nodes.size(), job.expression.nodes.size());
            EvaluateStats stats;
            return evaluate_boolean(operands, part, around, {}, stats);
          });
      ASSERT_TRUE(next) << next.error().message;
      ASSERT_LT(next->expression.nodes.size(), job.expression.nodes.size());
      job = *std::move(next);
    }
    EvaluateStats stats;
    const auto last = evaluate_boolean(job.operands, job.expression, tree.region, {}, stats);
    ASSERT_TRUE(last) << last.error().message;
    ASSERT_EQ(test::first_difference(**last, **whole), "") << "round " << round;
  }
  EXPECT_GT(grouped, 20);
  EXPECT_GT(firsts, 2);
}

}  // namespace
}  // namespace csgrun::operand_groups_test
