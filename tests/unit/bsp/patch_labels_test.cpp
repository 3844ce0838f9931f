// What becomes of a patch, against the expression at points on either side of it, in rational
// arithmetic.
#include "engine/bsp/patch_labels.h"

#include <gtest/gtest.h>

#include "tests/support/convex_operand.h"
#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/oracle.h"
#include "tests/support/random_solids.h"

namespace csgrun::patch_labels_test {
namespace {

using test::Query;

/// Whether a point is inside each operand, or nothing when it is on some other's surface than
/// `own`.
std::optional<std::vector<bool>> inside_of(const std::vector<test::Oracle>& oracles, uint32_t own,
                                           const Query& at) {
  std::vector<bool> inside;
  for (uint32_t o = 0; o < oracles.size(); ++o) {
    const auto winding = o == own ? 0 : oracles[o].winding(at);
    if (!winding) return std::nullopt;
    inside.push_back(*winding == 1);
  }
  return inside;
}

PatchFate fate_of(bool front, bool back) {
  if (front == back) return PatchFate::kDrop;
  return back ? PatchFate::kKeep : PatchFate::kFlip;
}

test::Tree flat_tree(BooleanOp op, int count) {
  test::Tree tree;
  tree.op = op;
  for (int i = 0; i < count; ++i) tree.children.push_back(test::leaf(i));
  return tree;
}

// Few operands and many, near each other and far apart, all or some of them named by facts.
TEST(PatchLabels, FatesAreWhatTheExpressionSays) {
  test::Random random(511);
  size_t fates[3] = {}, unknown = 0, lies = 0;
  for (int i = 0; i < 160; ++i) {
    const int count = i % 4 == 0 ? static_cast<int>(random.integer(17, 80))
                                 : static_cast<int>(random.integer(1, 16));
    const int64_t spread = random.integer(0, 3) * random.integer(0, 12);
    const int64_t away = random.integer(-2, 2) * 30;
    std::vector<Operand> operands;
    std::vector<test::Oracle> oracles;
    for (int o = 0; o < count; ++o) {
      Operand operand = test::operand_of(test::random_leaf(random));
      if (o > 0 && random.integer(0, 9) == 0) {  // nothing at all
        operand.leaf = std::make_shared<LeafGeometry>();
      }
      operand.first_source = static_cast<uint32_t>(o);
      for (int64_t& t : operand.translation) t = away + random.integer(-spread, spread);
      oracles.emplace_back(test::exact_solid(operand));
      operands.push_back(operand);
    }
    const Job job(operands);
    const auto op = static_cast<BooleanOp>(random.integer(0, 3));
    PlainlyCovered plainly;  // of some, what facts tell is not relied on
    for (int o = 0; o < count; ++o) plainly.is_open.push_back(random.integer(0, 3) == 0);
    PatchLabels labels(job, test::flat_expression(op, static_cast<uint32_t>(count)), plainly);
    const test::Tree tree = flat_tree(op, count);
    for (int k = 0; k < 30; ++k) {
      const JobPolygon& p = job.polygons()[static_cast<size_t>(
          random.integer(0, static_cast<int64_t>(job.polygons().size()) - 1))];
      const auto corners = job.corners(p);
      // Within a convex polygon; sixteenths are exact.
      Query at{};
      for (int c = 0; c < 3; ++c) {
        at[c] = (9 * job.rounded(corners[0])[c] + 4 * job.rounded(corners[1])[c] +
                 3 * job.rounded(corners.back())[c]) /
                16;
      }
      auto inside = inside_of(oracles, p.operand, at);
      if (!inside) continue;
      std::vector<CutLoops::Fact> facts;
      const bool at_first = random.integer(0, 1) == 1;
      for (uint32_t o = 0; o < operands.size(); ++o) {
        if (o == p.operand || random.integer(0, 5) != 0) continue;
        const bool is_elsewhere = random.integer(0, 2) > 0;
        const bool is_so =
            !plainly.is_open[o] || (at_first && !is_elsewhere) || random.integer(0, 1) == 0;
        lies += !is_so;
        const bool is = (*inside)[o] == is_so;
        facts.push_back({o, is, is, is_elsewhere});
      }
      // As if the boundary of one ran along the patch: lower ones count.
      if (random.integer(0, 3) == 0 && p.operand > 0 && facts.empty()) {
        const auto other = static_cast<uint32_t>(random.integer(0, p.operand - 1));
        const bool front = random.integer(0, 1) == 1;
        facts.push_back({other, front, !front});
        std::vector<bool> before = *inside, behind = *inside;
        before[other] = front, behind[other] = !front;
        behind[p.operand] = true;
        // Then the patch is the other's, if what is before and behind differs by it.
        before[p.operand] = false;
        const PatchFate got = labels.fate(p.operand, at, 0, facts, at_first);
        if (got == PatchFate::kUnknown) {
          ++unknown;
        } else if (tree.inside(before) == tree.inside(behind)) {
          ASSERT_EQ(got, PatchFate::kDrop);
        } else if (got != PatchFate::kDrop) {
          ASSERT_EQ(got, fate_of(tree.inside(before), tree.inside(behind)));
        }
        continue;
      }
      (*inside)[p.operand] = true;
      const bool back = tree.inside(*inside);
      (*inside)[p.operand] = false;
      const PatchFate fate = fate_of(tree.inside(*inside), back);
      for (const double error : {0.0, 0x1p-40}) {
        const PatchFate got = labels.fate(p.operand, at, error, facts, at_first);
        if (got == PatchFate::kUnknown) {
          ++unknown;
        } else {
          ASSERT_EQ(got, fate) << "case " << i << ", point " << k;
        }
      }
      ++fates[static_cast<size_t>(fate)];
    }
  }
  for (const size_t n : fates) EXPECT_GT(n, 50u);
  EXPECT_GT(lies, 500u);
  EXPECT_LT(unknown * 5, fates[0]);  // points in line with an edge
}

// Two boxes, one of which is added to the other; the point's coordinates may be wrong.
TEST(PatchLabels, WhatAPointCannotTellIsUnknown) {
  std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {10, 10, 10})),
                                test::operand_of(test::box_leaf({20, 20, 20}, {30, 30, 30}))};
  const Job job(operands);
  PlainlyCovered none;
  none.is_open = {0, 0};
  PatchLabels labels(job, test::flat_expression(BooleanOp::kUnion, 2), none);
  for (int k = 0; k < 3; ++k) {
    for (const double side : {20.0, 30.0}) {
      const double outwards = side == 20 ? -1 : 1;
      Query at{25, 25, 25};
      // May be inside the second: by no more than it may be wrong.
      at[k] = side + outwards * 0.25;
      EXPECT_EQ(labels.fate(0, at, 0.5, {}, false), PatchFate::kUnknown) << k << ' ' << side;
      EXPECT_EQ(labels.fate(0, at, 0.25, {}, false), PatchFate::kUnknown) << k << ' ' << side;
      EXPECT_EQ(labels.fate(0, at, 0.125, {}, false), PatchFate::kKeep) << k << ' ' << side;
      at[k] = side - outwards;
      EXPECT_EQ(labels.fate(0, at, 0.01, {}, false), PatchFate::kDrop) << k << ' ' << side;
    }
    EXPECT_EQ(labels.fate(0, {5, 5, 5}, 0.5, {}, false), PatchFate::kKeep);
    EXPECT_EQ(labels.fate(0, {5, 5, 5}, 1, {}, false), PatchFate::kUnknown);
    for (const double far : {0x1p30, -0x1p30, 0x1p40}) {
      Query at{25, 25, 25};
      at[k] = far;
      EXPECT_EQ(labels.fate(0, at, 0, {}, false), PatchFate::kUnknown);
      at[k] = far / 2;
      if (std::fabs(far) == 0x1p30) {
        EXPECT_EQ(labels.fate(0, at, 0, {}, false), PatchFate::kKeep);
      }
    }
  }
}

