// The planes of a job's polygons, which are made when somebody asks.
#include <vector>

#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/enter_planes.h"
#include "engine/bsp/grid_planes.h"
#include "engine/bsp/job.h"
#include "engine/bsp/piece_store.h"

namespace csgrun {

/// A corner of a face of a leaf, as the leaf counts, at the operand's place in its frame.
IVec3 Job::leaf_corner(const JobPolygon& p, uint32_t i) const {
  const uint32_t at = i < p.count ? i : i - p.count;
  const Operand& operand = (*operands_)[p.operand];
  if (operand.frame.is_identity) {
    // The same, from what those who ask for planes have looked at.
    const std::array<double, 3>& exact = rounded_[corners_[p.first + at]];
    return {static_cast<int64_t>(exact[0]), static_cast<int64_t>(exact[1]),
            static_cast<int64_t>(exact[2])};
  }
  const LeafGeometry& leaf = *operand.leaf;
  const IVec3& local = leaf.vertices[leaf.corners[leaf.face_starts[p.face] + at]];
  const IVec3& t = operand.translation;
  return {local[0] + t[0], local[1] + t[1], local[2] + t[2]};
}

ReducedPlane Job::reduced_support(uint32_t polygon) const {
  const JobPolygon& p = polygons_[polygon];
  if (const PieceStore* store = store_of(p)) return store->reduced_support(pieces_[p.face]);
  const Plane own = support_of_loop(p.count, [&](uint32_t i) { return leaf_corner(p, i); });
  const FrameMap& map = sources_[p.operand].map;
  return reduce(map.is_identity() ? own : map.plane(own));
}

ReducedPlane Job::reduced_edge(uint32_t polygon, uint32_t edge) const {
  const JobPolygon& p = polygons_[polygon];
  if (const PieceStore* store = store_of(p)) return store->reduced_edge(pieces_[p.face], edge);
  const FrameMap& map = sources_[p.operand].map;
  const auto corner = [&](uint32_t i) { return leaf_corner(p, i); };
  // A mirrored loop runs backwards: its edge from corner j to j + 1 is the leaf's edge n - 2 - j.
  const uint32_t i = map.is_mirrored() ? (2 * p.count - 2 - edge) % p.count : edge;
  const uint32_t turn = p.count == 3 ? 0 : turning_corner(p.count, corner);
  const int axis = dominant_axis(normal_through(corner(turn), corner(turn + 1), corner(turn + 2)));
  const Plane own = csgrun::edge_plane(corner(i), corner(i + 1), axis);
  return reduce(map.is_identity() ? own : map.plane(own));
}

/// The store that a polygon is a piece of, or null.
PieceStore* Job::store_of(const JobPolygon& p) const {
  const auto& pieces = (*operands_)[p.operand].pieces;
  return pieces ? pieces->store.get() : nullptr;
}

/// Whether the support is known; a piece may have got it since the job began.
bool Job::find_support(uint32_t polygon) {
  JobPolygon& p = polygons_[polygon];
  if (p.support.valid()) return true;
  if (const PieceStore* store = store_of(p)) p.support = store->piece(pieces_[p.face]).support;
  return p.support.valid();
}

/// The same of the plane of an edge.
bool Job::find_edge(const PolygonEdge& e) {
  const JobPolygon& p = polygons_[e.polygon];
  uint32_t& plane = edge_planes_[p.first + e.edge];
  if (plane != kNone) return true;
  if (const PieceStore* store = store_of(p)) plane = store->edges(pieces_[p.face])[e.edge];
  return plane != kNone;
}

void Job::take_support(uint32_t polygon, const ReducedPlane& plane) {
  JobPolygon& p = polygons_[polygon];
  PieceStore* const store = store_of(p);
  p.support = store ? store->take_support(pieces_[p.face], plane) : planes_.intern_computed(plane);
}

uint32_t Job::take_edge(const PolygonEdge& e, const ReducedPlane& plane) {
  const JobPolygon& p = polygons_[e.polygon];
  PieceStore* const store = store_of(p);
  return edge_planes_[p.first + e.edge] = store ? store->take_edge(pieces_[p.face], e.edge, plane)
                                                : planes_.intern_computed(plane).index();
}

void Job::ensure_support(uint32_t polygon) {
  if (!find_support(polygon)) take_support(polygon, reduced_support(polygon));
}

uint32_t Job::edge_plane(uint32_t polygon, uint32_t edge) {
  if (!find_edge({polygon, edge})) take_edge({polygon, edge}, reduced_edge(polygon, edge));
  return edge_planes_[polygons_[polygon].first + edge];
}

void Job::ensure_supports(std::span<const uint32_t> polygons) {
  // Most have one already, which several threads may see.
  std::vector<uint32_t> lacking = numbers_where(
      polygons.size(), [&](uint32_t i) { return !polygons_[polygons[i]].support.valid(); });
  for (uint32_t& i : lacking) i = polygons[i];
  std::erase_if(lacking, [&](uint32_t p) { return find_support(p); });
  enter_planes(
      planes_, lacking.size(), [&](size_t i) { return reduced_support(lacking[i]); },
      [&](size_t i, const ReducedPlane& plane) { take_support(lacking[i], plane); });
}

void Job::ensure_edges(std::span<const PolygonEdge> edges) {
  constexpr uint32_t kAsked = kNone - 1;  // stands in for a plane until it is made
  std::vector<PolygonEdge> lacking;
  for (const uint32_t i : numbers_where(edges.size(), [&](uint32_t i) {
         return edge_planes_[polygons_[edges[i].polygon].first + edges[i].edge] == kNone;
       })) {
    if (find_edge(edges[i])) continue;
    edge_planes_[polygons_[edges[i].polygon].first + edges[i].edge] = kAsked;
    lacking.push_back(edges[i]);
  }
  enter_planes(
      planes_, lacking.size(),
      [&](size_t i) { return reduced_edge(lacking[i].polygon, lacking[i].edge); },
      [&](size_t i, const ReducedPlane& plane) { take_edge(lacking[i], plane); });
}

void Job::ensure_planes(std::span<const uint32_t> polygons) {
  ensure_supports(polygons);
  std::vector<PolygonEdge> edges;
  for (const uint32_t p : polygons) {
    for (uint32_t e = 0; e < polygons_[p].count; ++e) edges.push_back({p, e});
  }
  ensure_edges(edges);
}

void Job::ensure_planes(uint32_t polygon) {
  ensure_support(polygon);
  for (uint32_t i = 0; i < polygons_[polygon].count; ++i) edge_plane(polygon, i);
}

}  // namespace csgrun
