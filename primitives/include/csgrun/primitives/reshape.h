// Evaluated solids as meshes of triangles again: refined, smoothed, with their points moved.
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include <csgrun/engine/solid.h>
#include <csgrun/primitives/solids.h>

namespace csgrun {

/// The triangles of a solid, with the colours and curved surfaces of their faces.
PolygonMesh triangle_mesh(const Solid& solid);

/// The mesh of triangles with every edge cut in halves until none is longer than `length` (mm, >
/// 0). The surface stays where it is; neighbours stay neighbours. `name` starts the message of
/// kLimit: too many points. O(triangles made).
MeshResult refine_edges(PolygonMesh mesh, double length, const std::string& name);

/// The mesh of triangles after `steps` of Loop's subdivision (Loop 1987): each triangle becomes
/// four, and the surface nears one without edges. The mesh must be a 2-manifold by index. kLimit:
/// too many points.
MeshResult smooth_mesh(PolygonMesh mesh, int steps);

/// The mesh with each point where `map` sends it. Errors:
/// kInvalidMesh when nothing closed is left of it. Where the moved surface crosses itself, what it
/// encloses is inside. Exceptions of the map pass through.
MeshResult warp_mesh(PolygonMesh mesh, const std::function<glm::dvec3(const glm::dvec3&)>& map,
                     std::string* note);

}  // namespace csgrun
