// Loops on several threads: everything is done once, in parts that do not depend on the threads.
#include "engine/base/parallel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "engine/base/in_order.h"
#include "engine/base/parallel_sort.h"
#include "engine/base/per_thread.h"
#include "engine/base/raw_vector.h"

namespace csgrun::parallel_test {
namespace {

TEST(Parallel, PartsMakeUpEverything) {
  for (const unsigned threads : {1u, 2u, 4u}) {
    for (const size_t count : {0, 1, 6, 7, 8, 14, 100}) {
      std::vector<std::array<size_t, 2>> parts(part_count(count, 7));
      std::vector<std::atomic<int>> seen(count);
      with_threads(threads, [&] {
        for_each_part(count, 7, [&](size_t part, size_t begin, size_t end) {
          parts[part] = {begin, end};
          for (size_t i = begin; i < end; ++i) ++seen[i];
        });
      });
      EXPECT_EQ(parts.size(), (count + 6) / 7);
      for (size_t part = 0; part < parts.size(); ++part) {
        EXPECT_EQ(parts[part][0], 7 * part);
        EXPECT_EQ(parts[part][1], part + 1 < parts.size() ? 7 * part + 7 : count);
      }
      for (const auto& times : seen) EXPECT_EQ(times, 1);
    }
  }
}

TEST(Parallel, RangesAndSinglesMakeUpEverything) {
  for (const unsigned threads : {1u, 4u}) {
    for (const size_t count : {size_t{0}, kFewForThreads, kFewForThreads + 1, 5 * kFewForThreads}) {
      std::vector<uint8_t> seen(count, 0), alone(count, 0), few(count, 0);
      with_threads(threads, [&] {
        for_each_range(count, [&](size_t begin, size_t end) {
          for (size_t i = begin; i < end; ++i) ++seen[i];
        });
        for_each_alone(count, true, [&](size_t i) { ++alone[i]; });
        for_each_alone(count, false, [&](size_t i) { ++few[i]; });
      });
      const std::vector<uint8_t> once(count, 1);
      EXPECT_EQ(seen, once);
      EXPECT_EQ(alone, once);
      EXPECT_EQ(few, once);
    }
  }
}

// Every part is as long as its weight allows, and what is too heavy has one of its own.
TEST(Parallel, PartsAreOfOneWeight) {
  constexpr size_t kMost = 10;
  const std::vector<size_t> weights{3, 3, 4, 0, 1, 25, 0, 1, 9, 10, 11, 2, 0, 0, 8, 1};
  for (size_t count = 0; count <= weights.size(); ++count) {
    const auto starts = part_starts(count, kMost, [&](size_t i) { return weights[i]; });
    ASSERT_EQ(starts.back(), count);
    EXPECT_EQ(starts.size() == 1, count == 0);
    EXPECT_EQ(starts[0], 0);
    for (size_t part = 0; part + 1 < starts.size(); ++part) {
      ASSERT_LT(starts[part], starts[part + 1]);
      size_t sum = 0;
      for (size_t i = starts[part]; i < starts[part + 1]; ++i) sum += weights[i];
      EXPECT_TRUE(sum <= kMost || starts[part + 1] == starts[part] + 1);
      EXPECT_TRUE(starts[part + 1] == count || sum + weights[starts[part + 1]] > kMost);
    }
  }
  const auto all = part_starts(weights.size(), kMost, [&](size_t i) { return weights[i]; });
  EXPECT_EQ(all, (std::vector<size_t>{0, 4, 5, 6, 9, 10, 11, 15, 16}));
}

TEST(Parallel, WhatIsMadeIsTakenInOrder) {
  for (const unsigned threads : {1u, 2u, 4u}) {
    for (const size_t count : {0, 1, 511, 512, 513, 8192, 8193, 40000}) {
      std::vector<std::atomic<int>> made(count);
      std::atomic<int> taking = 0;
      std::vector<size_t> taken, expected;
      with_threads(threads, [&] {
        make_and_take(
            count,
            [&](size_t i) {
              ++made[i];
              return std::array<size_t, 2>{i, 3 * i};
            },
            [&](size_t i, const std::array<size_t, 2>& what) {
              EXPECT_EQ(++taking, 1);
              EXPECT_EQ(what, (std::array<size_t, 2>{i, 3 * i}));
              taken.push_back(i);
              --taking;
            },
            [&](const std::array<size_t, 2>& what) {
              expected.push_back(what[0]);
              EXPECT_GT(what[0], taken.size());
            });
      });
      EXPECT_TRUE(std::is_sorted(expected.begin(), expected.end()));
      EXPECT_EQ(expected.size(), count - (count + 511) / 512) << "all but the first of each part";
      ASSERT_EQ(taken.size(), count);
      for (size_t i = 0; i < count; ++i) {
        EXPECT_EQ(taken[i], i);
        EXPECT_EQ(made[i], 1);
      }
    }
  }
}

TEST(Parallel, PartsWaitWhileTooManyAreAhead) {
  for (const unsigned threads : {1u, 2u, 5u}) {
    constexpr size_t kParts = 500;
    std::atomic<size_t> taken = 0;
    std::vector<size_t> order;
    with_threads(threads, [&] {
      make_parts_in_order(
          kParts, [&](size_t part) { EXPECT_LT(part, taken + parts_ahead()); },
          [&](size_t part) {
            order.push_back(part);
            ++taken;
          });
    });
    ASSERT_EQ(order.size(), kParts);
    for (size_t part = 0; part < kParts; ++part) EXPECT_EQ(order[part], part);
  }
}

TEST(Parallel, ThreadsAreAsManyAsAskedFor) {
  for (const unsigned threads : {1u, 2u, 5u}) {
    EXPECT_EQ(with_threads(threads, [] { return threads_here(); }), threads);
    std::vector<unsigned> in_loop(8, 0), within(8, 0);
    with_threads(threads, [&] {
      for_each_alone(in_loop.size(), true, [&](size_t i) {
        in_loop[i] = threads_here();
        within[i] = with_threads(3, [] { return threads_here(); });
      });
      EXPECT_EQ(threads_here(), threads);
    });
    EXPECT_EQ(in_loop, std::vector<unsigned>(in_loop.size(), threads));
    EXPECT_EQ(within, std::vector<unsigned>(within.size(), 3));
  }
}

// Loops within parts of loops, for another number of threads.
TEST(Parallel, LoopsNest) {
  for (const unsigned outer : {1u, 2u, 4u}) {
    for (const unsigned inner : {1u, 2u, 5u}) {
      std::array<std::atomic<int>, 20> seen{};
      with_threads(outer, [&] {
        for_each_part(seen.size(), 4, [&](size_t, size_t begin, size_t end) {
          with_threads(inner, [&] {
            for_each_alone(end - begin, true, [&](size_t i) { ++seen[begin + i]; });
          });
        });
      });
      for (const auto& times : seen) EXPECT_EQ(times, 1);
    }
  }
}

TEST(Parallel, FailuresComeThrough) {
  struct Failure {};
  with_threads(2, [&] {
    EXPECT_THROW(for_each_alone(8, true, [](size_t i) { i == 5 ? throw Failure() : void(); }),
                 Failure);
    EXPECT_EQ(threads_here(), 2u);
  });
}

bool is_library_begun() {
  return tbb::this_task_arena::current_thread_index() != tbb::task_arena::not_initialized;
}

/// Calls work() on a new thread while frames go on alone for so long.
template <class Work>
void with_alone_time(std::chrono::nanoseconds time, Work&& work) {
  ThreadsFrame::set_alone_time(time);
  std::thread(work).join();
  ThreadsFrame::set_alone_time({});
}

// A thread that has no large loop does not begin the threads' library.
TEST(Parallel, SmallWorkIsDoneAlone) {
  with_alone_time({}, [] {
    with_threads(2, [] {
      size_t done = 0;
      for_each_part(5, 8, [&](size_t, size_t begin, size_t end) { done += end - begin; });
      run_both(
          false, [&] { ++done; }, [&] { ++done; });
      EXPECT_EQ(done, 7u);
      EXPECT_EQ(threads_here(), 2u);
      EXPECT_FALSE(is_library_begun());
      for_each_alone(2, true, [](size_t) {});
      EXPECT_TRUE(is_library_begun());
    });
  });
}

// Nor one whose work is short: then all loops are done by the thread itself, in order.
TEST(Parallel, ShortWorkIsDoneAlone) {
  with_alone_time(std::chrono::hours(1), [] {
    with_threads(4, [] {
      EXPECT_EQ(threads_here(), 4u);
      EXPECT_FALSE(has_threads());
      std::vector<size_t> done, taken;
      for_each_part(50, 7, [&](size_t part, size_t, size_t) { done.push_back(part); });
      run_both(
          true, [&] { done.push_back(8); }, [&] { done.push_back(9); });
      make_parts_in_order(
          10, [&](size_t part) { EXPECT_EQ(part, taken.size()); },
          [&](size_t part) { taken.push_back(part); });
      for (const auto& all : {done, taken}) {
        ASSERT_EQ(all.size(), 10u);
        for (size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], i);
      }
      std::vector<uint32_t> numbers(4 * kFewForThreads);
      for (uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = 7919 * i;
      sort_all(numbers.begin(), numbers.end());
      EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
      PerThread own([] { return std::make_unique<int>(0); });
      const int* const first = own.local().get();
      for_each_alone(20, true, [&](size_t) { EXPECT_EQ(own.local().get(), first); });
      EXPECT_FALSE(is_library_begun());
    });
  });
}

// But work on many faces has threads at once.
TEST(Parallel, LargeWorkIsNotDoneAlone) {
  with_alone_time(std::chrono::hours(1), [] {
    with_threads(2, [] {
      expect_faces(kManyForThreads - 1);
      EXPECT_FALSE(has_threads());
      expect_faces(kManyForThreads);
      EXPECT_TRUE(has_threads());
      expect_faces(0);
      EXPECT_TRUE(has_threads());
      for_each_alone(2, true, [](size_t) {});
      EXPECT_TRUE(is_library_begun());
    });
    with_threads(2, [] { EXPECT_FALSE(has_threads()); });  // that is of a frame
  });
}

// Threads begin in the middle of a loop once it takes long: all is done once, and taken in order.
TEST(Parallel, ThreadsComeWhenTheyAreWorthIt) {
  using std::chrono::milliseconds;
  for (const bool in_order : {false, true}) {
    with_alone_time(milliseconds(160), [&] {  // the second time 20
      const std::thread::id self = std::this_thread::get_id();
      with_threads(3, [&] {
        std::array<std::atomic<int>, 60> seen{};
        std::atomic<size_t> alone = 0, first_not_alone = seen.size();
        PerThread own([] { return std::atomic<int>(0); });
        const auto make = [&](size_t i) {
          if (own.local().fetch_add(1) == 0 && std::this_thread::get_id() != self) {
            first_not_alone = std::min<size_t>(first_not_alone, i);
          }
          ++seen[i];
          if (!has_threads()) ++alone;
          std::this_thread::sleep_for(milliseconds(5));
        };
        std::vector<size_t> taken;
        if (in_order) {
          make_parts_in_order(seen.size(), make, [&](size_t part) { taken.push_back(part); });
        } else {
          for_each_alone(seen.size(), true, make);
        }
        EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](const auto& n) { return n == 1; }));
        EXPECT_TRUE(has_threads());
        EXPECT_TRUE(is_library_begun());
        EXPECT_GE(alone, 1u);
        EXPECT_GE(first_not_alone, 1u);
        for (size_t i = 0; i < taken.size(); ++i) EXPECT_EQ(taken[i], i);
        EXPECT_EQ(taken.size(), in_order ? seen.size() : 0);
      });
    });
  }
}

TEST(RawVector, KeepsWhatIsPutIn) {
  RawVector<std::array<uint32_t, 2>> v;
  for (uint32_t i = 0; i < 100; ++i) v.push_back({i, 2 * i});
  v.resize(200);
  for (uint32_t i = 100; i < 200; ++i) v[i] = {i, 2 * i};
  const RawVector<std::array<uint32_t, 2>> copy = v;
  for (uint32_t i = 0; i < 200; ++i) EXPECT_EQ(copy[i][1], 2 * i);
}

}  // namespace
}  // namespace csgrun::parallel_test
