// Points in lexicographic order of their coordinates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/base/counting_order.h"
#include "engine/base/sort_few.h"

namespace csgrun {

/// The numbers 0 .. count - 1 in the order of at(i), references to coordinates that are finite;
/// where they are equal, in that of before(i, j), which is asked on several threads. O(n), but for
/// points that have many x in common: O(n log n).
template <class At, class Before>
std::vector<uint32_t> lexicographic_order(size_t count, At at, Before before) {
  if (count == 0) return {};
  // By x in as many buckets as there are points, or as x has whole parts; then within each.
  double lo = at(0)[0], hi = lo;
  for (size_t i = 1; i < count; ++i) {
    const double x = at(static_cast<uint32_t>(i))[0];
    lo = std::min(lo, x), hi = std::max(hi, x);
  }
  const double buckets = std::min(static_cast<double>(count), std::floor(hi - lo) + 1);
  const double scale = buckets / (hi - lo + 1);
  CountingOrder by_x;
  by_x.sort(count, static_cast<size_t>(buckets) + 1, [&](size_t i) {
    return static_cast<size_t>((at(static_cast<uint32_t>(i))[0] - lo) * scale);
  });
  for_each_range(by_x.starts.size() - 1, [&](size_t begin, size_t end) {
    for (size_t b = begin; b < end; ++b) {
      // Beyond this range others sort.
      const size_t soon = by_x.starts[b] + size_t{16};
      if (soon < by_x.starts[end]) __builtin_prefetch(&at(by_x.order[soon]));
      sort_few(by_x.order.begin() + by_x.starts[b], by_x.order.begin() + by_x.starts[b + 1],
               [&](uint32_t i, uint32_t j) {
                 const std::array<double, 3>&p = at(i), &q = at(j);
                 if (p[0] != q[0]) return p[0] < q[0];
                 return p != q ? p < q : before(i, j);
               });
    }
  });
  return std::move(by_x.order);
}

}  // namespace csgrun
