#include "engine/mesh/vertex_fans.h"

#include <algorithm>
#include <atomic>
#include <span>

#include "engine/base/counting_order.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/mesh/fan_parts.h"
#include "engine/mesh/simple_fans.h"
#include "engine/mesh/sorted_edges.h"

namespace csgrun {
namespace {

/// The sheets around one edge, as half-planes named by their outward normals.
struct Sheet {
  uint32_t half_edge;
  uint32_t face;
  bool forward;  ///< runs along the edge from its lower to its higher point
  Plane normal;  ///< turned by 180 degrees for backward half-edges, so that its direction is the
                 ///< sheet's own turned by 90 degrees about the edge
  int half = 0;
};

class RadialOrder {
 public:
  /// `along`: an axis on which the edge's direction is not zero, and its sign there.
  explicit RadialOrder(LineAxis along) : along_(along) {}

  /// Sign of (a x b) . direction: +1 when b is less than 180 degrees counter-clockwise of a.
  [[nodiscard]] int turn(const Plane& a, const Plane& b) const {
    using N = Int<2>;
    const auto minor = [](Int128 p, Int128 q, Int128 r, Int128 s) {
      return (multiply<4>(N::from_int128(p), N::from_int128(s)) -
              multiply<4>(N::from_int128(q), N::from_int128(r)))
          .sign();
    };
    const int cross = along_.axis == 0   ? minor(a.b, a.c, b.b, b.c)
                      : along_.axis == 1 ? minor(a.c, a.a, b.c, b.a)
                                         : minor(a.a, a.b, b.a, b.b);
    return cross * along_.sign;
  }

