// Where the boundary that is kept may touch itself.
//
// Where polygons touch, mostly all that comes of it is an edge or a corner that what is kept has in
// common: the boundary is a surface there like anywhere else, and nobody need look for contacts
// when it is presented. A point is told to be of that kind by the corners of kept outlines there:
// each goes on to the next one through an edge that both have, and all are one round.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/point_index.h"

namespace csgrun {

class TouchFinder {
 public:
  /// `touched`: per vertex of the job, whether it may be on another operand's surface.
  TouchFinder(Job& job, CellGeometry& geometry, PointIndex& index,
              const std::vector<uint8_t>& touched)
      : job_(job), geometry_(geometry), index_(index), touched_(touched) {}

  /// Whether another operand's surface may pass a point: no vertex that is not touched.
  [[nodiscard]] bool may_be_met(uint32_t point) const {
    const uint32_t vertex = geometry_.point(point).vertex;
    return vertex == kNone || touched_[vertex] != 0;
  }
  /// Has a point of the geometry examined.
  void examine(uint32_t point);
  /// Whether there is any point to be examined.
  [[nodiscard]] bool has_examined() const { return !is_examined_.empty(); }
  /// Whether an outline may pass a point to be examined. All of these must be known. Several
  /// threads may ask at the same time.
  [[nodiscard]] bool may_pass_examined(std::span<const uint32_t> points) const;
  /// Adds an outline of what is kept of a polygon, `flip`: run backwards. `planes`: through the
  /// edge that starts at each point, as CutLoops::corner_plane has it; none, if the points are the
  /// polygon's corners. All points to be examined must be known.
  void add_outline(uint32_t polygon, std::span<const uint32_t> points,
                   std::span<const uint32_t> planes, bool flip);
  /// Adds the straight corner of a whole polygon at a point between the ends of one of its edges,
  /// and has the point examined. False if it is on none.
  bool add_on_edge(uint32_t polygon, uint32_t point, bool flip);
  /// Boxes around the edges at all points that were examined and are not as above. O(n).
  std::vector<GridBox> find();
  /// After find(): the operand all of whose outlines at a point may be named without being spelled
  /// out, or kNone. The point was examined and is as above, parts of cut polygons have corners
  /// there, and all polygons that are kept whole are of this operand.
  [[nodiscard]] uint32_t operand_beside_cuts(uint32_t point) {
    const uint32_t n = number(point);
    return n < beside_cuts_.size() ? beside_cuts_[n] : kNone;
  }
  /// After find(): something kept passes a point without a corner there.
  void note_passage(uint32_t point) {
    const uint32_t n = number(point);
    if (n < beside_cuts_.size()) beside_cuts_[n] = kNone;
  }

  /// The number of a point: that of all equal ones.
  uint32_t number(uint32_t point);

 private:
  struct Corner {
    uint32_t before, at, after;
    uint32_t polygon, plane;  ///< that hold the edge to the next corner
    bool is_whole;            ///< of a polygon that was not cut
  };
  [[nodiscard]] uint32_t operand_beside_cuts(std::span<const Corner> corners) const;
  bool is_one_round(std::span<const Corner> corners);
  bool leads_to(const Corner& corner, uint32_t point);
  void add_edge(uint32_t a, uint32_t b);

  Job& job_;
  CellGeometry& geometry_;
  PointIndex& index_;
  const std::vector<uint8_t>& touched_;
  std::vector<uint8_t> is_examined_;  ///< per point
  std::vector<Corner> corners_;
  std::vector<GridBox> boxes_;
  std::vector<uint32_t> beside_cuts_;  ///< per point, see operand_beside_cuts
};

}  // namespace csgrun
