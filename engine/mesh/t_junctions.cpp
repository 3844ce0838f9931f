#include "engine/mesh/t_junctions.h"

#include <algorithm>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/mesh/sorted_edges.h"

namespace csgrun {
namespace {

/// The numbers of edges of which more run one way than the other between two points.
std::vector<uint32_t> find_unbalanced(const SortedEdges& edges, size_t point_count) {
  const auto list = [&](size_t begin, size_t end, std::vector<uint32_t>& out) {
    edges.each_bundle(begin, end, [&](const SortedEdges::Bundle& bundle) {
      if (is_balanced(bundle)) return;
      for (const SortedEdges::Edge& e : bundle.edges) out.push_back(e.number());
    });
  };
  return list_in_parts<uint32_t>(point_count, kFewForThreads, list);
}

struct LooseEdge {
  LineKey line;
  PlaneId support;
  DirectedEdge* edge;
  std::vector<uint32_t>* inserted;
};

/// Breaks the loose edges of one line at all their ends; false when they do not balance.
bool break_line(LooseEdge* begin, LooseEdge* end, CellGeometry& geometry,
                const PlaneTable& planes) {
  const uint32_t p = begin->support.index(), q = begin->edge->plane;
  const LineAxis axis = line_axis(planes.plane(p), planes.plane(q));
  std::vector<uint32_t> points;
  for (LooseEdge* e = begin; e != end; ++e) {
    for (const uint32_t x : {e->edge->from, e->edge->to}) {
      // Keys are hashes: confirm that the point lies on the first edge's line.
      if (geometry.side(p, x) != 0 || geometry.side(q, x) != 0) return false;
      points.push_back(x);
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  const auto before = [&](uint32_t x, uint32_t y) {
    return geometry.compare_along(x, y, axis.axis) < 0;
  };
  std::sort(points.begin(), points.end(), before);
  std::vector<int> change(points.size(), 0);
  for (LooseEdge* e = begin; e != end; ++e) {
    auto from = std::lower_bound(points.begin(), points.end(), e->edge->from, before);
    auto to = std::lower_bound(points.begin(), points.end(), e->edge->to, before);
    ++change[from - points.begin()];
    --change[to - points.begin()];
    if (from < to) {
      e->inserted->assign(from + 1, to);
    } else {
      e->inserted->assign(to + 1, from);
      std::reverse(e->inserted->begin(), e->inserted->end());
    }
  }
  return std::all_of(change.begin(), change.end(), [](int c) { return c == 0; });
}

}  // namespace

bool resolve_t_junctions(std::vector<MergedFace>& faces, CellGeometry& geometry, PlaneTable& planes,
                         const WholeOrder& whole) {
  // Edges are numbered face by face, and then those of the rim.
  std::vector<uint32_t> first_edge(faces.size() + 1, 0);
  for (size_t f = 0; f < faces.size(); ++f) {
    first_edge[f + 1] = first_edge[f];
    for (const auto& loop : faces[f].loops) {
      first_edge[f + 1] += static_cast<uint32_t>(loop.size());
    }
  }
  const uint32_t own_edges = first_edge.back();
  RawVector<EdgePoints> ends(own_edges + whole.rim().size());
  for_each_range(faces.size(), [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      uint32_t i = first_edge[f];
      for (const auto& loop : faces[f].loops) {
        for (const DirectedEdge& e : loop) ends[i++] = {e.from, e.to};
      }
    }
  });
  for (size_t i = 0; i < whole.rim().size(); ++i) {
    ends[own_edges + i] = {whole.rim()[i].from, whole.rim()[i].to};
  }
  const size_t points = geometry.point_count();
  const std::vector<uint32_t> loose_edges = find_unbalanced(SortedEdges(ends, points), points);
  if (loose_edges.empty()) return true;
  // An edge of a face by its number.
  const auto edge_of = [&](MergedFace& face, uint32_t number) {
    uint32_t left = number - first_edge[&face - faces.data()];
    auto loop = face.loops.begin();
    for (; left >= loop->size(); ++loop) left -= static_cast<uint32_t>(loop->size());
    return &(*loop)[left];
  };
  std::vector<LooseEdge> loose;
  std::vector<DirectedEdge> rim;  // the loose ones, which stay where they are
  rim.reserve(loose_edges.size());
  std::vector<std::vector<uint32_t>> inserted(loose_edges.size());
  std::vector<LineNamer::PlanePair> lines;
  for (size_t k = 0; k < loose_edges.size(); ++k) {
    const uint32_t e = loose_edges[k];
    if (e < own_edges) {
      const auto after = std::upper_bound(first_edge.begin(), first_edge.end(), e);
      MergedFace& face = faces[after - first_edge.begin() - 1];
      loose.push_back({{}, face.plane, edge_of(face, e), &inserted[k]});
    } else {
      const auto [face, edge] = whole.planes_of(whole.rim()[e - own_edges], planes);
      rim.push_back({ends[e].from, ends[e].to, edge.index()});
      loose.push_back({{}, face, &rim.back(), &inserted[k]});
    }
    lines.push_back({loose.back().support.index(), loose.back().edge->plane});
  }
  std::vector<LineKey> keys;
  LineNamer(planes).keys(lines, keys);
  for (size_t k = 0; k < loose.size(); ++k) loose[k].line = keys[k];
  std::stable_sort(loose.begin(), loose.end(),
                   [](const LooseEdge& a, const LooseEdge& b) { return a.line < b.line; });
  for (size_t i = 0; i < loose.size();) {
    size_t j = i;
    while (j < loose.size() && loose[j].line == loose[i].line) ++j;
    if (!break_line(loose.data() + i, loose.data() + j, geometry, planes)) return false;
    i = j;
  }
  for (size_t k = 0; k < loose_edges.size(); ++k) {
    // Nothing ends inside an edge of what is untouched.
    if (loose_edges[k] >= own_edges && !inserted[k].empty()) return false;
  }
  // Rebuild the loops; edges are numbered in the order of the walk above.
  std::vector<uint32_t> slot(ends.size(), kNone);
  for (uint32_t k = 0; k < loose_edges.size(); ++k) slot[loose_edges[k]] = k;
  uint32_t number = 0;
  std::vector<DirectedEdge> broken;
  for (MergedFace& f : faces) {
    for (auto& loop : f.loops) {
      broken.clear();
      for (const DirectedEdge& e : loop) {
        const uint32_t k = slot[number++];
        uint32_t from = e.from;
        if (k != kNone) {
          for (const uint32_t x : inserted[k]) {
            broken.push_back({from, x, e.plane});
            from = x;
          }
        }
        broken.push_back({from, e.to, e.plane});
      }
      loop = broken;
    }
  }
  return true;
}

}  // namespace csgrun
