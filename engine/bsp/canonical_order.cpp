#include "engine/bsp/canonical_order.h"

#include <algorithm>
#include <atomic>
#include <tuple>

#include "engine/base/counting_order.h"
#include "engine/base/parallel.h"
#include "engine/base/sort_few.h"
#include "engine/bsp/lexicographic.h"

namespace csgrun {
namespace {

std::vector<uint32_t> used_points(const DraftBoundary& draft, size_t point_count) {
  std::vector<uint8_t> used(point_count, 0);
  for_each_range(draft.edges.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      std::atomic_ref(used[draft.edges[i].from]).store(1, std::memory_order_relaxed);
    }
  });
  return numbers_where(point_count, [&](uint32_t p) { return used[p] != 0; });
}

/// The loops of a face, each from its lowest corner, by these.
void sort_loops(DraftBoundary::Face& face, DraftBoundary& draft) {
  struct LoopRef {
    uint32_t begin, end;
  };
  const auto begin_of = [&](uint32_t l) { return draft.loop_starts[face.first_loop + l]; };
  const auto before = [](const DirectedEdge& a, const DirectedEdge& b) {
    return std::tie(a.from, a.to) < std::tie(b.from, b.to);
  };
  std::vector<DirectedEdge>& edges = draft.edges;
  for (uint32_t l = 0; l < face.loop_count; ++l) {
    const auto begin = edges.begin() + begin_of(l), end = edges.begin() + begin_of(l + 1);
    // A loop may pass a point twice: among equal corners the lower successor comes first.
    std::rotate(begin, std::min_element(begin, end, before), end);
  }
  if (face.loop_count < 2) return;
  std::vector<LoopRef> refs;
  for (uint32_t l = 0; l < face.loop_count; ++l) refs.push_back({begin_of(l), begin_of(l + 1)});
  std::sort(refs.begin(), refs.end(), [&](const LoopRef& a, const LoopRef& b) {
    return before(edges[a.begin], edges[b.begin]);
  });
  std::vector<DirectedEdge> sorted;
  std::vector<uint32_t> ends;
  for (const LoopRef& r : refs) {
    sorted.insert(sorted.end(), edges.begin() + r.begin, edges.begin() + r.end);
    ends.push_back(begin_of(0) + static_cast<uint32_t>(sorted.size()));
  }
  std::copy(sorted.begin(), sorted.end(), edges.begin() + begin_of(0));
  std::copy(ends.begin(), ends.end(), draft.loop_starts.begin() + face.first_loop + 1);
}

/// Faces by their lowest edge. Two with the same one lie on either side of one plane or in
/// different planes.
std::vector<uint32_t> face_order(const DraftBoundary& draft, const PlaneTable& planes,
                                 size_t point_count) {
  const auto lowest = [&](size_t f) -> const DirectedEdge& {
    return draft.edges[draft.loop_starts[draft.faces[f].first_loop]];
  };
  CountingOrder by_point;
  by_point.sort(draft.faces.size(), point_count, [&](size_t f) { return lowest(f).from; });
  const auto before = [&](uint32_t i, uint32_t j) {
    const DirectedEdge &u = lowest(i), &v = lowest(j);
    if (u.to != v.to) return u.to < v.to;
    const auto &a = draft.faces[i], &b = draft.faces[j];
    const Plane p = planes.oriented(a.plane), q = planes.oriented(b.plane);
    return std::tie(p.a, p.b, p.c, p.d, a.label) < std::tie(q.a, q.b, q.c, q.d, b.label);
  };
  for_each_range(point_count, [&](size_t begin, size_t end) {
    for (size_t point = begin; point < end; ++point) {
      sort_few(by_point.order.begin() + by_point.starts[point],
               by_point.order.begin() + by_point.starts[point + 1], before);
    }
  });
  return std::move(by_point.order);
}

/// What is needed so many steps later is asked for now: in its order it stands anywhere.
constexpr size_t kFacesAhead = 8;

