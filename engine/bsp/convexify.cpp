#include "engine/bsp/convexify.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "engine/bsp/regions.h"

namespace csgrun {
namespace {

/// Up to this many edges a region is cut along its own edges; above, walls halve it first, so that
/// the lines of edges stay short.
constexpr size_t kFewEdges = 12;
/// What is no longer than this is not worth a wall.
constexpr double kFewSteps = 64;
constexpr int64_t kFarWall = int64_t{1} << 29;

class Convexifier {
 public:
  Convexifier(CellGeometry& geometry, const PlaneTable& planes, PlaneId support,
              const std::function<uint32_t(int, int64_t)>& wall, std::vector<Fragment>& pieces)
      : geometry_(geometry),
        planes_(planes),
        support_(support),
        wall_(wall),
        pieces_(pieces),
        loops_(geometry, planes, support),
        axes_(loops_.axes()),
        positive_(loops_.is_positive()) {}

  void run(std::vector<BoundaryEdge> edges) {
    if (edges.empty()) return;
    if (is_convex_loop(edges)) {
      take(edges);
    } else {
      cut(far_square(), std::move(edges));
    }
  }

  void run_within(Fragment cell, const std::vector<BoundaryEdge>& edges) {
    Extent busy;
    if (!begin_within(cell, edges, busy)) return;
    if (!is_far_beside(cell, busy) && divide_loops(edges)) return;
    part_edges(cell, edges);
    while (cut_off(cell, busy)) {
    }
    cut(cell, std::move(inner_));
  }

  bool cut_off_within(const Fragment& cell, const std::vector<BoundaryEdge>& edges,
                      RegionRest& rest) {
    Extent busy;
    if (!begin_within(cell, edges, busy)) return false;
    rest.cell = cell;
    rest.edges.clear();
    rest.is_cut_off = false;
    if (!is_far_beside(cell, busy)) return true;
    part_edges(cell, edges);
    while (cut_off(rest.cell, busy)) rest.is_cut_off = true;
    if (!rest.is_cut_off) return true;
    rest.edges = inner_;
    rest.edges.insert(rest.edges.end(), rim_.begin(), rim_.end());
    return true;
  }

 private:
  /// An extent along the two axes.
  struct Extent {
    double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
  };

  /// Makes a piece of what is convex; else finds the extent of the edges of the region that are not
  /// on the rim of the cell, and returns true.
  bool begin_within(const Fragment& cell, const std::vector<BoundaryEdge>& edges, Extent& busy) {
    if (edges.empty()) return false;
    if (is_convex_loop(edges)) {
      take(edges);
      return false;
    }
    bool any_inner = false;
    for (const BoundaryEdge& e : edges) {
      if (is_on_rim(cell, e)) continue;
      any_inner = true;
      add(busy, e.from);
      add(busy, e.to);
    }
    if (!any_inner) pieces_.push_back(cell);
    return any_inner;
  }

  bool is_on_rim(const Fragment& cell, const BoundaryEdge& e) const {
    const uint32_t* planes = geometry_.edges(cell);
    return std::find(planes, planes + cell.count, e.plane) != planes + cell.count;
  }

  /// Lists the edges on the rim of the cell and the others.
  void part_edges(const Fragment& cell, const std::vector<BoundaryEdge>& edges) {
    for (const BoundaryEdge& e : edges) (is_on_rim(cell, e) ? rim_ : inner_).push_back(e);
  }

  /// Whether the edges are one loop, in its order, that turns left at every corner. It does not
  /// cross itself.
  bool is_convex_loop(const std::vector<BoundaryEdge>& edges) {
    const size_t count = edges.size();
    for (size_t i = 0; i < count; ++i) {
      if (edges[i].to != edges[i + 1 < count ? i + 1 : 0].from) return false;
    }
    if (count == 3) return true;
    for (size_t i = 0; i < count; ++i) {
      if (loops_.turn(edges[i], edges[i + 1 < count ? i + 1 : 0]) <= 0) return false;
    }
    return true;
  }

  /// Divides a region all of whose loops are outlines, one after another in the list; else does
  /// nothing and returns false.
  bool divide_loops(const std::vector<BoundaryEdge>& edges) {
    const size_t before = pieces_.size();
    for (size_t first = 0, last = 0; first < edges.size(); first = ++last) {
      while (edges[last].to != edges[first].from) {
        if (last + 1 == edges.size() || edges[last + 1].from != edges[last].to) break;
        ++last;
      }
      if (edges[last].to != edges[first].from ||
          !loops_.add(std::span(edges).subspan(first, last + 1 - first), pieces_)) {
        pieces_.resize(before);
        return false;
      }
    }
    return true;
  }

  /// The face as it is.
  void take(const std::vector<BoundaryEdge>& edges) {
    pieces_.push_back(geometry_.make_fragment(support_, edges));
  }

