#include "engine/mesh/whole_order.h"

#include <algorithm>
#include <numeric>

#include "engine/base/counting_order.h"
#include "engine/base/parallel.h"
#include "engine/base/sort_few.h"
#include "engine/bsp/grid_planes.h"
#include "engine/bsp/lexicographic.h"
#include "engine/mesh/triangle_normals.h"

namespace csgrun {
namespace {

/// What is needed so many steps later is asked for now: in its order it stands anywhere.
constexpr size_t kAhead = 16;

}  // namespace

WholeOrder::WholeOrder(const BoundaryMesh& boundary, const CellGeometry& geometry)
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

/// For points of a part that are met, and one more.
size_t WholeOrder::most_places(const UntouchedPart& part) {
  return std::min(part.leaf->vertices.size(), 3 * part.faces.size()) + 1;
}

/// Triangles over points as they are met, explicit points before all others.
void WholeOrder::collect_triangles() {
  const std::vector<UntouchedPart>& parts = boundary_.parts;
  std::vector<size_t> first(parts.size() + 1, 0);
  for (size_t k = 0; k < parts.size(); ++k) {
    first[k + 1] = first[k] + parts[k].faces.size();
    for (const UntouchedPart::Shared& s : parts[k].shared) shared_[s.point] = 1;
  }
  triangles_.resize(first.back());
  directions_.resize(first.back());
  // Small parts together: each for itself would take memory many times, and threads wait for one
  // another when they take it.
  const std::vector<size_t> starts =
      part_starts(parts.size(), kFewForThreads, [&](size_t k) { return parts[k].faces.size(); });
  std::vector<Met> met(starts.size() - 1);
  first_point_.resize(parts.size());
  for_each_alone(met.size(), true, [&](size_t m) {
    Met own;  // not beside that of another thread while it grows
    size_t most = 0;
    for (size_t k = starts[m]; k < starts[m + 1]; ++k) most += most_places(parts[k]);
    own.places.reserve(most);
    for (size_t k = starts[m]; k < starts[m + 1]; ++k) {
      first_point_[k] = static_cast<uint32_t>(own.places.size());
      collect_triangles(static_cast<uint32_t>(k), first[k], own);
    }
    own.number = {};
    met[m] = std::move(own);
  });
  std::vector<RimEdge> candidates;
  for (size_t m = 0; m < met.size(); ++m) {
    const uint32_t before = static_cast<uint32_t>(points_.size()) - explicit_count_;
    for (size_t k = starts[m]; k < starts[m + 1]; ++k) first_point_[k] += before;
    points_.insert(points_.end(), met[m].places.begin(), met[m].places.end());
    candidates.insert(candidates.end(), met[m].candidates.begin(), met[m].candidates.end());
  }
  find_rim(candidates);
}

/// Those of one part. Its own points are numbered from the number of explicit points on.
void WholeOrder::collect_triangles(uint32_t k, size_t first, Met& met) {
  const UntouchedPart& part = boundary_.parts[k];
  const size_t vertices = part.leaf->vertices.size(), before = met.places.size();
  met.places.resize(before + most_places(part));
  Place* const places = met.places.data() + before;
  uint32_t place_count = 0;
  std::vector<uint32_t>& number = met.number;
  number.assign(vertices, kNone);
  for (const UntouchedPart::Shared& s : part.shared) number[s.vertex] = s.point;
  for (const uint32_t f : part.faces) {
    UntouchedTriangle t{part.triangle(f), k, f};
    for (uint32_t& v : t.points) {
      // Whether a vertex was met before is chance: no branch on that.
      const uint32_t known = number[v];
      places[place_count] = {kNone, k, v};
      number[v] = known == kNone ? explicit_count_ + place_count : known;
      place_count += static_cast<uint32_t>(known == kNone);
      v = number[v];
    }
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t from = t.points[i], to = t.points[(i + 1) % 3];
      if (from < explicit_count_ && to < explicit_count_) {
        met.candidates.push_back({from, to, k, f, static_cast<uint32_t>(i)});
      }
    }
    triangles_[first] = t;
    directions_[first++] = outward_direction(part, f);
  }
  met.places.resize(before + place_count);
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

void WholeOrder::sort_points(const CellGeometry& geometry) {
  RawVector<std::array<double, 3>> at(points_.size());
  for_each_range(points_.size(), [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p) {
      if (p < explicit_count_) {
        at[p] = boundary_.point_rounded[p];
      } else {
        at[p] = part(points_[p]).rounded_point(points_[p].vertex);
      }
    }
  });
  const auto exact = [&](uint32_t p) {
    if (p < explicit_count_) return geometry.value(p);
    return part(points_[p]).point(points_[p].vertex);
  };
  const std::vector<uint32_t> order = lexicographic_order(
      at.size(), [&](uint32_t p) -> const std::array<double, 3>& { return at[p]; },
      [&](uint32_t p, uint32_t q) { return p != q && compare(exact(p), exact(q)) < 0; });
  RawVector<Place> sorted(points_.size());
  number_.resize(points_.size());
  for_each_range(order.size(), [&](size_t begin, size_t end) {
    for (size_t n = begin; n < end; ++n) {
      if (n + kAhead < end) __builtin_prefetch(&points_[order[n + kAhead]]);
      number_[order[n]] = static_cast<uint32_t>(n);
      sorted[n] = points_[order[n]];
    }
  });
  points_ = std::move(sorted);
}

void WholeOrder::number_triangles() {
  for_each_range(triangles_.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      UntouchedTriangle& t = triangles_[i];
      const uint32_t first_point = first_point_[t.part];
      for (uint32_t& p : t.points) p = number_[p < explicit_count_ ? p : p + first_point];
      // Which one is the lowest is chance.
      const auto [a, b, c] = t.points;
      const std::array<uint32_t, 5> twice{a, b, c, a, b};
      const uint32_t is_second = b < a, is_third = c < std::min(a, b);
      const uint32_t lowest = 2 * is_third + (is_second & ~is_third);
      t.points = {twice[lowest], twice[lowest + 1], twice[lowest + 2]};
    }
  });
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
  for_each_range(points_.size(), [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p) {
      const size_t soon = by_from.starts[p] + kAhead;
      // Beyond this range others sort.
      if (soon < by_from.starts[end] && faces_[soon] >= explicit_face_count_) {
        __builtin_prefetch(&triangle(faces_[soon]));
      }
      sort_few(faces_.begin() + by_from.starts[p], faces_.begin() + by_from.starts[p + 1],
               [&](uint32_t f, uint32_t g) { return to(f) < to(g); });
    }
  });
}

}  // namespace csgrun
