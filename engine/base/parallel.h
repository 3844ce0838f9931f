// Loops on several threads. What they do is divided by sizes alone, never by the number of threads,
// so that results put together in the order of the parts are the same for any number.
//
// The threads' library is not begun before a loop has work for it: that takes longer (half a
// millisecond where pages are slow) than most small models.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

namespace csgrun {

/// Below so many things of a few nanoseconds each threads do not pay.
constexpr size_t kFewForThreads = 8192;

/// A stretch of this thread's work for which so many threads are wanted. It enters their arena for
/// the loops alone.
class ThreadsFrame {
 public:
  explicit ThreadsFrame(unsigned threads)
      : threads_(threads), outer_(std::exchange(current_, this)) {}
  ~ThreadsFrame() { current_ = outer_; }
  ThreadsFrame(const ThreadsFrame&) = delete;
  ThreadsFrame& operator=(const ThreadsFrame&) = delete;

  /// That of this thread; null in an arena, and where nobody asked for a number of threads.
  static ThreadsFrame* current() { return current_; }
  [[nodiscard]] unsigned threads() const { return threads_; }

  template <class Work>
  void execute(Work&& work) {
    if (!arena_) {
      // Without the control, more threads than cores would be cut down, with a message.
      allow_.emplace(tbb::global_control::max_allowed_parallelism, threads_);
      arena_.emplace(static_cast<int>(threads_));
    }
    const InArena in_arena;
    arena_->execute(std::forward<Work>(work));
  }

 private:
  struct InArena {
    ThreadsFrame* frame = std::exchange(current_, nullptr);
    ~InArena() { current_ = frame; }
  };

  static inline constinit thread_local ThreadsFrame* current_ = nullptr;
  unsigned threads_;
  ThreadsFrame* outer_;
  std::optional<tbb::global_control> allow_;
  std::optional<tbb::task_arena> arena_;
};

/// How many threads the loops below use here.
inline unsigned threads_here() {
  const ThreadsFrame* frame = ThreadsFrame::current();
  return frame ? frame->threads() : static_cast<unsigned>(tbb::this_task_arena::max_concurrency());
}

/// Returns work(), in which the loops below use so many threads.
template <class Work>
auto with_threads(unsigned threads, Work&& work) {
  const bool is_begun =
      ThreadsFrame::current() != nullptr ||
      tbb::this_task_arena::current_thread_index() != tbb::task_arena::not_initialized;
  if (is_begun && threads_here() == threads) return work();
  ThreadsFrame frame(threads);  // loops within change it
  return work();
}

/// Calls work(), a loop of the threads' library, where it uses threads_here().
template <class Work>
void on_threads(Work&& work) {
  if (ThreadsFrame* frame = ThreadsFrame::current()) {
    frame->execute(std::forward<Work>(work));
  } else {
    work();
  }
}

/// The number of parts of so many things in each that all are divided into.
constexpr size_t part_count(size_t count, size_t each) { return (count + each - 1) / each; }

/// Calls work(part, begin, end) for the parts of [0, count), in any order and at the same time.
template <class Work>
void for_each_part(size_t count, size_t each, Work&& work) {
  const auto one = [&](size_t part) {
    work(part, part * each, std::min(count, (part + 1) * each));
  };
  const size_t parts = part_count(count, each);
  if (parts <= 1 || threads_here() == 1) {
    for (size_t part = 0; part < parts; ++part) one(part);
  } else {
    on_threads([&] { tbb::parallel_for(size_t{0}, parts, one); });
  }
}

/// Calls work(begin, end) for ranges that make up [0, count), in any order and at the same time.
template <class Work>
void for_each_range(size_t count, Work&& work) {
  for_each_part(count, kFewForThreads, [&](size_t, size_t begin, size_t end) { work(begin, end); });
}

/// Where parts of [0, count) begin that weigh `most` at most, and at last count: part i is
/// [starts[i], starts[i + 1]). What weighs more than that by itself is a part. O(count).
template <class Weight>
std::vector<size_t> part_starts(size_t count, size_t most, Weight&& weight) {
  std::vector<size_t> starts;
  size_t sum = 0;
  for (size_t i = 0; i < count; ++i) {
    const size_t own = weight(i);
    if (i == 0 || sum + own > most) starts.push_back(i), sum = 0;
    sum += own;
  }
  starts.push_back(count);
  return starts;
}

/// Calls work(i) for i below count, at the same time if all of it is `much`: each i by itself.
template <class Work>
void for_each_alone(size_t count, bool much, Work&& work) {
  if (!much) {
    for (size_t i = 0; i < count; ++i) work(i);
    return;
  }
  for_each_part(count, 1, [&](size_t, size_t i, size_t) { work(i); });
}

/// Calls list(begin, end, out) for the parts of [0, count), at the same time, and returns what they
/// append to `out`, in the order of the parts.
template <class T, class List>
std::vector<T> list_in_parts(size_t count, size_t each, List&& list) {
  if (count <= each) {
    std::vector<T> all;
    list(size_t{0}, count, all);
    return all;
  }
  std::vector<std::vector<T>> parts(part_count(count, each));
  for_each_part(count, each, [&](size_t part, size_t begin, size_t end) {
    std::vector<T> own;  // not beside those of other threads while it grows
    list(begin, end, own);
    parts[part] = std::move(own);
  });
  std::vector<T> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// The numbers below count for which `is_wanted` says so, ascending; it is asked on several
/// threads.
template <class Wanted>
std::vector<uint32_t> numbers_where(size_t count, Wanted&& is_wanted) {
  return list_in_parts<uint32_t>(count, kFewForThreads, [&](size_t begin, size_t end, auto& out) {
    for (auto i = static_cast<uint32_t>(begin); i < end; ++i) {
      if (is_wanted(i)) out.push_back(i);
    }
  });
}

/// Calls both, at the same time if they are `much`: neither may look at what the other changes.
template <class First, class Second>
void run_both(bool much, First&& first, Second&& second) {
  if (!much || threads_here() == 1) {
    first();
    second();
  } else {
    on_threads([&] { tbb::parallel_invoke(first, second); });
  }
}

}  // namespace csgrun
