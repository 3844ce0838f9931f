// The solved cells of a surface that crosses itself, in parallel: the pieces of the polygons that
// cross others, and what is known of the volumes on their sides.
#pragma once

#include <cstdint>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>

#include "engine/bsp/fragment_set.h"
#include "engine/bsp/surface_octree.h"
#include "engine/bsp/surface_patches.h"

namespace csgrun {

/// Volumes are those that a cell is divided into by the surface; they are numbered through a run.
struct SurfaceCells {
  /// Beside FragmentSet::pieces, one for one: which volumes a piece parts. `front` is on the
  /// positive side of its plane; the piece is seen from there.
  struct Sides {
    uint32_t front, back;
    bool has_up, has_down;  ///< polygons of the surface that face the front lie here; the back
  };
  /// A cell in which a patch was seen: the volumes at the front and the back of its polygons.
  struct PatchSides {
    uint32_t patch, front, back;
  };
  /// An edge of a piece in a wall of its cell: there the surface runs on in the next cell.
  struct WallEdge {
    uint32_t support, wall;
    bool is_below;      ///< the piece is on the negative side of the wall
    uint32_t from, to;  ///< FragmentSet::points
    uint32_t front, back;
  };
  /// The volume just below (lexicographically) a vertex.
  struct VertexVolume {
    uint32_t vertex, volume;
  };

  FragmentSet set;
  std::vector<Sides> sides;
  std::vector<int32_t> windings;  ///< per volume
  std::vector<PatchSides> patches;
  std::vector<WallEdge> wall_edges;          ///< when asked for
  std::vector<VertexVolume> vertex_volumes;  ///< of a vertex that was asked for
  /// When asked for, per point of the set: the volume just below it; kNone for a point in a wall.
  std::vector<uint32_t> below_point;
};

struct SurfaceCellsRequest {
  bool wall_edges = false;
  uint32_t below_vertex = kNone;  ///< a vertex of the job whose volume is wanted
  bool below_points = false;
};

/// Solves all cells of the octree; runs of cells in order, whatever number of threads.
/// Errors: kCancelled; kInternal when the surface is not closed.
Result<std::vector<SurfaceCells>> solve_surface_cells(Job& job, const SurfaceOctree& tree,
                                                      const SurfacePatches& patches,
                                                      const SurfaceCellsRequest& request,
                                                      const KernelOptions& options,
                                                      EvaluateStats& stats);

}  // namespace csgrun