 private:
  LineAxis along_;
};

int dot_sign(const Plane& a, const Plane& b) {
  using N = Int<2>;
  const auto product = [](Int128 p, Int128 q) {
    return multiply<4>(N::from_int128(p), N::from_int128(q));
  };
  return (product(a.a, b.a) + product(a.b, b.b) + product(a.c, b.c)).sign();
}

void make_twins(std::vector<uint32_t>& twin, uint32_t a, uint32_t b) {
  twin[a] = b;
  twin[b] = a;
}

/// Pairs the sheets around an edge: material lies clockwise of a forward sheet (seen with the edge
/// pointing at the viewer) and counter-clockwise of a backward one, so a backward sheet's partner
/// is the next forward one counter-clockwise, or, if solids are to be joined, a forward sheet's
/// partner the next backward one. A face that the edge only touches has no sheets here, and two
/// backward ones may follow each other: then they pair as brackets do. REQUIRES: as many forward as
/// backward ones.
void pair_sheets(std::vector<Sheet>& sheets, const RadialOrder& order, ContactRule contacts,
                 std::vector<uint32_t>& twin) {
  const bool join = contacts == ContactRule::kJoin;
  // A face that the edge runs through, and that all others touch from one side, is not parted:
  // where its diagonals are must not matter.
  for (const Sheet& s : sheets) {
    if (!s.forward || twin[s.half_edge] != kNone) continue;
    for (const Sheet& t : sheets) {
      if (t.forward || t.face != s.face || twin[t.half_edge] != kNone) continue;
      int left = 0, right = 0;
      for (const Sheet& o : sheets) {
        if (o.face == s.face) continue;
        const int turn = order.turn(s.normal, o.normal);
        left += turn > 0;
        right += turn < 0;
      }
      if (left == 0 || right == 0) make_twins(twin, s.half_edge, t.half_edge);
      break;
    }
  }
  const Sheet first = sheets[0];
  for (Sheet& s : sheets) {
    const int t = order.turn(first.normal, s.normal);
    s.half = t > 0 || (t == 0 && dot_sign(first.normal, s.normal) > 0) ? 0 : 1;
  }
  std::stable_sort(sheets.begin(), sheets.end(), [&](const Sheet& a, const Sheet& b) {
    if (a.half != b.half) return a.half < b.half;
    return order.turn(a.normal, b.normal) > 0;
  });
  // Twice around: the first time closes what was opened before the start.
  std::vector<uint32_t> open;
  for (size_t i = 0; i < 2 * sheets.size(); ++i) {
    const Sheet& s = sheets[i % sheets.size()];
    if (twin[s.half_edge] != kNone) continue;
    if (s.forward == join) {
      if (i < sheets.size()) open.push_back(s.half_edge);
    } else if (!open.empty()) {
      make_twins(twin, s.half_edge, open.back());
      open.pop_back();
    }
  }
}

/// The half-edges of triangles, and then the edges of the rim.
RawVector<EdgePoints> half_edges_and_rim(const TriangleSet& set, const WholeOrder& whole) {
  const size_t half_edges = set.triangles.size() * 3;
  RawVector<EdgePoints> ends(half_edges + whole.rim().size());
  for_each_range(set.triangles.size(), [&](size_t begin, size_t end) {
    for (size_t t = begin; t < end; ++t) {
      const auto [a, b, c] = set.triangles[t];
      ends[3 * t] = {a, b};
      ends[3 * t + 1] = {b, c};
      ends[3 * t + 2] = {c, a};
    }
  });
  for (size_t i = 0; i < whole.rim().size(); ++i) {
    ends[half_edges + i] = {whole.rim()[i].from, whole.rim()[i].to};
  }
  return ends;
}

/// `ends`: see above. `crowded`: the forward half-edges of each edge where more than two triangles
/// meet. On the rim of what is untouched a half-edge has no twin.
bool find_twins(const TriangleSet& set, const RawVector<EdgePoints>& ends,
                const std::vector<MergedFace>& faces, CellGeometry& geometry,
                const PlaneTable& planes, ContactRule contacts, std::vector<uint32_t>& twin,
                std::vector<std::vector<uint32_t>>& crowded) {
  const auto half_edges = static_cast<uint32_t>(set.triangles.size() * 3);
  const SortedEdges sorted(ends, geometry.point_count());
  using Bundle = SortedEdges::Bundle;
  twin.assign(half_edges, kNone);
  // Two are paired at once; where several edges meet, they are listed.
  std::atomic<bool> is_closed = true;
  const auto pair = [&](size_t begin, size_t end, std::vector<Bundle>& several) {
    sorted.each_bundle(begin, end, [&](const Bundle& bundle) {
      const bool are_two = bundle.edges.size() == 2;
      const bool is_rim = bundle.edges.back().number() >= half_edges;
      if (!is_balanced(bundle) || (is_rim && !are_two)) is_closed = false;
      if (!are_two) {
        several.push_back(bundle);
      } else if (!is_rim) {
        make_twins(twin, bundle.edges[0].number(), bundle.edges[1].number());
      }
    });
  };
  const std::vector<Bundle> several =
      list_in_parts<Bundle>(geometry.point_count(), kFewForThreads, pair);
  if (!is_closed) return false;
  std::vector<Sheet> sheets;
  for (const Bundle& bundle : several) {
    // A diagonal of one face may run along other faces' edge: both its sides lie in one plane,
    // and the order below treats it like any other pair of sheets.
    sheets.clear();
    LineAxis along;
    for (const SortedEdges::Edge& e : bundle.edges) {
      const uint32_t face = set.face[e.number() / 3];
      const Plane normal = planes.oriented(faces[face].plane);
      sheets.push_back(
          {e.number(), face, e.is_forward(), e.is_forward() ? normal : normal.reversed()});
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (const int s = geometry.compare_along(bundle.edges[0].high, bundle.low, axis)) {
        along = {axis, s};
        break;
      }
    }
    pair_sheets(sheets, RadialOrder(along), contacts, twin);
    crowded.emplace_back();
    for (const Sheet& s : sheets) {
      if (s.forward) crowded.back().push_back(s.half_edge);
    }
  }
  return true;
}

/// The fans around points [begin, end): vertices are numbered from 0, and their points appended.
void walk_fans(const CountingOrder& by_point, size_t begin, size_t end,
               const std::vector<uint32_t>& twin, const WholeOrder& whole,
               RawVector<uint32_t>& vertex_of_corner, std::vector<uint32_t>& point_of_vertex) {
  for (auto point = static_cast<uint32_t>(begin); point < end; ++point) {
    const std::span<const uint32_t> corners(by_point.order.data() + by_point.starts[point],
                                            by_point.order.data() + by_point.starts[point + 1]);
    if (!corners.empty() && whole.is_shared(point)) {
      for (const uint32_t c : corners) {
        vertex_of_corner[c] = static_cast<uint32_t>(point_of_vertex.size());
      }
      point_of_vertex.push_back(point);
      continue;
    }
    for (const uint32_t start : corners) {
      if (vertex_of_corner[start] != kNone) continue;
      const auto vertex = static_cast<uint32_t>(point_of_vertex.size());
      point_of_vertex.push_back(point);
      // Walk around the vertex: the twin of the edge that leaves corner c arrives at it in the next
      // triangle; the corner there is the one after that edge.
      uint32_t c = start;
      do {
        vertex_of_corner[c] = vertex;
        const uint32_t across = twin[c];
        c = across % 3 == 2 ? across - 2 : across + 1;
      } while (c != start);
    }
  }
}

/// One vertex for each fan of triangles that are joined across edges, and for each point that
/// untouched triangles share. `by_point`: corners by their points.
void walk_fans(const CountingOrder& by_point, const std::vector<uint32_t>& twin,
               const WholeOrder& whole, VertexFans& fans) {
  fans.vertex_of_corner.assign(twin.size(), kNone);
  walk_in_parts(by_point, fans, [&](size_t begin, size_t end, std::vector<uint32_t>& points) {
    walk_fans(by_point, begin, end, twin, whole, fans.vertex_of_corner, points);
    return true;
  });
}

/// Calls `visit(i, j)` for half-edges that run between the same two vertices.
template <class Visit>
void for_each_double_edge(const std::vector<std::vector<uint32_t>>& crowded, const VertexFans& fans,
                          Visit visit) {
  const auto ends = [&](uint32_t h) {
    return std::pair(fans.vertex_of_corner[h], fans.vertex_of_corner[h / 3 * 3 + (h % 3 + 1) % 3]);
  };
  for (const auto& halves : crowded) {
    for (size_t i = 0; i < halves.size(); ++i) {
      for (size_t j = i + 1; j < halves.size(); ++j) {
        if (ends(halves[i]) == ends(halves[j])) visit(halves[i], halves[j]);
      }
    }
  }
}

/// Exchanging the partners of the sheets of a double edge parts both fans at its ends (a closed
/// walk that passes a place twice falls in two there), and the edges with them. False when all is
/// well.
bool part_double_edges(const std::vector<std::vector<uint32_t>>& crowded, const VertexFans& fans,
                       std::vector<uint32_t>& twin) {
  std::vector<uint8_t> parted(fans.point_of_vertex.size(), 0);
  bool any = false;
  for_each_double_edge(crowded, fans, [&](uint32_t g, uint32_t h) {
    const uint32_t a = fans.vertex_of_corner[g],
                   b = fans.vertex_of_corner[g / 3 * 3 + (g % 3 + 1) % 3];
    // A fan that was parted already has other vertices: next time.
    if (parted[a] || parted[b]) return;
    std::swap(twin[g], twin[h]);
    twin[twin[g]] = g;
    twin[twin[h]] = h;
    parted[a] = parted[b] = 1;
    any = true;
  });
  return any;
}

}  // namespace

bool split_fans(const TriangleSet& set, const std::vector<MergedFace>& faces,
                CellGeometry& geometry, const PlaneTable& planes, const WholeOrder& whole,
                ContactRule contacts, VertexFans& fans,
                std::vector<std::array<uint32_t, 2>>* doubled) {
  const size_t corners = 3 * set.triangles.size();
  CountingOrder by_point;
  by_point.sort(corners, geometry.point_count(),
                [&](size_t c) { return set.triangles[c / 3][c % 3]; });
  fans.were_parted = false;
  if (make_simple_fans(set, by_point, whole, fans)) {
    if (doubled != nullptr) doubled->clear();
    return true;
  }
  std::vector<uint32_t> twin;
  std::vector<std::vector<uint32_t>> crowded;
  const RawVector<EdgePoints> ends = half_edges_and_rim(set, whole);
  if (!find_twins(set, ends, faces, geometry, planes, contacts, twin, crowded)) return false;
  walk_fans(by_point, twin, whole, fans);
  if (doubled != nullptr) {
    doubled->clear();
    for_each_double_edge(crowded, fans, [&](uint32_t h, uint32_t) {
      const uint32_t from = set.triangles[h / 3][h % 3], to = set.triangles[h / 3][(h % 3 + 1) % 3];
      doubled->push_back({std::min(from, to), std::max(from, to)});
    });
    std::sort(doubled->begin(), doubled->end());
    doubled->erase(std::unique(doubled->begin(), doubled->end()), doubled->end());
    return true;
  }
  while (part_double_edges(crowded, fans, twin)) {
    walk_fans(by_point, twin, whole, fans);
    fans.were_parted = true;
  }
  return true;
}

}  // namespace csgrun
