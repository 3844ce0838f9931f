// From solids to 2D shapes: shadows and sections.
#pragma once

#include <optional>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/shape2d.h>

namespace csgrun {

/// The shadow of a solid on the plane z = 0: the union of its faces that look up, exact on the 2D
/// grid. `grid_mm`: the step of the grid that the solid was evaluated on (EvaluateStats::grid_mm);
/// it tells which corners of the shadow may be there by rounding. Errors: kOutOfRange, kInternal.
Result<Shape2D> project_solid(const Solid& solid, double grid_mm);

/// The section of a solid just above height z: what the plane cuts, with faces in the plane that
/// have the solid above them. Cut exactly; corners are then rounded to the 2D grid. `z` must be
/// finite. Errors: those of Evaluator::section.
Result<Shape2D> slice_solid(Evaluator& evaluator, const NodePtr& solid, double z);

/// The appearance that all of a tree has, as far as it tells without being evaluated: what its
/// shadows and sections are painted with. Nothing where it is that of no colour, or where there are
/// several; of a difference the first operand's counts. O(nodes).
std::optional<Appearance> one_appearance_of(const NodePtr& root);

}  // namespace csgrun
