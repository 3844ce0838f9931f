// An outline that shrinks: every edge moves inwards at speed 1 along its normal, and what its
// corners pass over are the arcs of the straight skeleton.
//
// Between events all corners move on straight lines. At an event edges have shrunk to nothing, or
// corners that point inwards have reached other edges. All that happens at one time is taken
// together: corners that meet are one place, edges that a corner has reached are cut there, pieces
// that lie on each other in opposite directions vanish (a ridge), and around each place the edges
// that are left are paired anew, each with the one that bounds the same wedge of the inside. So
// corners that meet head on, squares, crosses and parallel walls need no rules of their own.
//
// Invariants: (1) every corner's two neighbours know it; (2) an edge's two corners are on its line,
// moved inwards by the time; (3) an arc or a ridge is told once, to the faces on both its sides.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "primitives/shape2d/roof_outline.h"

namespace csgrun {

/// The straight skeleton, as the borders of its faces. Lengths and times in steps of the outline.
struct Skeleton {
  struct Node {
    glm::dvec2 at;
    double time = 0;
  };
  /// A directed border of the face of an edge, which is on its left.
  struct Border {
    uint32_t edge, from, to;
  };
  std::vector<Node> nodes;  ///< first the points of the outline
  std::vector<Border> borders;
};

/// `corners` says where the outline's points are: on its grid, or near it. Which way edges turn is
/// told by the grid. Nothing if the wavefront comes to no end: rounding has misled it. O(n^2) time
/// as a rule.
std::optional<Skeleton> shrink(const RoofOutline& outline, const std::vector<glm::dvec2>& corners);

}  // namespace csgrun
