// Results that name untouched triangles as operands, against the same results spelled out: what
// comes of both must be one value.
#include <gtest/gtest.h>

#include "engine/bsp/self_resolution.h"
#include "engine/mesh/leaf_check.h"
#include "tests/support/kernel_case.h"
#include "tests/support/named_results.h"
#include "tests/support/random_frames.h"

namespace csgrun::named_operands_test {
namespace {

using namespace test;  // NOLINT: a test

Operand result_operand(Boundary boundary, const Operand& like) {
  Operand operand = like;
  operand.leaf.reset();
  operand.boundary = std::move(boundary);
  return operand;
}

/// One operation on the operands of either kind.
Pair evaluate_again(BooleanOp op, const std::vector<Operand>& spelled,
                    const std::vector<Operand>& naming, KernelOptions options = {}) {
  Pair pair;
  const GridBox region = region_of(spelled);
  const auto evaluated = [&](const std::vector<Operand>& operands) -> Boundary {
    EvaluateStats stats;
    const auto made = evaluate_boolean(operands, flat_expression(op, 2), region, options, stats);
    if (!made) ADD_FAILURE() << text(made.error());
    return made ? *made : std::make_shared<BoundaryMesh>();
  };
  pair.spelled = evaluated(spelled);
  EXPECT_EQ(difference_between(*pair.spelled, *evaluated(naming)), "");
  options.name_untouched = true;
  pair.naming = evaluated(naming);
  return pair;
}

/// A torus of bumps, or a box of tiles with neighbours in one plane; of some appearances.
std::shared_ptr<LeafGeometry> any_leaf(Random& random, int64_t size) {
  const auto leaf = leaf_of_triangles(
      random.integer(0, 1) ? bumpy_torus(random, {0, 0, 0}, static_cast<double>(size))
                           : tiled_box(random, {-size, -size, -size}, 8, size / 4));
  if (random.integer(0, 1)) {
    std::vector<uint32_t> numbers(leaf->face_count());
    for (uint32_t& n : numbers) n = static_cast<uint32_t>(random.integer(0, 2));
    leaf->appearance = numbers;
  }
  return leaf;
}

IVec3 any_move(Random& random, int64_t size) {
  return {random.integer(-size, size), random.integer(-size, size), random.integer(-size, size)};
}

TEST(NamedOperands, OfRandomTrees) {
  constexpr int64_t kSize = 1 << 16;
  size_t first_named = 0, then_named = 0, flipped = 0;
  for (int round = 0; round < 30; ++round) {
    Random random(4300 + round);
    std::vector<Operand> leaves;
    for (int i = 0; i < 3; ++i) {
      leaves.push_back(placed(any_leaf(random, kSize), any_move(random, kSize)));
      leaves.back().first_source = static_cast<uint32_t>(i);
    }
    // Two of them, and then the result with the third, and that with a leaf once more.
    const Tree two{-1, static_cast<BooleanOp>(random.integer(0, 3)), {leaf(0), leaf(1)}};
    Pair pair = evaluate_both(two, {leaves[0], leaves[1]});
    for (int step = 0; step < 2; ++step) {
      first_named += named(*pair.naming);
      Operand place;
      place.translation = any_move(random, kSize / 2);
      place.first_source = 3 * static_cast<uint32_t>(random.integer(1, 5));  // none as a leaf's
      if (random.integer(0, 2) == 0) place.appearance = 3;
      if (random.integer(0, 5) == 0) place.frame = random_frame(random);
      const bool is_second = random.integer(0, 1) != 0;
      const auto operands = [&](const Boundary& boundary) {
        std::vector<Operand> list{leaves[2], result_operand(boundary, place)};
        if (!is_second) std::swap(list[0], list[1]);
        return list;
      };
      KernelOptions options;
      options.literal_cells = random.integer(0, 9) == 0;
      options.whole_faces = random.integer(0, 4) != 0;
      options.threads = static_cast<unsigned>(random.integer(1, 2));
      const auto op = static_cast<BooleanOp>(random.integer(0, 3));
      const std::string what =
          std::to_string(round) + " " + std::to_string(step) + " " + two.text();
      pair = evaluate_again(op, operands(pair.spelled), operands(pair.naming), options);
      ASSERT_NO_FATAL_FAILURE(expect_one_value(pair, what));
      then_named += named(*pair.naming);
      for (const UntouchedPart& part : pair.naming->parts) {
        flipped += part.flipped ? part.faces.size() : 0;
      }
    }
  }
  EXPECT_GT(first_named, 5000u);
  EXPECT_GT(then_named, 3000u);
  EXPECT_GT(flipped, 500u);
}

// Solids that cross one another in one mesh, resolved; then with a leaf.
TEST(NamedOperands, OfResolvedSurfaces) {
  constexpr int64_t kSize = 1 << 16;
  size_t resolved_named = 0, then_named = 0;
  for (int round = 0; round < 14; ++round) {
    Random random(4400 + round);
    std::vector<Loop> loops;
    for (int64_t i = random.integer(2, 3); i > 0; --i) {
      const IVec3 at = any_move(random, kSize);
      const auto own = random.integer(0, 1)
                           ? bumpy_torus(random, at, static_cast<double>(kSize))
                           : tiled_box(random, {at[0] / 8, at[1] / 8, at[2] / 8}, 8, kSize / 8);
      loops.insert(loops.end(), own.begin(), own.end());
    }
    const auto mesh = leaf_of_triangles(loops);
    const auto crossings = find_self_intersections(*mesh);
    mesh->may_touch = true;
    mesh->has_single_fans = false;
    Operand surface = placed(mesh, any_move(random, 100));
    if (random.integer(0, 5) == 0) surface.frame = random_frame(random);
    for (const InsideRule rule : {InsideRule::kNonZero, InsideRule::kPositive, InsideRule::kEvenOdd,
                                  InsideRule::kOuterHull}) {
      const std::string what =
          std::to_string(round) + " by rule " + std::to_string(static_cast<int>(rule));
      Pair pair;
      KernelOptions options;
      options.whole_faces = random.integer(0, 3) != 0;
      for (Boundary* result : {&pair.spelled, &pair.naming}) {
        options.name_untouched = result == &pair.naming;
        EvaluateStats stats;
        const auto made = resolve_surface(surface, crossings, rule, options, stats);
        ASSERT_TRUE(made) << what << text(made.error());
        *result = *made;
      }
      ASSERT_NO_FATAL_FAILURE(expect_one_value(pair, what));
      resolved_named += named(*pair.naming);
      Operand place;
      place.translation = any_move(random, kSize / 2);
      const Operand tool = placed(any_leaf(random, kSize), any_move(random, kSize));
      const auto op = static_cast<BooleanOp>(random.integer(0, 3));
      const Pair next = evaluate_again(op, {result_operand(pair.spelled, place), tool},
                                       {result_operand(pair.naming, place), tool});
      ASSERT_NO_FATAL_FAILURE(expect_one_value(next, what));
      then_named += named(*next.naming);
    }
  }
  EXPECT_GT(resolved_named, 5000u);
  EXPECT_GT(then_named, 5000u);
}

// Faces at the tips of a double pyramid over a figure of eight cross one another from there on:
// what is left is two fans at either tip, though nothing meets their faces.
TEST(NamedOperands, AtCornersWhereFacesCross) {
  const std::vector<IVec3> eight{{-8, -3, 0}, {8, 3, 0},  {14, 6, 0},  {18, 0, 0},  {14, -6, 0},
                                 {8, -3, 0},  {-8, 3, 0}, {-14, 6, 0}, {-18, 0, 0}, {-14, -6, 0}};
  std::vector<Loop> loops;
  for (size_t i = 0; i < eight.size(); ++i) {
    const IVec3 &a = eight[i], &b = eight[(i + 1) % eight.size()];
    loops.push_back({a, b, {0, 0, 20}});
    loops.push_back({b, a, {0, 0, -20}});
  }
  const auto mesh = leaf_of_triangles(loops);
  ASSERT_TRUE(mesh->has_single_fans);
  mesh->may_touch = true;
  const auto crossings = find_self_intersections(*mesh);
  ASSERT_EQ(crossings.size(), 4u);  // those above and below also meet in the middle
  for (const InsideRule rule : {InsideRule::kNonZero, InsideRule::kPositive}) {
    Pair pair;
    KernelOptions options;
    for (Boundary* result : {&pair.spelled, &pair.naming}) {
      options.name_untouched = result == &pair.naming;
      EvaluateStats stats;
      const auto made = resolve_surface(operand_of(mesh), crossings, rule, options, stats);
      ASSERT_TRUE(made) << text(made.error());
      *result = *made;
    }
    ASSERT_NO_FATAL_FAILURE(expect_one_value(pair, "an eight"));
    const auto solid = present(*pair.naming, test_context());
    ASSERT_TRUE(solid);
    EXPECT_EQ((*solid)->measures.components, rule == InsideRule::kNonZero ? 2 : 1);
  }
}

}  // namespace
}  // namespace csgrun::named_operands_test
