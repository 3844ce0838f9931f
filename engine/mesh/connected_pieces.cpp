#include "engine/mesh/connected_pieces.h"

#include <algorithm>
#include <bit>
#include <tuple>

#include "engine/base/sort_few.h"
#include "engine/bsp/line_key.h"

namespace csgrun {
namespace {

/// Most neighbours meet end to end: joins them, and leaves the edges whose reverse is not there.
void join_reversed(std::vector<PieceEdge>& edges, UnionFind& pieces) {
  const auto ends = [&](uint32_t i) { return ends_together(edges[i].edge.from, edges[i].edge.to); };
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

/// One line of a plane: the stretches that some pieces have on their left and others on their
/// right.
class LineOfPieces {
 public:
  LineOfPieces(PointView& points, UnionFind& pieces, std::vector<PieceEdge>& boundary)
      : points_(points), pieces_(pieces), boundary_(boundary) {}

  /// Begins with the line in which `plane` meets that of the pieces; `axis` orders its points.
  void begin(uint32_t plane, int axis) {
    plane_ = plane;
    axis_ = axis;
    up_.clear();
    down_.clear();
  }

  void add(const PieceEdge& e) {
    if (points_.compare_along(e.edge.from, e.edge.to, axis_) < 0) {
      up_.push_back({e.edge.from, e.edge.to, e.piece});
    } else {
      down_.push_back({e.edge.to, e.edge.from, e.piece});
    }
  }

  /// Joins pieces on either side of a stretch, and appends the stretches with a piece on one side
  /// to the boundary. No interval overlaps another of its own direction.
  void finish() {
    if (!up_.empty() && !down_.empty()) {
      const auto by_start = [this](const Interval& a, const Interval& b) {
        return before(a.from, b.from);
      };
      std::sort(up_.begin(), up_.end(), by_start);
      std::sort(down_.begin(), down_.end(), by_start);
    }
    size_t u = 0, d = 0;
    while (u < up_.size() && d < down_.size()) {
      Interval &up = up_[u], &down = down_[d];
      if (up.from == down.from) {
        pieces_.join(up.piece, down.piece);
        const bool is_one_end = up.to == down.to, is_up_first = before(up.to, down.to);
        if (is_one_end || is_up_first) down.from = up.to, ++u;
        if (is_one_end || !is_up_first) up.from = down.to, ++d;
      } else if (before(up.from, down.from)) {
        if (keep_up_to(down.from, up, true)) ++u;
      } else {
        if (keep_up_to(up.from, down, false)) ++d;
      }
    }
    for (; u < up_.size(); ++u) keep(up_[u], up_[u].to, true);
    for (; d < down_.size(); ++d) keep(down_[d], down_[d].to, false);
  }

 private:
  [[nodiscard]] bool before(uint32_t p, uint32_t q) const {
    return p != q && points_.compare_along(p, q, axis_) < 0;
  }

  void keep(const Interval& i, uint32_t to, bool is_up) {
    boundary_.push_back(
        {is_up ? DirectedEdge{i.from, to, plane_} : DirectedEdge{to, i.from, plane_}, i.piece});
  }

  /// Keeps what of an interval is before a point, and leaves the rest. True if that is nothing.
  bool keep_up_to(uint32_t point, Interval& i, bool is_up) {
    const bool is_all = !before(point, i.to);
    const uint32_t to = is_all ? i.to : point;
    keep(i, to, is_up);
    i.from = to;
    return is_all;
  }

  PointView& points_;
  UnionFind& pieces_;
  std::vector<PieceEdge>& boundary_;
  uint32_t plane_ = kNone;
  int axis_ = 0;
  std::vector<Interval> up_, down_;
};

}  // namespace

bool join_neighbours(PlaneId support, std::vector<PieceEdge>& edges, PointView& points,
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
  std::vector<PieceEdge> boundary;
  LineOfPieces line(points, pieces, boundary);
  for (size_t i = 0, j = 0; i < order.size(); i = j) {
    while (j < order.size() && keys[order[j]] == keys[order[i]]) ++j;
    const uint32_t first = starts[order[i]];
    if (j - i == 1 && starts[order[i] + 1] - first == 1) {
      boundary.push_back(edges[first]);  // alone on its line
      continue;
    }
    const uint32_t plane = lines[order[i]].q;
    line.begin(plane, line_axis(planes.plane(support.index()), planes.plane(plane)).axis);
    for (size_t l = i; l < j; ++l) {
      for (uint32_t k = starts[order[l]]; k < starts[order[l] + 1]; ++k) {
        const DirectedEdge& e = edges[k].edge;
        if (e.plane != plane && (points.side(plane, e.from) || points.side(plane, e.to))) {
          return false;
        }
        line.add(edges[k]);
      }
    }
    line.finish();
  }
  edges = std::move(boundary);
  return true;
}

}  // namespace csgrun
