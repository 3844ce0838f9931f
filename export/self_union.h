// The exact union of a mesh with itself.
#pragma once

#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>
#include <csgrun/export/write.h>

#include "export/fidelity.h"
#include "export/rounding.h"

namespace csgrun {

/// The finest power of two millimetres at which the engine's grid holds points this far out: an
/// eighth of the step of floats there, so floats of at least an eighth of the extent are on it.
GridStep lattice_of(std::span<const glm::dvec3> points);

/// The faces that a mesh belongs to.
struct MeshFaces {
  std::vector<glm::dvec3> directions;  ///< along their outward normals
  std::vector<uint32_t> original;      ///< the face of the solid that was to be written
};

/// What the mesh encloses with a positive winding number, evaluated exactly on the lattice and
/// rounded again. Points that are not on the lattice are snapped to it. The faces become those of
/// the exact union, each of which goes on belonging to an original one. Outlines are lost. What
/// was moved is added to `moves`. Errors: those of the evaluator; then nothing has changed.
Status unite_with_itself(RoundedMesh& mesh, MeshFaces& faces, Precision precision,
                         const WriteOptions& options, Moves& moves);

}  // namespace csgrun
