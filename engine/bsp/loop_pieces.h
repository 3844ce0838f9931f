// Convex pieces of what one loop bounds: at each corner that turns right, the edge that arrives
// there is drawn on to where it first meets the loop (the naive decomposition of Chazelle & Dobkin
// 1985). That is one piece and one new point for each such corner at most; cutting all of the plane
// by the lines of edges (convexify.h) makes several times as many, and goes on cutting them.
#pragma once

#include <span>
#include <vector>

#include "engine/bsp/cell_geometry.h"

namespace csgrun {

/// A directed boundary edge with the interior on its left, seen from outside.
struct BoundaryEdge {
  uint32_t from, to;  ///< points of the geometry
  uint32_t plane;     ///< holds the edge, not the support
};

class LoopPieces {
 public:
  /// Loops are in the plane `support`.
  LoopPieces(CellGeometry& geometry, const PlaneTable& planes, PlaneId support);

  /// The axes along which loops are seen, and whether outlines run counter-clockwise there.
  [[nodiscard]] const std::array<int, 2>& axes() const { return axes_; }
  [[nodiscard]] bool is_positive() const { return positive_; }

  /// The turn from one edge to the next: 1 to the left, -1 to the right, 0 for straight on or back.
  int turn(const BoundaryEdge& arriving, const BoundaryEdge& leaving);

  /// Appends the pieces of the inside of a loop, given in its order, to `pieces`. Their corners may
  /// be straight. False, and nothing is appended, if the loop runs clockwise, passes a point twice
  /// or turns back on itself. O(n) for each corner that turns right.
  bool add(std::span<const BoundaryEdge> loop, std::vector<Fragment>& pieces);

 private:
  struct Corner {
    uint32_t point, plane;  ///< of the edge that leaves
    int turn;
  };
  /// Where a line that is drawn on meets the loop.
  struct Hit {
    size_t corner;   ///< that it meets, or at the start of the edge that it meets
    uint32_t point;  ///< kNone until the point on an edge is made
    bool on_edge;
  };

  [[nodiscard]] BoundaryEdge edge(std::span<const Corner> loop, size_t i) const;
  bool find_turns(std::span<const BoundaryEdge> loop);
  [[nodiscard]] bool passes_twice(std::span<const BoundaryEdge> loop);
  [[nodiscard]] bool goes_back(const BoundaryEdge& arriving, const BoundaryEdge& leaving);
  [[nodiscard]] bool is_outline();
  bool find_hit(size_t start, size_t reflex, Hit& hit);
  void divide(size_t start, size_t reflex, const Hit& hit);
  void take(size_t start, std::vector<Fragment>& pieces);

  CellGeometry& geometry_;
  const PlaneTable& planes_;
  const PlaneId support_;
  std::array<int, 2> axes_{};
  bool positive_ = true;
  std::vector<Corner> corners_, part_;  ///< loops that are left to divide, one after another
  std::vector<size_t> starts_;
  std::vector<uint32_t> points_, edges_;
  std::vector<int8_t> sides_;
};

}  // namespace csgrun
