// What a job gives is put into a store as convex pieces and regions; where it does not close up, it
// is refused.
#include "engine/bsp/piece_writer.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <gtest/gtest.h>

#include "engine/bsp/evaluate_job.h"
#include "engine/bsp/grid_planes.h"
#include "engine/bsp/region_parts.h"
#include "tests/support/kernel_case.h"
#include "tests/support/piece_planes.h"
#include "tests/support/random_solids.h"

namespace csgrun::piece_writer_test {
namespace {

/// Two boxes that cross, and a store for what is left of them.
struct Written {
  std::vector<Operand> operands{test::operand_of(test::box_leaf({0, 0, 0}, {4, 4, 4})),
                                test::operand_of(test::box_leaf({2, 2, 2}, {6, 7, 8}))};
  PieceStore store;
  Job job{operands, &store.planes};
  EvaluatedJob made;
  PieceWriter writer{job, operands, store};

  Written() {
    EvaluateStats stats;
    made = *evaluate_job(job, operands, test::flat_expression(BooleanOp::kDifference, 2),
                         test::region_of(operands), {}, stats);
    EXPECT_TRUE(writer.add_operands());
  }
  /// The set that has pieces.
  FragmentSet& cut() {
    return *std::find_if(made.sets.begin(), made.sets.end(),
                         [](const FragmentSet& s) { return !s.pieces.empty(); });
  }
};

TEST(PieceWriter, MakesPiecesAndRegions) {
  Written written;
  written.writer.add_whole(written.made.whole);
  EXPECT_EQ(written.writer.added.size(), 3u);
  ASSERT_TRUE(written.writer.add_cut(written.made.sets));
  // Three sides with a corner cut out, and three of the notch.
  ASSERT_EQ(written.writer.added.size(), 3u + 3u + 3u);
  RegionParts parts(written.store, [&](int axis, int64_t m) { return written.job.wall(axis, m); });
  for (const uint32_t p : written.writer.added) {
    const PieceStore::Piece piece = written.store.piece(p);
    EXPECT_EQ(piece.is_whole, p < 3);
    EXPECT_EQ(piece.operand, p < 6 ? 0u : 1u);
    EXPECT_EQ(written.store.is_region(p), p >= 3 && p < 6);
    EXPECT_EQ(piece.count, written.store.is_region(p) ? 6u : 4u);
    if (!written.store.is_region(p)) continue;
    const auto [begin, count] = parts.of(p);
    EXPECT_EQ(count, 2u);
    EXPECT_EQ(parts.of(p).first, begin);
    PieceBox box;
    for (uint32_t part = begin; part < begin + count; ++part) {
      EXPECT_EQ(written.store.piece(part).count, 4u);
      EXPECT_EQ(written.store.piece(part).operand, piece.operand);
      EXPECT_EQ(written.store.piece(part).face, piece.face);
      EXPECT_EQ(written.store.piece(part).support, piece.support);
      EXPECT_FALSE(written.store.is_region(part));
      box.add(written.store.box(part));
    }
    EXPECT_EQ(box.lo, written.store.box(p).lo);
    EXPECT_EQ(box.hi, written.store.box(p).hi);
  }
}

Plane support_of_face(const Operand& o, uint32_t face, bool flip) {
  const LeafGeometry& leaf = *o.leaf;
  const uint32_t first = leaf.face_starts[face];
  std::array<IVec3, 3> at{};
  for (uint32_t i = 0; i < 3; ++i) {
    at[i] = leaf.vertices[leaf.corners[first + i]];
    for (size_t k = 0; k < 3; ++k) at[i][k] += o.translation[k];
  }
  if (flip) std::swap(at[1], at[2]);
  return plane_through(at[0], at[1], at[2]);
}

/// A body with more sides than a group has, and what it is taken from or added to.
std::vector<Operand> disc_and_box(int sides, const IVec3& disc_at) {
  std::vector<IVec3> corners;
  for (int i = 0; i < sides; ++i) {
    const double turn = i * 2 * M_PI / sides;
    for (const int64_t z : {0, 40}) {
      corners.push_back({std::lround(900 * std::cos(turn)), std::lround(900 * std::sin(turn)), z});
    }
  }
  std::vector<Operand> operands{test::operand_of(test::box_leaf({-999, -999, -99}, {999, 999, 99})),
                                test::operand_of(test::make_leaf(test::hull_loops(corners)))};
  operands[1].translation = disc_at;
  return operands;
}

// Faces that nothing met, in few groups of faces that are near one another: each in one, turned as
// the operation turns it. Their parts are the faces, whole.
TEST(PieceWriter, GroupsWhatNothingMet) {
  for (const auto op : {BooleanOp::kDifference, BooleanOp::kUnion}) {
    const bool is_flipped = op == BooleanOp::kDifference;
    const std::vector<Operand> operands =
        disc_and_box(90, is_flipped ? IVec3{0, 0, 0} : IVec3{0, 0, 500});
    const LeafGeometry& disc = *operands[1].leaf;
    ASSERT_EQ(disc.face_count(), 92u);
    PieceStore store;
    Job job(operands, &store.planes);
    PieceWriter writer(job, operands, store);
    ASSERT_TRUE(writer.add_operands());
    EvaluateStats stats;
    const auto made = evaluate_job(job, operands, test::flat_expression(op, 2),
                                   test::region_of(operands), {}, stats);
    ASSERT_TRUE(made);
    writer.add_whole(made->whole);
    std::vector<uint32_t> faces;
    size_t singles = 0;
    for (const uint32_t p : writer.added) {
      const PieceStore::Piece group = store.piece(p);
      if (!store.is_group(p)) {
        // A box has too few faces, and so may an octant.
        EXPECT_TRUE(group.is_whole);
        if (group.operand == 1) faces.push_back(group.face);
        singles += group.operand == 0;
        continue;
      }
      EXPECT_EQ(group.operand, 1u);
      EXPECT_EQ(group.is_flipped, is_flipped);
      EXPECT_LE(store.group_faces(p).size(), 64u);
      EXPECT_FALSE(store.parts(p).were_made());
      const std::vector<uint32_t> own(store.group_faces(p).begin(), store.group_faces(p).end());
      const size_t before = store.piece_count();
      const PieceStore::Parts parts = store.group_parts(p);
      EXPECT_EQ(store.group_parts(p).first, parts.first);
      ASSERT_EQ(parts.count, own.size());
      EXPECT_EQ(store.piece_count(), before + own.size());
      PieceBox box;
      size_t next = 0;
      store.each_face(p, [&](std::span<const uint32_t> corners) {
        const auto part = static_cast<uint32_t>(parts.first + next);
        EXPECT_EQ(store.piece(part).face, own[next]);
        EXPECT_TRUE(store.piece(part).is_whole && !store.is_group(part));
        const auto stored = store.corners(part);
        EXPECT_TRUE(std::equal(corners.begin(), corners.end(), stored.begin(), stored.end()));
        // The loop of the leaf, or the same run backwards.
        const uint32_t begin = disc.face_starts[own[next]],
                       n = disc.face_starts[own[next] + 1] - begin;
        ASSERT_EQ(corners.size(), n);
        for (uint32_t i = 0; i < n; ++i) {
          const uint32_t vertex = disc.corners[begin + (is_flipped ? n - 1 - i : i)];
          EXPECT_EQ(corners[i], store.first_point(1) + vertex);
        }
        EXPECT_EQ(test::support_of(store, part),
                  store.planes.intern(support_of_face(operands[1], own[next], is_flipped)));
        box.add(store.box(part));
        ++next;
      });
      EXPECT_EQ(box.lo, store.box(p).lo);
      EXPECT_EQ(box.hi, store.box(p).hi);
      faces.insert(faces.end(), own.begin(), own.end());
    }
    EXPECT_EQ(singles, 6u);
    std::sort(faces.begin(), faces.end());
    ASSERT_EQ(faces.size(), 92u);
    for (uint32_t f = 0; f < 92; ++f) EXPECT_EQ(faces[f], f);
    EXPECT_LE(writer.added.size(), 6u + 8u);
  }
}

// All of a fan that begins at one point.
TEST(PieceWriter, GroupsWhatBeginsAtOnePoint) {
  std::vector<IVec3> corners{{0, 0, 700}};
  for (int i = 0; i < 150; ++i) {
    const double turn = i * 2 * M_PI / 150;
    corners.push_back({std::lround(2000 * std::cos(turn)), std::lround(2000 * std::sin(turn)), 0});
  }
  std::vector<test::Loop> loops = test::hull_loops(corners);
  size_t sides = 0;
  for (test::Loop& loop : loops) {
    const auto top = std::find(loop.begin(), loop.end(), corners[0]);
    sides += top != loop.end();
    std::rotate(loop.begin(), top == loop.end() ? loop.begin() : top, loop.end());
  }
  ASSERT_GT(sides, 2 * 64u);
  std::vector<Operand> operands{test::operand_of(test::make_leaf(loops)),
                                test::operand_of(test::box_leaf({0, 0, 900}, {9, 9, 950}))};
  PieceStore store;
  Job job(operands, &store.planes);
  PieceWriter writer(job, operands, store);
  ASSERT_TRUE(writer.add_operands());
  std::vector<WholePolygon> whole;
  for (uint32_t p = job.polygon_start(0); p < job.polygon_start(1); ++p)
    whole.push_back({p, false});
  writer.add_whole(whole);
  size_t grouped = 0;
  for (const uint32_t p : writer.added)
    grouped += store.is_group(p) ? store.group_faces(p).size() : 1;
  EXPECT_EQ(grouped, loops.size());
  EXPECT_LE(writer.added.size(), 12u);
}

TEST(PieceWriter, RefusesPiecesThatDoNotCloseUp) {
  Written written;
  written.cut().pieces.push_back(written.cut().pieces.front());
  EXPECT_FALSE(written.writer.add_cut(written.made.sets));
}

}  // namespace
}  // namespace csgrun::piece_writer_test
