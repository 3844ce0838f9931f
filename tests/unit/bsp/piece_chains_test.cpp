// Chains of results in pieces, from random leaves, against one operation over everything.
#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "engine/bsp/boundary_pieces.h"
#include "engine/bsp/result_pieces.h"
#include "engine/bsp/untouched.h"
#include "engine/mesh/boundary_volume.h"
#include "engine/mesh/pieces_measures.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/convex_operand.h"
#include "tests/support/kernel_case.h"
#include "tests/support/named_results.h"
#include "tests/support/piece_steps.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"
#include "tests/support/random_trees.h"

namespace csgrun::piece_chains_test {
namespace {

using test::check_names;
using test::continued;
using test::step_of;

/// A version in pieces, and the operation that gives it at once.
struct Version {
  PiecesPtr pieces;
  std::vector<Operand> operands;
  Expression expression;
};

class Chains {
 public:
  explicit Chains(uint64_t seed) : random_(seed), maker_(random_) {}

  /// Starts from two operands, in pieces or as a boundary, by turns, and goes on for some steps;
  /// each version is looked at. `turning`: steps may take the version away from something.
  void run(const test::TreeShape& shape, int steps, bool turning = false) {
    const test::RandomTree leaves = maker_.make(shape);
    run_with(leaves.operands, leaves.region, steps, turning);
  }

  void run_with(const std::vector<Operand>& leaves, const GridBox& region, int steps,
                bool turning) {
    std::vector<Version> versions;
    for (const Operand& o : leaves) unused_.push_back(o);
    Version start;
    take(start.operands, 2);
    const auto op = static_cast<BooleanOp>(starts_ / 2 % 4);
    start.expression = test::flat_expression(op, 2);
    if (starts_++ % 2 == 0) {
      auto made = evaluate_pieces(start.operands, start.expression, region, {}, stats_);
      ASSERT_TRUE(made) << made.error().message;
      if (!*made) return;
      start.pieces = *made;
    } else {
      KernelOptions options;
      options.name_untouched = true;
      const auto boundary =
          evaluate_boolean(start.operands, start.expression, region, options, stats_);
      ASSERT_TRUE(boundary) << boundary.error().message;
      for (const UntouchedPart& part : (*boundary)->parts) {
        (part.flipped ? flipped_ : named_) += part.faces.size();
      }
      start.pieces = pieces_of(*boundary);
      check_points(*start.pieces, (*boundary)->point_planes.size());
    }
    ASSERT_NO_FATAL_FAILURE(check(start, region));
    versions.push_back(start);
    for (int i = 0; i < steps && !unused_.empty(); ++i) {
      // Now and then from a version that others went on from already.
      const size_t from =
          random_.integer(0, 3)
              ? versions.size() - 1
              : static_cast<size_t>(random_.integer(0, static_cast<int64_t>(versions.size()) - 1));
      Version next = versions[from];
      const auto first = static_cast<uint32_t>(next.operands.size());
      std::vector<Operand> others;
      take(others, static_cast<size_t>(random_.integer(1, 2)));
      next.operands.insert(next.operands.end(), others.begin(), others.end());
      const auto count = static_cast<uint32_t>(others.size());
      const auto step = static_cast<BooleanOp>(random_.integer(0, 3));
      const bool is_last = turning && random_.integer(0, 1);
      next.expression = continued(next.expression, step, first, count, is_last);
      const PieceStore& store = *versions[from].pieces->store;
      const size_t pieces_before = store.piece_count(), points_before = store.point_count();
      auto changed = change_pieces(*versions[from].pieces, others, step_of(step, count, is_last),
                                   region, {}, stats_);
      ASSERT_TRUE(changed) << changed.error().message;
      if (!*changed) continue;
      next.pieces = *changed;
      check_bytes(*next.pieces, next.pieces->store.get() == &store ? pieces_before : 0,
                  next.pieces->store.get() == &store ? points_before : 0);
      ASSERT_NO_FATAL_FAILURE(check(next, region)) << "step " << i;
      versions.push_back(next);
      ++steps_;
    }
    // What came later did not change any of them.
    for (const Version& v : versions) ASSERT_NO_FATAL_FAILURE(check(v, region));
    unused_.clear();
  }

