#include "engine/mesh/whole_order.h"

#include <algorithm>
#include <numeric>

#include "engine/base/counting_order.h"
#include "engine/base/sort_few.h"
#include "engine/bsp/grid_planes.h"
#include "engine/bsp/lexicographic.h"

namespace csgrun {

WholeOrder::WholeOrder(const BoundaryMesh& boundary, CellGeometry& geometry)
    : boundary_(boundary), explicit_count_(static_cast<uint32_t>(boundary.point_planes.size())) {
  points_.reserve(explicit_count_);
  for (uint32_t p = 0; p < explicit_count_; ++p) points_.push_back({p, kNone, kNone});
  number_.resize(explicit_count_);
  std::iota(number_.begin(), number_.end(), 0u);
  if (boundary.parts.empty()) return;
  shared_.assign(explicit_count_, 0);
  collect_triangles();
  sort_points(geometry);
  number_triangles();
}

/// Triangles over points as they are met, explicit points before all others.
void WholeOrder::collect_triangles() {
  size_t count = 0;
  for (const UntouchedPart& part : boundary_.parts) count += part.faces.size();
  triangles_.reserve(count);
  points_.reserve(points_.size() + count / 2 + 16);
  std::vector<uint32_t> met;
  std::vector<RimEdge> candidates;
  for (uint32_t k = 0; k < boundary_.parts.size(); ++k) {
    const UntouchedPart& part = boundary_.parts[k];
    met.assign(part.leaf->vertices.size(), kNone);
    for (const UntouchedPart::Shared& s : part.shared) {
      met[s.vertex] = s.point;
      shared_[s.point] = 1;
    }
    for (const uint32_t f : part.faces) {
      UntouchedTriangle t{part.triangle(f), k, f};
      for (uint32_t& v : t.points) {
        if (met[v] == kNone) {
          met[v] = static_cast<uint32_t>(points_.size());
          points_.push_back({kNone, k, v});
        }
        v = met[v];
      }
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t from = t.points[i], to = t.points[(i + 1) % 3];
        if (from < explicit_count_ && to < explicit_count_) {
          candidates.push_back({from, to, k, f, static_cast<uint32_t>(i)});
        }
      }
      triangles_.push_back(t);
    }
  }
  find_rim(candidates);
}

/// Edges between shared points are the rim where they do not run both ways.
void WholeOrder::find_rim(const std::vector<RimEdge>& candidates) {
  CountingOrder by_low;
  by_low.sort(candidates.size(), explicit_count_,
              [&](size_t i) { return std::min(candidates[i].from, candidates[i].to); });
  for (uint32_t p = 0; p < explicit_count_; ++p) {
    const auto begin = by_low.order.begin() + by_low.starts[p],
               end = by_low.order.begin() + by_low.starts[p + 1];
    for (auto i = begin; i != end; ++i) {
      const RimEdge& e = candidates[*i];
      const bool is_inner = std::any_of(begin, end, [&](uint32_t j) {
        return candidates[j].from == e.to && candidates[j].to == e.from;
      });
      if (!is_inner) rim_.push_back(e);
    }
  }
}

std::array<PlaneId, 2> WholeOrder::planes_of(const RimEdge& edge, PlaneTable& planes) const {
  const UntouchedPart& part = boundary_.parts[edge.part];
  const auto corners = part.triangle(edge.face);
  const auto at = [&](uint32_t i) { return part.vertex(corners[(edge.corner + i) % 3]); };
  const Plane support = plane_through(at(0), at(1), at(2));
  const Plane of_edge = edge_plane(at(0), at(1), dominant_axis(support));
  return {planes.intern(part.map.plane(support)), planes.intern(part.map.plane(of_edge))};
}

void WholeOrder::sort_points(CellGeometry& geometry) {
  std::vector<std::array<double, 3>> at(points_.size());
  for (uint32_t p = 0; p < points_.size(); ++p) {
    if (p < explicit_count_) {
      at[p] = boundary_.point_rounded[p];
    } else {
      at[p] = part(points_[p]).rounded_point(points_[p].vertex);
    }
  }
  const auto exact = [&](uint32_t p) {
    if (p < explicit_count_) return geometry.exact(p);
    return part(points_[p]).point(points_[p].vertex);
  };
  const std::vector<uint32_t> order = lexicographic_order(
      at.size(), [&](uint32_t p) -> const std::array<double, 3>& { return at[p]; },
      [&](uint32_t p, uint32_t q) { return p != q && compare(exact(p), exact(q)) < 0; });
  std::vector<Place> sorted;
  sorted.reserve(points_.size());
  number_.resize(points_.size());
  for (const uint32_t p : order) {
    number_[p] = static_cast<uint32_t>(sorted.size());
    sorted.push_back(points_[p]);
  }
  points_ = std::move(sorted);
}

void WholeOrder::number_triangles() {
  for (UntouchedTriangle& t : triangles_) {
    for (uint32_t& p : t.points) p = number_[p];
    const auto [a, b, c] = t.points;
    if (b < a && b < c) t.points = {b, c, a};
    if (c < a && c < b) t.points = {c, a, b};
  }
}

void WholeOrder::order_faces(std::span<const LowestEdge> explicit_faces) {
  explicit_face_count_ = static_cast<uint32_t>(explicit_faces.size());
  faces_.resize(explicit_face_count_ + triangles_.size());
  if (triangles_.empty()) {
    std::iota(faces_.begin(), faces_.end(), 0u);
    return;
  }
  const auto from = [&](size_t f) {
    return f < explicit_face_count_ ? number(explicit_faces[f].from)
                                    : triangles_[f - explicit_face_count_].points[0];
  };
  const auto to = [&](uint32_t f) {
    return f < explicit_face_count_ ? number(explicit_faces[f].to)
                                    : triangles_[f - explicit_face_count_].points[1];
  };
  CountingOrder by_from;
  by_from.sort(faces_.size(), points_.size(), from);
  faces_ = std::move(by_from.order);
  // Explicit faces with the same lowest edge stay as they are.
  for (size_t p = 0; p < points_.size(); ++p) {
    sort_few(faces_.begin() + by_from.starts[p], faces_.begin() + by_from.starts[p + 1],
             [&](uint32_t f, uint32_t g) { return to(f) < to(g); });
  }
}

}  // namespace csgrun
