#include "engine/mesh/merge_faces.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "engine/mesh/nest_loops.h"

namespace csgrun {
namespace {

constexpr uint32_t kUnseen = ~0u, kMixed = ~0u - 1;

/// Per point: the source all of whose whole facets meet there, or kMixed.
std::vector<uint32_t> sources_at_points(const BoundaryMesh& b) {
  std::vector<uint32_t> state(b.point_planes.size(), kUnseen);
  for (const BoundaryMesh::Face& f : b.faces) {
    for (uint32_t c = b.loop_starts[f.first_loop]; c < b.loop_starts[f.first_loop + f.loop_count]; ++c) {
      uint32_t& s = state[b.corners[c].point];
      if (!f.whole || (s != kUnseen && s != f.label.source)) {
        s = kMixed;
      } else {
        s = f.label.source;
      }
    }
  }
  return state;
}

bool untouched(const BoundaryMesh& b, const BoundaryMesh::Face& f,
               const std::vector<uint32_t>& state) {
  if (!f.whole) return false;
  for (uint32_t c = b.loop_starts[f.first_loop]; c < b.loop_starts[f.first_loop + f.loop_count]; ++c) {
    if (state[b.corners[c].point] == kMixed) return false;
  }
  return true;
}

struct Group {
  PlaneId plane;
  uint32_t appearance;
  bool curved;
  uint32_t keep;  ///< 0: merge; else 1 + face, kept apart
  uint32_t face;
};

}  // namespace

bool merge_faces(const BoundaryMesh& b, CellGeometry& geometry, const PlaneTable& planes,
                 const std::vector<PlaneId>& plane_of, std::vector<MergedFace>& faces) {
  const std::vector<uint32_t> state = sources_at_points(b);
  std::vector<Group> groups;
  groups.reserve(b.faces.size());
  for (uint32_t i = 0; i < b.faces.size(); ++i) {
    const BoundaryMesh::Face& f = b.faces[i];
    const PlaneId mapped = plane_of[f.plane.index()];
    groups.push_back({f.plane.flipped() ? mapped.flip() : mapped, f.label.appearance,
                      f.label.surface != 0, untouched(b, f, state) ? i + 1 : 0, i});
  }
  std::sort(groups.begin(), groups.end(), [](const Group& x, const Group& y) {
    return std::tie(x.plane, x.appearance, x.curved, x.keep, x.face) <
           std::tie(y.plane, y.appearance, y.curved, y.keep, y.face);
  });
  RegionBuilder builder(geometry, planes);
  RegionLoops loops;
  std::vector<DirectedEdge> edges;
  for (size_t i = 0; i < groups.size();) {
    size_t j = i;
    edges.clear();
    FaceLabel lowest = b.faces[groups[i].face].label;
    while (j < groups.size() && groups[j].plane == groups[i].plane &&
           groups[j].appearance == groups[i].appearance && groups[j].curved == groups[i].curved &&
           groups[j].keep == groups[i].keep) {
      const BoundaryMesh::Face& f = b.faces[groups[j++].face];
      lowest = std::min(lowest, f.label);
      for (uint32_t l = f.first_loop; l < f.first_loop + f.loop_count; ++l) {
        const uint32_t begin = b.loop_starts[l], end = b.loop_starts[l + 1];
        for (uint32_t c = begin; c < end; ++c) {
          edges.push_back({b.corners[c].point, b.corners[c + 1 < end ? c + 1 : begin].point,
                           plane_of[b.corners[c].edge_plane].index()});
        }
      }
    }
    const bool built = j - i == 1 ? builder.build_single(groups[i].plane, edges, loops)
                                  : builder.build(groups[i].plane, edges, loops);
    if (!built) return false;
    for (auto& nested : nest_loops(groups[i].plane, loops, geometry, planes)) {
      faces.push_back({groups[i].plane, lowest.appearance, lowest.surface, lowest.source,
                       groups[i].keep != 0, std::move(nested)});
    }
    i = j;
  }
  sort_faces(faces, planes);
  return true;
}

void sort_faces(std::vector<MergedFace>& faces, const PlaneTable& planes) {
  for (MergedFace& f : faces) {
    for (auto& loop : f.loops) {
      std::rotate(loop.begin(),
                  std::min_element(loop.begin(), loop.end(),
                                   [](const DirectedEdge& x, const DirectedEdge& y) {
                                     return std::tie(x.from, x.to) < std::tie(y.from, y.to);
                                   }),
                  loop.end());
    }
    std::sort(f.loops.begin() + 1, f.loops.end(), [](const auto& x, const auto& y) {
      return std::tie(x[0].from, x[0].to) < std::tie(y[0].from, y[0].to);
    });
  }
  std::sort(faces.begin(), faces.end(), [&](const MergedFace& x, const MergedFace& y) {
    const DirectedEdge &u = x.loops[0][0], &v = y.loops[0][0];
    if (u.from != v.from) return u.from < v.from;
    if (u.to != v.to) return u.to < v.to;
    const Plane p = planes.oriented(x.plane), q = planes.oriented(y.plane);
    return std::tie(p.a, p.b, p.c, p.d, x.appearance, x.surface) <
           std::tie(q.a, q.b, q.c, q.d, y.appearance, y.surface);
  });
}

}  // namespace csgrun
