// A sweep over segments that meet in end points only, from left to right (and upwards).
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>
#include <tuple>
#include <vector>

#include "primitives/shape2d/grid2d.h"

namespace csgrun {

constexpr uint32_t kNoSegment = 0xffffffff;

/// Calls visit(i, below) for each segment i when the sweep meets its first point; `below` is the
/// segment just below it there (kNoSegment: none), which was visited before. Of segments that start
/// in one point the lowest comes first; a vertical segment is the highest of them, and what is
/// below it is what is to its right. O(n log n).
///
/// REQUIRES: segments[i].a < segments[i].b, and segments meet in common end points only.
template <class Segment, class Visit>
void sweep_segments(const std::vector<Segment>& segments, Visit visit) {
  auto below = [&](uint32_t i, uint32_t j) {
    const Segment& s = segments[i];
    const Segment& t = segments[j];
    if (s.a == t.a) return orient(s.a, s.b, t.b) > 0;
    // The one that starts later is compared with the line of the other.
    if (s.a < t.a) return orient(s.a, s.b, t.a) > 0;
    return orient(t.a, t.b, s.a) < 0;
  };
  std::set<uint32_t, decltype(below)> status(below);
  std::vector<typename decltype(status)::iterator> place(segments.size());

  std::vector<uint32_t> starts(segments.size()), ends(segments.size());
  std::iota(starts.begin(), starts.end(), 0u);
  std::iota(ends.begin(), ends.end(), 0u);
  std::sort(starts.begin(), starts.end(), [&](uint32_t i, uint32_t j) {
    if (segments[i].a != segments[j].a) return segments[i].a < segments[j].a;
    return orient(segments[i].a, segments[i].b, segments[j].b) > 0;
  });
  std::sort(ends.begin(), ends.end(),
            [&](uint32_t i, uint32_t j) { return segments[i].b < segments[j].b; });

  size_t next_end = 0;
  for (const uint32_t i : starts) {
    // Everything that ends here or before is gone before anything starts here.
    for (; next_end < ends.size() && segments[ends[next_end]].b <= segments[i].a; ++next_end) {
      status.erase(place[ends[next_end]]);
    }
    place[i] = status.insert(i).first;
    visit(i, place[i] == status.begin() ? kNoSegment : *std::prev(place[i]));
  }
}

}  // namespace csgrun