/// Lines up the faces and their corners. Planes keep their numbers.
void fill_faces(const DraftBoundary& draft, const std::vector<uint32_t>& order,
                BoundaryMesh& mesh) {
  struct Place {
    uint32_t loop, corner;
  };
  RawVector<Place> places(order.size());
  Place next{0, 0};
  for (size_t n = 0; n < order.size(); ++n) {
    const DraftBoundary::Face& face = draft.faces[order[n]];
    places[n] = next;
    next.loop += face.loop_count;
    next.corner +=
        draft.loop_starts[face.first_loop + face.loop_count] - draft.loop_starts[face.first_loop];
  }
  mesh.faces.resize(order.size());
  mesh.loop_starts.resize(next.loop + size_t{1});
  mesh.corners.resize(next.corner);
  for_each_range(order.size(), [&](size_t begin, size_t end) {
    for (size_t n = begin; n < end; ++n) {
      if (n + kFacesAhead < end) {
        const DraftBoundary::Face& soon = draft.faces[order[n + kFacesAhead]];
        __builtin_prefetch(&draft.edges[draft.loop_starts[soon.first_loop]]);
      }
      const DraftBoundary::Face& face = draft.faces[order[n]];
      auto [loop, corner] = places[n];
      mesh.faces[n] = {face.plane, face.label, face.whole, loop, face.loop_count, face.complete};
      for (uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
        for (uint32_t c = draft.loop_starts[l]; c < draft.loop_starts[l + 1]; ++c) {
          mesh.corners[corner++] = {draft.edges[c].from, draft.edges[c].plane};
        }
        mesh.loop_starts[++loop] = corner;
      }
    }
  });
}

/// Numbers the planes as faces and their corners come to them, and names points by three.
void name_by_planes(const PlaneTable& planes, size_t point_count, BoundaryMesh& mesh) {
  std::vector<uint32_t> plane_number(planes.size(), kNone), used_planes;
  const auto local_plane = [&](uint32_t index) {
    if (plane_number[index] == kNone) {
      plane_number[index] = static_cast<uint32_t>(used_planes.size());
      used_planes.push_back(index);
    }
    return plane_number[index];
  };
  mesh.point_planes.assign(point_count, {kNone, kNone, kNone});
  for (BoundaryMesh::Face& face : mesh.faces) {
    const uint32_t support = local_plane(face.plane.index());
    face.plane = PlaneId(support, face.plane.flipped());
    for (uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      const uint32_t begin = mesh.loop_starts[l], end = mesh.loop_starts[l + 1];
      uint32_t before = kNone;  // the plane before the first one is met last
      for (uint32_t c = begin; c < end; ++c) {
        BoundaryMesh::Corner& corner = mesh.corners[c];
        const uint32_t edge_plane = local_plane(corner.edge_plane);
        auto& named = mesh.point_planes[corner.point];
        // A true corner: the planes of its two edges and of the face meet in it alone.
        if (named[0] == kNone) {
          named = {support, c > begin ? before : local_plane(mesh.corners[end - 1].edge_plane),
                   edge_plane};
        }
        before = corner.edge_plane = edge_plane;
      }
    }
  }
  mesh.planes.resize(used_planes.size());
  for_each_range(used_planes.size(), [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p) {
      if (p + kFacesAhead < end) __builtin_prefetch(&planes.plane(used_planes[p + kFacesAhead]));
      mesh.planes[p] = planes.plane(used_planes[p]);
    }
  });
}

}  // namespace

BoundaryMesh canonical(CellGeometry& geometry, const PlaneTable& planes, DraftBoundary draft,
                       std::vector<uint32_t>* number_of_point) {
  BoundaryMesh mesh;
  const std::vector<uint32_t> used = used_points(draft, geometry.point_count());
  const std::vector<uint32_t> points = lexicographic_order(
      used.size(),
      [&](uint32_t i) -> const std::array<double, 3>& { return geometry.point(used[i]).rounded; },
      [&](uint32_t i, uint32_t j) {
        // Doubles cannot tell them apart: exactly.
        return compare(geometry.value(used[i]), geometry.value(used[j])) < 0;
      });
  std::vector<uint32_t> number(geometry.point_count(), kNone);
  mesh.point_rounded.resize(points.size());
  for_each_range(points.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      number[used[points[i]]] = static_cast<uint32_t>(i);
      mesh.point_rounded[i] = geometry.point(used[points[i]]).rounded;
    }
  });
  for_each_range(draft.edges.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      DirectedEdge& e = draft.edges[i];
      e.from = number[e.from], e.to = number[e.to];
    }
  });
  for_each_range(draft.faces.size(), [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) sort_loops(draft.faces[f], draft);
  });
  fill_faces(draft, face_order(draft, planes, points.size()), mesh);
  draft = DraftBoundary();  // of the size of the result
  name_by_planes(planes, points.size(), mesh);
  if (number_of_point != nullptr) *number_of_point = std::move(number);
  return mesh;
}

}  // namespace csgrun
