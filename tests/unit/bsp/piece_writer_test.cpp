// What a job gives is put into a store as convex pieces; where it does not close up, it is refused.
#include "engine/bsp/piece_writer.h"

#include <gtest/gtest.h>

#include "engine/bsp/evaluate_job.h"
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

TEST(PieceWriter, MakesConvexPieces) {
  Written written;
  for (const WholePolygon& w : written.made.whole) written.writer.add_whole(w);
  EXPECT_EQ(written.writer.added.size(), 3u);
  ASSERT_TRUE(written.writer.add_cut(written.made.sets));
  // Three sides with a corner cut out, which are two pieces each, and three of the notch.
  EXPECT_EQ(written.writer.added.size(), 3u + 6u + 3u);
  for (const uint32_t p : written.writer.added) {
    const PieceStore::Piece& piece = written.store.piece(p);
    EXPECT_EQ(piece.count, 4u);
    EXPECT_EQ(piece.is_whole, p < 3);
    EXPECT_EQ(piece.operand, p < 9 ? 0u : 1u);
  }
}

TEST(PieceWriter, RefusesPiecesThatDoNotCloseUp) {
  Written written;
  written.cut().pieces.push_back(written.cut().pieces.front());
  EXPECT_FALSE(written.writer.add_cut(written.made.sets));
}

}  // namespace
}  // namespace csgrun
