// Runs of cells: all of them, once each, in order where one thread works; none after a
// cancellation.
#include "engine/bsp/parallel_runs.h"

#include <mutex>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "engine/bsp/kernel.h"
#include "engine/bsp/union_find.h"
#include "tests/support/random_trees.h"

namespace csgrun::parallel_runs_test {
namespace {

struct Done {
  std::vector<size_t> runs;
  std::vector<std::pair<uint64_t, uint64_t>> progress;
  size_t solvers = 0;
};

Done run_all(size_t runs, unsigned threads, std::atomic<bool>* cancel = nullptr,
             size_t cancel_in = SIZE_MAX) {
  Done done;
  std::mutex lock;
  KernelOptions options;
  options.threads = threads;
  options.cancel = cancel;
  options.progress = [&](uint64_t at, uint64_t of) { done.progress.emplace_back(at, of); };
  const auto make = [&] {
    const std::lock_guard guard(lock);
    return ++done.solvers;
  };
  for_each_run(runs, options, make, [&](size_t, size_t run) {
    const std::lock_guard guard(lock);
    done.runs.push_back(run);
    if (run == cancel_in) *cancel = true;
  });
  return done;
}

TEST(ParallelRuns, HoldSixtyFourCellsEach) {
  volatile size_t cells = 0;  // not folded by the compiler
  for (const auto& [count, runs] :
       {std::pair<size_t, size_t>{0, 0}, {1, 1}, {63, 1}, {64, 1}, {65, 2}, {128, 2}, {129, 3}}) {
    cells = count;
    EXPECT_EQ(run_count(cells), runs);
  }
}

TEST(ParallelRuns, AreDoneOnceEach) {
  for (const unsigned threads : {0u, 1u, 2u, 4u}) {
    for (const size_t runs : {size_t{0}, size_t{1}, size_t{2}, size_t{100}}) {
      const Done done = run_all(runs, threads);
      std::vector<size_t> all(runs);
      std::iota(all.begin(), all.end(), size_t{0});
      auto sorted = done.runs;
      std::sort(sorted.begin(), sorted.end());
      EXPECT_EQ(sorted, all);
      if (threads > 1 && runs > 1) {
        EXPECT_LE(done.solvers, threads);
        // What the calling thread saw, and that all is done.
        ASSERT_FALSE(done.progress.empty());
        EXPECT_EQ(done.progress.back(), std::pair(runs, runs));
        EXPECT_TRUE(std::is_sorted(done.progress.begin(), done.progress.end()));
        for (const auto& [at, of] : done.progress) EXPECT_EQ(of, runs);
        continue;
      }
      EXPECT_EQ(done.runs, all);
      EXPECT_EQ(done.solvers, runs ? 1u : 0u);
      ASSERT_EQ(done.progress.size(), runs);
      for (size_t i = 0; i < runs; ++i) EXPECT_EQ(done.progress[i], std::pair(i + 1, runs));
    }
  }
}

TEST(ParallelRuns, StopWhenTheEvaluationIsCancelled) {
  std::atomic<bool> cancel = false;
  EXPECT_EQ(run_all(10, 1, &cancel, 3).runs, (std::vector<size_t>{0, 1, 2, 3}));
  for (const unsigned threads : {1u, 4u}) EXPECT_TRUE(run_all(10, threads, &cancel).runs.empty());
  cancel = false;
  EXPECT_EQ(run_all(10, 4, &cancel).runs.size(), 10u);
}

TEST(Kernel, IsCancelledBeforeAndBetweenRuns) {
  test::Random random(84);
  test::TreeMaker maker(random);
  test::RandomTree tree;
  EvaluateStats stats;
  for (uint64_t cells = 0; cells < 200;) {
    tree = maker.make({.size = 9, .operands = 9, .depth = 3});
    KernelOptions options;
    options.whole_faces = false;
    options.cell_limit = 2;
    stats = {};
    ASSERT_TRUE(evaluate_boolean(tree.operands, tree.expression, tree.region, options, stats));
    cells = stats.solved_cells;
  }
  std::atomic<bool> cancel = true;
  KernelOptions options;
  options.whole_faces = false;
  options.cell_limit = 2;
  options.cancel = &cancel;
  size_t calls = 0;
  options.progress = [&](uint64_t, uint64_t) { ++calls; };
  const auto code = [&] {
    stats = {};
    const auto r = evaluate_boolean(tree.operands, tree.expression, tree.region, options, stats);
    return r ? std::optional<ErrorCode>() : r.error().code;
  };
  EXPECT_EQ(code(), ErrorCode::kCancelled);
  EXPECT_EQ(calls, 0u);
  cancel = false;
  EXPECT_EQ(code(), std::nullopt);
  EXPECT_GE(calls, 4u);
  calls = 0;
  options.progress = [&](uint64_t, uint64_t) { cancel = ++calls == 2; };
  EXPECT_EQ(code(), ErrorCode::kCancelled);
  EXPECT_EQ(calls, 2u);
}

TEST(UnionFind, JoinsSetsUnderTheirSmallestMember) {
  test::Random random(85);
  for (int round = 0; round < 50; ++round) {
    constexpr uint32_t kCount = 40;
    UnionFind sets(kCount);
    ASSERT_EQ(sets.size(), kCount);
    std::vector<uint32_t> smallest(kCount);
    std::iota(smallest.begin(), smallest.end(), 0u);
    for (int i = 0; i < 30; ++i) {
      const auto a = static_cast<uint32_t>(random.integer(0, kCount - 1)),
                 b = static_cast<uint32_t>(random.integer(0, kCount - 1));
      sets.join(a, b);
      const uint32_t old = std::max(smallest[a], smallest[b]),
                     now = std::min(smallest[a], smallest[b]);
      std::replace(smallest.begin(), smallest.end(), old, now);
      for (uint32_t k = 0; k < kCount; ++k) ASSERT_EQ(sets.find(k), smallest[k]);
    }
  }
}

}  // namespace
}  // namespace csgrun::parallel_runs_test