  [[nodiscard]] int steps() const { return steps_; }
  /// Groups in all versions that were looked at, and those that an operation looked into.
  [[nodiscard]] size_t groups() const { return groups_; }
  [[nodiscard]] size_t expanded_groups() const { return expanded_groups_; }
  /// Faces that boundaries named from which chains started, and those that they had turned over.
  [[nodiscard]] size_t named() const { return named_; }
  [[nodiscard]] size_t flipped() const { return flipped_; }

 private:
  void take(std::vector<Operand>& to, size_t count) {
    for (; count > 0 && !unused_.empty(); --count) {
      to.push_back(unused_.front());
      unused_.erase(unused_.begin());
    }
  }

  /// What is new takes its bytes, and not many times as many; what was there before is not counted.
  static void check_bytes(const ResultPieces& pieces, size_t pieces_before, size_t points_before) {
    const size_t more_pieces = pieces.store->piece_count() - pieces_before,
                 more_points = pieces.store->point_count() - points_before;
    EXPECT_GE(pieces.bytes,
              more_pieces * (sizeof(PieceStore::Piece) + sizeof(PieceBox) + 6 * sizeof(uint32_t)) +
                  more_points * (6 * sizeof(double)));
    EXPECT_LE(pieces.bytes, 500 * (1 + more_pieces + more_points));
  }
  /// No point of a boundary, the first operand, is a corner of faces that it names: there these
  /// have a number before.
  static void check_points(const ResultPieces& pieces, size_t boundary_points) {
    const PieceStore& store = *pieces.store;
    std::set<std::array<double, 3>> of_named;
    for (const bool whole : {true, false}) {
      pieces.tree.each([](const PieceBox&) { return true; },
                       [&](uint32_t p) {
                         if (store.piece(p).is_whole != whole) return;
                         store.each_face(p, [&](std::span<const uint32_t> corners) {
                           for (const uint32_t c : corners) {
                             if (whole) {
                               of_named.insert(store.rounded(c));
                             } else if (c < boundary_points) {
                               EXPECT_FALSE(of_named.contains(store.rounded(c)));
                             }
                           }
                         });
                       });
    }
  }
  static bool may_touch_anywhere(const BoundaryMesh& mesh) {
    return mesh.may_touch && mesh.touches.empty();
  }

  /// The sums from which a volume came say how large the triangles are that they had to cut.
  static void check_bounds(const ResultPieces& pieces) {
    const PieceTree::NodePtr& root = pieces.tree.root();
    if (!root) return;
    const PieceStore& store = *pieces.store;
    double twice_area = 0, edges = 0;
    pieces.tree.each(
        [](const PieceBox&) { return true; },
        [&](uint32_t p) {
          if (store.is_group(p)) return;  // from whole numbers
          const auto corners = store.corners(p);
          if (std::all_of(corners.begin(), corners.end(),
                          [&](uint32_t c) { return store.is_on_grid(c); })) {
            return;
          }
          store.each_loop(p, [&](uint32_t begin, uint32_t end) {
            const auto& a = store.rounded(corners[begin]);
            for (uint32_t i = begin + 1; i + 1 < end; ++i) {
              const auto &b = store.rounded(corners[i]), &c = store.rounded(corners[i + 1]);
              double of_b = 0, of_c = 0;
              for (size_t k = 0; k < 3; ++k) {
                const size_t x = (k + 1) % 3, y = (k + 2) % 3;
                twice_area +=
                    std::fabs((b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x]));
                of_b = std::max(of_b, std::fabs(b[k] - a[k]));
                of_c = std::max(of_c, std::fabs(c[k] - a[k]));
              }
              edges += of_b + of_c;
            }
          });
        });
    ASSERT_TRUE(root->has_sums);
    EXPECT_GE(root->sums.twice_area, twice_area * (1 - 1e-9));
    EXPECT_GE(root->sums.edges, edges * (1 - 1e-9));
  }

