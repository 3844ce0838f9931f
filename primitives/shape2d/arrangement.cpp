#include "primitives/shape2d/arrangement.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>
#include <utility>

namespace csgrun {
namespace {

/// A segment is to be cut at a point that is none of its ends.
struct Cut {
  uint32_t segment;
  Point2D at;
};

/// What `of` says of its windings and operand, from one point to another.
void push_segment(const Point2D& from, const Point2D& to, const Segment2D& of,
                  std::vector<Segment2D>& segments) {
  if (from == to) return;
  if (from < to) {
    segments.push_back({from, to, of.first, of.rest, of.operands});
  } else {
    segments.push_back({to, from, -of.first, -of.rest, of.operands});
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
      merged.operands.add(segments[i].operands);
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

/// Along each axis a crossing is rounded by half a step at most, and so are corners and the ends of
/// edges when they are moved, turned or made up to twice as large.
constexpr int64_t kMostRounded = 2;

/// Whether a point is between the ends of a segment, and on it as far as can be told when both were
/// rounded.
bool may_lie_on(const Segment2D& s, const Point2D& p) {
  const Point2D way = s.b - s.a;
  const int128 off = cross(way, p - s.a);
  const int128 reach = kMostRounded * (static_cast<int128>(std::abs(way.x)) + std::abs(way.y));
  return off <= reach && -off <= reach && dot(way, p - s.a) > 0 && dot(way, s.b - p) > 0;
}

/// Cuts each of two segments at ends of the other that may lie on it.
void find_cuts_at_near_ends(const Segment2D& s, uint32_t si, const Segment2D& t, uint32_t ti,
                            std::vector<Cut>& cuts) {
  for (const Point2D& p : {t.a, t.b}) {
    if (may_lie_on(s, p)) cuts.push_back({si, p});
  }
  for (const Point2D& p : {s.a, s.b}) {
    if (may_lie_on(t, p)) cuts.push_back({ti, p});
  }
}

/// Bands of equal height, in which segments lie: about as many as there are segments, but so few
/// that one lies in a few, on average.
class Bands {
 public:
  explicit Bands(const std::vector<Segment2D>& segments) {
    if (segments.empty()) return;
    int64_t low = segments[0].a.y, high = low;
    double heights = 0;
    for (const Segment2D& s : segments) {
      low = std::min({low, s.a.y, s.b.y});
      high = std::max({high, s.a.y, s.b.y});
      heights += std::fabs(static_cast<double>(s.b.y) - static_cast<double>(s.a.y));
    }
    constexpr double kFew = 3;
    const auto count = static_cast<double>(segments.size()),
               extent = static_cast<double>(high) - static_cast<double>(low);
    const double bands = heights > 0 ? std::min(count, kFew * count * extent / heights) : count;
    low_ = static_cast<double>(low);
    count_ = static_cast<uint32_t>(std::max(1.0, bands));
    per_step_ = extent > 0 ? count_ / extent : 0;
  }

  [[nodiscard]] uint32_t count() const { return count_; }
  /// Monotone: what is between two heights is in a band between theirs.
  [[nodiscard]] uint32_t at(int64_t y) const {
    const double place = (static_cast<double>(y) - low_) * per_step_;
    return static_cast<uint32_t>(std::clamp(place, 0.0, static_cast<double>(count_ - 1)));
  }

 private:
  double low_ = 0, per_step_ = 0;
  uint32_t count_ = 1;
};

/// Calls visit(s, t) for all pairs of segments, which are sorted by a, whose boxes come near: a
/// sweep along x, in bands.
template <class Visit>
void for_each_near_pair(const std::vector<Segment2D>& segments, int64_t steps, Visit&& visit) {
  const Bands bands(segments);
  std::vector<std::vector<uint32_t>> active(bands.count());
  std::vector<uint32_t> first_band(segments.size());
  for (uint32_t i = 0; i < segments.size(); ++i) {
    const Segment2D& s = segments[i];
    const int64_t low = std::min(s.a.y, s.b.y) - steps, high = std::max(s.a.y, s.b.y) + steps;
    first_band[i] = bands.at(low);
    for (uint32_t band = first_band[i]; band <= bands.at(high); ++band) {
      std::vector<uint32_t>& own = active[band];
      size_t kept = 0;
      for (const uint32_t j : own) {
        const Segment2D& t = segments[j];
        if (t.b.x + steps < s.a.x) continue;
        own[kept++] = j;
        if (std::max(t.a.y, t.b.y) < low || std::min(t.a.y, t.b.y) > high) continue;
        // Once, in the first band that both are in.
        if (std::max(first_band[i], first_band[j]) == band) visit(i, j);
      }
      own.resize(kept);
      own.push_back(i);
    }
  }
}

/// All cuts that the segments make in one another; in `at_near_ends`, if it is given, those where
/// operands may have met before they were rounded.
std::vector<Cut> find_all_cuts(const std::vector<Segment2D>& segments,
                               std::vector<Cut>* at_near_ends = nullptr) {
  std::vector<Cut> cuts;
  for_each_near_pair(segments, at_near_ends ? kMostRounded : 0, [&](uint32_t i, uint32_t j) {
    const Segment2D &s = segments[i], &t = segments[j];
    if (at_near_ends && !s.operands.meets(t.operands)) {
      find_cuts_at_near_ends(s, i, t, j, *at_near_ends);
    }
    find_cuts(s, i, t, j, cuts);
  });
  return cuts;
}

/// Whether a segment meets the square of one step around a grid point.
bool meets_pixel(const Segment2D& s, const Point2D& p) {
  const Point2D a{2 * (s.a.x - p.x), 2 * (s.a.y - p.y)}, b{2 * (s.b.x - p.x), 2 * (s.b.y - p.y)};
  if (b.x < -1 || a.x > 1 || std::max(a.y, b.y) < -1 || std::min(a.y, b.y) > 1) return false;
  int low = 1, high = -1;
  for (const Point2D& corner : {Point2D{-1, -1}, Point2D{-1, 1}, Point2D{1, -1}, Point2D{1, 1}}) {
    const int side = orient(a, b, corner);
    low = std::min(low, side);
    high = std::max(high, side);
  }
  return low <= 0 && high >= 0;
}

/// Snap rounding: a segment is cut at every vertex, and every crossing, whose pixel it meets.
std::vector<Cut> find_snapping_cuts(const std::vector<Segment2D>& segments,
                                    const std::vector<Cut>& crossings) {
  std::vector<Point2D> hot;
  for (const Cut& cut : crossings) hot.push_back(cut.at);
  for (const Segment2D& s : segments) hot.insert(hot.end(), {s.a, s.b});
  std::sort(hot.begin(), hot.end());
  hot.erase(std::unique(hot.begin(), hot.end()), hot.end());
  std::vector<Cut> cuts;
  for (uint32_t i = 0; i < segments.size(); ++i) {
    const Segment2D& s = segments[i];
    auto p = std::lower_bound(hot.begin(), hot.end(), s.a.x - 1,
                              [](const Point2D& q, int64_t x) { return q.x < x; });
    for (; p != hot.end() && p->x <= s.b.x + 1; ++p) {
      if (*p != s.a && *p != s.b && meets_pixel(s, *p)) cuts.push_back({i, *p});
    }
  }
  return cuts;
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
      push_segment(from, cuts[next].at, s, result);
      from = cuts[next].at;
    }
    push_segment(from, s.b, s, result);
  }
  return result;
}

// Two or three rounds are usual. Bundles of needles a few steps wide can go on for long; then
// segments are also pulled to the vertices that they pass within half a step, which ends it
// (Hobby 1999, Practical segment intersection with finite precision output).
constexpr int kMostRounds = 40;

std::optional<std::vector<Segment2D>> arrange_in(int rounds, std::vector<Segment2D> segments) {
  merge_equal(segments);
  std::vector<Cut> at_near_ends, cuts = find_all_cuts(segments, &at_near_ends);
  if (!at_near_ends.empty()) {
    // First these alone: what is the same edge then is cut at the same points.
    segments = apply_cuts(segments, std::move(at_near_ends));
    merge_equal(segments);
    cuts = find_all_cuts(segments);
  }
  for (int round = 0; !cuts.empty(); ++round) {
    if (round == rounds) return std::nullopt;
    if (round >= kRoundsBeforeSnapping) cuts = find_snapping_cuts(segments, cuts);
    segments = apply_cuts(segments, std::move(cuts));
    merge_equal(segments);
    cuts = find_all_cuts(segments);
  }
  return segments;
}

}  // namespace

void add_segment(const Point2D& from, const Point2D& to, uint32_t operand,
                 std::vector<Segment2D>& segments) {
  const bool is_first = operand == kFirstOperand;
  push_segment(from, to, {{}, {}, is_first ? 1 : 0, is_first ? 0 : 1, OperandSet(operand)},
               segments);
}

void add_outline(const GridLoop& loop, uint32_t operand, std::vector<Segment2D>& segments) {
  for (size_t i = 0; i < loop.size(); ++i) {
    add_segment(loop[i], loop[(i + 1) % loop.size()], operand, segments);
  }
}

std::optional<std::vector<Segment2D>> arrange(std::vector<Segment2D> segments) {
  return arrange_in(kMostRounds, std::move(segments));
}

std::optional<std::vector<Segment2D>> arrange_without_snapping(std::vector<Segment2D> segments) {
  return arrange_in(kRoundsBeforeSnapping, std::move(segments));
}

}  // namespace csgrun
