// Sorting of what is mostly a few things.
#pragma once

#include <algorithm>
#include <iterator>
#include <utility>

namespace csgrun {

/// Sorts stably. O(n log n), and quick where there is hardly anything to sort.
template <class Iterator, class Less>
void sort_few(Iterator begin, Iterator end, Less less) {
  constexpr auto kMany = 32;
  if (end - begin > kMany) {
    std::stable_sort(begin, end, less);
    return;
  }
  for (Iterator i = begin; i != end; ++i) {
    auto value = std::move(*i);
    Iterator at = i;
    for (; at != begin && less(value, *std::prev(at)); --at) *at = std::move(*std::prev(at));
    *at = std::move(value);
  }
}

}  // namespace csgrun