  void check(const Version& v, const GridBox& region) {
    const auto once = evaluate_boolean(v.operands, v.expression, region, {}, stats_);
    ASSERT_TRUE(once) << once.error().message;
    const auto assembled = assemble_pieces(*v.pieces, false);
    ASSERT_TRUE(assembled) << assembled.error().message;
    ASSERT_EQ(test::first_difference(**assembled, **once), "");
    ASSERT_TRUE(may_touch_anywhere(**assembled) || !may_touch_anywhere(**once));
    const auto named = assemble_pieces(*v.pieces, true);
    ASSERT_TRUE(named) << named.error().message;
    ASSERT_EQ(test::first_difference(*expanded(*named), **once), "");
    const GridStep step{1, 1, 0};
    const auto volume = pieces_volume(*v.pieces, step), truth = boundary_volume(**once, step);
    ASSERT_TRUE(volume && truth);
    ASSERT_EQ(*volume, *truth);
    check_bounds(*v.pieces);
    check_names(*v.pieces);
    const auto box = pieces_box(*v.pieces, step);
    ASSERT_EQ(box.has_value(), !(*once)->faces.empty());
    for (int k = 0; box && k < 3; ++k) {
      double lo = HUGE_VAL, hi = -HUGE_VAL;
      for (const auto& p : (*once)->point_rounded) {
        lo = std::min(lo, p[static_cast<size_t>(k)]);
        hi = std::max(hi, p[static_cast<size_t>(k)]);
      }
      ASSERT_EQ((*box)[0][k], lo);
      ASSERT_EQ((*box)[1][k], hi);
    }
    const PieceStore& store = *v.pieces->store;
    v.pieces->tree.each([](const PieceBox&) { return true; },
                        [&](uint32_t p) {
                          groups_ += store.is_group(p);
                          expanded_groups_ += store.is_group(p) && store.parts(p).were_made();
                        });
  }

