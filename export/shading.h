// Normals for shading: which corners of a mesh share one, and what it is.
//
// Faces of one curved surface of one leaf are shaded as one where they meet at less than 40
// degrees; every other edge is sharp. The normal of a corner is the mean of the exact normals of
// the faces that are smooth with it around its vertex, each face counted once: so it does not
// depend on how faces were cut or triangulated, and needs no arc cosine, which differs between
// machines.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <csgrun/engine/solid.h>

#include "export/rounding.h"

namespace csgrun {

/// A mesh whose vertices were duplicated where their corners have different normals.
struct ShadedMesh {
  std::vector<uint32_t> vertex_of;            ///< per shading vertex: its vertex of the manifold
  std::vector<std::array<float, 3>> normals;  ///< per shading vertex: unit length, never NaN
  std::vector<Triangle> triangles;            ///< of shading vertices, in the mesh's order
};

/// Shades a mesh that was rounded from `solid`. Of the shading vertices of one vertex, the first is
/// the one that the manifold is made of. O(n).
ShadedMesh shade(const Solid& solid, const RoundedMesh& mesh);

}  // namespace csgrun
