#include "engine/mesh/merge_faces.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <tuple>

#include "engine/base/counting_order.h"
#include "engine/base/in_order.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/base/sort_few.h"
#include "engine/mesh/connected_pieces.h"
#include "engine/mesh/nest_loops.h"

namespace csgrun {
namespace {

constexpr uint32_t kUnseen = ~0u, kMixed = ~0u - 1;

/// Per point: the source all of whose whole facets meet there, or kMixed.
std::vector<uint32_t> sources_at_points(const BoundaryMesh& b) {
  std::vector<uint32_t> state(b.point_planes.size(), kUnseen);
  for (const BoundaryMesh::Face& f : b.faces) {
    for (uint32_t c = b.loop_starts[f.first_loop]; c < b.loop_starts[f.first_loop + f.loop_count];
         ++c) {
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
  for (uint32_t c = b.loop_starts[f.first_loop]; c < b.loop_starts[f.first_loop + f.loop_count];
       ++c) {
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

  [[nodiscard]] bool goes_with(const Group& o) const {
    return plane == o.plane && appearance == o.appearance && curved == o.curved && keep == o.keep;
  }
};

class FaceMerger {
 public:
  FaceMerger(const BoundaryMesh& boundary, const CellGeometry& geometry, const PlaneTable& planes,
             std::vector<MergedFace>& faces)
      : boundary_(boundary),
        points_(geometry),
        planes_(planes),
        faces_(faces),
        builder_(geometry, planes) {}

  /// The faces of one group.
  bool add(std::span<const Group> group) {
    if (group.size() == 1) {
      if (!add_plain(group[0])) add_alone(group[0]);
      return true;
    }
    const auto label = [&](const Group& g) { return boundary_.faces[g.face].label; };
    const FaceLabel first = label(group[0]);
    const bool is_of_one = std::all_of(group.begin(), group.end(), [&](const Group& g) {
      return label(g).source == first.source && label(g).surface == first.surface;
    });
    return is_of_one ? add_as_one(group) : add_connected(group);
  }

 private:
  /// A connected part of a face of the boundary.
  struct Piece {
    FaceLabel label;
    std::vector<std::vector<DirectedEdge>> loops;  ///< the outer one first
  };

  /// A face by itself of one loop is what it was. False for all others.
  bool add_plain(const Group& group) {
    const BoundaryMesh::Face& face = boundary_.faces[group.face];
    if (face.loop_count != 1) return false;
    edges_.clear();
    append_edges(face, edges_);
    add_face(group, face.label, FaceLoops(edges_));
    return true;
  }

  /// A face by itself is what it was, but that its parts are faces of their own.
  void add_alone(const Group& group) {
    for (const auto& nested : parts_of(group)) {
      add_face(group, boundary_.faces[group.face].label, FaceLoops(nested));
    }
  }

  bool add_as_one(std::span<const Group> group) {
    edges_.clear();
    for (const Group& g : group) append_edges(boundary_.faces[g.face], edges_);
    if (!builder_.build(group[0].plane, edges_, loops_)) return false;
    add_region(group[0], boundary_.faces[group[0].face].label);
    return true;
  }

  /// Pieces that do not hang together are different faces, each from the lowest label within it.
  bool add_connected(std::span<const Group> group) {
    std::vector<Piece> pieces;
    for (const Group& g : group) {
      for (auto& nested : parts_of(g)) {
        pieces.push_back({boundary_.faces[g.face].label, std::move(nested)});
      }
    }
    std::vector<PieceEdge> edges;
    for (uint32_t p = 0; p < pieces.size(); ++p) {
      for (const auto& loop : pieces[p].loops) {
        for (const DirectedEdge& e : loop) edges.push_back({e, p});
      }
    }
    UnionFind connected(pieces.size());
    if (!join_neighbours(group[0].plane, edges, points_, planes_, connected)) return false;
    CountingOrder by_root, edges_by_root;
    by_root.sort(pieces.size(), pieces.size(),
                 [&](size_t p) { return connected.find(static_cast<uint32_t>(p)); });
    edges_by_root.sort(edges.size(), pieces.size(),
                       [&](size_t e) { return connected.find(edges[e].piece); });
    for (size_t root = 0; root < pieces.size(); ++root) {
      const uint32_t begin = by_root.starts[root], end = by_root.starts[root + 1];
      if (begin == end) continue;
      FaceLabel lowest = pieces[root].label;
      if (end - begin == 1) {
        add_face(group[0], lowest, FaceLoops(pieces[root].loops));
        continue;
      }
      for (uint32_t i = begin; i < end; ++i) {
        lowest = std::min(lowest, pieces[by_root.order[i]].label);
      }
      edges_.clear();
      for (uint32_t i = edges_by_root.starts[root]; i < edges_by_root.starts[root + 1]; ++i) {
        edges_.push_back(edges[edges_by_root.order[i]].edge);
      }
      if (!builder_.build_single(group[0].plane, edges_, loops_)) return false;
      add_region(group[0], lowest);
    }
    return true;
  }

  /// The region that `loops_` bound, of several pieces.
  void add_region(const Group& group, const FaceLabel& label) {
    for (const auto& nested : nest_loops(group.plane, loops_, points_, planes_)) {
      add_face(group, label, FaceLoops(nested));
    }
  }

  void add_face(const Group& group, const FaceLabel& label, FaceLoops loops) {
    faces_.push_back({group.plane, group.appearance, label.surface, label.source, group.keep != 0,
                      std::move(loops)});
  }

  void append_edges(const BoundaryMesh::Face& face, std::vector<DirectedEdge>& edges) const {
    const BoundaryMesh& b = boundary_;
    for (uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      const uint32_t begin = b.loop_starts[l], end = b.loop_starts[l + 1];
      for (uint32_t c = begin; c < end; ++c) {
        edges.push_back({b.corners[c].point, b.corners[c + 1 < end ? c + 1 : begin].point,
                         b.corners[c].edge_plane});
      }
    }
  }

  /// The connected parts of a face of the boundary; its loops are those of a region already.
  std::vector<std::vector<std::vector<DirectedEdge>>> parts_of(const Group& group) {
    const BoundaryMesh& b = boundary_;
    const BoundaryMesh::Face& face = b.faces[group.face];
    loops_.clear();
    append_edges(face, loops_.edges);
    for (uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      loops_.starts.push_back(b.loop_starts[l + 1] - b.loop_starts[face.first_loop]);
    }
    return nest_loops(group.plane, loops_, points_, planes_);
  }

  const BoundaryMesh& boundary_;
  PointView points_;
  const PlaneTable& planes_;
  std::vector<MergedFace>& faces_;
  RegionBuilder builder_;
  RegionLoops loops_;
  std::vector<DirectedEdge> edges_;
};

/// The faces of a boundary by what they may be merged with.
RawVector<Group> group_faces(const BoundaryMesh& b, const PlaneTable& planes) {
  const std::vector<uint32_t> state = sources_at_points(b);
  const auto plane = [&](size_t i) { return b.faces[i].plane; };
  CountingOrder by_plane;
  by_plane.sort(b.faces.size(), planes.size(), [&](size_t i) { return plane(i).index(); });
  RawVector<Group> groups(b.faces.size());
  for_each_range(planes.size(), [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p) {
      const uint32_t first = by_plane.starts[p], last = by_plane.starts[p + 1];
      for (uint32_t k = first; k < last; ++k) {
        const uint32_t i = by_plane.order[k];
        const BoundaryMesh::Face& f = b.faces[i];
        groups[k] = {plane(i), f.label.appearance, f.label.surface != 0,
                     untouched(b, f, state) ? i + 1 : 0, i};
      }
      sort_few(groups.begin() + first, groups.begin() + last, [](const Group& x, const Group& y) {
        return std::tie(x.plane, x.appearance, x.curved, x.keep, x.face) <
               std::tie(y.plane, y.appearance, y.curved, y.keep, y.face);
      });
    }
  });
  return groups;
}

/// Puts elements in the order of their numbers, which are forgotten. In place: a second list would
/// take as much memory again.
template <class T>
void put_in_order(std::vector<uint32_t>& order, std::vector<T>& elements) {
  for (uint32_t start = 0; start < order.size(); ++start) {
    if (order[start] == start) continue;
    T first = std::move(elements[start]);
    uint32_t at = start;
    for (uint32_t from = order[at]; from != start; from = order[at]) {
      elements[at] = std::move(elements[from]);
      order[at] = at;
      at = from;
    }
    elements[at] = std::move(first);
    order[at] = at;
  }
}

}  // namespace

bool merge_faces(const BoundaryMesh& b, const CellGeometry& geometry, const PlaneTable& planes,
                 std::vector<MergedFace>& faces) {
  constexpr size_t kFacesPerPart = 4096;
  const RawVector<Group> groups = group_faces(b, planes);
  const auto end_of = [&](size_t i) {  // of the group that begins there
    size_t end = i;
    while (end < groups.size() && groups[end].goes_with(groups[i])) ++end;
    return end;
  };
  std::vector<size_t> starts;  // of parts with whole groups
  for (size_t i = 0, next = 0; i < groups.size(); i = end_of(i)) {
    if (i < next) continue;
    starts.push_back(i);
    next = i + kFacesPerPart;
  }
  const size_t parts = starts.size();
  starts.push_back(groups.size());
  std::vector<std::vector<MergedFace>> made(parts);
  std::vector<uint8_t> is_open(parts, 0);
  faces.reserve(groups.size());  // and hardly ever more
  make_parts_in_order(
      parts,
      [&](size_t part) {
        made[part].reserve(starts[part + 1] - starts[part]);
        FaceMerger merger(b, geometry, planes, made[part]);
        for (size_t i = starts[part], j = i; i < starts[part + 1]; i = j) {
          j = end_of(i);
          if (!merger.add({groups.data() + i, j - i})) is_open[part] = 1;
        }
      },
      [&](size_t part) {
        std::move(made[part].begin(), made[part].end(), std::back_inserter(faces));
        made[part] = std::vector<MergedFace>();
      });
  if (std::find(is_open.begin(), is_open.end(), 1) != is_open.end()) return false;
  sort_faces(faces, planes);
  return true;
}

void sort_faces(std::vector<MergedFace>& faces, const PlaneTable& planes) {
  const auto begin_at_lowest = [](MergedFace& f) {
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
  };
  for_each_range(faces.size(), [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) begin_at_lowest(faces[f]);
  });
  uint32_t last_point = 0;
  for (const MergedFace& f : faces) last_point = std::max(last_point, f.loops[0][0].from);
  CountingOrder by_point;
  by_point.sort(faces.size(), size_t{last_point} + 1,
                [&](size_t f) { return faces[f].loops[0][0].from; });
  const auto before = [&](uint32_t f, uint32_t g) {
    const MergedFace &x = faces[f], &y = faces[g];
    const DirectedEdge &u = x.loops[0][0], &v = y.loops[0][0];
    if (u.to != v.to) return u.to < v.to;
    const Plane p = planes.oriented(x.plane), q = planes.oriented(y.plane);
    return std::tie(p.a, p.b, p.c, p.d, x.appearance, x.surface) <
           std::tie(q.a, q.b, q.c, q.d, y.appearance, y.surface);
  };
  for_each_range(size_t{last_point} + 1, [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p) {
      sort_few(by_point.order.begin() + by_point.starts[p],
               by_point.order.begin() + by_point.starts[p + 1], before);
    }
  });
  put_in_order(by_point.order, faces);
}

}  // namespace csgrun
