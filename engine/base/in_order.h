// Work done at the same time whose outcome is taken in order, so that it is the same for any number
// of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <tbb/parallel_pipeline.h>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"

namespace csgrun {

/// How many parts may be made or wait to be taken at a time.
inline size_t parts_ahead() { return 4 * threads_here(); }

/// Calls make(part) for the parts below `count`, in any order and at the same time, and take(part)
/// for one after another, in this order, while later ones are made: neither may look at what the
/// other changes. Parts that are parts_ahead() apart are not there at the same time.
template <class Make, class Take>
void make_parts_in_order(size_t count, Make&& make, Take&& take) {
  size_t next = do_alone(count, false, [&](size_t part) { make(part), take(part); });
  if (next == count) return;
  const auto hand_out = [&](tbb::flow_control& flow) {
    if (next == count) flow.stop();
    return next < count ? next++ : count;
  };
  const auto make_one = [&](size_t part) {
    make(part);
    return part;
  };
  using tbb::filter_mode;
  const auto stages = tbb::make_filter<void, size_t>(filter_mode::serial_in_order, hand_out) &
                      tbb::make_filter<size_t, size_t>(filter_mode::parallel, make_one) &
                      tbb::make_filter<size_t, void>(filter_mode::serial_in_order, take);
  on_threads([&] { tbb::parallel_pipeline(parts_ahead(), stages); });
}

/// Calls take(i, make(i)) for i below count: takes one after another, in this order, what is made
/// at the same time, see make_parts_in_order. `expect(made)` comes some steps before it is taken,
/// time enough to fetch memory.
template <class Make, class Take, class Expect>
void make_and_take(size_t count, Make&& make, Take&& take, Expect&& expect) {
  constexpr size_t kEach = 512, kAhead = 12;
  const size_t parts = part_count(count, kEach);
  std::vector<RawVector<decltype(make(size_t{0}))>> ring(std::min(parts, parts_ahead()));
  make_parts_in_order(
      parts,
      [&](size_t part) {
        const size_t first = part * kEach;
        auto& made = ring[part % ring.size()];
        made.resize(std::min(kEach, count - first));
        for (size_t i = 0; i < made.size(); ++i) made[i] = make(first + i);
      },
      [&](size_t part) {
        const auto& made = ring[part % ring.size()];
        for (size_t i = 1; i < std::min(kAhead, made.size()); ++i) expect(made[i]);
        for (size_t i = 0; i < made.size(); ++i) {
          if (i + kAhead < made.size()) expect(made[i + kAhead]);
          take(part * kEach + i, made[i]);
        }
      });
}

}  // namespace csgrun
