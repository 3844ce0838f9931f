// Pieces of result boundary on their way from where they are cut to the assembled mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/raw_vector.h"
#include "engine/bsp/cell_geometry.h"

namespace csgrun {

struct FragmentSet {
  struct NamedPoint {
    std::array<double, 3> rounded;
    std::array<uint32_t, 3> planes;  ///< kNone thrice for a vertex of a leaf
    uint32_t vertex;                 ///< of the job, or kNone
  };
  /// A piece; `plane` is oriented to the outside of the result.
  struct Piece {
    PlaneId plane;
    uint32_t polygon;
    uint32_t first, count;  ///< into corner_point and corner_plane
    /// The loop may run along a line twice, or past points at which it does not turn.
    bool is_loose = false;
  };

  RawVector<NamedPoint> points;
  std::vector<Piece> pieces;
  RawVector<uint32_t> corner_point, corner_plane;

  /// Adds a fragment; `flip`: the outside of the result is behind it. `numbers` maps the geometry's
  /// points to this set's and grows as needed; it belongs to one geometry between two clear()
  /// calls.
  void add(const CellGeometry& geometry, const Fragment& f, bool flip,
           std::vector<uint32_t>& numbers) {
    Piece piece{flip ? f.support.flip() : f.support, f.polygon,
                static_cast<uint32_t>(corner_point.size()), f.count};
    numbers.resize(geometry.point_count(), kNone);
    for (uint32_t i = 0; i < f.count; ++i) {
      const uint32_t p = geometry.corners(f)[corner_place(i, f.count, flip)];
      if (numbers[p] == kNone) {
        numbers[p] = static_cast<uint32_t>(points.size());
        const auto& s = geometry.point(p);
        points.push_back({s.rounded, s.planes, s.vertex});
      }
      corner_point.push_back(numbers[p]);
      corner_plane.push_back(geometry.edges(f)[edge_place(i, f.count, flip)]);
    }
    pieces.push_back(piece);
  }

  /// Turns a piece over.
  void flip(Piece& piece) {
    const auto corner = corner_point.begin() + piece.first,
               edge = corner_plane.begin() + piece.first;
    std::reverse(corner, corner + piece.count);
    // The last edge, which closes the loop, stays the last.
    std::reverse(edge, edge + piece.count - 1);
    piece.plane = piece.plane.flip();
  }
};

}  // namespace csgrun
