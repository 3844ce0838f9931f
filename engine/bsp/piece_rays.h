// Winding numbers in front of pieces of a closed surface's polygons, which meet nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/packed_boxes.h"

namespace csgrun {

class PieceRays {
 public:
  /// The surface is the only operand of the job, a leaf without a frame, and closed. `geometry`
  /// holds the pieces. O(n).
  PieceRays(const Job& job, CellGeometry& geometry);

  /// How often the surface wraps around a point just in front of all that lies where the piece is:
  /// by a ray from a point of a fine grid inside of it, moved off all vertices and edges by
  /// infinitesimals. Exact; none if no such point is found. REQUIRES: no polygon meets the inside
  /// of the piece without holding all of it. O(log n + k) mostly for k polygons along the ray.
  [[nodiscard]] std::optional<int32_t> winding_in_front(const Fragment& piece) const;

 private:
  /// A line along an axis, in parts of a grid step, that passes the two other coordinates.
  struct Line {
    size_t axis, u, v;
    std::array<int64_t, 2> at;
  };
  [[nodiscard]] std::optional<Line> line_through(const Fragment& piece, const Plane& plane) const;
  [[nodiscard]] int turns_around(uint32_t polygon, const Line& line) const;
  [[nodiscard]] Plane plane_of(uint32_t polygon) const;

  const Job& job_;
  CellGeometry& geometry_;
  PackedBoxes tree_;  ///< of all polygons
};

}  // namespace csgrun
