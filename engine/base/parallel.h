// Loops on several threads. What they do is divided by sizes alone, never by the number of threads,
// so that results put together in the order of the parts are the same for any number.
//
// The threads' library is not begun before there is work that is worth it: to begin takes it three
// milliseconds on some machines, and its threads keep a core busy while they wait for more. Its
// headers take longer to read than most files of the engine: those of loops are in parallel.cpp.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/base/function_ref.h"

namespace csgrun {

/// Below so many things of a few nanoseconds each threads do not pay.
constexpr size_t kFewForThreads = 8192;
/// With so many faces an operation is worth threads from its start.
constexpr size_t kManyForThreads = 200'000;

/// A stretch of this thread's work for which so many threads are wanted. It enters their arena for
/// the loops alone, and only once it has gone on for a while, or much is expected of it: short ones
/// end sooner alone.
class ThreadsFrame {
 public:
  explicit ThreadsFrame(unsigned threads);
  ~ThreadsFrame();
  ThreadsFrame(const ThreadsFrame&) = delete;
  ThreadsFrame& operator=(const ThreadsFrame&) = delete;

  /// How long frames of this process go on alone; an eighth of that once any has begun threads, as
  /// the first time takes longest. Zero: loops have threads from their start.
  static void set_alone_time(std::chrono::nanoseconds time) { alone_time_ = time; }
  static std::chrono::nanoseconds alone_time() {
    return alone_time_.load(std::memory_order_relaxed);
  }

  /// That of this thread; null in an arena, and where nobody asked for a number of threads.
  static ThreadsFrame* current() { return current_; }
  /// Whether this thread is in a frame, or in an arena, one of somebody else's perhaps.
  static bool is_within() {
    return current_ != nullptr || is_in_arena_ || (!is_outside_ && is_known_to_library());
  }
  [[nodiscard]] unsigned threads() const { return threads_; }

  [[nodiscard]] bool has_begun() const { return arena_ != nullptr; }
  /// Some of the work is on so many faces.
  void expect(size_t faces) { is_much_ = is_much_ || faces >= kManyForThreads; }
  /// Whether it has gone on for long enough, or will.
  [[nodiscard]] bool is_worth_threads() const {
    constexpr int kShareLater = 8;
    const std::chrono::nanoseconds first = alone_time();
    return has_begun() || is_much_ ||
           Clock::now() - start_ >=
               (any_began_.load(std::memory_order_relaxed) ? first / kShareLater : first);
  }

  /// Calls work() in the frame's arena.
  void execute(FunctionRef<void()> work);

 private:
  using Clock = std::chrono::steady_clock;
  struct Arena;
  struct InArena;
  static bool is_known_to_library();

  static inline std::atomic<std::chrono::nanoseconds> alone_time_{std::chrono::milliseconds(50)};
  static inline std::atomic<bool> any_began_{false};
  static inline constinit thread_local ThreadsFrame* current_ = nullptr;
  static inline constinit thread_local bool is_in_arena_ = false;
  /// A thread that had a frame before the library knew it. (The library knows it ever after, in an
  /// arena of all cores.)
  static inline constinit thread_local bool is_outside_ = false;
  unsigned threads_;
  ThreadsFrame* outer_;
  const Clock::time_point start_ = Clock::now();
  bool is_much_ = false;
  std::unique_ptr<Arena> arena_;
};

/// How many threads the loops below may use here.
unsigned threads_here();

/// Whether a loop that begins now has several from the start. One that has not may have them later:
/// what it does must not depend on it.
inline bool has_threads() {
  const ThreadsFrame* frame = ThreadsFrame::current();
  return threads_here() > 1 && (!frame || frame->is_worth_threads());
}

/// What this thread does now is on so many faces.
inline void expect_faces(size_t faces) {
  if (ThreadsFrame* frame = ThreadsFrame::current()) frame->expect(faces);
}

/// Returns work(), in which the loops below use so many threads.
template <class Work>
auto with_threads(unsigned threads, Work&& work) {
  if (ThreadsFrame::is_within() && threads_here() == threads) return work();
  ThreadsFrame frame(threads);  // loops within change it
  return work();
}

/// Calls work(), a loop of the threads' library, where it uses threads_here().
void on_threads(FunctionRef<void()> work);

/// Calls one(i) for i from `begin` to `end`, in any order and at the same time.
void loop_on_threads(size_t begin, size_t end, FunctionRef<void(size_t)> one);

/// Calls one(i) for i from 0 on until several threads should do the rest, or `count` are done;
/// returns how many were. Of what is `tried` first so much must be left for them, by what it took
/// so far, that it takes half a millisecond: they do not come at once, and those that wait for more
/// may share a core with this one.
template <class One>
size_t do_alone(size_t count, bool is_tried, One&& one) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::microseconds kWorthIt(500);
  is_tried = is_tried && ThreadsFrame::alone_time().count() > 0;
  const Clock::time_point start = is_tried ? Clock::now() : Clock::time_point();
  size_t done = 0;
  const auto is_much_left = [&] {
    const size_t left = count - done;
    return left > 1 && (!is_tried || (done > 0 && (Clock::now() - start) / done * left > kWorthIt));
  };
  while (done < count && !(is_much_left() && has_threads())) one(done++);
  return done;
}

/// The number of parts of so many things in each that all are divided into.
constexpr size_t part_count(size_t count, size_t each) { return (count + each - 1) / each; }

/// Calls work(part, begin, end) for the parts of [0, count), in any order and at the same time.
template <class Work>
void for_each_part(size_t count, size_t each, Work&& work) {
  const auto one = [&](size_t part) {
    work(part, part * each, std::min(count, (part + 1) * each));
  };
  const size_t parts = part_count(count, each), done = do_alone(parts, each >= kFewForThreads, one);
  if (done < parts) loop_on_threads(done, parts, one);
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
  const auto one = [&](size_t i) { i == 0 ? first() : second(); };
  for_each_alone(2, much, one);
}

}  // namespace csgrun
