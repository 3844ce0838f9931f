// The fast way through a Boolean: polygons are cut whole along the segments in which they cross
// others, and patches between cuts are kept, turned over or dropped as a whole. No cell cuts
// anything, no plane is made away from the cuts, and connectivity is by name where no sign is zero
// (cut_polygon.h), by value where polygons touch (face_arrangement.h).
//
// Left to the general way (octree.h, cell_solver.h), which is exact for all: where edges of more
// than two faces are in contact, where doubles do not decide what a ray meets, and evaluations with
// so many contacts that cells are less work.
#pragma once

#include <cstdint>
#include <vector>

#include <csgrun/engine/evaluate.h>

#include "engine/bsp/assemble.h"
#include "engine/bsp/fragment_set.h"
#include "engine/bsp/job.h"
#include "engine/bsp/near_faces.h"

namespace csgrun {

struct WholeFaces {
  FragmentSet cut;                  ///< what is kept of polygons that were cut
  std::vector<WholePolygon> whole;  ///< what is kept as it is
  std::vector<FarFaces> far;        ///< per operand; empty if the job has all faces
  std::vector<uint8_t> general;     ///< per polygon: left to the general way
  bool any_general = false;         ///< or a face that the job does not have
  bool is_crowded = false;          ///< given up: see KernelOptions::stop_when_crowded
  /// Where what is kept, here or in the general way, may touch itself; see BoundaryMesh::touches.
  std::vector<GridBox> touching;
};

/// Evaluates an expression as far as names do. `stats` is added to. Errors: kCancelled, kInternal.
Result<WholeFaces> evaluate_whole_faces(Job& job, const Expression& expression,
                                        const KernelOptions& options, EvaluateStats& stats);

}  // namespace csgrun
