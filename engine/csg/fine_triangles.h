// Triangles of faces whose loops cross only once they are rounded.
//
// Outlines come with vertices that lie much nearer to their edges than a step of a coarse grid:
// parts of unions, for instance. On the grid their loops then cross by less than a step, no
// triangulation has them as its boundary, and the fans that would take its place cross the whole
// face. The triangulation of the loops as they were given, on a grid as fine as integers allow,
// differs from a valid one in slivers only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// By face: triangles over `points` of the mesh, or none for a face that is a triangle or whose
/// loops cross as they are. O(n log n).
std::vector<std::vector<std::array<uint32_t, 3>>> fine_triangles(const PolygonMesh& mesh);

}  // namespace csgrun
