#include "engine/bsp/cut_polygon.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace csgrun {
namespace {

bool have_common_end(const CutSegment& a, const CutSegment& b) {
  return a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to;
}

constexpr uint32_t half(uint32_t arc, bool backwards) { return 2 * arc + (backwards ? 1 : 0); }

}  // namespace

bool PolygonCutter::cut(uint32_t polygon, std::span<const CutSegment> segments, CutLoops& out) {
  polygon_ = &job_.polygons()[polygon];
  arcs_.clear();
  return find_meets(segments) && add_segments(segments) && add_boundary(segments) &&
         link_inner(segments) && (link_meets(), trace(segments, out));
}

/// Segments of an operand that nowhere touches itself share ends only; others may cross.
bool PolygonCutter::find_meets(std::span<const CutSegment> segments) {
  meets_.clear();
  if (segments.empty()) return true;
  const auto operand = [&](uint32_t s) { return job_.polygons()[segments[s].other].operand; };
  uint32_t different = 1;
  while (different < segments.size() && operand(different) == operand(0)) ++different;
  if (different >= segments.size() && job_.has_simple_edges(operand(0))) return true;

  sweep_.clear();
  for (const CutSegment& s : segments) {
    sweep_.add(geometry_.point(s.from).rounded, geometry_.point(s.to).rounded);
  }
  bool apart = true;
  sweep_.for_each_pair([&](uint32_t s, uint32_t t) {
    if (operand(s) == operand(t) &&
        (job_.has_simple_edges(operand(s)) || have_common_end(segments[s], segments[t]))) {
      return;
    }
    const PlaneId plane_s = job_.polygons()[segments[s].other].support,
                  plane_t = job_.polygons()[segments[t].other].support;
    const int s_from = geometry_.side(plane_t.index(), segments[s].from),
              s_to = geometry_.side(plane_t.index(), segments[s].to);
    if (s_from * s_to > 0) return;
    const int t_from = geometry_.side(plane_s.index(), segments[t].from),
              t_to = geometry_.side(plane_s.index(), segments[t].to);
    if (t_from * t_to > 0) return;
    if (s_from == 0 || s_to == 0 || t_from == 0 || t_to == 0) {
      apart = false;
      return;
    }
    const uint32_t x =
        geometry_.add_point({polygon_->support.index(), plane_s.index(), plane_t.index()});
    // On the left of s is its back.
    meets_.push_back({s, t, x, (plane_s.flipped() ? -t_to : t_to) < 0});
  });
  return apart;
}

/// Sorts points along a line, from one end on; false when two coincide. Indices are kept.
bool PolygonCutter::order(std::vector<Stop>& stops, uint32_t from, uint32_t to) {
  if (stops.size() < 2) return true;
  const LineAxis way = geometry_.axis_between(from, to);
  std::sort(stops.begin(), stops.end(), [&](const Stop& p, const Stop& q) {
    return geometry_.compare_along(p.point, q.point, way.axis) * way.sign < 0;
  });
  for (size_t i = 1; i < stops.size(); ++i) {
    if (geometry_.compare_along(stops[i - 1].point, stops[i].point, way.axis) == 0) return false;
  }
  return true;
}

/// The arcs of each segment, in parts between its meets.
bool PolygonCutter::add_segments(std::span<const CutSegment> segments) {
  first_arc_.clear();
  arc_to_meet_.assign(meets_.size(), {kNone, kNone});
  // Meets of a segment stand together once they are sorted by it.
  auto& of_segment = meets_of_segment_;
  of_segment.clear();
  for (uint32_t m = 0; m < meets_.size(); ++m) {
    of_segment.emplace_back(meets_[m].first, m);
    of_segment.emplace_back(meets_[m].second, m);
  }
  std::sort(of_segment.begin(), of_segment.end());
  size_t at = 0;
  for (uint32_t s = 0; s < segments.size(); ++s) {
    first_arc_.push_back(static_cast<uint32_t>(arcs_.size()));
    stops_.clear();
    for (; at < of_segment.size() && of_segment[at].first == s; ++at) {
      stops_.push_back({meets_[of_segment[at].second].point, of_segment[at].second});
    }
    if (!order(stops_, segments[s].from, segments[s].to)) return false;
    const uint32_t plane = job_.polygons()[segments[s].other].support.index();
    uint32_t from = segments[s].from;
    for (const Stop& stop : stops_) {
      arc_to_meet_[stop.index][meets_[stop.index].first == s ? 0 : 1] =
          static_cast<uint32_t>(arcs_.size());
      arcs_.push_back({{from, stop.point}, plane, s, {kNone, kNone}});
      from = stop.point;
    }
    arcs_.push_back({{from, segments[s].to}, plane, s, {kNone, kNone}});
  }
  first_arc_.push_back(static_cast<uint32_t>(arcs_.size()));
  return true;
}

