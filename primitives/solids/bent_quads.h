// Quadrilaterals that are bent, cut as OpenSCAD cuts them.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// Cuts each face of four corners that do not lie in one plane, and whose shadow along the axis
/// that it faces does not cross itself, into two triangles, along the diagonal that OpenSCAD takes:
/// over which one a face is bent is a matter of volume, and files do not say it. Faces that are
/// bent by less than 10^-7 of their longest edge stay. O(n).
void cut_bent_quads(PolygonMesh& mesh);
/// The same with the diagonals that OpenSCAD takes where the points lie at `seen`; `is_mirrored` if
/// a mirror brought them there, which turns the order of the corners around. What is bent is a
/// matter of the mesh's own points all the same.
void cut_bent_quads(PolygonMesh& mesh, const std::vector<glm::dvec3>& seen, bool is_mirrored);

/// Whether the mesh has a face of four corners that is bent by more than that. O(n).
bool has_bent_quads(const PolygonMesh& mesh);

}  // namespace csgrun
