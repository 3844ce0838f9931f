// linear_extrude with rounded edges at its bottom and top.
//
// Across an edge of the outline the profile is a quarter of a circle: each layer is the outline
// with its edges moved inwards, sharp corners staying sharp, so every corner runs along the
// bisector of its two edges, concave ones and those of holes too. As long as no edge vanishes and
// no walls meet the layers have the outline's own points, and bands between them are trapezoids:
// closed by construction. Beyond that the bands are cut from the outline's roof (inset_bands.h).
#pragma once

#include <csgrun/primitives/shape2d.h>

namespace csgrun {

/// REQUIRES: a shape that is not empty, options that linear_extrude has checked, one of the radii
/// `round` not 0. Errors: kInvalidArgument when the radii do not fit, kLimit, kInternal. O(layers x
/// points) as long as the outline keeps its form.
MeshResult rounded_extrude(const Shape2D& shape, const LinearExtrudeOptions& options,
                           const glm::dvec3& height);

}  // namespace csgrun
