#include "engine/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace csgrun {

struct ThreadsFrame::Arena {
  explicit Arena(unsigned threads)
      : allow(tbb::global_control::max_allowed_parallelism, threads),
        arena(static_cast<int>(threads)) {}

  // Without the control, more threads than cores would be cut down, with a message.
  tbb::global_control allow;
  tbb::task_arena arena;
};

struct ThreadsFrame::InArena {
  ThreadsFrame* const frame = std::exchange(current_, nullptr);
  const bool was_in_arena = std::exchange(is_in_arena_, true);
  ~InArena() { current_ = frame, is_in_arena_ = was_in_arena; }
};

ThreadsFrame::ThreadsFrame(unsigned threads)
    : threads_(threads), outer_(std::exchange(current_, this)) {
  is_outside_ = is_outside_ || !is_known_to_library();
}

ThreadsFrame::~ThreadsFrame() { current_ = outer_; }

bool ThreadsFrame::is_known_to_library() {
  return tbb::this_task_arena::current_thread_index() != tbb::task_arena::not_initialized;
}

void ThreadsFrame::execute(FunctionRef<void()> work) {
  if (!arena_) {
    arena_ = std::make_unique<Arena>(threads_);
    any_began_.store(true, std::memory_order_relaxed);
  }
  const InArena in_arena;
  arena_->arena.execute(work);
}

unsigned threads_here() {
  const ThreadsFrame* frame = ThreadsFrame::current();
  return frame ? frame->threads() : static_cast<unsigned>(tbb::this_task_arena::max_concurrency());
}

void on_threads(FunctionRef<void()> work) {
  if (ThreadsFrame* frame = ThreadsFrame::current()) {
    frame->execute(work);
  } else {
    work();
  }
}

void loop_on_threads(size_t begin, size_t end, FunctionRef<void(size_t)> one) {
  on_threads([&] { tbb::parallel_for(begin, end, [&](size_t i) { one(i); }); });
}

}  // namespace csgrun