/// The arcs of the polygon's own edges, in parts between the ends of segments on them, and the
/// turns there: what comes along an edge turns left into the segment, what comes along the segment
/// turns left into the edge.
bool PolygonCutter::add_boundary(std::span<const CutSegment> segments) {
  ends_on_edge_.clear();
  for (uint32_t s = 0; s < segments.size(); ++s) {
    if (segments[s].from_edge != kNone) ends_on_edge_.push_back({segments[s].from_edge, s, false});
    if (segments[s].to_edge != kNone) ends_on_edge_.push_back({segments[s].to_edge, s, true});
  }
  std::sort(ends_on_edge_.begin(), ends_on_edge_.end(), [](const EndOnEdge& a, const EndOnEdge& b) {
    return std::tie(a.edge, a.segment, a.at_to) < std::tie(b.edge, b.segment, b.at_to);
  });
  const auto corners = job_.corners(*polygon_);
  const auto first = static_cast<uint32_t>(arcs_.size());
  size_t at = 0;
  for (uint32_t e = 0; e < polygon_->count; ++e) {
    const uint32_t begin = geometry_.vertex_point(corners[e]),
                   end = geometry_.vertex_point(corners[e + 1 < polygon_->count ? e + 1 : 0]);
    stops_.clear();
    for (; at < ends_on_edge_.size() && ends_on_edge_[at].edge == e; ++at) {
      const EndOnEdge& x = ends_on_edge_[at];
      stops_.push_back({x.at_to ? segments[x.segment].to : segments[x.segment].from,
                        2 * x.segment + (x.at_to ? 1 : 0)});
    }
    if (!order(stops_, begin, end)) return false;
    uint32_t from = begin;
    for (const Stop& stop : stops_) {
      const auto arriving = static_cast<uint32_t>(arcs_.size());
      const uint32_t s = stop.index / 2;
      const bool at_to = stop.index % 2;
      const uint32_t arc = at_to ? first_arc_[s + 1] - 1 : first_arc_[s];
      arcs_.push_back(
          {{from, stop.point}, CutLoops::kOwnEdge | e, kNone, {half(arc, at_to), kNone}});
      arcs_[arc].next[at_to ? 0 : 1] = half(arriving + 1, false);
      from = stop.point;
    }
    arcs_.push_back({{from, end},
                     CutLoops::kOwnEdge | e,
                     kNone,
                     {half(static_cast<uint32_t>(arcs_.size()) + 1, false), kNone}});
  }
  arcs_.back().next[0] = half(first, false);
  return true;
}

/// Two segments share each end that is not on the boundary: there an edge of the other operand
/// passes, and both of its faces cross the polygon. Unless one of these is hidden.
bool PolygonCutter::link_inner(std::span<const CutSegment> segments) {
  inner_ends_.clear();
  for (uint32_t s = 0; s < segments.size(); ++s) {
    if (segments[s].from_edge == kNone) inner_ends_.push_back({segments[s].from, s, 0});
    if (segments[s].to_edge == kNone) inner_ends_.push_back({segments[s].to, s, 1});
  }
  std::sort(inner_ends_.begin(), inner_ends_.end());
  const auto arc_at = [&](const std::array<uint32_t, 3>& end) {
    return end[2] ? first_arc_[end[1] + 1] - 1 : first_arc_[end[1]];
  };
  const auto are_together = [&](size_t i, size_t j) {
    return j < inner_ends_.size() && inner_ends_[i][0] == inner_ends_[j][0];
  };
  for (size_t i = 0; i < inner_ends_.size();) {
    const auto& a = inner_ends_[i];
    const uint32_t arc_a = arc_at(a);
    if (!are_together(i, i + 1)) {
      if (!is_open_[job_.polygons()[segments[a[1]].other].operand]) return false;
      arcs_[arc_a].next[a[2] ? 0 : 1] = half(arc_a, a[2]);
      ++i;
      continue;
    }
    if (are_together(i, i + 2)) return false;
    const auto& b = inner_ends_[i + 1];
    const uint32_t arc_b = arc_at(b);
    i += 2;
    // Arriving at a's end, one goes on from b's end, and the other way round.
    arcs_[arc_a].next[a[2] ? 0 : 1] = half(arc_b, b[2]);
    arcs_[arc_b].next[b[2] ? 0 : 1] = half(arc_a, a[2]);
  }
  return true;
}

