// Sorting by small whole numbers, in linear time.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"

namespace csgrun {

/// Numbers grouped by key: those with key k stand, ascending, at starts[k] .. starts[k + 1].
struct CountingOrder {
  std::vector<uint32_t> starts, order;

  /// Orders 0 .. count - 1 by key(i) < keys. REQUIRES: keys > 0, unless there is nothing to order.
  /// O(count + keys).
  template <class Key>
  void sort(size_t count, size_t keys, Key key) {
    if (count >= kMany && tbb::this_task_arena::max_concurrency() > 1) {
      return sort_in_ranges(count, keys, key);
    }
    // starts[k + 1] is where the next number of key k goes while they are distributed.
    starts.assign(keys + 2, 0);
    for (size_t i = 0; i < count; ++i) ++starts[key(i) + 2];
    for (size_t k = 2; k < starts.size(); ++k) starts[k] += starts[k - 1];
    order.resize(count);
    for (size_t i = 0; i < count; ++i) {
      order[starts[key(i) + 1]++] = static_cast<uint32_t>(i);
    }
    starts.pop_back();
  }

 private:
  static constexpr size_t kMany = 4 * kFewForThreads;

  /// The same on several threads: each range of keys is counted and filled by itself.
  template <class Key>
  void sort_in_ranges(size_t count, size_t keys, Key key) {
    constexpr size_t kRanges = 4;
    assert(keys > 0);  // each of the ranges has some
    RawVector<uint32_t> key_of(count);
    for_each_range(count, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) key_of[i] = static_cast<uint32_t>(key(i));
    });
    starts.assign(keys + 2, 0);
    order.resize(count);
    const size_t each = part_count(keys, kRanges);
    std::array<uint32_t, kRanges + 1> before{};
    // What is in a range of keys: `place` of each of them is called with the number.
    const auto each_in = [&](size_t begin, size_t end, auto&& place) {
      for (uint32_t i = 0; i < count; ++i) {
        if (key_of[i] - begin < end - begin) place(i);
      }
    };
    for_each_part(keys, each, [&](size_t range, size_t begin, size_t end) {
      uint32_t own = 0;
      each_in(begin, end, [&](uint32_t i) { ++starts[key_of[i] + 1], ++own; });
      before[range + 1] = own;
    });
    for (size_t range = 0; range < kRanges; ++range) before[range + 1] += before[range];
    for_each_part(keys, each, [&](size_t range, size_t begin, size_t end) {
      uint32_t next = before[range];
      for (size_t k = begin; k < end; ++k) next += std::exchange(starts[k + 1], next);
      each_in(begin, end, [&](uint32_t i) { order[starts[key_of[i] + 1]++] = i; });
    });
    starts.pop_back();
  }
};

}  // namespace csgrun
