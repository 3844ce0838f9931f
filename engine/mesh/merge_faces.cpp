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

/// The end of the group that begins there.
size_t end_of_group(const std::vector<Group>& groups, size_t begin) {
  size_t end = begin;
  while (end < groups.size() && groups[end].goes_with(groups[begin])) ++end;
  return end;
}

class FaceMerger {
 public:
  FaceMerger(const BoundaryMesh& boundary, const CellGeometry& geometry, const PlaneTable& planes,
             std::vector<MergedFace>& faces)
      : boundary_(boundary),
        points_(geometry),
        planes_(planes),
        faces_(faces),
        builder_(geometry, planes) {}

  /// A face of one loop, by itself, is what it was.
  void add_plain(const BoundaryMesh::Face& face, bool is_kept) {
    edges_.clear();
    append_edges(face, edges_);
    faces_.push_back({face.plane, face.label.appearance, face.label.surface, face.label.source,
                      is_kept, FaceLoops(edges_)});
  }

  /// The faces of one group.
  bool add(std::span<const Group> group) {
    if (group.size() == 1) {
      add_alone(group[0]);
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

/// The faces of a boundary by what becomes of them.
struct Groups {
  Groups(const BoundaryMesh& b, const PlaneTable& planes);

  enum Alone : uint8_t { kNot, kAlone, kKept };
  /// Per face: whether it is of one loop and goes with no other, and whether it is kept apart.
  std::vector<Alone> alone;
  /// The others; what goes together stands together.
  std::vector<Group> others;
};

Groups::Groups(const BoundaryMesh& b, const PlaneTable& planes) : alone(b.faces.size(), kNot) {
  constexpr size_t kPlanesPerPart = 4096;
  const std::vector<uint32_t> state = sources_at_points(b);
  CountingOrder by_plane;
  by_plane.sort(b.faces.size(), planes.size(), [&](size_t i) { return b.faces[i].plane.index(); });
  const auto group_of = [&](uint32_t i) {
    const BoundaryMesh::Face& f = b.faces[i];
    return Group{f.plane, f.label.appearance, f.label.surface != 0,
                 untouched(b, f, state) ? i + 1 : 0, i};
  };
  std::vector<std::vector<Group>> made(part_count(planes.size(), kPlanesPerPart));
  make_parts_in_order(
      made.size(),
      [&](size_t part) {
        const size_t begin = part * kPlanesPerPart;
        const size_t end = std::min(begin + kPlanesPerPart, planes.size());
        std::vector<Group> of_plane;
        for (size_t p = begin; p < end; ++p) {
          of_plane.clear();
          for (uint32_t k = by_plane.starts[p]; k < by_plane.starts[p + 1]; ++k) {
            of_plane.push_back(group_of(by_plane.order[k]));
          }
          sort_few(of_plane.begin(), of_plane.end(), [](const Group& x, const Group& y) {
            return std::tie(x.plane, x.appearance, x.curved, x.keep, x.face) <
                   std::tie(y.plane, y.appearance, y.curved, y.keep, y.face);
          });
          for (size_t i = 0, j = 0; i < of_plane.size(); i = j) {
            j = end_of_group(of_plane, i);
            const Group& first = of_plane[i];
            if (j - i == 1 && b.faces[first.face].loop_count == 1) {
              alone[first.face] = first.keep != 0 ? kKept : kAlone;
            } else {
              made[part].insert(made[part].end(), of_plane.begin() + i, of_plane.begin() + j);
            }
          }
        }
      },
      [&](size_t part) {
        others.insert(others.end(), made[part].begin(), made[part].end());
        made[part] = std::vector<Group>();
      });
}

constexpr size_t kFacesPerPart = 4096;

/// Makes faces of groups. False when a region does not close.
bool merge_groups(const BoundaryMesh& b, const CellGeometry& geometry, const PlaneTable& planes,
                  const std::vector<Group>& groups, std::vector<MergedFace>& faces) {
  std::vector<size_t> starts;  // of parts with whole groups
  for (size_t i = 0, next = 0; i < groups.size(); i = end_of_group(groups, i)) {
    if (i < next) continue;
    starts.push_back(i);
    next = i + kFacesPerPart;
  }
  const size_t parts = starts.size();
  starts.push_back(groups.size());
  std::vector<std::vector<MergedFace>> made(parts);
  std::vector<uint8_t> is_open(parts, 0);
  make_parts_in_order(
      parts,
      [&](size_t part) {
        FaceMerger merger(b, geometry, planes, made[part]);
        for (size_t i = starts[part], j = i; i < starts[part + 1]; i = j) {
          j = end_of_group(groups, i);
          if (!merger.add({groups.data() + i, j - i})) is_open[part] = 1;
        }
      },
      [&](size_t part) {
        std::move(made[part].begin(), made[part].end(), std::back_inserter(faces));
        made[part] = std::vector<MergedFace>();
      });
  return std::find(is_open.begin(), is_open.end(), 1) == is_open.end();
}

/// The canonical order of faces whose loops begin where they are lowest.
bool comes_before(const MergedFace& x, const MergedFace& y, const PlaneTable& planes) {
  const DirectedEdge &u = x.loops[0][0], &v = y.loops[0][0];
  if (u.from != v.from) return u.from < v.from;
  if (u.to != v.to) return u.to < v.to;
  const Plane p = planes.oriented(x.plane), q = planes.oriented(y.plane);
  return std::tie(p.a, p.b, p.c, p.d, x.appearance, x.surface) <
         std::tie(q.a, q.b, q.c, q.d, y.appearance, y.surface);
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
  const Groups groups(b, planes);
  std::vector<MergedFace> others;
  if (!merge_groups(b, geometry, planes, groups.others, others)) return false;
  sort_faces(others, planes);
  if (std::all_of(groups.alone.begin(), groups.alone.end(),
                  [](Groups::Alone alone) { return alone == Groups::kNot; })) {
    faces = std::move(others);
    return true;
  }
  // Those that stay alone are in order: where a boundary's are.
  faces.reserve(b.faces.size());  // and hardly ever more
  auto next = others.begin();
  std::vector<std::vector<MergedFace>> made(part_count(b.faces.size(), kFacesPerPart));
  make_parts_in_order(
      made.size(),
      [&](size_t part) {
        FaceMerger merger(b, geometry, planes, made[part]);
        const size_t begin = part * kFacesPerPart;
        const size_t end = std::min(begin + kFacesPerPart, b.faces.size());
        for (size_t f = begin; f < end; ++f) {
          if (groups.alone[f]) merger.add_plain(b.faces[f], groups.alone[f] == Groups::kKept);
        }
      },
      [&](size_t part) {
        for (MergedFace& face : made[part]) {
          while (next != others.end() && comes_before(*next, face, planes)) {
            faces.push_back(std::move(*next++));
          }
          faces.push_back(std::move(face));
        }
        made[part] = std::vector<MergedFace>();
      });
  std::move(next, others.end(), std::back_inserter(faces));
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
    return comes_before(faces[f], faces[g], planes);
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
