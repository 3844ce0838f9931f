// The arrays of a result: what is measured and written.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>
#include <csgrun/engine/solid.h>

#include "engine/bsp/boundary_mesh.h"

namespace csgrun {

/// What the labels of a boundary mean, and the length of a step.
struct PresentContext {
  GridStep step;                              ///< never automatic here
  std::vector<Appearance> appearances;        ///< by appearance id of the labels
  Measuring measuring = Measuring::kAll;      ///< what to fill in of the measures, and the hash
  bool join_contacts = false;                 ///< EvaluateOptions::join_contacts
  bool exact_points = false;                  ///< whether to fill in the exact points
  const std::atomic<bool>* cancel = nullptr;  ///< EvaluateOptions::cancel; asked between steps
};

/// The arrays of a boundary: coplanar faces of equal appearance and surface merged wherever they
/// were touched, true corners only, T-junctions resolved, exact triangulation, one fan per vertex
/// (edges in which solids are joined may have a point in the middle), correctly rounded
/// coordinates, measures and hash. O(n log n). Errors: kCancelled; kInternal when the boundary is
/// not closed: an invariant of ours is broken.
Result<SolidPtr> present(const BoundaryMesh& boundary, const PresentContext& context);

}  // namespace csgrun
