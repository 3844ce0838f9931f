// Leaves of many bodies that cross one another, resolved as a union of the bodies.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "engine/bsp/self_resolution.h"

namespace csgrun {

/// resolve_surface of a leaf in local axes, with the same result: by a union of the leaf's bodies
/// where so many faces cross that to cut each by all others would be more work. Errors: those of
/// resolve_surface and evaluate_boolean.
Result<std::shared_ptr<const BoundaryMesh>> resolve_leaf(
    const Operand& surface, std::span<const std::array<uint32_t, 2>> crossings, InsideRule rule,
    const KernelOptions& options, EvaluateStats& stats);

/// The same by the union, if the bodies (csg/bodies.h) tell what is inside: each wraps every point
/// 0 or 1 times, or, if it crosses itself and is resolved before, never a negative number of times.
/// Nothing where they do not, or most pairs of faces that cross are of one body.
/// REQUIRES: `rule` is kNonZero or kPositive, which are the same then; closed.
std::optional<Result<std::shared_ptr<const BoundaryMesh>>> resolve_bodies(
    const LeafGeometry& leaf, std::span<const std::array<uint32_t, 2>> crossings, InsideRule rule,
    const KernelOptions& options, EvaluateStats& stats);

}  // namespace csgrun
