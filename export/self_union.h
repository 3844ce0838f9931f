// The exact union of a mesh with itself.
#pragma once

#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>
#include <csgrun/export/write.h>

#include "export/rounding.h"

namespace csgrun {

/// The finest power of two millimetres at which the engine's grid holds points this far out: an
/// eighth of the step of floats there, so floats of at least an eighth of the extent are on it.
GridStep lattice_of(std::span<const glm::dvec3> points);

/// What the mesh encloses with a positive winding number, evaluated exactly on the lattice and
/// rounded again. Points that are not on the lattice are snapped to it. Triangles keep the faces
/// they belong to. Errors: those of the evaluator.
Status unite_with_itself(RoundedMesh& mesh, Precision precision, const WriteOptions& options);

}  // namespace csgrun
