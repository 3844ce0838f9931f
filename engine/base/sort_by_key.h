// Sorting things by small whole numbers first, on one thread: CountingOrder is for all of them, and
// one that waits there may begin another task, which would find the working memory of this one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/sort_few.h"

namespace csgrun {

/// Sorts things by keys below a bound and those of one key, few mostly, by an order of their own.
/// Keeps its working memory from one time to the next.
template <class T>
class SortByKey {
 public:
  /// The outcome of std::sort by less. REQUIRES: key(item) < keys, `less` orders by keys first, no
  /// two equal items that differ in what it does not look at. O(n + keys) but for items of one key;
  /// O(n log n) if there are few items, or keys are many more than these.
  template <class Key, class Less>
  void sort(std::vector<T>& items, size_t keys, Key&& key, Less&& less) {
    constexpr size_t kFew = 256;
    if (items.size() <= kFew || keys / 4 > items.size()) {
      std::sort(items.begin(), items.end(), less);
      return;
    }
    // starts_[k + 1] is where the next item of key k goes while they are distributed.
    starts_.assign(keys + 2, 0);
    for (const T& item : items) ++starts_[key(item) + 2];
    for (size_t k = 2; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
    sorted_.resize(items.size());
    for (const T& item : items) sorted_[starts_[key(item) + 1]++] = item;
    std::swap(sorted_, items);
    for (size_t k = 0; k < keys; ++k) {
      sort_few(items.begin() + starts_[k], items.begin() + starts_[k + 1], less);
    }
  }

 private:
  std::vector<uint32_t> starts_;
  std::vector<T> sorted_;
};

}  // namespace csgrun
