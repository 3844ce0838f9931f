// The outline that a roof stands on: points by number, edges that run around the shape.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include <csgrun/engine/error.h>
#include <csgrun/engine/polygon_mesh.h>
#include <csgrun/primitives/roof.h>

#include "primitives/shape2d/grid2d.h"

namespace csgrun {

/// Loops on an integer grid, free of crossings, the shape on the left of every edge. Edge i starts
/// at point from[i]; loops that touch share the point.
struct RoofOutline {
  std::vector<Point2D> points;     ///< sorted; |coordinate| < 2^30
  std::vector<glm::dvec2> places;  ///< of the points, mm
  std::vector<uint32_t> from, to;  ///< per edge: its points
  std::vector<uint32_t> next;      ///< per edge: the one that bounds the same wedge after it
  std::vector<std::vector<uint32_t>> loops;  ///< points
  std::vector<uint32_t> outer_of;            ///< per loop, as in GridRegions
  double step = 1;                           ///< mm, a power of two

  [[nodiscard]] size_t edge_count() const { return from.size(); }
  [[nodiscard]] Point2D way(uint32_t edge) const { return points[to[edge]] - points[from[edge]]; }
  /// Whether the shape's corner at the end of an edge is wider than 180 degrees.
  [[nodiscard]] bool is_reflex_end(uint32_t edge) const {
    return cross(way(edge), way(next[edge])) < 0;
  }
};

/// Whether the direction of c comes before that of d when turning clockwise from `back`; straight
/// back is the last.
inline bool clockwise_before(const Point2D& back, const Point2D& c, const Point2D& d) {
  const auto rank = [&](const Point2D& p) {
    const int half = sign(cross(back, p));
    return half < 0 ? 0 : half > 0 ? 2 : dot(back, p) < 0 ? 1 : 3;
  };
  if (rank(c) != rank(d)) return rank(c) < rank(d);
  return cross(c, d) < 0;
}

/// Snaps the shape to a grid on which its coordinates are below 2^bits, at most 30, and cleans it
/// there. Errors: kInternal.
Result<RoofOutline> make_roof_outline(const Shape2D& shape, int bits);

/// A mesh that starts with the outline's points at height 0 and has the shape, looking down.
PolygonMesh roof_floor(const RoofOutline& outline);

/// The mesh without parts that are too thin for the outline's grid. The error says that it is not
/// closed.
Result<PolygonMesh> closed_roof(const RoofOutline& outline, PolygonMesh mesh);

Result<PolygonMesh> voronoi_roof(const RoofOutline& outline, const RoofOptions& options);
Result<PolygonMesh> straight_roof(const RoofOutline& outline);

}  // namespace csgrun
