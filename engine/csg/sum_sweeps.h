// What the boundary of a solid sweeps when a convex solid is summed with it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// Convex solids whose union, with A + `middle`, is A + B. Each is the hull of a face, an edge or a
/// vertex of A, moved by `middle`, and of the same with what it is summed with here.
struct SumSweeps {
  /// A face, and those vertices of B that are farthest along its normal, as a face of B has them:
  /// one, or the ends of an edge, or all of a face. One of these will do where the angles at the
  /// edges of the face are all more than 180 degrees.
  struct Face {
    uint32_t face;
    uint32_t first, count;  ///< in `farthest`
  };
  /// An edge of A, as the face on its left runs, and one of B, as the farthest vertex changes when
  /// the normal turns from that face to the other.
  struct Edge {
    uint32_t from, to;
    uint32_t b_from, b_to;
  };
  /// A vertex of A and a face of B.
  struct Vertex {
    uint32_t vertex, face;
  };

  IVec3 middle;  ///< strictly inside of B
  std::vector<Face> faces;
  std::vector<uint32_t> farthest;
  std::vector<Edge> edges;
  std::vector<Vertex> vertices;
};

/// Let B have 0 inside, and x be a point of A + B in general position that is not in A. With t the
/// least for which x is in A + tB, A and x - tB have points in common, but the inside of x - tB has
/// none of A. Of these there is one, p, in an element of the boundary of A (a face, an edge or a
/// vertex) and in one of x - tB, -t b of B's, that have no direction in common; so their dimensions
/// are 2 and 0, 1 and 1, or 0 and 2, or x would not be in general position.
///   - In a face of A, and at a vertex b: that is farthest along the face's normal. (If x - tB has
///     a face there, no edge at which A rises lets it out of A's: it is at each of its vertices.)
///   - In an edge of A, and in an edge of B. If the angle at the edge of A is 180 degrees or more,
///     x - tB is behind neither of its faces, and b is farthest along both normals. Else a normal
///     between these, or one of them, is one of B's edge. One of them: b is farthest along it.
///   - At a vertex v of A, and in a face of B: all of A near v is behind that face. So are the
///   edges
///     of A at v; and of two faces of A at the highest of these the angle is less than 180 degrees,
///     as what is above them is not in A. No such normal is between those of the faces around v if
///     the same vertex alone is farthest along all of these.
/// So x is in one of these, all of which are parts of A + B; and there are about as many as faces
/// of A, and as faces that A + B has where A is convex. (Cells of sums, as in sum_cells, are more
/// wherever A is not convex: then most of them lie inside.)
///
/// Nothing if there is no grid point strictly inside of B, close to its middle, if an edge of A has
/// not two faces, or if several faces of B are in one plane. REQUIRES: A bounds a solid and crosses
/// nothing; B is convex; |coordinate| <= 2^40. Exact:
/// what may be left out is told by exact signs, and by doubles with room for their errors. O(|A|
/// |B|), and quick.
std::optional<SumSweeps> sum_sweeps(const LeafGeometry& a, const LeafGeometry& b);

}  // namespace csgrun
