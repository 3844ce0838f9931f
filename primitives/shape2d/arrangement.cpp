#include "primitives/shape2d/arrangement.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace csgrun {
namespace {

/// A segment is to be cut at a point that is none of its ends.
struct Cut {
  uint32_t segment;
  Point2D at;
};

void push_segment(const Point2D& from, const Point2D& to, int32_t first, int32_t rest,
                  std::vector<Segment2D>& segments) {
  if (from == to) return;
  if (from < to) {
    segments.push_back({from, to, first, rest});
  } else {
    segments.push_back({to, from, -first, -rest});
  }
}

void merge_equal(std::vector<Segment2D>& segments) {
  std::sort(segments.begin(), segments.end(), [](const Segment2D& s, const Segment2D& t) {
    return std::tie(s.a, s.b) < std::tie(t.a, t.b);
  });
  size_t count = 0;
  for (size_t i = 0; i < segments.size();) {
    Segment2D merged = segments[i++];
    for (; i < segments.size() && segments[i].a == merged.a && segments[i].b == merged.b; ++i) {
      merged.first += segments[i].first;
      merged.rest += segments[i].rest;
    }
    // A segment that changes no winding number is no boundary of anything.
    if (merged.first != 0 || merged.rest != 0) segments[count++] = merged;
  }
  segments.resize(count);
}

/// floor(n / d + 1/2) for d > 0.
int64_t rounded_quotient(int128 n, int128 d) {
  const int128 twice = 2 * n + d;
  int128 q = twice / (2 * d);
  if (q * 2 * d > twice) --q;
  return static_cast<int64_t>(q);
}

/// The grid point nearest to the crossing of two segments that cross properly.
Point2D rounded_crossing(const Segment2D& s, const Segment2D& t) {
  const Point2D ds = s.b - s.a, dt = t.b - t.a;
  int128 denominator = cross(ds, dt), numerator = cross(t.a - s.a, dt);
  if (denominator < 0) {
    denominator = -denominator;
    numerator = -numerator;
  }
  return {s.a.x + rounded_quotient(ds.x * numerator, denominator),
          s.a.y + rounded_quotient(ds.y * numerator, denominator)};
}

bool strictly_between(const Point2D& p, const Segment2D& s) { return s.a < p && p < s.b; }

void find_cuts(const Segment2D& s, uint32_t si, const Segment2D& t, uint32_t ti,
               std::vector<Cut>& cuts) {
  const int sa = orient(s.a, s.b, t.a), sb = orient(s.a, s.b, t.b);
  if (sa * sb > 0) return;
  const int ta = orient(t.a, t.b, s.a), tb = orient(t.a, t.b, s.b);
  if (ta * tb > 0) return;
  if (sa * sb < 0 && ta * tb < 0) {
    const Point2D p = rounded_crossing(s, t);
    if (p != s.a && p != s.b) cuts.push_back({si, p});
    if (p != t.a && p != t.b) cuts.push_back({ti, p});
    return;
  }
  if (sa == 0 && strictly_between(t.a, s)) cuts.push_back({si, t.a});
  if (sb == 0 && strictly_between(t.b, s)) cuts.push_back({si, t.b});
  if (ta == 0 && strictly_between(s.a, t)) cuts.push_back({ti, s.a});
  if (tb == 0 && strictly_between(s.b, t)) cuts.push_back({ti, s.b});
}

/// All cuts that the segments, sorted by a, make in one another.
std::vector<Cut> find_all_cuts(const std::vector<Segment2D>& segments) {
  std::vector<Cut> cuts;
  std::vector<uint32_t> active;
  for (uint32_t i = 0; i < segments.size(); ++i) {
    const Segment2D& s = segments[i];
    const auto [low, high] = std::minmax(s.a.y, s.b.y);
    size_t kept = 0;
    for (const uint32_t j : active) {
      const Segment2D& t = segments[j];
      if (t.b.x < s.a.x) continue;
      active[kept++] = j;
      if (std::max(t.a.y, t.b.y) < low || std::min(t.a.y, t.b.y) > high) continue;
      find_cuts(s, i, t, j, cuts);
    }
    active.resize(kept);
    active.push_back(i);
  }
  return cuts;
}

/// Whether a segment meets the square of so many steps around a grid point.
bool meets_square(const Segment2D& s, const Point2D& p, int64_t steps) {
  const int64_t r = steps;  // in halves of a step
  const Point2D a{2 * (s.a.x - p.x), 2 * (s.a.y - p.y)}, b{2 * (s.b.x - p.x), 2 * (s.b.y - p.y)};
  if (b.x < -r || a.x > r || std::max(a.y, b.y) < -r || std::min(a.y, b.y) > r) return false;
  int low = 1, high = -1;
  for (const Point2D& corner : {Point2D{-r, -r}, Point2D{-r, r}, Point2D{r, -r}, Point2D{r, r}}) {
    const int side = orient(a, b, corner);
    low = std::min(low, side);
    high = std::max(high, side);
  }
  return low <= 0 && high >= 0;
}

/// The ends of segments, and where they are cut.
std::vector<Point2D> list_vertices(const std::vector<Segment2D>& segments,
                                   const std::vector<Cut>& crossings) {
  std::vector<Point2D> vertices;
  for (const Cut& cut : crossings) vertices.push_back(cut.at);
  for (const Segment2D& s : segments) vertices.insert(vertices.end(), {s.a, s.b});
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// Cuts where at(segment, vertex) holds, which is asked of vertices other than the segment's ends
/// and in its range of x, with a step to spare.
template <class At>
std::vector<Cut> cuts_at(const std::vector<Point2D>& vertices,
                         const std::vector<Segment2D>& segments, At&& at) {
  std::vector<Cut> cuts;
  for (uint32_t i = 0; i < segments.size(); ++i) {
    const Segment2D& s = segments[i];
    auto p = std::lower_bound(vertices.begin(), vertices.end(), s.a.x - 1,
                              [](const Point2D& q, int64_t x) { return q.x < x; });
    for (; p != vertices.end() && p->x <= s.b.x + 1; ++p) {
      if (*p != s.a && *p != s.b && at(s, *p)) cuts.push_back({i, *p});
    }
  }
  return cuts;
}

/// Snap rounding: a segment is cut at every vertex, and every crossing, whose pixel it meets.
std::vector<Cut> find_snapping_cuts(const std::vector<Segment2D>& segments,
                                    const std::vector<Cut>& crossings) {
  return cuts_at(list_vertices(segments, crossings), segments,
                 [](const Segment2D& s, const Point2D& p) { return meets_square(s, p, 1); });
}

std::vector<Segment2D> apply_cuts(const std::vector<Segment2D>& segments, std::vector<Cut> cuts) {
  std::sort(cuts.begin(), cuts.end(), [&](const Cut& c, const Cut& d) {
    if (c.segment != d.segment) return c.segment < d.segment;
    const Segment2D& s = segments[c.segment];
    const int128 along_c = dot(c.at - s.a, s.b - s.a), along_d = dot(d.at - s.a, s.b - s.a);
    return std::tie(along_c, c.at) < std::tie(along_d, d.at);
  });
  std::vector<Segment2D> result;
  result.reserve(segments.size() + cuts.size());
  size_t next = 0;
  for (uint32_t i = 0; i < segments.size(); ++i) {
    const Segment2D& s = segments[i];
    Point2D from = s.a;
    for (; next < cuts.size() && cuts[next].segment == i; ++next) {
      push_segment(from, cuts[next].at, s.first, s.rest, result);
      from = cuts[next].at;
    }
    push_segment(from, s.b, s.first, s.rest, result);
  }
  return result;
}

// Two or three rounds are usual. Bundles of needles a few steps wide can go on for long; then
// segments are also pulled to the vertices that they pass within half a step, which ends it
// (Hobby 1999, Practical segment intersection with finite precision output).
constexpr int kMostRounds = 40;

std::optional<std::vector<Segment2D>> arrange_in(int rounds, std::vector<Segment2D> segments) {
  for (int round = 0; round < rounds; ++round) {
    merge_equal(segments);
    std::vector<Cut> cuts = find_all_cuts(segments);
    if (cuts.empty()) return segments;
    if (round >= kRoundsBeforeSnapping) cuts = find_snapping_cuts(segments, cuts);
    segments = apply_cuts(segments, std::move(cuts));
  }
  return std::nullopt;
}

}  // namespace

void add_segment(const Point2D& from, const Point2D& to, bool is_first,
                 std::vector<Segment2D>& segments) {
  push_segment(from, to, is_first ? 1 : 0, is_first ? 0 : 1, segments);
}

void add_outline(const GridLoop& loop, bool is_first, std::vector<Segment2D>& segments) {
  for (size_t i = 0; i < loop.size(); ++i) {
    add_segment(loop[i], loop[(i + 1) % loop.size()], is_first, segments);
  }
}

void cut_at_near_vertices(std::vector<Segment2D>& segments) {
  merge_equal(segments);
  segments = apply_cuts(
      segments,
      cuts_at(list_vertices(segments, {}), segments, [](const Segment2D& s, const Point2D& p) {
        return meets_square(s, p, 2) && dot(p - s.a, s.b - s.a) > 0 && dot(p - s.b, s.a - s.b) > 0;
      }));
}

std::optional<std::vector<Segment2D>> arrange(std::vector<Segment2D> segments) {
  return arrange_in(kMostRounds, std::move(segments));
}

std::optional<std::vector<Segment2D>> arrange_without_snapping(std::vector<Segment2D> segments) {
  return arrange_in(kRoundsBeforeSnapping, std::move(segments));
}

}  // namespace csgrun