  test::Random random_;
  test::TreeMaker maker_;
  std::vector<Operand> unused_;
  EvaluateStats stats_;
  int starts_ = 0, steps_ = 0;
  size_t groups_ = 0, expanded_groups_ = 0, named_ = 0, flipped_ = 0;
};

TEST(PieceChains, OfTouchingLeaves) {
  Chains chains(521);
  for (int i = 0; i < 25; ++i) {
    ASSERT_NO_FATAL_FAILURE(chains.run({.size = 4, .operands = 7, .known = i % 2 == 0}, 4))
        << "chain " << i;
  }
  EXPECT_GT(chains.steps(), 40);
}

TEST(PieceChains, OfTurnedLeaves) {
  Chains chains(522);
  for (int i = 0; i < 15; ++i) {
    ASSERT_NO_FATAL_FAILURE(
        chains.run({.size = 6, .operands = 6, .frames = true, .known = i % 2 == 0}, 3))
        << "chain " << i;
  }
  EXPECT_GT(chains.steps(), 20);
}

TEST(PieceChains, OfCrossingLeaves) {
  Chains chains(523);
  for (int i = 0; i < 25; ++i) {
    ASSERT_NO_FATAL_FAILURE(chains.run({.size = 1000, .operands = 7, .known = i % 2 == 0}, 4))
        << "chain " << i;
  }
  EXPECT_GT(chains.steps(), 40);
}

TEST(PieceChains, ThatAreTakenAway) {
  Chains chains(525);
  for (int i = 0; i < 30; ++i) {
    const int64_t size = i % 3 ? 5 : 1000;
    ASSERT_NO_FATAL_FAILURE(chains.run(
        {.size = size, .operands = 8, .frames = i % 5 == 0, .known = i % 2 == 0}, 5, true))
        << "chain " << i;
  }
  EXPECT_GT(chains.steps(), 60);
}

/// A convex body of so many corners or somewhat fewer, near a sphere.
Operand round_body(test::Random& random, const IVec3& middle, double radius, int corners) {
  std::vector<IVec3> points;
  while (static_cast<int>(points.size()) < corners) {
    const double z = static_cast<double>(random.integer(-1000, 1000)) / 1000,
                 turn = static_cast<double>(random.integer(0, 999)) * 2 * M_PI / 1000,
                 across = std::sqrt(1 - z * z) * radius;
    points.push_back({std::lround(across * std::cos(turn)), std::lround(across * std::sin(turn)),
                      std::lround(z * radius)});
  }
  Operand body = test::convex_operand(test::hull_loops(points));
  body.translation = middle;
  return body;
}

/// The vertex that is furthest along a direction, moved as the operand is.
IVec3 furthest(const Operand& o, const IVec3& direction) {
  const IVec3 v = *std::max_element(
      o.leaf->vertices.begin(), o.leaf->vertices.end(), [&](const IVec3& a, const IVec3& b) {
        return test::dot_of(a, direction) < test::dot_of(b, direction);
      });
  return {v[0] + o.translation[0], v[1] + o.translation[1], v[2] + o.translation[2]};
}

// Faces that nothing met are in groups, until an operation comes near; also where they are so far
// from the first vertex that sums need more bits, of leaves in a frame, and where another one
// touches a corner and no more.
TEST(PieceChains, OfLeavesOfManyFaces) {
  test::Random random(529);
  Chains chains(530);
  for (int i = 0; i < 24; ++i) {
    const int64_t apart = i % 4 == 3 ? 1 << 29 : 0;
    std::vector<Operand> bodies;
    for (uint32_t o = 0; o < 7; ++o) {
      const IVec3 middle{random.integer(-160, 160) + apart * (o % 3), random.integer(-160, 160),
                         random.integer(-60, 60)};
      bodies.push_back(round_body(random, middle, 60 + static_cast<double>(random.integer(0, 90)),
                                  static_cast<int>(random.integer(8, 60))));
      bodies.back().first_source = o;
      if (o > 0 && random.integer(0, 2) == 0) {
        const Operand& before = bodies[static_cast<size_t>(random.integer(0, o - 1))];
        const IVec3 way{random.integer(-9, 9), random.integer(-9, 9), random.integer(-9, 9)};
        const IVec3 to = furthest(before, way),
                    from = furthest(bodies.back(), {-way[0], -way[1], -way[2]});
        for (size_t k = 0; k < 3; ++k) bodies.back().translation[k] += to[k] - from[k];
      }
      if (i % 5 == 4 && o % 3 == 1) bodies.back().frame = test::random_frame(random);
    }
    ASSERT_NO_FATAL_FAILURE(chains.run_with(bodies, test::region_of(bodies), 6, i % 2 == 1))
        << "chain " << i;
  }
  EXPECT_GT(chains.steps(), 60);
  EXPECT_GT(chains.groups(), 300u);
  EXPECT_GT(chains.expanded_groups(), 100u);
}

// Meshes whose facets are their triangles, many of them in one plane: also what is turned over, and
// both sides of one leaf, of a symmetric difference.
TEST(PieceChains, OfMeshesOfFacets) {
  constexpr int64_t kSize = 1 << 12;
  test::Random random(531);
  Chains chains(532);
  for (int i = 0; i < 16; ++i) {
    std::vector<Operand> meshes;
    for (uint32_t o = 0; o < 5; ++o) {
      const auto leaf = test::leaf_of_triangles(
          random.integer(0, 1) ? test::bumpy_torus(random, {0, 0, 0}, kSize)
                               : test::tiled_box(random, {-kSize, -kSize, -kSize}, 6, kSize / 3));
      meshes.push_back(test::operand_of(leaf));
      for (int64_t& t : meshes.back().translation) t = random.integer(-kSize, kSize);
      meshes.back().first_source = o;
      if (random.integer(0, 2) == 0) meshes.back().appearance = 3;
      if (i % 4 == 3 && o % 2 == 0) meshes.back().frame = test::random_frame(random);
    }
    ASSERT_NO_FATAL_FAILURE(chains.run_with(meshes, test::region_of(meshes), 3, i % 2 == 1))
        << "chain " << i;
  }
  EXPECT_GT(chains.steps(), 30);
  EXPECT_GT(chains.named(), 1000u);
  EXPECT_GT(chains.flipped(), 300u);
}

}  // namespace
}  // namespace csgrun::piece_chains_test
