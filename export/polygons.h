// Polygons of a rounded mesh for formats that can hold them: outlines of faces where they can stand
// for their triangles (flat, without holes, not concave), triangles elsewhere.
#pragma once

#include <span>
#include <vector>

#include <csgrun/engine/solid.h>

#include "export/rounding.h"

namespace csgrun {

struct Polygon {
  uint32_t face;                   ///< of the solid
  std::span<const uint32_t> loop;  ///< vertices of the mesh, counter-clockwise from outside
};

/// The polygons of a mesh that was rounded with outlines, in the order of faces, triangles of one
/// face in theirs. Valid as long as the mesh is.
inline std::vector<Polygon> polygons_of(const RoundedMesh& mesh) {
  std::vector<std::vector<uint32_t>> loose(mesh.outlines.size());
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const uint32_t face = mesh.triangle_face[t];
    if (mesh.outlines[face].empty()) loose[face].push_back(t);
  }
  std::vector<Polygon> polygons;
  for (uint32_t f = 0; f < mesh.outlines.size(); ++f) {
    if (!mesh.outlines[f].empty()) polygons.push_back({f, mesh.outlines[f]});
    for (const uint32_t t : loose[f]) polygons.push_back({f, mesh.triangles[t]});
  }
  return polygons;
}

}  // namespace csgrun
