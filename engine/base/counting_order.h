// Sorting by small whole numbers, in linear time.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"

namespace csgrun {

/// Values grouped by key: those of key k stand at starts[k] .. starts[k + 1], as they came.
template <class Values>
struct CountingGroups {
  std::vector<uint32_t> starts;
  Values values;

  /// Takes value(i) for i = 0 .. count - 1, which is of key(i) < keys; both are asked more than
  /// once, on several threads. REQUIRES: keys > 0, unless there is nothing to take. O(count +
  /// keys).
  template <class Key, class Value>
  void sort(size_t count, size_t keys, Key key, Value value) {
    if (count >= kMany && has_threads()) {
      return sort_in_ranges(count, keys, key, value);
    }
    // starts[k + 1] is where the next one of key k goes while they are distributed.
    starts.assign(keys + 2, 0);
    for (size_t i = 0; i < count; ++i) ++starts[key(i) + 2];
    for (size_t k = 2; k < starts.size(); ++k) starts[k] += starts[k - 1];
    values.resize(count);
    for (size_t i = 0; i < count; ++i) values[starts[key(i) + 1]++] = value(i);
    starts.pop_back();
  }

 private:
  static constexpr size_t kMany = 4 * kFewForThreads;

  /// The same on several threads: what is of each range of keys is brought together first, so that
  /// each range is counted and filled by itself, within a part of the memory.
  template <class Key, class Value>
  void sort_in_ranges(size_t count, size_t keys, Key key, Value value) {
    constexpr size_t kRanges = 16;
    assert(keys > 0);
    unsigned shift = 0;
    while ((keys - 1) >> shift >= kRanges) ++shift;
    using Counts = std::array<uint32_t, kRanges>;
    std::vector<Counts> next(part_count(count, kFewForThreads));
    for_each_part(count, kFewForThreads, [&](size_t part, size_t begin, size_t end) {
      Counts own{};
      for (size_t i = begin; i < end; ++i) ++own[key(i) >> shift];
      next[part] = own;
    });
    // Where each part puts what it has of each range.
    std::array<uint32_t, kRanges + 1> first{};
    for (size_t range = 0; range < kRanges; ++range) {
      uint32_t at = first[range];
      for (Counts& of_part : next) at += std::exchange(of_part[range], at);
      first[range + 1] = at;
    }
    struct Entry {
      uint32_t key;
      typename Values::value_type value;
    };
    RawVector<Entry> entries(count);
    for_each_part(count, kFewForThreads, [&](size_t part, size_t begin, size_t end) {
      Counts own = next[part];
      for (size_t i = begin; i < end; ++i) {
        const auto k = static_cast<uint32_t>(key(i));
        entries[own[k >> shift]++] = {k, value(i)};
      }
    });
    starts.assign(keys + 2, 0);
    values.resize(count);
    for_each_part(keys, size_t{1} << shift, [&](size_t range, size_t begin, size_t end) {
      const std::span<const Entry> own(entries.data() + first[range],
                                       entries.data() + first[range + 1]);
      for (const Entry& e : own) ++starts[e.key + 1];
      uint32_t at = first[range];
      for (size_t k = begin; k < end; ++k) at += std::exchange(starts[k + 1], at);
      for (const Entry& e : own) values[starts[e.key + 1]++] = e.value;
    });
    starts.pop_back();
  }
};

/// Numbers grouped by key: those with key k stand, ascending, at starts[k] .. starts[k + 1].
struct CountingOrder {
  std::vector<uint32_t> starts, order;

  /// Orders 0 .. count - 1 by key(i) < keys. REQUIRES: keys > 0, unless there is nothing to order.
  /// O(count + keys).
  template <class Key>
  void sort(size_t count, size_t keys, Key key) {
    CountingGroups<std::vector<uint32_t>> groups{std::move(starts), std::move(order)};
    groups.sort(count, keys, key, [](size_t i) { return static_cast<uint32_t>(i); });
    starts = std::move(groups.starts);
    order = std::move(groups.values);
  }
};

}  // namespace csgrun
