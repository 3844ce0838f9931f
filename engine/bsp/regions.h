// From pieces of one plane to the maximal regions that they form.
//
// Every piece contributes its directed edges. On each line the edges are intervals; where as many
// run one way as the other they cancel, and what is left is the boundary of the union: cuts by cell
// walls and by extended planes vanish, whatever points they were broken at. Then corners where the
// boundary runs straight through are dropped, and loops are traced with the interior on their left.
#pragma once

#include <utility>
#include <vector>

#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/line_key.h"
#include "engine/bsp/point_view.h"

namespace csgrun {

/// A directed edge of a piece, over points of a CellGeometry; `plane` holds it and is not the
/// support.
struct DirectedEdge {
  uint32_t from, to, plane;
};

/// Closed loops of true corners; corner i has the edge to corner i + 1 in its plane.
struct RegionLoops {
  std::vector<uint32_t> starts{0};
  std::vector<DirectedEdge> edges;  ///< edge i of a loop starts at corner i

  void clear() {
    starts.assign(1, 0);
    edges.clear();
  }
  [[nodiscard]] size_t loop_count() const { return starts.size() - 1; }
};

/// Exact sign of the turn from the direction of edge `a` to that of edge `b` in the plane
/// `support`, seen from outside: +1 left, -1 right, 0 straight on or straight back. `Points` is a
/// CellGeometry or a PointView.
template <class Points>
int turn_between(Points& points, const PlaneTable& planes, PlaneId support, const DirectedEdge& a,
                 const DirectedEdge& b);

class RegionBuilder {
 public:
  /// Points that are equal must have equal numbers in `geometry`, which is only read: several
  /// builders may do so on several threads.
  RegionBuilder(const CellGeometry& geometry, const PlaneTable& planes)
      : geometry_(geometry), planes_(planes), namer_(planes) {}

  /// The boundary of the union of pieces that do not overlap, given by all their edges. Loops touch
  /// but do not cross; a loop passes a point at most once for each wedge of interior there.
  /// False when the edges do not bound a region (some net multiplicity is not 0 or 1): the input
  /// was not a set of disjoint pieces.
  bool build(PlaneId support, const std::vector<DirectedEdge>& edges, RegionLoops& loops);
  /// The same for edges of which none overlaps another: one piece, one region of before, or what is
  /// left of pieces that were joined. An edge may be there in both directions: a slit.
  bool build_single(PlaneId support, const std::vector<DirectedEdge>& edges, RegionLoops& loops);

 private:
  bool cancel_on_lines(PlaneId support);
  bool cancel_few(PlaneId support);
  bool cancel_line(uint32_t support);
  bool sweep_line(uint32_t support);
  bool trace(PlaneId support, RegionLoops& loops);
  [[nodiscard]] bool straight(const DirectedEdge& in, const DirectedEdge& out);
  void link(uint32_t in, uint32_t out);
  bool link_in_order();
  bool link_at_points(PlaneId support);
  void pair_wedges(PlaneId support, std::vector<uint32_t>& incident);

  PointView geometry_;
  const PlaneTable& planes_;
  LineNamer namer_;
  std::vector<LineNamer::PlanePair> lines_;
  std::vector<LineKey> keys_;
  std::vector<uint32_t> line_of_edge_;  ///< per open edge
  /// Edges by both ends, then by the one that they come from and by their planes.
  std::vector<std::pair<uint64_t, uint64_t>> by_ends_;
  std::vector<DirectedEdge> open_;                    ///< edges whose exact reverse is not there
  std::vector<DirectedEdge> line_;                    ///< those of one line
  std::vector<uint32_t> on_line_;                     ///< their ends, in order
  std::vector<std::pair<uint32_t, uint32_t>> place_;  ///< by end: where it stands there
  std::vector<int> change_;
  std::vector<DirectedEdge> boundary_;  ///< elementary boundary edges
  std::vector<uint32_t> next_;          ///< per boundary edge: the one that follows
  std::vector<uint8_t> corner_;         ///< per boundary edge: whether it starts in a true corner
  std::vector<uint8_t> done_;
  std::vector<uint64_t> ends_;  ///< of boundary edges, by point
  std::vector<uint32_t> incident_;
};

}  // namespace csgrun