// A block less three bodies, the second of which is open: what decides is relied on, wherever it
// is.
TEST(PatchLabels, OfOpenOperandsOnlyWhatDecidesIsReliedOn) {
  const std::vector<Operand> operands{
      test::operand_of(test::box_leaf({0, 0, 0}, {40, 40, 40})), test::octahedron({10, 10, 10}, 9),
      test::octahedron({20, 20, 20}, 9), test::octahedron({30, 30, 30}, 9)};
  const Job job(operands);
  const Expression expression = test::flat_expression(BooleanOp::kDifference, 4);
  PlainlyCovered plainly = find_plainly_covered(job, expression);
  for (uint32_t o = 0; o < 4; ++o) ASSERT_EQ(plainly.dead->is_remover(o), o > 0);
  plainly.is_open[2] = 1;
  PatchLabels labels(job, expression, plainly);
  using Facts = std::vector<CutLoops::Fact>;
  const auto fate = [&](const Query& at, const Facts& facts, bool is_at_first = false) {
    return labels.fate(1, at, 0, facts, is_at_first);
  };
  const Query beside{5, 10, 11}, within{20, 21, 20}, near_surface{20, 24, 22};
  EXPECT_EQ(fate(beside, {}, false), PatchFate::kFlip);
  EXPECT_EQ(fate(beside, {{2, true, true}}), PatchFate::kDrop);
  EXPECT_EQ(fate(beside, {{2, false, false}}), PatchFate::kFlip);
  // Inside the open one, or said not to be, where that is not known or known.
  for (const Query& at : {within, near_surface}) {
    EXPECT_EQ(fate(at, {}, false), PatchFate::kDrop);
    EXPECT_EQ(fate(at, {{2, false, false}}), PatchFate::kDrop);
    EXPECT_EQ(fate(at, {{2, false, false}}, true), PatchFate::kDrop);
    EXPECT_EQ(fate(at, {{2, false, false, false}}), PatchFate::kDrop);
    EXPECT_EQ(fate(at, {{2, false, false, false}}, true), PatchFate::kFlip);
    EXPECT_EQ(fate(at, {{2, false, true}}), PatchFate::kFlip);
  }
  // A point that may be wrong by more than balls allow for is told by planes.
  EXPECT_EQ(labels.fate(1, within, 0.75, {}, false), PatchFate::kDrop);
  // Its hidden surface passes through the patch.
  EXPECT_EQ(fate(beside, {{2, false, false}, {2, true, true}}), PatchFate::kDrop);
  // The block is open: outside of it nothing is left, wherever that is.
  plainly.is_open[0] = 1;
  for (uint32_t o = 0; o < 4; ++o) ASSERT_EQ(plainly.dead->is_confiner(o), o == 0);
  EXPECT_EQ(fate(beside, {{0, false, false}}), PatchFate::kDrop);
  EXPECT_EQ(fate(beside, {{0, true, true}}), PatchFate::kFlip);
  EXPECT_EQ(fate(beside, {{0, false, false, false}}, true), PatchFate::kDrop);
  EXPECT_EQ(fate(beside, {{0, false, false}, {0, true, true}}), PatchFate::kDrop);
}

}  // namespace
}  // namespace csgrun::patch_labels_test
