// The loops of cut faces that are part of a result.
#pragma once

#include "engine/bsp/cut_faces.h"
#include "engine/bsp/fragment_set.h"
#include "engine/bsp/job.h"
#include "engine/bsp/patch_fates.h"

namespace csgrun {

/// The loops that are kept, but for rims, as pieces: what stays whole is told by its polygon. Makes
/// the planes of the polygons' own edges that any kept loop runs along. Parallel, O(n).
FragmentSet emit_loops(Job& job, const CellGeometry& geometry, const CutFaces& cut,
                       const PatchFates& fates);

}  // namespace csgrun
