#include "engine/mesh/connected_pieces.h"

#include <algorithm>
#include <tuple>

#include "engine/bsp/line_key.h"

namespace csgrun {
namespace {

/// Most neighbours meet end to end: joins them, and leaves the edges whose reverse is not there.
void join_reversed(std::vector<PieceEdge>& edges, UnionFind& pieces) {
  const auto ends = [](const PieceEdge& e) { return std::minmax(e.edge.from, e.edge.to); };
  std::sort(edges.begin(), edges.end(), [&](const PieceEdge& a, const PieceEdge& b) {
    const auto [a0, a1] = ends(a);
    const auto [b0, b1] = ends(b);
    return std::tie(a0, a1, a.edge.from, a.piece) < std::tie(b0, b1, b.edge.from, b.piece);
  });
  size_t kept = 0;
  for (size_t i = 0; i < edges.size(); ++i) {
    // Pieces that do not overlap: at most one edge each way.
    if (i + 1 < edges.size() && ends(edges[i]) == ends(edges[i + 1])) {
      pieces.join(edges[i].piece, edges[i + 1].piece);
      ++i;
    } else {
      edges[kept++] = edges[i];
    }
  }
  edges.resize(kept);
}

/// An edge as an interval along its line.
struct Interval {
  uint32_t from, to;  ///< points, in the order along the line
  uint32_t piece;
};

/// Joins the pieces of the intervals that overlap; none overlaps another of its own list.
void join_overlapping(std::vector<Interval>& up, std::vector<Interval>& down, int axis,
                      CellGeometry& geometry, UnionFind& pieces) {
  const auto before = [&](uint32_t p, uint32_t q) {
    return p != q && geometry.compare_along(p, q, axis) < 0;
  };
  const auto by_start = [&](const Interval& a, const Interval& b) {
    return before(a.from, b.from);
  };
  std::sort(up.begin(), up.end(), by_start);
  std::sort(down.begin(), down.end(), by_start);
  for (size_t u = 0, d = 0; u < up.size() && d < down.size();) {
    if (before(up[u].from, down[d].to) && before(down[d].from, up[u].to)) {
      pieces.join(up[u].piece, down[d].piece);
    }
    if (before(up[u].to, down[d].to)) {
      ++u;
    } else {
      ++d;
    }
  }
}

}  // namespace

bool join_neighbours(PlaneId support, std::vector<PieceEdge> edges, CellGeometry& geometry,
                     const PlaneTable& planes, UnionFind& pieces) {
  join_reversed(edges, pieces);
  std::vector<LineNamer::PlanePair> lines;
  for (const PieceEdge& e : edges) lines.push_back({support.index(), e.edge.plane});
  std::vector<LineKey> keys;
  LineNamer(planes).keys(lines, keys);
  std::vector<uint32_t> order(edges.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return std::tie(keys[a], a) < std::tie(keys[b], b); });
  std::vector<Interval> up, down;
  for (size_t i = 0, j = 0; i < order.size(); i = j) {
    while (j < order.size() && keys[order[j]] == keys[order[i]]) ++j;
    if (j - i == 1) continue;
    const uint32_t plane = edges[order[i]].edge.plane;
    const int axis = line_axis(planes.plane(support.index()), planes.plane(plane)).axis;
    up.clear();
    down.clear();
    for (size_t k = i; k < j; ++k) {
      const auto& [e, piece] = edges[order[k]];
      if (e.plane != plane && (geometry.side(plane, e.from) || geometry.side(plane, e.to))) {
        return false;
      }
      if (geometry.compare_along(e.from, e.to, axis) < 0) {
        up.push_back({e.from, e.to, piece});
      } else {
        down.push_back({e.to, e.from, piece});
      }
    }
    join_overlapping(up, down, axis, geometry, pieces);
  }
  return true;
}

}  // namespace csgrun