/// Where two segments cross, every walk turns left.
void PolygonCutter::link_meets() {
  for (size_t m = 0; m < meets_.size(); ++m) {
    // Of two directions, `left` runs to the left of `right`.
    uint32_t right = arc_to_meet_[m][0], left = arc_to_meet_[m][1];
    if (!meets_[m].second_left) std::swap(left, right);
    arcs_[right].next[0] = half(left + 1, false);
    arcs_[right + 1].next[1] = half(left, true);
    arcs_[left].next[0] = half(right, true);
    arcs_[left + 1].next[1] = half(right + 1, false);
  }
}

bool PolygonCutter::trace(std::span<const CutSegment> segments, CutLoops& out) {
  const size_t loops = out.loops.size(), corners = out.corner_point.size(),
               facts = out.facts.size();
  const auto fail = [&] {
    out.loops.resize(loops);
    out.corner_point.resize(corners);
    out.corner_plane.resize(corners);
    out.facts.resize(facts);
    return false;
  };
  seen_.assign(2 * arcs_.size(), 0);
  for (uint32_t start = 0; start < seen_.size(); ++start) {
    if (seen_[start] || (arcs_[start / 2].segment == kNone && start % 2)) continue;
    CutLoops::Loop loop{static_cast<uint32_t>(out.corner_point.size()), 0,
                        static_cast<uint32_t>(out.facts.size()), 0, kNone};
    uint32_t h = start;
    do {
      if (h == kNone || seen_[h]) return fail();
      seen_[h] = 1;
      const Arc& arc = arcs_[h / 2];
      const uint32_t from = arc.point[h % 2];
      out.corner_point.push_back(from);
      out.corner_plane.push_back(arc.plane);
      if (arc.segment != kNone) {
        const bool inside = h % 2 == 0;
        const uint32_t operand = job_.polygons()[segments[arc.segment].other].operand;
        out.facts.push_back({operand, inside, inside, h != start});
      } else if (loop.vertex == kNone) {
        // A crossing may have the number of a vertex elsewhere, where an operand touches itself.
        const uint32_t v = geometry_.point(from).vertex;
        const auto own = job_.corners(*polygon_);
        if (std::find(own.begin(), own.end(), v) != own.end()) loop.vertex = v;
      }
      h = arc.next[h % 2];
    } while (h != start);
    loop.corner_count = static_cast<uint32_t>(out.corner_point.size()) - loop.first_corner;
    if (!out.finish_facts(loop, is_open_)) return fail();
    out.loops.push_back(loop);
  }
  return true;
}

bool CutLoops::finish_facts(Loop& loop, std::span<const uint8_t> is_open) {
  const auto begin = facts.begin() + loop.first_fact;
  std::sort(begin, facts.end());
  const auto says_the_same = [](const Fact& a, const Fact& b) { return a.says_the_same(b); };
  facts.erase(std::unique(begin, facts.end(), says_the_same), facts.end());
  loop.fact_count = static_cast<uint32_t>(facts.size()) - loop.first_fact;
  return std::adjacent_find(begin, facts.end(), [&](const Fact& a, const Fact& b) {
           return a.operand == b.operand && !may_contradict(a, b, is_open);
         }) == facts.end();
}

}  // namespace csgrun
