// What a job gives is put into a store as convex pieces and regions; where it does not close up, it
// is refused.
#include "engine/bsp/piece_writer.h"

#include <gtest/gtest.h>

#include "engine/bsp/evaluate_job.h"
#include "engine/bsp/region_parts.h"
#include "tests/support/kernel_case.h"

namespace csgrun {
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
  for (const WholePolygon& w : written.made.whole) written.writer.add_whole(w);
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
    const auto [begin, end] = parts.of(p);
    EXPECT_EQ(end - begin, 2u);
    EXPECT_EQ(parts.of(p), std::pair(begin, end));
    PieceBox box;
    for (uint32_t part = begin; part < end; ++part) {
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

TEST(PieceWriter, RefusesPiecesThatDoNotCloseUp) {
  Written written;
  written.cut().pieces.push_back(written.cut().pieces.front());
  EXPECT_FALSE(written.writer.add_cut(written.made.sets));
}

}  // namespace
}  // namespace csgrun
