// Sorting on several threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>

#include <tbb/parallel_sort.h>

#include "engine/base/parallel.h"

namespace csgrun {

/// Sorts by `<`. REQUIRES: elements of which neither is less than the other are the same in all
/// respects, so that their order does not matter.
template <class Iterator>
void sort_all(Iterator begin, Iterator end) {
  const auto count = static_cast<size_t>(std::distance(begin, end));
  if (count > kFewForThreads && has_threads()) {
    on_threads([&] { tbb::parallel_sort(begin, end); });
  } else {
    std::sort(begin, end);
  }
}

}  // namespace csgrun
