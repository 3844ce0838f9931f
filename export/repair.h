// Repair of rounded meshes that cross themselves or have faces turned over, in a few rounds.
//
// A round does what is enough, and no more: (1) a triangle that was turned over or has no area is
// taken out by turning its longest edge, and what is thin of what is wrong by turning edges and
// merging corners: one by one, each step judged by what is near it (small_steps.h), and all at
// once, as long as that leaves less wrong (thin_triangles.h); (2) what crosses itself then is
// resolved by the exact self-union of the mesh, where only what is enclosed more often than not
// counts (winding number > 0): an overlap is united, and what turned inside out is cut away. The
// result is rounded and examined again. A round that does not leave less wrong than before is
// undone, but for (1), and in the next one, before the union, the corners of what is wrong, with
// all that shares their cells of a lattice, are snapped to it, so that what rounding brought too
// near becomes one (Valque & Lazard 2025). The lattice is coarser with each such round, up to a
// bound: what is coarser would be another model, not the same rounded. Then all are tried again
// from other origins. A round is undone, too, after which the mesh differs from the solid by more
// than all moves of its vertices explain (fidelity.h).
#pragma once

#include <csgrun/engine/error.h>
#include <csgrun/export/write.h>

#include "export/defects.h"
#include "export/fidelity.h"
#include "export/rounding.h"

namespace csgrun {

constexpr unsigned kMostRounds = 128;
/// The coarsest lattice, as a power of two of the finest that the engine takes at the mesh's
/// extent: 2^10 units in the last place of floats there; for doubles one unit of floats.
constexpr int kCoarsestFloatLattice = 13, kCoarsestDoubleLattice = 3;

/// Repairs `mesh`, which has the defects `left`, in place; its triangles go on belonging to the
/// faces of the solid that it was rounded from, whose directions are given. Outlines are lost. On
/// return `left` is what is still wrong after the rounds that `check` counts, and `check.distance`
/// has grown by what was moved. Deterministic.
/// Errors: kCancelled, kLimit, kInternal.
Status repair(RoundedMesh& mesh, std::vector<glm::dvec3> directions, Precision precision,
              const Fidelity& fidelity, const WriteOptions& options, Defects& left,
              MeshCheck& check);

}  // namespace csgrun
