// The faces of a leaf that cross others, cut whole, and the winding number in front of everything:
// what a surface that crosses itself in few places costs is told by these places.
//
// A face is cut along the planes of all faces that it crosses or touches, or along their edges if
// they lie in its own, so that no other face meets the inside of a piece without holding all of it.
// From one piece of a face to the next the winding number changes by the faces that stand
// between them, and over an edge of two faces that no other one touches it stays. One ray for all
// that hangs together in this way says what it is. Faces that too many cross, and those of which a
// piece is too thin for a ray to start in it, are left to the cells that they are in.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>

#include "engine/bsp/fragment_set.h"
#include "engine/bsp/job.h"
#include "engine/bsp/operand.h"

namespace csgrun {

struct CutSurface {
  /// Per polygon that crosses nothing: the winding number in front of it. Behind it is one more.
  std::vector<int32_t> winding_of_polygon;
  /// Of polygons that cross others. Where several lie upon one another one of them has the pieces.
  struct Pieces {
    FragmentSet set;
    /// One for one: the winding numbers in front of all that lies there, from where the piece is
    /// seen, and behind it.
    std::vector<std::array<int32_t, 2>> windings;
  };
  std::vector<Pieces> pieces;  ///< cut whole, and of cells
};

/// Cuts the only operand of a job, a leaf in no frame of its own. `opposite` are its own opposite
/// edges, or NonManifold's. `crossings` as resolve_surface has them; `crosses` says for each
/// polygon whether it is in one of them.
///
/// To cells go polygons that more than kMostCuts planes would cut, and those with pieces in which
/// PieceRays finds no start. Of a surface that is not closed all is asked of cells, which see that:
/// also polygons that something crosses which ends at no corner of a piece, and what hangs together
/// with no polygon that crosses nothing.
///
/// std::nullopt where the parts contradict each other, or the evaluation was cancelled. O(n log n)
/// and, for a polygon that k planes cut, O(k^3). `stats` is added to. Errors: those of
/// solve_surface_cells.
Result<std::optional<CutSurface>> cut_surface(Job& job, const LeafGeometry& leaf,
                                              std::span<const uint32_t> opposite,
                                              std::span<const std::array<uint32_t, 2>> crossings,
                                              std::span<const uint8_t> crosses,
                                              const KernelOptions& options, EvaluateStats& stats);

/// So many planes may cut one polygon.
constexpr size_t kMostCuts = 48;

}  // namespace csgrun
