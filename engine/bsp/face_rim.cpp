// The arrangement of a polygon that nothing enters: whatever meets it does so in its edges, as
// flush faces of bodies beside each other do. Each line is then outside one of the edges, or along
// it, and need only be held against that one; the polygon's rim is the one loop there is. Bodies
// side by side often have equal faces: then one tells all of the other.
#include <algorithm>
#include <utility>

#include "engine/base/sort_few.h"
#include "engine/bsp/face_arrangement.h"

namespace csgrun {

/// Whether a vertex of another operand is a corner of the polygon.
bool FaceArrangement::is_own_corner(uint32_t vertex) {
  if (!touched_[vertex]) return false;
  const uint32_t point = points_.of_vertex(vertex);
  for (uint32_t e = 0; e < polygon_->count; ++e) {
    if (lines_[e].from == point) return true;
  }
  return false;
}

/// Whether a few questions find a corner of another one that is one of the polygon.
bool FaceArrangement::has_own_corner(const JobPolygon& other) {
  if (polygon_->count > kMaxEdges || other.count > kMaxEdges) return false;
  const auto corners = job_.corners(other);
  return std::any_of(corners.begin(), corners.end(), [&](uint32_t v) { return is_own_corner(v); });
}

bool FaceArrangement::has_own_corners(const JobPolygon& other) {
  const auto corners = job_.corners(other);
  return other.count == polygon_->count &&
         std::all_of(corners.begin(), corners.end(), [&](uint32_t v) { return is_own_corner(v); });
}

/// Appends the polygon as it is when all that meets it is one operand with an equal polygon, which
/// tells alone what is in front and behind: as long as all coplanar ones face the same way, no
/// other covers any of it.
bool FaceArrangement::take_equal(std::span<const SheetSegment> segments,
                                 std::span<const uint32_t> coplanar, CutLoops& out) {
  constexpr uint32_t kMostCorners = 128;  // each of one may be held against each of the other
  if (coplanar.empty() || polygon_->count > kMostCorners) return false;
  const JobPolygon& first = job_.polygons()[coplanar[0]];
  bool any_equal = false;
  for (const uint32_t q : coplanar) {
    const JobPolygon& other = job_.polygons()[q];
    if (other.operand != first.operand || other.support != first.support) return false;
    any_equal = any_equal || has_own_corners(other);
  }
  if (!any_equal) return false;
  for (const SheetSegment& s : segments) {
    if (job_.polygons()[s.other].operand != first.operand) return false;
  }
  CutLoops::Loop loop{
      static_cast<uint32_t>(out.corner_point.size()), polygon_->count, 0, 0, kNone, true};
  for (uint32_t e = 0; e < polygon_->count; ++e) {
    out.corner_point.push_back(lines_[e].from);
    out.corner_plane.push_back(lines_[e].plane);
  }
  const bool same = first.support == polygon_->support;
  loop.first_fact = static_cast<uint32_t>(out.facts.size());
  loop.fact_count = 1;
  loop.is_rim = true;
  out.facts.push_back({first.operand, !same, same, false});
  out.loops.push_back(loop);
  return true;
}

int FaceArrangement::edge_side(uint32_t point, uint32_t edge) {
  EdgeSides& sides = edge_sides_[point];
  if (sides.build != build_) sides = {build_, 0, 0, 0, 0};
  const uint32_t bit = 1u << edge;
  if ((sides.known & bit) == 0) {
    const int side = geometry_.side(lines_[edge].plane, point) * lines_[edge].left;
    sides.known |= bit;
    sides.beyond |= side < 0 ? bit : 0;
    sides.on |= side == 0 ? bit : 0;
  }
  return (sides.beyond & bit) != 0 ? -1 : (sides.on & bit) != 0 ? 0 : 1;
}

/// Where a point on the line of an edge is along that edge; what is between its ends is listed.
FaceArrangement::RimPlace FaceArrangement::place_on_edge(uint32_t edge, uint32_t point) {
  const Line& line = lines_[edge];
  if (point == line.from) return RimPlace::kBefore;
  if (point == line.to) return RimPlace::kAfter;
  const LineAxis way = geometry_.axis_between(line.from, line.to);
  if (geometry_.compare_along(point, line.from, way.axis) * way.sign <= 0) return RimPlace::kBefore;
  if (geometry_.compare_along(line.to, point, way.axis) * way.sign <= 0) return RimPlace::kAfter;
  rim_points_.emplace_back(edge, point);
  return RimPlace::kBetween;
}

/// Finds an edge that each line is along or beyond, and lists those along; false if some line is so
/// of none, or could be along two.
bool FaceArrangement::is_met_at_rim() {
  const uint32_t count = polygon_->count;
  if (has_through_ || has_straight_angle_ || count > kMaxEdges) return false;
  edge_sides_.resize(std::max(edge_sides_.size(), geometry_.point_count()));
  for (uint32_t e = 0; e < count; ++e) {
    edge_sides_[lines_[e].from] = {build_, ~0u, 0, 1u << e | 1u << (e > 0 ? e - 1 : count - 1), 0};
  }
  along_rim_.clear();
  rim_points_.clear();
  for (uint32_t l = count; l < lines_.size(); ++l) {
    const Line& line = lines_[l];
    uint32_t edge = 0;
    while (edge < count && (edge_side(line.from, edge) > 0 || edge_side(line.to, edge) > 0)) ++edge;
    if (edge == count) return false;
    RimPlace from = RimPlace::kOff, to = RimPlace::kOff;
    if (edge_side(line.from, edge) == 0) from = place_on_edge(edge, line.from);
    if (edge_side(line.to, edge) == 0) to = place_on_edge(edge, line.to);
    if (from == RimPlace::kOff || to == RimPlace::kOff) continue;
    along_rim_.push_back({l, edge, from, to});
  }
  return true;
}

/// Lists all points of the edges, one edge after the other.
void FaceArrangement::list_rim() {
  sort_few(rim_points_.begin(), rim_points_.end(), [&](const auto& p, const auto& q) {
    if (p.first != q.first || p.second == q.second) return p.first < q.first;
    const Line& line = lines_[p.first];
    const LineAxis way = geometry_.axis_between(line.from, line.to);
    return geometry_.compare_along(p.second, q.second, way.axis) * way.sign < 0;
  });
  rim_points_.erase(std::unique(rim_points_.begin(), rim_points_.end()), rim_points_.end());
  rim_.clear();
  rim_start_.clear();
  size_t next = 0;
  for (uint32_t e = 0; e < polygon_->count; ++e) {
    rim_start_.push_back(static_cast<uint32_t>(rim_.size()));
    rim_.push_back(lines_[e].from);
    for (; next < rim_points_.size() && rim_points_[next].first == e; ++next) {
      edge_sides_[rim_points_[next].second].at = static_cast<uint32_t>(rim_.size());
      rim_.push_back(rim_points_[next].second);
    }
    rim_.push_back(lines_[e].to);
  }
  rim_start_.push_back(static_cast<uint32_t>(rim_.size()));
}

/// Where one of the places is in rim_.
uint32_t FaceArrangement::rim_index(uint32_t edge, RimPlace place, uint32_t point) const {
  if (place == RimPlace::kBetween) return edge_sides_[point].at;
  return place == RimPlace::kAfter ? rim_start_[edge + 1] - 1 : rim_start_[edge];
}

/// Lists what is along each part of the rim, by ascending lines.
void FaceArrangement::list_along_rim() {
  rim_parts_.clear();
  for (uint32_t i = 0; i < along_rim_.size(); ++i) {
    const AlongRim& along = along_rim_[i];
    const Line& line = lines_[along.line];
    const uint32_t from = rim_index(along.edge, along.from, line.from),
                   to = rim_index(along.edge, along.to, line.to);
    for (uint32_t at = std::min(from, to); at < std::max(from, to); ++at) {
      rim_parts_.emplace_back(at, 2 * i + (from < to ? 0 : 1));
    }
  }
  sort_pairs_.sort(
      rim_parts_, rim_.size(), [](const auto& part) { return part.first; }, pair_less);
}

/// Appends the one loop there is, the polygon's rim.
bool FaceArrangement::trace_rim(CutLoops& out) {
  list_rim();
  list_along_rim();
  facts_.clear();
  parts_.clear();
  arcs_.clear();
  CutLoops::Loop loop{static_cast<uint32_t>(out.corner_point.size()), 0, 0, 0, kNone, true};
  loop.is_bare = true;
  auto next = rim_parts_.begin();
  for (uint32_t e = 0; e < polygon_->count; ++e) {
    for (uint32_t i = rim_start_[e]; i + 1 < rim_start_[e + 1]; ++i) {
      const auto [low, high] = std::minmax(rim_[i], rim_[i + 1]);
      const bool falls = rim_[i] == high;
      const auto arc = static_cast<uint32_t>(arcs_.size()),
                 first_part = static_cast<uint32_t>(parts_.size());
      parts_.push_back({low, high, e, falls});
      for (; next != rim_parts_.end() && next->first == i; ++next) {
        const bool runs_back = next->second % 2 == 1;
        parts_.push_back({low, high, along_rim_[next->second / 2].line, falls != runs_back});
      }
      arcs_.push_back({low, high, first_part, static_cast<uint32_t>(parts_.size()) - first_part});
      out.corner_point.push_back(rim_[i]);
      out.corner_plane.push_back(lines_[e].plane);
      const uint32_t v = geometry_.point(rim_[i]).vertex;
      if (v != kNone && !touched_[v]) loop.vertex = v;
      if (!add_facts(2 * arc + (falls ? 1 : 0), 0, arc == 0)) return false;
      loop.is_bare = loop.is_bare && at_arc_.empty();
    }
  }
  loop.corner_count = static_cast<uint32_t>(out.corner_point.size()) - loop.first_corner;
  loop.is_rim = true;
  out.loops.push_back(loop);
  return true;
}

}  // namespace csgrun
