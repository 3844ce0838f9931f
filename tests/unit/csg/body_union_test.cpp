// A leaf of several bodies is what resolving it as it is makes of it, and what winding numbers say.
#include "engine/csg/body_union.h"

#include <atomic>

#include <gtest/gtest.h>

#include "engine/csg/bodies.h"
#include "tests/support/exact_solid.h"
#include "tests/support/kernel_case.h"
#include "tests/support/kernel_checks.h"
#include "tests/support/oracle.h"

namespace csgrun::test::body_union_test {
namespace {

/// The faces of one shell, and what they are labelled with.
struct ShellLoops {
  std::vector<Loop> loops;
  uint32_t surface = 0, appearance = 0;
};

/// A prism over a polygon that may cross itself, its caps fans about a point: the winding number of
/// a point is that of the polygon, where it is within.
std::vector<Loop> fanned_prism(const std::vector<Point2>& base, const Point2& hub, int64_t z0,
                               int64_t z1) {
  std::vector<Loop> loops;
  for (size_t i = 0; i < base.size(); ++i) {
    const Point2 &a = base[i], &b = base[(i + 1) % base.size()];
    loops.push_back({{a[0], a[1], z0}, {b[0], b[1], z0}, {b[0], b[1], z1}, {a[0], a[1], z1}});
    loops.push_back({{a[0], a[1], z1}, {b[0], b[1], z1}, {hub[0], hub[1], z1}});
    loops.push_back({{b[0], b[1], z0}, {a[0], a[1], z0}, {hub[0], hub[1], z0}});
  }
  return loops;
}

std::vector<Loop> moved(std::vector<Loop> loops, const IVec3& by) {
  for (Loop& loop : loops) {
    for (IVec3& p : loop) {
      for (size_t k = 0; k < 3; ++k) p[k] += by[k];
    }
  }
  return loops;
}

IVec3 random_vector(Random& random, int64_t from, int64_t to) {
  return {random.integer(from, to), random.integer(from, to), random.integer(from, to)};
}

/// A shell like those before it, or unlike them.
void add_shells(Random& random, std::vector<ShellLoops>& shells) {
  const auto kind = random.integer(0, 11);
  std::vector<Loop> loops;
  if (kind == 0 && !shells.empty()) {  // one that was there
    const size_t which =
        static_cast<size_t>(random.integer(0, static_cast<int64_t>(shells.size()) - 1));
    loops = shells[which].loops;
  } else if (kind == 1) {  // a box with a cavity
    const IVec3 at = random_vector(random, -3, 3), by = random_vector(random, 0, 1);
    const auto corner = [&](int64_t d) { return IVec3{at[0] + d, at[1] + d, at[2] + d}; };
    auto cavity = moved(box_loops(corner(1), corner(3)), by);
    turn_over(cavity);
    shells.push_back({std::move(cavity), 2, 0});
    loops = box_loops(corner(0), corner(5));
  } else if (kind == 2) {  // a pentagram, or an eight, of which one half is inside out
    const bool is_star = random.integer(0, 2) > 0;
    const std::vector<Point2> star{{0, 6}, {-4, -5}, {6, 2}, {-6, 2}, {4, -5}},
        eight{{-4, -4}, {4, 4}, {4, -4}, {-4, 4}};
    loops = fanned_prism(is_star ? star : eight, {0, 1}, random.integer(-3, 0), 2);
  } else {
    loops = moved(random_loops(random, 4), random_vector(random, 0, 2));
  }
  if (random.integer(0, 15) == 0) turn_over(loops);
  shells.push_back({std::move(loops), static_cast<uint32_t>(random.integer(0, 1)),
                    static_cast<uint32_t>(random.integer(0, 5) / 5)});
}

/// One leaf of all faces, as it is prepared. In some their order is mixed, or faces are parted into
/// triangles of one facet.
PreparedLeaf prepared_leaf(Random& random, const std::vector<ShellLoops>& shells) {
  const bool keep_facets = random.integer(0, 1) != 0, parts_faces = random.integer(0, 2) == 0;
  struct Face {
    Loop loop;
    uint32_t surface, appearance, facet;
  };
  std::vector<std::vector<Face>> facets;
  for (const ShellLoops& shell : shells) {
    for (const Loop& loop : shell.loops) {
      std::vector<Face>& parts = facets.emplace_back();
      if (!parts_faces) parts.push_back({loop, shell.surface, shell.appearance, 0});
      for (size_t i = 2; i < loop.size() && parts_faces; ++i) {
        const std::array<IVec3, 3> t{loop[0], loop[i - 1], loop[i]};
        if (cross_of(sub(t[1], t[0]), sub(t[2], t[0])) == IVec3{0, 0, 0}) {
          parts = {{loop, shell.surface, shell.appearance, 0}};
          break;
        }
        parts.push_back({{t[0], t[1], t[2]}, shell.surface, shell.appearance, 0});
      }
    }
  }
  if (random.integer(0, 3) == 0) {
    for (size_t i = facets.size(); i > 1; --i) {
      std::swap(facets[i - 1],
                facets[static_cast<size_t>(random.integer(0, static_cast<int64_t>(i) - 1))]);
    }
  }
  std::vector<Loop> loops;
  std::vector<uint32_t> facet, surface, appearance;
  for (size_t f = 0; f < facets.size(); ++f) {
    for (const Face& face : facets[f]) {
      loops.push_back(face.loop);
      facet.push_back(static_cast<uint32_t>(f) + 1);
      surface.push_back(face.surface);
      appearance.push_back(face.appearance);
    }
  }
  LeafGeometry leaf = *make_leaf(loops);
  if (keep_facets) leaf.facet = parts_faces ? FaceNumbers(facet) : FaceNumbers::ascending(1);
  leaf.surface = surface;
  leaf.appearance = appearance;
  return prepare_faces(std::move(leaf));
}

BoundaryResult resolved_as_it_is(const PreparedLeaf& leaf, InsideRule rule,
                                 const KernelOptions& options = {}) {
  EvaluateStats stats;
  return resolve_surface(operand_of(leaf.geometry), leaf.crossings, rule, options, stats);
}
std::optional<BoundaryResult> resolved_by_bodies(const PreparedLeaf& leaf, InsideRule rule,
                                                 const KernelOptions& options = {}) {
  EvaluateStats stats;
  return resolve_bodies(*leaf.geometry, leaf.crossings, rule, options, stats);
}

SolidPtr presented(const BoundaryMesh& mesh) {
  auto solid = present(mesh, test_context());
  EXPECT_TRUE(solid) << solid.error().message;
  return solid ? *solid : std::make_shared<Solid>();
}

/// Empty, or a point where the result is not what the winding number of the leaf says.
std::string disagreement_with_winding(Random& random, const LeafGeometry& leaf, InsideRule rule,
                                      const BoundaryMesh& result) {
  Operand operand;
  operand.leaf = std::make_shared<LeafGeometry>(leaf);
  const Oracle of_leaf(exact_solid(operand)), of_result(exact_solid(result));
  for (int i = 0; i < 25; ++i) {
    const Query q = random_query(random, of_leaf.solid());
    const auto winding = of_leaf.winding(q), found = of_result.winding(q);
    if (!winding || !found) continue;
    const bool is_inside = rule == InsideRule::kPositive ? *winding > 0 : *winding != 0;
    if (*found != (is_inside ? 1 : 0)) {
      return "winding number " + std::to_string(*found) + " where the leaf's is " +
             std::to_string(*winding);
    }
  }
  return "";
}

class RandomBodies : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Parts, RandomBodies, ::testing::Range(0, 10));

TEST_P(RandomBodies, AreResolvedAsTheyAre) {
  const int count = cases(30);
  int by_bodies = 0, tangled = 0;
  for (int i = GetParam() * count; i < (GetParam() + 1) * count; ++i) {
    Random random(70'000 + i);
    std::vector<ShellLoops> shells;
    const int64_t wanted = random.integer(2, 5);
    while (static_cast<int64_t>(shells.size()) < wanted) add_shells(random, shells);
    const PreparedLeaf leaf = prepared_leaf(random, shells);
    if (leaf.status != PreparedLeaf::Status::kTangled) continue;
    ++tangled;
    const InsideRule rule = random.integer(0, 1) ? InsideRule::kNonZero : InsideRule::kPositive;
    const auto found = resolved_by_bodies(leaf, rule);
    if (!found) continue;
    ++by_bodies;
    ASSERT_TRUE(*found) << found->error().message << ", case " << i;
    const auto expected = resolved_as_it_is(leaf, rule);
    ASSERT_TRUE(expected);
    ASSERT_EQ(difference_between(**expected, ***found), "") << "case " << i;
    ASSERT_EQ(disagreement_with_winding(random, *leaf.geometry, rule, ***found), "")
        << "case " << i;
    KernelOptions options;
    options.name_untouched = true;
    const auto naming = resolved_by_bodies(leaf, rule, options);
    ASSERT_TRUE(naming && *naming);
    const SolidPtr solid = presented(**resolved_as_it_is(leaf, rule, options));
    ASSERT_EQ(difference_between(*solid, *presented(***naming)), "") << "case " << i;
    ASSERT_EQ(difference_between(*solid, *presented(***found)), "") << "case " << i;
  }
  EXPECT_GT(3 * by_bodies, tangled);
}

PreparedLeaf leaf_of(const std::vector<std::vector<Loop>>& shells, bool keep_facets = false) {
  std::vector<Loop> all;
  for (const auto& loops : shells) all.insert(all.end(), loops.begin(), loops.end());
  return prepare_faces(LeafGeometry(*make_leaf(all, keep_facets)));
}
std::vector<Loop> cube(int64_t at, int64_t size) {
  return box_loops({at, at, at}, {at + size, at + size, at + size});
}
std::vector<Loop> inside_out(std::vector<Loop> loops) {
  turn_over(loops);
  return loops;
}
/// How many bodies there are, if they are told.
std::optional<size_t> count_bodies(const PreparedLeaf& leaf) {
  const auto bodies = find_bodies(*leaf.geometry, leaf.crossings);
  return bodies ? std::optional(bodies->size()) : std::nullopt;
}

TEST(BodyUnion, EqualBodiesAreOne) {
  EXPECT_EQ(count_bodies(leaf_of({cube(0, 4), cube(0, 4), cube(2, 4), cube(0, 4)})), 2u);
  EXPECT_EQ(count_bodies(leaf_of({cube(0, 4), cube(0, 4), cube(0, 4)}, true)), 1u);
  EXPECT_EQ(count_bodies(leaf_of({cube(0, 4), cube(4, 4), cube(3, 4)})), 3u);
}

TEST(BodyUnion, CavitiesAreOfOneBodyEach) {
  const auto outer = cube(0, 9), cavity = inside_out(cube(2, 3)), other = inside_out(cube(3, 3));
  // What one copy lacks the other one has.
  EXPECT_EQ(count_bodies(leaf_of({cavity, outer, outer})), 2u);
  EXPECT_EQ(count_bodies(leaf_of({outer, cavity, outer, cavity})), 1u);
  EXPECT_EQ(count_bodies(leaf_of({outer, outer, cavity, other})), 2u);
  // One that no body can have: it crosses both, or is in a cavity.
  EXPECT_EQ(count_bodies(leaf_of({outer, cube(1, 9), inside_out(cube(7, 5))})), std::nullopt);
  EXPECT_EQ(count_bodies(leaf_of({outer, cavity, other, cube(5, 9)})), std::nullopt);
  const auto small = inside_out(cube(3, 1));
  EXPECT_EQ(count_bodies(leaf_of({outer, cavity, small, cube(8, 3)})), std::nullopt);
  EXPECT_EQ(count_bodies(leaf_of({inside_out(outer), cube(8, 3)})), std::nullopt);
}

TEST(BodyUnion, FacesUponOthersTellTheOrder) {
  // All faces of the second cube come before the last of the first one.
  auto first = cube(0, 4), rest = first;
  first.resize(1);
  rest.erase(rest.begin());
  const auto second = box_loops({1, 1, 1}, {3, 3, 4});  // upon the second face
  EXPECT_EQ(count_bodies(leaf_of({first, second, rest})), 2u);
  EXPECT_EQ(count_bodies(leaf_of({first, second, rest}, true)), std::nullopt);
  EXPECT_EQ(count_bodies(leaf_of({first, rest, second}, true)), 2u);
}

TEST(BodyUnion, BodiesThatCrossThemselves) {
  const std::vector<Point2> star{{0, 6}, {-4, -5}, {6, 2}, {-6, 2}, {4, -5}},
      eight{{-4, -4}, {4, 4}, {4, -4}, {-4, 4}};
  std::vector<std::vector<Loop>> bars;
  for (int64_t i = 0; i < 8; ++i) bars.push_back(box_loops({-9, i - 5, -7}, {9, i + 1, 9 + i}));
  const auto with = [&](const std::vector<Loop>& shell) {
    auto shells = bars;
    shells.push_back(shell);
    return leaf_of(shells);
  };
  const PreparedLeaf starred = with(fanned_prism(star, {0, 0}, -9, 12));
  const auto result = resolved_by_bodies(starred, InsideRule::kNonZero);
  ASSERT_TRUE(result && *result);
  EXPECT_EQ(difference_between(***result, **resolved_as_it_is(starred, InsideRule::kNonZero)), "");
  // Half of it is inside out: what it wraps is to be taken from others.
  const PreparedLeaf mixed = with(fanned_prism(eight, {0, 1}, -9, 12));
  EXPECT_FALSE(resolved_by_bodies(mixed, InsideRule::kNonZero));
  EXPECT_FALSE(resolved_by_bodies(mixed, InsideRule::kPositive));
  // Nothing is gained where few pairs are of different bodies.
  EXPECT_FALSE(resolved_by_bodies(leaf_of({fanned_prism(star, {0, 0}, -9, 12), cube(8, 3)}),
                                  InsideRule::kNonZero));
}

// A face of so many partners would be left to cells, which are divided on and on.
TEST(BodyUnion, CrowdsAreEvaluatedAsOperands) {
  std::vector<std::vector<Loop>> rods;
  std::vector<Operand> operands;
  Random random(5);
  while (rods.size() < 24) {
    const IVec3 far = random_vector(random, -4000, 4000);
    const auto rod = hull_loops({{far[0], far[1], far[2]},
                                 {far[0] + 60, far[1], far[2]},
                                 {far[0], far[1] + 60, far[2] + 60},
                                 {-far[0], -far[1], -far[2]},
                                 {60 - far[0], -far[1], -far[2]},
                                 {-far[0], 60 - far[1], 60 - far[2]}});
    if (rod.empty()) continue;
    rods.push_back(rod);
    operands.push_back(operand_of(make_leaf(rod)));
  }
  const PreparedLeaf leaf = leaf_of(rods);
  EvaluateStats stats;
  const auto expected = evaluate_boolean(operands, flat_expression(BooleanOp::kUnion, 24),
                                         region_of(operands), {}, stats);
  ASSERT_TRUE(expected);
  const uint64_t cells = stats.cells;
  for (const InsideRule rule : {InsideRule::kNonZero, InsideRule::kPositive}) {
    stats = {};
    const auto found = resolve_leaf(operand_of(leaf.geometry), leaf.crossings, rule, {}, stats);
    ASSERT_TRUE(found);
    EXPECT_EQ(difference_between(**found, **expected), "");
    EXPECT_EQ(stats.cells, cells);
  }
}

TEST(BodyUnion, OtherRulesAreAsTheyWere) {
  std::vector<std::vector<Loop>> plates;
  for (int64_t i = 0; i < 16; ++i) plates.push_back(box_loops({i, -i, 0}, {40 + i, 60 - i, 5}));
  const PreparedLeaf leaf = leaf_of(plates);
  for (const InsideRule rule : {InsideRule::kNonZero, InsideRule::kPositive, InsideRule::kEvenOdd,
                                InsideRule::kOuterHull, InsideRule::kOrientedHull}) {
    EvaluateStats stats;
    const auto found = resolve_leaf(operand_of(leaf.geometry), leaf.crossings, rule, {}, stats);
    ASSERT_TRUE(found);
    EXPECT_EQ(difference_between(**found, **resolved_as_it_is(leaf, rule)), "");
  }
}

TEST(BodyUnion, StopsWhenCancelled) {
  const PreparedLeaf leaf = leaf_of({cube(0, 4), cube(1, 5), cube(3, 6)});
  const std::atomic<bool> cancel = true;
  KernelOptions options;
  options.cancel = &cancel;
  const auto stopped = resolved_by_bodies(leaf, InsideRule::kNonZero, options);
  ASSERT_TRUE(stopped);
  ASSERT_FALSE(*stopped);
  EXPECT_EQ(stopped->error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace csgrun::test::body_union_test
