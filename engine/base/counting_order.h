// Sorting by small whole numbers, in linear time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace csgrun {

/// Numbers grouped by key: those with key k stand, ascending, at starts[k] .. starts[k + 1].
struct CountingOrder {
  std::vector<uint32_t> starts, order;

  /// Orders 0 .. count - 1 by key(i) < keys. O(count + keys).
  template <class Key>
  void sort(size_t count, size_t keys, Key key) {
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
};

}  // namespace csgrun
