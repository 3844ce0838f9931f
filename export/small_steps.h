// Steps of repair one by one: each is taken if less is wrong near it then.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include <csgrun/engine/error.h>

#include "export/rounding.h"

namespace csgrun {

struct SmallSteps {
  uint64_t turned = 0;  ///< edges
  uint64_t merged = 0;  ///< vertices that went to another one
  double farthest = 0;  ///< mm: no point of the surface moved by more
};

/// Takes what is wrong of the triangles `wrong` out of a mesh, and what comes of that, by turning
/// edges next to a thin triangle and by merging the two ends of short ones. Each such step moves
/// the surface by less than `width` (mm), which is doubled from `first` to `last`. Of the steps
/// near a triangle of which something is wrong the best is taken: the one after which the least
/// crosses, has no area or is turned over, or as much, but with less area turned over: so a corner
/// that rounding put beyond several thin triangles goes through one after another. Exact near each
/// step; surfaces that are inside out are not seen, so whether less is wrong in the end is for who
/// calls to see. Vertices and triangles are numbered anew, and outlines are lost, if any step was
/// taken. Errors: kCancelled; kInternal when the result is not a closed manifold. O(n log n), and
/// what is near what is wrong.
Result<SmallSteps> take_small_steps(RoundedMesh& mesh, std::span<const uint32_t> wrong,
                                    double first, double last,
                                    std::span<const glm::dvec3> directions,
                                    const std::atomic<bool>* cancel = nullptr);

}  // namespace csgrun