  /// The part of the plane between far walls: contains the whole face.
  Fragment far_square() {
    const uint32_t u0 = wall_(axes_[0], -kFarWall), u1 = wall_(axes_[0], kFarWall);
    const uint32_t v0 = wall_(axes_[1], -kFarWall), v1 = wall_(axes_[1], kFarWall);
    const uint32_t s = support_.index();
    std::vector<uint32_t> points{geometry_.add_point({s, u0, v0}), geometry_.add_point({s, u1, v0}),
                                 geometry_.add_point({s, u1, v1}),
                                 geometry_.add_point({s, u0, v1})};
    std::vector<uint32_t> edges{v0, u1, v1, u0};
    if (!positive_) {
      std::reverse(points.begin(), points.end());
      edges = {v1, u1, v0, u0};
    }
    return geometry_.make_fragment(support_, points, edges);
  }

  void cut(const Fragment& cell, std::vector<BoundaryEdge> edges) {
    if (edges.size() > kFewEdges && cut_by_wall(cell, edges)) return;
    // The edge in the middle of the list: loops are listed in order, so neighbours go either way.
    cut_by_edge(cell, edges, edges[edges.size() / 2]);
  }

  struct Halves {
    std::vector<BoundaryEdge> front, back;
  };

  Halves distribute(const std::vector<BoundaryEdge>& edges, uint32_t plane) {
    Halves halves;
    for (const BoundaryEdge& e : edges) {
      const int s = geometry_.side(plane, e.from), t = geometry_.side(plane, e.to);
      if (s >= 0 && t >= 0) {
        if (s || t) halves.front.push_back(e);
      } else if (s <= 0 && t <= 0) {
        halves.back.push_back(e);
      } else {
        const uint32_t x = geometry_.add_point({support_.index(), e.plane, plane});
        (s > 0 ? halves.front : halves.back).push_back({e.from, x, e.plane});
        (s > 0 ? halves.back : halves.front).push_back({x, e.to, e.plane});
      }
    }
    return halves;
  }

  void add(Extent& extent, uint32_t point) const {
    for (int k = 0; k < 2; ++k) {
      const double c = geometry_.point(point).rounded[axes_[k]];
      extent.lo[k] = std::min(extent.lo[k], c);
      extent.hi[k] = std::max(extent.hi[k], c);
    }
  }
  [[nodiscard]] Extent extent_of(const std::vector<BoundaryEdge>& edges) const {
    Extent extent;
    for (const BoundaryEdge& e : edges) {
      add(extent, e.from);
      add(extent, e.to);
    }
    return extent;
  }

  /// Where most of a cell is beside all of its edges.
  struct Beside {
    int axis = 0;
    bool above = false;
    double most = 0;  ///< 0 if that is not far more than these
  };
  Beside find_beside(const Fragment& cell, const Extent& busy) const {
    Extent extent;
    for (uint32_t i = 0; i < cell.count; ++i) add(extent, geometry_.corners(cell)[i]);
    Beside found;
    for (int k = 0; k < 2; ++k) {
      const double enough = std::max((busy.hi[k] - busy.lo[k]) / 2, kFewSteps);
      for (const bool side : {false, true}) {
        const double beside = side ? extent.hi[k] - busy.hi[k] : busy.lo[k] - extent.lo[k];
        if (beside > std::max(found.most, enough)) found = {k, side, beside};
      }
    }
    return found;
  }

  /// Whether edges that are drawn on would run through a cell in which all else is small: what
  /// comes next would meet the slivers between them.
  bool is_far_beside(const Fragment& cell, const Extent& busy) const {
    constexpr double kFar = 4;
    const double size = std::max(busy.hi[0] - busy.lo[0], busy.hi[1] - busy.lo[1]);
    return find_beside(cell, busy).most > kFar * std::max(size, kFewSteps);
  }

  /// Cuts off what of a cell is furthest beside all of its edges, if that is far more than these,
  /// by a wall. False when nothing is.
  bool cut_off(Fragment& cell, const Extent& busy) {
    const auto [axis, above, most] = find_beside(cell, busy);
    if (most == 0) return false;
    const double at = above ? std::ceil(busy.hi[axis]) : std::floor(busy.lo[axis]) - 1;
    const uint32_t plane = wall_(axes_[axis], static_cast<int64_t>(at));
    Fragment front, back;
    if (geometry_.split(cell, plane, front, back) != Side::kSplit) return false;
    // No edge of the region is there but on the rim: it is all or nothing.
    const int outer = above ? 1 : -1;
    const bool inside = std::any_of(rim_.begin(), rim_.end(), [&](const BoundaryEdge& e) {
      return geometry_.side(plane, e.from) == outer || geometry_.side(plane, e.to) == outer;
    });
    if (inside) pieces_.push_back(above ? front : back);
    cell = above ? back : front;
    cut_rim(cell, plane, outer, inside);
    return true;
  }

