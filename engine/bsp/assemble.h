// From fragments to the canonical boundary of a result.
#pragma once

#include <memory>
#include <vector>

#include <csgrun/engine/error.h>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/fragment_set.h"

namespace csgrun {

/// A polygon that belongs to the result as a whole, as it is or turned over. What of another
/// operand is in the result touches it in its rim, if it is met, or not at all.
struct WholePolygon {  // small: there may be one for each polygon of the operands
  uint32_t polygon : 30;
  bool flip : 1;
  bool is_met : 1 = false;  ///< another operand's surface touches it, and see rim_faces.h
};

/// BoundaryMesh::may_touch and ::touches.
struct Touching {
  bool anywhere = true;
  std::vector<GridBox> boxes{};  ///< more places
};

/// Merges the fragments of each (plane, side, label) into maximal regions, names equal points once,
/// and brings everything into canonical order. `job` must have planes for all polygons concerned;
/// they are made here for whole ones. `touching` is what BoundaryMesh says. O(k log k).
/// `parts` are taken over as they are, but for the numbers of their shared points: vertices of the
/// job, which other faces have. Error kInternal when the fragments do not close up: an invariant of
/// ours is broken. What is given is let go of as soon as it was read, for there is much of it.
Result<std::shared_ptr<const BoundaryMesh>> assemble(Job& job, std::vector<FragmentSet> sets,
                                                     std::vector<WholePolygon> whole,
                                                     Touching touching = {},
                                                     std::vector<UntouchedPart> parts = {});

}  // namespace csgrun
