// Where the boundary that is kept may touch itself.
//
// Where polygons touch, mostly all that comes of it is an edge or a corner that what is kept has in
// common: the boundary is a surface there like anywhere else, and nobody need look for contacts
// when it is presented. A point is told to be of that kind by the corners of kept outlines there:
// each goes on to the next one through an edge that both have, and all are one round.
#pragma once

#include <atomic>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/parallel.h"
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
  /// Has points that may be met examined, which are in the index: each(mark) calls mark(point) for
  /// them, maybe on several threads.
  template <class Each>
  void examine_known(Each&& each) {
    is_examined_.resize(geometry_.point_count(), 0);
    std::atomic<bool> any = false;
    each([&](uint32_t point) {
      assert(index_.known(point) != kNone);
      const std::atomic_ref<uint8_t> shared(is_examined_[index_.known(point)]);
      shared.store(1, std::memory_order_relaxed);
      if (!any.load(std::memory_order_relaxed)) any.store(true, std::memory_order_relaxed);
    });
    has_examined_ |= any;
  }
  /// Whether there is any point to be examined.
  [[nodiscard]] bool has_examined() const { return has_examined_; }
  /// An outline of what is kept of a polygon. `planes`: through the edge that starts at each point,
  /// as CutLoops::corner_plane has it; none, if the points are the polygon's corners.
  struct Outline {
    uint32_t polygon;
    std::span<const uint32_t> points, planes;
    bool flip;  ///< it is run backwards
  };
  /// Adds outlines, once all points to be examined are known: list(begin, end, add) calls
  /// add(outline) for those of [begin, end), parts of [0, count), maybe on several threads.
  template <class List>
  void add_outlines(size_t count, size_t each, List&& list) {
    is_examined_.resize(geometry_.point_count(), 0);
    add_corners(list_in_parts<Corner>(
        count, each, [&](size_t begin, size_t end, std::vector<Corner>& corners) {
          list(begin, end, [&](const Outline& outline) { list_corners(outline, corners); });
        }));
  }
  /// Adds the straight corner of a whole polygon at a point between the ends of one of its edges,
  /// and has the point examined. False if it is on none.
  bool add_on_edge(uint32_t polygon, uint32_t point, bool flip);
  /// Boxes around the edges at all points that were examined and are not as above. O(n).
  std::vector<GridBox> find();
  /// After find(): the operand all of whose outlines at a point may be named without being spelled
  /// out, or kNone. The point was examined and is as above, parts of cut polygons have corners
  /// there, and all polygons that are kept whole are of this operand.
  /// Several threads may ask. REQUIRES: as for known_number.
  [[nodiscard]] uint32_t operand_beside_cuts(uint32_t point) const {
    const uint32_t n = known_number(point);
    return n < beside_cuts_.size() ? beside_cuts_[n] : kNone;
  }
  /// After find(): something kept passes a point without a corner there.
  void note_passage(uint32_t point) {
    const uint32_t n = number(point);
    if (n < beside_cuts_.size()) beside_cuts_[n] = kNone;
  }

  /// The number of a point: that of all equal ones.
  uint32_t number(uint32_t point);
  /// The same. REQUIRES: the point is in the index, if it may be met.
  [[nodiscard]] uint32_t known_number(uint32_t point) const {
    return may_be_met(point) ? index_.known(point) : point;
  }

 private:
  struct Corner {
    uint32_t before, at, after;
    uint32_t polygon, plane;  ///< that hold the edge to the next corner
    bool is_whole;            ///< of a polygon that was not cut, nor has a loop that is its rim
    bool is_numbered = true;  ///< the points are numbers
  };
  /// The number of a point, or kNone if it has none yet.
  [[nodiscard]] uint32_t number_or_none(uint32_t point) const {
    return may_be_met(point) ? index_.known_or_none(point) : point;
  }
  void list_corners(const Outline& outline, std::vector<Corner>& corners) const;
  void add_corners(std::span<const Corner> corners);
  [[nodiscard]] uint32_t operand_beside_cuts(std::span<const Corner> corners) const;
  template <class LeadsTo>
  static bool is_one_round(std::span<const Corner> corners, LeadsTo&& leads_to);
  bool leads_to(const Corner& corner, uint32_t point);
  void add_edge(uint32_t a, uint32_t b);

  Job& job_;
  CellGeometry& geometry_;
  PointIndex& index_;
  const std::vector<uint8_t>& touched_;
  std::vector<uint8_t> is_examined_;  ///< per point
  bool has_examined_ = false;
  std::vector<Corner> corners_;
  std::vector<GridBox> boxes_;
  std::vector<uint32_t> beside_cuts_;  ///< per point, see operand_beside_cuts
};

}  // namespace csgrun
