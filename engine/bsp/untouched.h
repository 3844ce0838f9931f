// Triangles of leaves that no operation came near: named, not copied.
//
// A face of a leaf is untouched in a result when all faces at its corners are there as they are in
// the leaf, all of them kept or all of them turned over, and each corner is simple: its faces form
// one fan. What lies around such a face is as it was in the leaf, so nothing of it can be merged,
// broken or joined with anything else. (A facet that is kept as it is where nothing touches it, or
// the only face of a convex leaf in its plane.)
#pragma once

#include <memory>
#include <vector>

#include "engine/bsp/assemble.h"
#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/job.h"

namespace csgrun {

/// Takes the untouched triangles of the operands out of `whole`; their corners that other faces
/// have too are named by the job's vertices in UntouchedPart::shared. A leaf counts if it stands in
/// the world's axes, touches itself nowhere, and its edges are paired; a face if it is a triangle,
/// and a kept facet of its own or of a convex leaf and alone in its plane. O(faces of such leaves).
std::vector<UntouchedPart> take_untouched(const Job& job, const std::vector<Operand>& operands,
                                          std::vector<WholePolygon>& whole);

/// The same boundary with all faces spelled out; the mesh itself if they are.
std::shared_ptr<const BoundaryMesh> expanded(std::shared_ptr<const BoundaryMesh> mesh);

}  // namespace csgrun
