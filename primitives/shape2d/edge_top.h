// The top of a linear_extrude that collapses to an edge (one scale is 0).
//
// Between the last slice and the edge, walls whose triangles are cut in different ways can cross,
// however fine the slices: all of them come together in the edge. So the outlines are first cut at
// the same places along the edge, into slabs. In a slab all walls are cut alike, from the same
// side, so every point of a wall is the same mixture of its two ends as on all other walls, and
// walls keep their order. Where walls meet in a point of the outline, they are cut from the other
// end, lest both contain the same triangle.
#pragma once

#include <cstdint>
#include <vector>

#include <csgrun/primitives/shape2d.h>

#include "primitives/shape2d/extrude_facets.h"

namespace csgrun {

class EdgeTop {
 public:
  /// Adds vertices to the loops (and stops when they are more than kMostPoints). `slices` as in
  /// slice_point. O(edges x places).
  EdgeTop(std::vector<Shape2D::Loop>& loops, const LinearExtrudeOptions& options, int slices);

  /// How many places along the edge there are; they are numbered along it.
  [[nodiscard]] uint32_t size() const { return static_cast<uint32_t>(places_.size()); }
  /// The coordinate of a place, relative to where the axis of the extrusion ends.
  [[nodiscard]] glm::dvec2 point(uint32_t place) const;
  /// Where a vertex of the loops comes to lie.
  [[nodiscard]] uint32_t place_of(const glm::dvec2& p) const;
  /// Whether the wall over an edge between neighbouring places `from` and `to` is cut from the
  /// lower corner over `from` to the upper one over `to` (else from the lower one over `to`).
  [[nodiscard]] bool cut_at_from(uint32_t from, uint32_t to) const;

 private:
  [[nodiscard]] double along(const glm::dvec2& p) const;
  void find_places(const std::vector<Shape2D::Loop>& loops);
  void split_loops(std::vector<Shape2D::Loop>& loops) const;

  Slice top_;
  int axis_;                     // the coordinate that stays
  std::vector<double> places_;   // ascending
  std::vector<bool> from_high_;  // per slab: cut from its upper end
};

}  // namespace csgrun
