#include "engine/bsp/canonical_order.h"

#include <algorithm>
#include <numeric>

namespace csgrun {
namespace {

std::vector<uint32_t> used_points(const DraftBoundary& draft) {
  std::vector<uint32_t> points;
  for (const auto& face : draft.faces) {
    for (const DirectedEdge& e : face.loops.edges) points.push_back(e.from);
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

}  // namespace

BoundaryMesh canonical(CellGeometry& geometry, const PlaneTable& planes, DraftBoundary draft,
                       std::vector<uint32_t>* number_of_point) {
  BoundaryMesh mesh;
  std::vector<uint32_t> points = used_points(draft);
  std::sort(points.begin(), points.end(), [&](uint32_t p, uint32_t q) {
    const auto &a = geometry.point(p).rounded, &b = geometry.point(q).rounded;
    if (a != b) return a < b;
    // Doubles cannot tell them apart on some axes: exactly.
    for (int axis = 0; axis < 3; ++axis) {
      if (const int order = geometry.compare_along(p, q, axis)) return order < 0;
    }
    return false;
  });
  std::vector<uint32_t> number(geometry.point_count(), kNone);
  for (uint32_t i = 0; i < points.size(); ++i) {
    number[points[i]] = i;
    mesh.point_rounded.push_back(geometry.point(points[i]).rounded);
  }

  // Loops in new numbers, each from its lowest corner.
  struct LoopRef {
    uint32_t face, begin, end;
  };
  for (auto& face : draft.faces) {
    RegionLoops sorted;
    std::vector<LoopRef> refs;
    auto& edges = face.loops.edges;
    for (DirectedEdge& e : edges) e.from = number[e.from], e.to = number[e.to];
    for (size_t l = 0; l < face.loops.loop_count(); ++l) {
      const auto begin = edges.begin() + face.loops.starts[l];
      const auto end = edges.begin() + face.loops.starts[l + 1];
      // A loop may pass a point twice: among equal corners the lower successor comes first.
      const auto lowest = std::min_element(begin, end, [](const auto& a, const auto& b) {
        return std::tie(a.from, a.to) < std::tie(b.from, b.to);
      });
      std::rotate(begin, lowest, end);
      refs.push_back({0, face.loops.starts[l], face.loops.starts[l + 1]});
    }
    std::sort(refs.begin(), refs.end(), [&](const LoopRef& a, const LoopRef& b) {
      return std::tie(edges[a.begin].from, edges[a.begin].to) <
             std::tie(edges[b.begin].from, edges[b.begin].to);
    });
    for (const LoopRef& r : refs) {
      sorted.edges.insert(sorted.edges.end(), edges.begin() + r.begin, edges.begin() + r.end);
      sorted.starts.push_back(static_cast<uint32_t>(sorted.edges.size()));
    }
    face.loops = std::move(sorted);
  }
  std::vector<uint32_t> order(draft.faces.size());
  std::iota(order.begin(), order.end(), 0u);
  // Two faces with the same lowest edge lie on either side of one plane or in different planes.
  std::sort(order.begin(), order.end(), [&](uint32_t i, uint32_t j) {
    const auto &a = draft.faces[i], &b = draft.faces[j];
    const auto &u = a.loops.edges[0], &v = b.loops.edges[0];
    if (u.from != v.from) return u.from < v.from;
    if (u.to != v.to) return u.to < v.to;
    const Plane p = planes.oriented(a.plane), q = planes.oriented(b.plane);
    return std::tie(p.a, p.b, p.c, p.d, a.label) < std::tie(q.a, q.b, q.c, q.d, b.label);
  });

  std::vector<uint32_t> plane_number(planes.size(), kNone);
  const auto local_plane = [&](uint32_t index) {
    if (plane_number[index] == kNone) {
      plane_number[index] = static_cast<uint32_t>(mesh.planes.size());
      mesh.planes.push_back(planes.plane(index));
    }
    return plane_number[index];
  };
  mesh.point_planes.assign(points.size(), {kNone, kNone, kNone});
  for (const uint32_t f : order) {
    const auto& face = draft.faces[f];
    const uint32_t support = local_plane(face.plane.index());
    BoundaryMesh::Face out{PlaneId(support, face.plane.flipped()),
                           face.label,
                           face.whole,
                           static_cast<uint32_t>(mesh.loop_starts.size() - 1),
                           static_cast<uint32_t>(face.loops.loop_count()),
                           face.complete};
    for (size_t l = 0; l < face.loops.loop_count(); ++l) {
      const uint32_t begin = face.loops.starts[l], end = face.loops.starts[l + 1];
      for (uint32_t c = begin; c < end; ++c) {
        const DirectedEdge& e = face.loops.edges[c];
        const uint32_t edge_plane = local_plane(e.plane);
        const DirectedEdge& before = face.loops.edges[c > begin ? c - 1 : end - 1];
        auto& named = mesh.point_planes[e.from];
        // A true corner: the planes of its two edges and of the face meet in it alone.
        if (named[0] == kNone) named = {support, local_plane(before.plane), edge_plane};
        mesh.corners.push_back({e.from, edge_plane});
      }
      mesh.loop_starts.push_back(static_cast<uint32_t>(mesh.corners.size()));
    }
    mesh.faces.push_back(out);
  }
  if (number_of_point != nullptr) *number_of_point = std::move(number);
  return mesh;
}

}  // namespace csgrun
