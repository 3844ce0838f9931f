// Sorting of what is mostly a few things.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

namespace csgrun {

/// Two numbers that compare as one, the first one first: sooner than one after the other.
constexpr uint64_t together(uint32_t first, uint32_t second) {
  return uint64_t{first} << 32 | second;
}

/// The same of two numbers in either order: the ends of an edge, whichever way it runs.
constexpr uint64_t ends_together(uint32_t a, uint32_t b) {
  return a < b ? together(a, b) : together(b, a);
}

/// a < b. An object: a function passed on would be called, not inlined.
constexpr auto pair_less = [](std::pair<uint32_t, uint32_t> a, std::pair<uint32_t, uint32_t> b) {
  return together(a.first, a.second) < together(b.first, b.second);
};

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
