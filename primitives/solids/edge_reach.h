// How far the bodies along chosen edges reach beyond the surface. A little, so that no face of
// theirs lies in one of the solid's but for rounding to the grid; but where the solid has other
// material there, which touches the edge or nearly so, that must stay.
#pragma once

#include <optional>

#include <csgrun/engine/error.h>

#include "primitives/solids/edge_ends.h"

namespace csgrun {

/// Sets the reach of all chosen edges: a part of the setback, and some grid steps at least; less
/// where other material is near; none (flush) where there is no room for that, and sides along the
/// axes do without. Errors: kInvalidArgument for an edge at which neither is possible, or whose
/// setback is of few grid steps. O((t + e) log t) for the t triangles near to e edges.
std::optional<Error> choose_reaches(const Solid& solid, EdgeFrames& frames, const EdgeEnds& ends,
                                    double grid_step_mm);

}  // namespace csgrun
