// What is put together must close up: where it does not, a fault of ours is told, and nothing made.
#include "engine/bsp/assemble.h"

#include <gtest/gtest.h>

#include "engine/bsp/evaluate_job.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun::assemble_test {
namespace {

/// Two boxes that cross, cut, and one beside them.
struct Parts {
  static std::vector<Operand> boxes() {
    std::vector<Operand> operands{
        test::operand_of(test::box_leaf({0, 0, 0}, {4, 4, 4})),
        test::operand_of(test::box_leaf({2, 2, 2}, {6, 7, 8})),
        test::operand_of(test::make_leaf(test::box_with_middle({5, 0, 0}, {6, 1, 2})))};
    for (uint32_t o = 0; o < 3; ++o) operands[o].first_source = o;
    return operands;
  }
  std::vector<Operand> operands = boxes();
  Job job{operands};
  EvaluatedJob made;

  Parts() {
    EvaluateStats stats;
    made = *evaluate_job(job, operands, test::flat_expression(BooleanOp::kUnion, 3),
                         test::region_of(operands), {}, stats);
  }
  Result<std::shared_ptr<const BoundaryMesh>> assembled(std::vector<UntouchedPart> parts = {}) {
    return assemble(job, made.sets, made.whole, made.touching, std::move(parts));
  }
  uint32_t vertex_at(const std::array<double, 3>& at) const {
    for (uint32_t v = 0; v < job.vertex_count(); ++v) {
      if (job.rounded(v) == at) return v;
    }
    return kNone;
  }
  /// The set that has pieces.
  FragmentSet& cut() {
    return *std::find_if(made.sets.begin(), made.sets.end(),
                         [](const FragmentSet& s) { return !s.pieces.empty(); });
  }
};

TEST(Assemble, MakesWhatTheKernelMakes) {
  Parts parts;
  EvaluateStats stats;
  const auto once = evaluate_boolean(parts.operands, test::flat_expression(BooleanOp::kUnion, 3),
                                     test::region_of(parts.operands), {}, stats);
  const auto made = parts.assembled();
  ASSERT_TRUE(once && made);
  EXPECT_EQ(test::first_difference(**made, **once), "");
  EXPECT_EQ((*made)->faces.size(), 18u);
}

TEST(Assemble, RefusesPiecesThatDoNotCloseUp) {
  const auto is_refused = [](const auto& spoil) {
    Parts parts;
    EXPECT_GT(parts.cut().pieces.size(), 3u);
    spoil(parts);
    const auto made = parts.assembled();
    EXPECT_TRUE(made || made.error().code == ErrorCode::kInternal);
    return !made;
  };
  EXPECT_FALSE(is_refused([](Parts&) {}));
  EXPECT_TRUE(is_refused([](Parts& p) { p.cut().pieces.push_back(p.cut().pieces.front()); }));
  EXPECT_TRUE(is_refused([](Parts& p) { p.made.whole.push_back(p.made.whole.front()); }));
}

// What an untouched part shares with other faces is named by their point; it must be a corner
// there.
TEST(Assemble, NamesTheCornersThatUntouchedPartsShare) {
  Parts parts;
  const auto shared = [&](uint32_t vertex) {
    std::vector<UntouchedPart> untouched(1);
    untouched[0].shared.push_back({7, vertex});
    return parts.assembled(untouched);
  };
  const std::vector<std::array<double, 3>> corners{{0, 0, 0}, {4, 0, 4}, {6, 7, 8}, {6, 1, 2}};
  for (const auto& corner : corners) {
    ASSERT_NE(parts.vertex_at(corner), kNone);
    const auto made = shared(parts.vertex_at(corner));
    ASSERT_TRUE(made);
    ASSERT_EQ((*made)->parts.size(), 1u);
    const UntouchedPart::Shared& named = (*made)->parts[0].shared[0];
    EXPECT_EQ(named.vertex, 7u);
    EXPECT_EQ((*made)->point_rounded[named.point], corner);
  }
  // Inside of another box, between two corners, and none of the job's.
  ASSERT_NE(parts.vertex_at({4, 4, 4}), kNone);
  ASSERT_NE(parts.vertex_at({5, 0, 1}), kNone);
  const auto count = static_cast<uint32_t>(parts.job.vertex_count());
  for (const uint32_t v :
       {parts.vertex_at({4, 4, 4}), parts.vertex_at({5, 0, 1}), count, count + 100}) {
    const auto made = shared(v);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::kInternal);
  }
}

}  // namespace
}  // namespace csgrun::assemble_test
