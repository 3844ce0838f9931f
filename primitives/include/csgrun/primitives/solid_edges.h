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

/// A straight line between two flat sides of a solid. Faces in one plane are one side.
struct SolidEdge {
  glm::dvec3 from{0}, to{0};  ///< its ends, the lower one (by x, y, z) first
  /// Of the two sides, outwards, of length 1. The first is on the left of the edge, seen from
  /// outside.
  std::array<glm::dvec3, 2> normals;
  double turn = 0;         ///< degrees between the normals
  bool is_convex = false;  ///< else it is concave
  bool is_smooth = false;  ///< between facets of one curved surface, or of fillets
};

/// All edges, ordered by their ends.
std::vector<SolidEdge> edges_of_solid(const Solid& solid);

/// A solid less what is in front of planes through two lines on either side of each edge, at
/// `distance` mm from it. `chosen` are indices of edges_of_solid(evaluated), which is the value of
/// `solid`. Where all three edges of a corner are chosen, the corner is cut off as well, through
/// the three points at which these lines meet on its sides.
///
/// Edges are cut as far as their ends: at a side that bounds the solid there to its surface, at one
/// that rises from the edge's end up to it, and where two chosen edges meet on a side in a mitre.
///
/// Errors: kInvalidArgument for an edge that is not convex, or for which that is too much: the
/// message says where it is and what fits. O(edges^2) on each side.
Result<NodePtr> chamfer_edges(const NodePtr& solid, const Solid& evaluated,
                              std::span<const uint32_t> chosen, double distance);

/// A solid with edges rounded by a cylinder of radius `radius` that touches both sides. Its facets
/// have their corners on the cylinder, as many as `facets` says for its part of a turn. Where all
/// three edges of a corner are chosen, a ball of that radius rounds the corner. All else as
/// chamfer_edges.
Result<NodePtr> fillet_edges(const NodePtr& solid, const Solid& evaluated,
                             std::span<const uint32_t> chosen, double radius, const Facets& facets);

}  // namespace csgrun
