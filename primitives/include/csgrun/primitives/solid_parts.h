// Solids in parts, by a plane and by what is connected; solids grown and shrunk.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>

namespace csgrun {

/// The plane of the points p with normal . p = offset.
struct CutPlane {
  glm::dvec3 normal{0, 0, 1};     ///< of length 1
  double offset = 0;              ///< mm
  glm::dvec3 direction{0, 0, 1};  ///< the normal as it was given, of any length
  glm::dvec3 point{0};            ///< mm: one of its points, as it was given
};

/// The plane with a normal of any length but 0, at a distance from the origin along it, or through
/// a point. Errors: kInvalidArgument.
Result<CutPlane> make_cut_plane(const glm::dvec3& normal, double offset);
Result<CutPlane> make_cut_plane(const glm::dvec3& normal, const glm::dvec3& point);

/// A box or a prism whose face lies in the plane, large enough to hold all of `solid` that is in
/// front of it; empty if that is nothing; made at `where`. What is cut with it keeps its exact
/// planes. The face lies in the plane exactly if the normal is a multiple of small whole numbers
/// and the point is one of the grid (whose step is not larger than a part of 1 mm that such a
/// plane needs for so small a solid); else its corners, or its offset, are rounded to the grid.
/// Errors: those of the evaluation.
Result<NodePtr> half_space(Evaluator& evaluator, const NodePtr& solid, const CutPlane& plane,
                           const SourceRef& where);

/// A solid with its surface moved outwards by `tool`, a convex solid about the origin, or inwards
/// when `distance`, which the tool reaches along each axis, is negative: then what the tool touches
/// when it is moved over all that is outside goes, which is all of it where the tool has no room.
/// Exact on the grid, as minkowski_sum. Errors:
/// those of the evaluation.
Result<NodePtr> offset_solid(Evaluator& evaluator, const NodePtr& solid, const NodePtr& tool,
                             double distance);

struct Components {
  std::vector<NodePtr> parts;
  size_t rounded_corners = 0;  ///< that were not on the grid, of those made of their corners
};

/// The connected solids of which one consists, in the order of their smallest corners; voids belong
/// to what is around them. Solids that touch in edges or corners are apart. A component is cut out
/// by boxes, exactly, if its box meets no other's, or if it has corners off the grid and one of any
/// two whose boxes meet is clear of a box around the other, along the world's axes or along faces;
/// others are made of their corners, which are rounded to the grid where they are not on it.
/// Errors: those of the evaluation.
Result<Components> decompose_solid(Evaluator& evaluator, const NodePtr& solid,
                                   const SourceRef& where);

}  // namespace csgrun
