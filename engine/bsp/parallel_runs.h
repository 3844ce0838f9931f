// Cells in parallel: handed out in fixed runs, so that what a run gives does not depend on the
// threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>

#include "engine/base/parallel.h"
#include "engine/base/per_thread.h"
#include "engine/bsp/operand.h"

namespace csgrun {

constexpr size_t kCellsPerRun = 64;

/// The number of runs for so many cells.
constexpr size_t run_count(size_t cells) { return (cells + kCellsPerRun - 1) / kCellsPerRun; }

/// Calls `work(solver, run)` for each run, in any order, with solvers made by `make`, one a thread.
/// Runs that have not begun when the evaluation is cancelled are left out. Progress is told by the
/// calling thread.
template <class Make, class Work>
void for_each_run(size_t runs, const KernelOptions& options, Make&& make, Work&& work) {
  const auto cancelled = [&] {
    return options.cancel && options.cancel->load(std::memory_order_relaxed);
  };
  if (runs == 0) return;
  if (options.threads <= 1 || runs <= 1) {
    auto solver = make();
    for (size_t run = 0; run < runs && !cancelled(); ++run) {
      work(solver, run);
      if (options.progress) options.progress(run + 1, runs);
    }
    return;
  }
  const auto caller = std::this_thread::get_id();
  std::atomic<size_t> done = 0;
  with_threads(options.threads, [&] {
    PerThread solvers([&] { return make(); });
    for_each_alone(runs, true, [&](size_t run) {
      if (cancelled()) return;
      work(solvers.local(), run);
      const size_t now = done.fetch_add(1, std::memory_order_relaxed) + 1;
      if (options.progress && std::this_thread::get_id() == caller) options.progress(now, runs);
    });
  });
  if (options.progress && !cancelled()) options.progress(runs, runs);
}

}  // namespace csgrun
