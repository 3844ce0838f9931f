// The edges of an evaluated solid, and solids with edges cut off: chamfers and fillets.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/error.h>
#include <csgrun/engine/solid.h>
#include <csgrun/primitives/solids.h>

namespace csgrun {

/// A straight line between two flat sides of a solid. Faces in one plane are one side, also where
/// they are in one plane but for the rounding of their corners to the grid.
struct SolidEdge {
  glm::dvec3 from{0}, to{0};  ///< its ends, the lower one (by x, y, z) first
  /// Of the two sides, outwards, of length 1. The first is on the left of the edge, seen from
  /// outside.
  std::array<glm::dvec3, 2> normals;
  double turn = 0;         ///< degrees between the normals
  bool is_convex = false;  ///< else it is concave
  bool is_smooth = false;  ///< between facets of one curved surface, or of fillets
};

/// All edges, ordered by their ends, but for those of a few steps of the grid that the solid was
/// evaluated on.
std::vector<SolidEdge> edges_of_solid(const Solid& solid, double grid_step_mm);

/// Which edges of which solid are to be cut.
struct EdgeCut {
  const NodePtr& solid;
  const Solid& evaluated;            ///< the value of `solid`
  std::span<const uint32_t> chosen;  ///< indices of edges_of_solid(evaluated, grid_step_mm)
  double grid_step_mm = 0;           ///< of the grid that `solid` was evaluated on
  SourceRef where;                   ///< of what is made
};

/// A solid less what is in front of planes through two lines on either side of each edge, at
/// `distance` mm from it. Where all three edges of a corner are chosen, the corner is cut off as
/// well, through the three points at which these lines meet on its sides.
///
/// Edges are cut as far as their ends: at a side that bounds the solid there to its surface, at one
/// that rises from the edge's end up to it, and where two chosen edges meet on a side in a mitre.
/// Other material of the solid stays, also where it touches the edge.
///
/// Errors: kInvalidArgument for an edge that is not convex, for which that is too much, or too
/// little for the grid, and for one that other material touches or nearly touches, unless the sides
/// around it are along the axes: the message says where it is. O(t log t) for t triangles where
/// sides have few edges near to one another.
Result<NodePtr> chamfer_edges(const EdgeCut& cut, double distance);

/// A solid with edges rounded by a cylinder of radius `radius` that touches both sides. Its facets
/// have their corners on the cylinder, as many as `facets` says for its part of a turn. Where all
/// three edges of a corner are chosen, a ball of that radius rounds the corner. All else as
/// chamfer_edges.
Result<NodePtr> fillet_edges(const EdgeCut& cut, double radius, const Facets& facets);

}  // namespace csgrun
