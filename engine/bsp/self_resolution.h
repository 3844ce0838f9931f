// A surface that crosses itself, made into the boundary of what it encloses (Campen & Kobbelt 2010,
// chapter 6).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>

#include "engine/bsp/operand.h"

namespace csgrun {

/// What a surface encloses. By winding number w, which an oriented closed surface gives each point
/// off it; or by what can be reached from infinity.
enum class InsideRule : uint8_t {
  kNonZero,       ///< w != 0
  kPositive,      ///< w > 0
  kEvenOdd,       ///< w odd
  kOuterHull,     ///< not reachable from infinity without crossing the surface
  kOrientedHull,  ///< likewise, where crossings from back to front are free
};

/// The boundary of what `surface` encloses, in canonical form, exactly; identical to the surface's
/// own where nothing crosses it.
///
/// A leaf may cross itself if it is otherwise as LeafGeometry says: balanced, with planar convex
/// faces. `crossings` are all pairs of its faces that meet other than in common edges and vertices
/// (by coordinates), each once, in any order. A boundary does not cross itself: `crossings` is
/// empty. The surface's frame and translation are obeyed.
///
/// The cost is that of the places where the surface crosses itself, and O(n log n) to tell the
/// parts that are left inside from those that are not. By a fill rule polygons are cut whole where
/// `options.whole_faces` allows it (cut_surface.h), else by cells. `stats` is added to. Errors:
/// kCancelled, kInternal.
Result<std::shared_ptr<const BoundaryMesh>> resolve_surface(
    const Operand& surface, std::span<const std::array<uint32_t, 2>> crossings, InsideRule rule,
    const KernelOptions& options, EvaluateStats& stats);

}  // namespace csgrun
