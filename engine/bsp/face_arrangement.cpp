#include "engine/bsp/face_arrangement.h"

#include <algorithm>
#include <cassert>

#include "engine/base/sort_few.h"

namespace csgrun {

uint32_t FaceArrangement::vertex(uint32_t v) {
  return touched_[v] ? points_.of_vertex(v) : geometry_.vertex_point(v);
}

/// The signs of the planes that hold the edges of a polygon at its other corners. Where many
/// polygons are in one plane they are asked for again and again. Each thread finds them for itself,
/// so they are not counted.
std::span<const int8_t> FaceArrangement::inner_signs(const JobPolygon& polygon) {
  const size_t end = size_t{polygon.first} + polygon.count;
  if (end > inner_signs_.size()) inner_signs_.resize(end, kUnknownSign);
  int8_t* const signs = inner_signs_.data() + polygon.first;
  if (signs[0] == kUnknownSign) {
    const SignCounters before = geometry_.counters;
    for (uint32_t e = 0; e < polygon.count; ++e) {
      signs[e] = static_cast<int8_t>(inner_sign(polygon, e));
    }
    geometry_.counters = before;
  }
  return {signs, polygon.count};
}

int FaceArrangement::inner_sign(const JobPolygon& polygon, uint32_t edge) {
  const auto corners = job_.corners(polygon);
  const uint32_t plane = job_.edge_planes(polygon)[edge];
  // The corners after those of the edge are off it, but for straight angles.
  for (uint32_t i = 2; i < polygon.count; ++i) {
    const uint32_t v = corners[(edge + i) % polygon.count];
    if (const int s = geometry_.side_of_vertex(plane, v)) return s;
  }
  return 0;
}

bool FaceArrangement::build(uint32_t polygon, std::span<const SheetSegment> segments,
                            std::span<const uint32_t> coplanar, CutLoops& out) {
  polygon_ = &job_.polygons()[polygon];
  ++build_;
  lines_.clear();
  add_boundary();
  if (take_equal(segments, coplanar, out)) return true;
  add_segments(segments);
  add_coplanar(coplanar);
  is_at_rim_ = is_met_at_rim();
  if (!is_at_rim_) {
    find_same_lines();
    find_stops();
    break_lines();
    join_parts();
    sort_around_points();
  }
  const auto first_loop = static_cast<uint32_t>(out.loops.size());
  const size_t corners = out.corner_point.size(), facts = out.facts.size();
  if ((is_at_rim_ ? trace_rim(out) : trace(out)) && find_covered(out, first_loop) &&
      write_facts(out, first_loop)) {
    return true;
  }
  out.loops.resize(first_loop);
  out.corner_point.resize(corners);
  out.corner_plane.resize(corners);
  out.facts.resize(facts);
  return false;
}

uint64_t FaceArrangement::count_coplanar_crossings(uint32_t polygon,
                                                   std::span<const uint32_t> coplanar) {
  polygon_ = &job_.polygons()[polygon];
  ++build_;
  lines_.clear();
  add_boundary();
  add_coplanar(coplanar);
  const std::span<const Line> edges = std::span<const Line>(lines_).subspan(first_coplanar_line_);
  sweep_.clear();
  for (const Line& e : edges) {
    sweep_.add(geometry_.point(e.from).rounded, geometry_.point(e.to).rounded);
  }
  // That boxes meet does not do: of nested rings hundreds of times as many do as edges.
  const auto is_beside = [&](const Line& e, const Line& other) {
    return geometry_.side(other.plane, e.from) * geometry_.side(other.plane, e.to) > 0;
  };
  uint64_t count = 0;
  sweep_.for_each_pair([&](uint32_t i, uint32_t j) {
    const Line &e = edges[i], &other = edges[j];
    if (e.operand == other.operand) return;
    count += is_beside(e, other) || is_beside(other, e) ? 0 : 1;
  });
  return count;
}

void FaceArrangement::add_boundary() {
  const auto corners = job_.corners(*polygon_);
  const auto planes = job_.edge_planes(*polygon_);
  const uint32_t count = polygon_->count;
  box_ = {};
  has_straight_angle_ = false;
  for (uint32_t e = 0; e < count; ++e) {
    box_.include(job_.rounded(corners[e]));
    int inner = geometry_.side_of_vertex(planes[e], corners[(e + 2) % count]);
    if (inner == 0) {
      has_straight_angle_ = true;
      inner = inner_sign(*polygon_, e);
    }
    lines_.push_back({vertex(corners[e]), 0, planes[e], inner, Kind::kBoundary, kNone, kNone});
  }
  for (uint32_t e = 0; e < count; ++e) lines_[e].to = lines_[e + 1 < count ? e + 1 : 0].from;
}

void FaceArrangement::add_segments(std::span<const SheetSegment> segments) {
  has_through_ = false;
  for (const SheetSegment& s : segments) {
    has_through_ |= s.front && s.back;
    const JobPolygon& other = job_.polygons()[s.other];
    const Kind kind = s.front && s.back ? Kind::kThrough : s.front ? Kind::kFront : Kind::kBack;
    lines_.push_back({s.from, s.to, other.support.index(), other.support.flipped() ? 1 : -1, kind,
                      s.other, other.operand});
  }
}

/// Whether the way between two vertices is clearly beside the polygon's box: rounding keeps order.
bool FaceArrangement::is_far(uint32_t vertex, uint32_t other) const {
  const auto &a = job_.rounded(vertex), &b = job_.rounded(other);
  bool far = false;
  for (int k = 0; k < 3; ++k) {
    far |= (a[k] < box_.lo[k] && b[k] < box_.lo[k]) || (a[k] > box_.hi[k] && b[k] > box_.hi[k]);
  }
  return far;
}

/// Whether a coplanar polygon is strictly on the outer side of an edge of the polygon.
bool FaceArrangement::is_apart(uint32_t sheet) {
  const auto corners = job_.corners(job_.polygons()[sheet]);
  size_t inner = 0;  // a corner that is inside of most edges, once it is found
  for (uint32_t e = 0; e < polygon_->count; ++e) {
    const Line& edge = lines_[e];
    const auto is_beyond = [&](size_t c) {
      return geometry_.side_of_vertex(edge.plane, corners[c]) * edge.left < 0;
    };
    if (!is_beyond(inner)) continue;
    size_t c = 0;
    while (c < corners.size() && is_beyond(c)) ++c;
    if (c == corners.size()) return true;
    inner = c;
  }
  return false;
}

/// The edges of coplanar sheets, without those that only two sheets of one operand have.
void FaceArrangement::add_coplanar(std::span<const uint32_t> coplanar) {
  first_coplanar_line_ = lines_.size();
  covered_.clear();
  sheets_.clear();
  sheet_edges_.clear();
  for (const uint32_t q : coplanar) {
    const JobPolygon& other = job_.polygons()[q];
    if (!has_own_corner(other) && is_apart(q)) continue;
    sheets_.push_back(q);
    const auto corners = job_.corners(other);
    for (uint32_t e = 0; e < other.count; ++e) {
      const uint32_t a = corners[e], b = corners[e + 1 < other.count ? e + 1 : 0];
      sheet_edges_.push_back({other.operand, std::min(a, b), std::max(a, b), q, e});
    }
  }
  std::sort(sheet_edges_.begin(), sheet_edges_.end(), [](const SheetEdge& a, const SheetEdge& b) {
    if (a.operand != b.operand) return a.operand < b.operand;
    const uint64_t of_a = together(a.low, a.high), of_b = together(b.low, b.high);
    return of_a != of_b ? of_a < of_b : a.sheet < b.sheet;
  });
  const auto same = [](const SheetEdge& a, const SheetEdge& b) {
    return a.low == b.low && a.high == b.high;
  };
  for (size_t i = 0; i < sheet_edges_.size(); ++i) {
    const SheetEdge& s = sheet_edges_[i];
    if (i + 1 < sheet_edges_.size() && same(s, sheet_edges_[i + 1]) &&
        job_.has_simple_edges(s.operand)) {
      ++i;
      continue;
    }
    if (is_far(s.low, s.high)) continue;
    const JobPolygon& other = job_.polygons()[s.sheet];
    const auto corners = job_.corners(other);
    const uint32_t plane = job_.edge_planes(other)[s.edge];
    // Seen from outside the polygon, a sheet that faces the other way runs clockwise.
    const bool is_left = other.support == polygon_->support;
    const int inner = inner_signs(other)[s.edge];
    lines_.push_back(
        {vertex(corners[s.edge]), vertex(corners[s.edge + 1 < other.count ? s.edge + 1 : 0]), plane,
         is_left ? inner : -inner, is_left ? Kind::kLeft : Kind::kRight, s.sheet, other.operand});
  }
}

/// Lines of one operand with the same ends: the two sheets of an edge in the polygon's plane. One
/// in front and one behind are as good as a sheet that goes through.
void FaceArrangement::find_same_lines() {
  line_ends_.clear();
  for (uint32_t l = 0; l < lines_.size(); ++l) {
    const Line& line = lines_[l];
    line_ends_.push_back(
        {std::min(line.from, line.to), std::max(line.from, line.to), line.operand, l});
  }
  sort_line_ends_.sort(
      line_ends_, geometry_.point_count(), [](const auto& ends) { return ends[0]; },
      [](const auto& a, const auto& b) {
        const uint64_t of_a = together(a[0], a[1]), of_b = together(b[0], b[1]);
        return of_a != of_b ? of_a < of_b : together(a[2], a[3]) < together(b[2], b[3]);
      });
  bool any_gone = false;
  for (size_t begin = 0, end = 1; begin < line_ends_.size(); begin = end++) {
    while (end < line_ends_.size() && have_same_ends(end - 1, end)) ++end;
    if (end - begin != 2) continue;
    Line &first = lines_[line_ends_[begin][3]], &second = lines_[line_ends_[begin + 1][3]];
    const bool are_opposite = (first.kind == Kind::kFront && second.kind == Kind::kBack) ||
                              (first.kind == Kind::kBack && second.kind == Kind::kFront);
    if (!are_opposite || first.from != second.from) continue;
    first.kind = Kind::kThrough;
    second.kind = Kind::kGone;
    any_gone = true;
  }
  if (any_gone) drop_gone_lines();
  next_same_.assign(lines_.size(), kNone);
  is_swept_.assign(lines_.size(), 1);
  for (size_t i = 1; i < line_ends_.size(); ++i) {
    if (!have_same_ends(i - 1, i)) continue;
    next_same_[line_ends_[i - 1][3]] = line_ends_[i][3];
    is_swept_[line_ends_[i][3]] = 0;
  }
  swept_.clear();
  for (uint32_t l = 0; l < lines_.size(); ++l) {
    if (is_swept_[l]) swept_.push_back(l);
  }
}

/// Whether two entries of line_ends_ are of lines of one operand with the same ends.
bool FaceArrangement::have_same_ends(size_t i, size_t j) const {
  const auto &a = line_ends_[i], &b = line_ends_[j];
  return a[2] != kNone && a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/// None of them is coplanar.
void FaceArrangement::drop_gone_lines() {
  numbers_.clear();
  uint32_t left = 0;
  for (uint32_t l = 0; l < lines_.size(); ++l) {
    const bool is_gone = lines_[l].kind == Kind::kGone;
    numbers_.push_back(is_gone ? kNone : left);
    if (!is_gone) lines_[left++] = lines_[l];
  }
  first_coplanar_line_ -= lines_.size() - left;
  lines_.resize(left);
  size_t kept = 0;
  for (const auto& ends : line_ends_) {
    if (numbers_[ends[3]] == kNone) continue;
    line_ends_[kept] = ends;
    line_ends_[kept++][3] = numbers_[ends[3]];
  }
  line_ends_.resize(kept);
}

/// Whether a line may pass a corner of its sheet: along edges between which there is a straight
/// angle, all of which are one line.
bool FaceArrangement::may_pass_corner(const Line& line) const {
  return (line.kind == Kind::kFront || line.kind == Kind::kBack) &&
         job_.polygons()[line.sheet].count > 3;
}

/// Lines may meet in ends of others.
void FaceArrangement::index_ends() {
  index_.clear();
  for (const uint32_t l : swept_) {
    for (const uint32_t point : {lines_[l].from, lines_[l].to}) {
      [[maybe_unused]] const uint32_t unique = index_.unique(point);
      assert(unique == point);
    }
  }
}

/// The points in which lines meet.
void FaceArrangement::find_stops() {
  index_ends();
  stops_.clear();
  sweep_.clear();
  for (const uint32_t l : swept_) {
    sweep_.add(geometry_.point(lines_[l].from).rounded, geometry_.point(lines_[l].to).rounded);
    stops_.emplace_back(l, lines_[l].from);
    stops_.emplace_back(l, lines_[l].to);
  }
  sweep_.for_each_pair([&](uint32_t i, uint32_t j) {
    const uint32_t s = swept_[i], t = swept_[j];
    // Sheets of a leaf meet in edges and corners that both have: lines in ends that both have.
    const uint32_t operand = lines_[t].operand;
    if (operand == kNone || lines_[s].operand != operand || !job_.has_simple_edges(operand) ||
        may_pass_corner(lines_[s]) || may_pass_corner(lines_[t])) {
      meet(s, t);
    }
  });
  for (size_t i = 0, count = stops_.size(); i < count; ++i) {
    const auto [line, point] = stops_[i];
    for (uint32_t l = next_same_[line]; l != kNone; l = next_same_[l])
      stops_.emplace_back(l, point);
  }
}

/// The sign of a line's plane at a point. Looking at the rim may have told it.
int FaceArrangement::side(uint32_t line, uint32_t point) {
  const Line& l = lines_[line];
  const bool is_known =
      l.kind == Kind::kBoundary && point < edge_sides_.size() && edge_sides_[point].build == build_;
  return is_known ? edge_side(point, line) * l.left : geometry_.side(l.plane, point);
}

void FaceArrangement::meet(uint32_t s, uint32_t t) {
  const Line a = lines_[s], b = lines_[t];
  // Lines that share an end meet nowhere else, unless they are one.
  const bool shares = a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to;
  if (shares) {
    const uint32_t far = a.from == b.from || a.from == b.to ? a.to : a.from;
    const bool all = (a.from == b.from && a.to == b.to) || (a.from == b.to && a.to == b.from);
    if (all || side(t, far) != 0) return;
  } else {
    const int a_from = side(t, a.from), a_to = side(t, a.to);
    if (a_from * a_to > 0) return;
    const int b_from = side(s, b.from), b_to = side(s, b.to);
    if (b_from * b_to > 0) return;
    if (a_from != 0 || a_to != 0) {
      const uint32_t x =
          a_from == 0   ? a.from
          : a_to == 0   ? a.to
          : b_from == 0 ? b.from
          : b_to == 0
              ? b.to
              : index_.unique(geometry_.add_point({polygon_->support.index(), a.plane, b.plane}));
      stops_.emplace_back(s, x);
      stops_.emplace_back(t, x);
      return;
    }
  }
  add_collinear(a, s, b.from);
  add_collinear(a, s, b.to);
  add_collinear(b, t, a.from);
  add_collinear(b, t, a.to);
}

/// Adds a point of the line if it lies between its ends.
void FaceArrangement::add_collinear(const Line& on, uint32_t line, uint32_t point) {
  const LineAxis way = geometry_.axis_between(on.from, on.to);
  if (geometry_.compare_along(point, on.from, way.axis) * way.sign > 0 &&
      geometry_.compare_along(on.to, point, way.axis) * way.sign > 0) {
    stops_.emplace_back(line, point);
  }
}

void FaceArrangement::break_lines() {
  parts_.clear();
  beyond_.resize(geometry_.point_count(), 0);
  sort_pairs_.sort(
      stops_, lines_.size(), [](const auto& stop) { return stop.first; }, pair_less);
  stops_.erase(std::unique(stops_.begin(), stops_.end()), stops_.end());
  for (size_t begin = 0; begin < stops_.size();) {
    const uint32_t l = stops_[begin].first;
    const Line& line = lines_[l];
    size_t end = begin;
    while (end < stops_.size() && stops_[end].first == l) ++end;
    if (end - begin == 2) {
      stops_[begin].second = line.from, stops_[begin + 1].second = line.to;
    } else {
      const LineAxis way = geometry_.axis_between(line.from, line.to);
      std::sort(stops_.begin() + static_cast<long>(begin), stops_.begin() + static_cast<long>(end),
                [&](const auto& p, const auto& q) {
                  return geometry_.compare_along(p.second, q.second, way.axis) * way.sign < 0;
                });
    }
    for (size_t i = begin; i + 1 < end; ++i) {
      const uint32_t p = stops_[i].second, q = stops_[i + 1].second;
      const Part part{std::min(p, q), std::max(p, q), l, p > q};
      if (!is_outside(part)) parts_.push_back(part);
    }
    begin = end;
  }
}

/// Whether a part of a coplanar sheet's edge is outside the polygon; parts are broken at its edges.
bool FaceArrangement::is_outside(const Part& part) {
  if (!is_coplanar(lines_[part.line].kind)) return false;
  return is_beyond(part.backwards ? part.high : part.low) ||
         is_beyond(part.backwards ? part.low : part.high);
}

/// Whether a point is outside the polygon. Parts that share one ask the same.
bool FaceArrangement::is_beyond(uint32_t point) {
  if (beyond_[point] / 2 == build_) return beyond_[point] % 2 == 1;
  const auto& at = geometry_.point(point).rounded;
  bool is_beyond = !box_.holds({at, at});
  for (uint32_t e = 0; e < polygon_->count && !is_beyond; ++e) {
    is_beyond = side(e, point) * lines_[e].left < 0;
  }
  beyond_[point] = 2 * build_ + (is_beyond ? 1 : 0);
  return is_beyond;
}

void FaceArrangement::join_parts() {
  arcs_.clear();
  sort_parts_.sort(
      parts_, geometry_.point_count(), [](const Part& part) { return part.low; },
      [](const Part& a, const Part& b) {
        const uint64_t of_a = together(a.low, a.high), of_b = together(b.low, b.high);
        return of_a != of_b ? of_a < of_b : a.line < b.line;
      });
  for (uint32_t i = 0; i < parts_.size(); ++i) {
    if (!arcs_.empty() && arcs_.back().low == parts_[i].low &&
        arcs_.back().high == parts_[i].high) {
      ++arcs_.back().part_count;
    } else {
      arcs_.push_back({parts_[i].low, parts_[i].high, i, 1});
    }
  }
}

int FaceArrangement::left_of(uint32_t half, uint32_t point) {
  const Part& part = parts_[arcs_[half / 2].first_part];
  const Line& line = lines_[part.line];
  const int left = part.backwards != (half % 2 == 1) ? -line.left : line.left;
  return geometry_.side(line.plane, point) * left;
}

/// Half-edges that leave a point, counter-clockwise.
void FaceArrangement::sort_around_points() {
  around_.clear();
  for (uint32_t h = 0; h < 2 * arcs_.size(); ++h) around_.emplace_back(from(h), h);
  sort_pairs_.sort(
      around_, geometry_.point_count(), [](const auto& half) { return half.first; }, pair_less);
  for (size_t begin = 0; begin < around_.size();) {
    size_t end = begin + 1;
    while (end < around_.size() && around_[end].first == around_[begin].first) ++end;
    if (end - begin > 2) {
      const uint32_t first = around_[begin].second;
      // 1: within half a turn to the left of the first; 2: straight back; 3: further round.
      const auto sector = [&](uint32_t h) {
        const int side = left_of(first, to(h));
        return side > 0 ? 1 : side == 0 ? 2 : 3;
      };
      std::sort(around_.begin() + begin + 1, around_.begin() + end,
                [&](const auto& a, const auto& b) {
                  const int s = sector(a.second), t = sector(b.second);
                  return s != t ? s < t : left_of(a.second, to(b.second)) > 0;
                });
    }
    begin = end;
  }
  place_.resize(around_.size());
  for (uint32_t i = 0; i < around_.size(); ++i) place_[around_[i].second] = i;
}

/// Whether a half-edge runs along the polygon's boundary with the outside on its left.
bool FaceArrangement::is_outer(uint32_t half) const {
  const Arc& arc = arcs_[half / 2];
  for (uint32_t i = arc.first_part; i < arc.first_part + arc.part_count; ++i) {
    if (lines_[parts_[i].line].kind == Kind::kBoundary) {
      return parts_[i].backwards != (half % 2 == 1);
    }
  }
  return false;
}

bool FaceArrangement::trace(CutLoops& out) {
  facts_.clear();
  loop_of_.assign(2 * arcs_.size(), kNone);
  uint32_t number = 0;
  for (uint32_t start = 0; start < loop_of_.size(); ++start) {
    if (loop_of_[start] != kNone || is_outer(start)) continue;
    CutLoops::Loop loop{static_cast<uint32_t>(out.corner_point.size()), 0, 0, 0, kNone, true};
    loop.is_bare = true;
    uint32_t h = start;
    do {
      if (loop_of_[h] != kNone || is_outer(h)) return false;
      loop_of_[h] = number;
      const uint32_t point = from(h);
      out.corner_point.push_back(point);
      out.corner_plane.push_back(lines_[parts_[arcs_[h / 2].first_part].line].plane);
      const uint32_t v = geometry_.point(point).vertex;
      if (v != kNone && !touched_[v]) loop.vertex = v;
      if (!add_facts(h, number, h == start)) return false;
      loop.is_bare = loop.is_bare && at_arc_.empty();
      // The next half-edge is the one before this one's reverse, counter-clockwise.
      uint32_t at = place_[h ^ 1];
      if (at > 0 && around_[at - 1].first == around_[at].first) {
        --at;
      } else {
        while (at + 1 < around_.size() && around_[at + 1].first == around_[at].first) ++at;
      }
      h = around_[at].second;
    } while (h != start);
    loop.corner_count = static_cast<uint32_t>(out.corner_point.size()) - loop.first_corner;
    out.loops.push_back(loop);
    ++number;
  }
  return true;
}

}  // namespace csgrun
