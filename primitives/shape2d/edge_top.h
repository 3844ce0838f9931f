// The top of a linear_extrude that collapses to an edge (one scale is 0).
#pragma once

#include <cstdint>
#include <vector>

#include <csgrun/primitives/shape2d.h>

#include "primitives/shape2d/extrude_facets.h"

namespace csgrun {

/// The places on that edge where vertices of the outlines come to lie. The edge is cut there: what
/// a wall passes over is the same for all walls, so that the edges of the walls make up for one
/// another whichever way each wall goes.
class EdgeTop {
 public:
  /// `slices` as in Slice. O(vertices log vertices).
  EdgeTop(const std::vector<Shape2D::Loop>& loops, const LinearExtrudeOptions& options, int slices);

  /// How many places along the edge there are; they are numbered along it.
  [[nodiscard]] uint32_t size() const { return static_cast<uint32_t>(places_.size()); }
  /// The coordinate of a place, relative to where the axis of the extrusion ends.
  [[nodiscard]] glm::dvec2 point(uint32_t place) const;
  /// Where a vertex of the loops comes to lie.
  [[nodiscard]] uint32_t place_of(const glm::dvec2& p) const;

 private:
  [[nodiscard]] double along(const glm::dvec2& p) const;

  Slice top_;
  int axis_;                    // the coordinate that stays
  std::vector<double> places_;  // ascending
};

}  // namespace csgrun
