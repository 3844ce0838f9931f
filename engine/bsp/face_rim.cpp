// The arrangement of a polygon that nothing enters: whatever meets it does so in its edges, as
// flush faces of bodies beside each other do. Each line is then outside one of the edges, or along
// it, and need only be held against that one.
#include <algorithm>
#include <utility>

#include "engine/base/sort_few.h"
#include "engine/bsp/face_arrangement.h"

namespace csgrun {
namespace {

/// Of polygons with more edges it takes long to see that a line enters, which most do.
constexpr uint32_t kMaxEdges = 6;

}  // namespace

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
  const LineAxis way = geometry_.axis_between(line.from, line.to);
  if (geometry_.compare_along(point, line.from, way.axis) * way.sign <= 0) return RimPlace::kBefore;
  if (geometry_.compare_along(line.to, point, way.axis) * way.sign <= 0) return RimPlace::kAfter;
  rim_points_.emplace_back(edge, point);
  return RimPlace::kBetween;
}

/// Finds the edge that each line is along or beyond; false if some line is so of none, or could be
/// along two.
bool FaceArrangement::find_rim_edges() {
  const uint32_t count = polygon_->count;
  if (has_through_ || has_straight_angle_ || count > kMaxEdges) return false;
  edge_sides_.resize(std::max(edge_sides_.size(), geometry_.point_count()));
  for (uint32_t e = 0; e < count; ++e) {
    edge_sides_[lines_[e].from] = {build_, ~0u, 0, 1u << e | 1u << (e > 0 ? e - 1 : count - 1), 0};
  }
  on_rim_.assign(lines_.size(), {});
  rim_points_.clear();
  for (const uint32_t l : swept_) {
    const Line& line = lines_[l];
    if (line.kind == Kind::kBoundary) continue;
    uint32_t edge = 0;
    while (edge < count && (edge_side(line.from, edge) > 0 || edge_side(line.to, edge) > 0)) ++edge;
    if (edge == count) return false;
    OnRim& on = on_rim_[l];
    on.edge = edge;
    if (edge_side(line.from, edge) == 0) on.from = place_on_edge(edge, line.from);
    if (edge_side(line.to, edge) == 0) on.to = place_on_edge(edge, line.to);
    for (uint32_t same = next_same_[l]; same != kNone; same = next_same_[same]) {
      on_rim_[same] = on;
      if (lines_[same].from != line.from) std::swap(on_rim_[same].from, on_rim_[same].to);
    }
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

bool FaceArrangement::break_lines_at_rim() {
  if (!find_rim_edges()) return false;
  list_rim();
  parts_.clear();
  stops_.clear();
  for (uint32_t l = 0; l < lines_.size(); ++l) {
    const Line& line = lines_[l];
    OnRim on = on_rim_[l];
    if (line.kind == Kind::kBoundary) on = {l, RimPlace::kBefore, RimPlace::kAfter};
    if (is_coplanar(line.kind)) {
      stops_.emplace_back(l, line.from);
      stops_.emplace_back(l, line.to);
    }
    if (on.from == RimPlace::kOff || on.to == RimPlace::kOff) continue;
    const uint32_t from = rim_index(on.edge, on.from, line.from);
    const uint32_t to = rim_index(on.edge, on.to, line.to);
    const bool is_along = from < to;
    for (uint32_t i = std::min(from, to); i < std::max(from, to); ++i) {
      const uint32_t low = std::min(rim_[i], rim_[i + 1]), high = std::max(rim_[i], rim_[i + 1]);
      parts_.push_back({low, high, l, is_along != (rim_[i] == low)});
      if (!is_coplanar(line.kind)) continue;
      stops_.emplace_back(l, low);
      stops_.emplace_back(l, high);
    }
  }
  return true;
}

}  // namespace csgrun