  /// Takes away what of the rim lies on the side `outer` of a wall that is an edge of the cell now,
  /// and adds that edge if the region is `inside` there.
  void cut_rim(const Fragment& cell, uint32_t wall, int outer, bool inside) {
    const uint32_t* planes = geometry_.edges(cell);
    const auto i = static_cast<uint32_t>(std::find(planes, planes + cell.count, wall) - planes);
    const uint32_t* corners = geometry_.corners(cell);
    const uint32_t start = corners[i], end = corners[i + 1 < cell.count ? i + 1 : 0];
    std::vector<BoundaryEdge> left;
    for (BoundaryEdge e : rim_) {
      const int s = geometry_.side(wall, e.from) * outer, t = geometry_.side(wall, e.to) * outer;
      if (s >= 0 && t >= 0) continue;
      // Edges on the rim run as the cell's do, which come to the wall where its edge starts.
      if (s >= 0) e.from = end;
      if (t >= 0) e.to = start;
      left.push_back(e);
    }
    if (inside) left.push_back({start, end, wall});
    rim_ = std::move(left);
  }

  bool cut_by_wall(const Fragment& cell, const std::vector<BoundaryEdge>& edges) {
    const Extent extent = extent_of(edges);
    const int k = extent.hi[0] - extent.lo[0] >= extent.hi[1] - extent.lo[1] ? 0 : 1;
    std::vector<double> at;
    at.reserve(edges.size());
    for (const BoundaryEdge& e : edges) at.push_back(geometry_.point(e.from).rounded[axes_[k]]);
    std::nth_element(at.begin(), at.begin() + at.size() / 2, at.end());
    const auto m = static_cast<int64_t>(std::floor(at[at.size() / 2]));
    const uint32_t plane = wall_(axes_[k], m);
    Fragment front, back;
    if (geometry_.split(cell, plane, front, back) != Side::kSplit) return false;
    Halves halves = distribute(edges, plane);
    // What a side is its edges say: where a wall holds edges there may be none left on one side.
    if (halves.front.empty() || halves.back.empty()) return false;
    // A cut must make progress.
    if (std::max(halves.front.size(), halves.back.size()) + 3 > edges.size()) return false;
    cut(front, std::move(halves.front));
    cut(back, std::move(halves.back));
    return true;
  }

  void cut_by_edge(const Fragment& cell, const std::vector<BoundaryEdge>& edges,
                   const BoundaryEdge& chosen) {
    Fragment front, back;
    const Side side = geometry_.split(cell, chosen.plane, front, back);
    // The edge lies inside the cell or on its rim; on the rim all other edges are on one side.
    if (side == Side::kFront) front = cell;
    if (side == Side::kBack) back = cell;
    Halves halves = distribute(edges, chosen.plane);
    const bool left_is_front = left_side(chosen) > 0;
    if (side != Side::kBack) finish(front, std::move(halves.front), left_is_front);
    if (side != Side::kFront) finish(back, std::move(halves.back), !left_is_front);
  }

  void finish(const Fragment& cell, std::vector<BoundaryEdge> edges, bool inside) {
    if (!edges.empty()) {
      cut(cell, std::move(edges));
    } else if (inside) {
      pieces_.push_back(cell);
    }
  }

  /// The sign of the edge's plane on the left of the edge. With D = n x t (n the outward normal of
  /// the support, t the normal of the edge's plane), an edge along D has -t on its left.
  int left_side(const BoundaryEdge& e) {
    const LineAxis line = line_axis(planes_.oriented(support_), planes_.plane(e.plane));
    const int along = geometry_.compare_along(e.to, e.from, line.axis) * line.sign;
    assert(along != 0);
    return -along;
  }

  CellGeometry& geometry_;
  const PlaneTable& planes_;
  PlaneId support_;
  const std::function<uint32_t(int, int64_t)>& wall_;
  std::vector<Fragment>& pieces_;
  LoopPieces loops_;
  const std::array<int, 2> axes_;
  const bool positive_;
  std::vector<BoundaryEdge> rim_, inner_;  ///< of a region within a cell
};

/// Whether three edges follow each other.
bool is_triangle(const std::vector<BoundaryEdge>& edges) {
  return edges.size() == 3 && edges[0].to == edges[1].from && edges[1].to == edges[2].from &&
         edges[2].to == edges[0].from;
}

}  // namespace

void convexify(CellGeometry& geometry, const PlaneTable& planes, PlaneId support,
               std::vector<BoundaryEdge> edges, const std::function<uint32_t(int, int64_t)>& wall,
               std::vector<Fragment>& pieces) {
  if (is_triangle(edges)) {
    pieces.push_back(geometry.make_fragment(support, edges));
    return;
  }
  Convexifier(geometry, planes, support, wall, pieces).run(std::move(edges));
}

void convexify_within(CellGeometry& geometry, const PlaneTable& planes, const Fragment& cell,
                      const std::vector<BoundaryEdge>& edges,
                      const std::function<uint32_t(int, int64_t)>& wall,
                      std::vector<Fragment>& pieces) {
  Convexifier(geometry, planes, cell.support, wall, pieces).run_within(cell, edges);
}

bool cut_off_within(CellGeometry& geometry, const PlaneTable& planes, const Fragment& cell,
                    const std::vector<BoundaryEdge>& edges,
                    const std::function<uint32_t(int, int64_t)>& wall,
                    std::vector<Fragment>& pieces, RegionRest& rest) {
  return Convexifier(geometry, planes, cell.support, wall, pieces)
      .cut_off_within(cell, edges, rest);
}

}  // namespace csgrun
