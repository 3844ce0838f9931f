#include "engine/mesh/connected_pieces.h"

#include <algorithm>
#include <bit>
#include <tuple>

#include "engine/bsp/line_key.h"

namespace csgrun {
namespace {

/// Most neighbours meet end to end: joins them, and leaves the edges whose reverse is not there.
void join_reversed(std::vector<PieceEdge>& edges, UnionFind& pieces) {
  const auto ends = [&](uint32_t i) {
    const auto [low, high] = std::minmax(edges[i].edge.from, edges[i].edge.to);
    return static_cast<uint64_t>(low) << 32 | high;
  };
  // Edges by their ends, open addressing; it is only asked, never walked through.
  std::vector<uint32_t> table(std::bit_ceil(2 * edges.size() + 1), kNone);
  const int shift = 64 - std::countr_zero(table.size());
  std::vector<uint8_t> is_met(edges.size(), 0);
  for (uint32_t i = 0; i < edges.size(); ++i) {
    const uint64_t key = ends(i);
    size_t at = key * 0x9fb21c651e98df25ull >> shift;
    while (table[at] != kNone && ends(table[at]) != key) at = (at + 1) & (table.size() - 1);
    const uint32_t other = table[at];
    if (other == kNone) {
      table[at] = i;
      continue;
    }
    // Pieces that do not overlap: at most one edge each way.
    is_met[i] = is_met[other] = 1;
    pieces.join(edges[i].piece, edges[other].piece);
  }
  size_t kept = 0;
  for (size_t i = 0; i < edges.size(); ++i) {
    if (!is_met[i]) edges[kept++] = edges[i];
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
  // By the planes that hold them, and these by the lines that they name.
  std::sort(edges.begin(), edges.end(),
            [](const PieceEdge& a, const PieceEdge& b) { return a.edge.plane < b.edge.plane; });
  std::vector<LineNamer::PlanePair> lines;
  std::vector<uint32_t> starts;  // of the edges of each plane
  for (uint32_t i = 0; i < edges.size(); ++i) {
    if (i > 0 && edges[i].edge.plane == edges[i - 1].edge.plane) continue;
    lines.push_back({support.index(), edges[i].edge.plane});
    starts.push_back(i);
  }
  starts.push_back(static_cast<uint32_t>(edges.size()));
  std::vector<LineKey> keys;
  LineNamer(planes).keys(lines, keys);
  std::vector<uint32_t> order(lines.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return std::tie(keys[a], a) < std::tie(keys[b], b); });
  std::vector<Interval> up, down;
  for (size_t i = 0, j = 0; i < order.size(); i = j) {
    const uint32_t plane = lines[order[i]].q;
    const int axis = line_axis(planes.plane(support.index()), planes.plane(plane)).axis;
    up.clear();
    down.clear();
    for (; j < order.size() && keys[order[j]] == keys[order[i]]; ++j) {
      for (uint32_t k = starts[order[j]]; k < starts[order[j] + 1]; ++k) {
        const auto& [e, piece] = edges[k];
        if (e.plane != plane && (geometry.side(plane, e.from) || geometry.side(plane, e.to))) {
          return false;
        }
        if (geometry.compare_along(e.from, e.to, axis) < 0) {
          up.push_back({e.from, e.to, piece});
        } else {
          down.push_back({e.to, e.from, piece});
        }
      }
    }
    if (!up.empty() && !down.empty()) join_overlapping(up, down, axis, geometry, pieces);
  }
  return true;
}

}  // namespace csgrun
