// Connectivity of a result: T-junctions, twins, and one vertex for each fan of triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/merge_faces.h"

namespace csgrun {

/// Inserts into the loops of faces the points at which neighbours have corners: afterwards each
/// directed edge between consecutive points has as many reverses as copies (Campen & Kobbelt 2010,
/// section 4.3). New edges inherit the plane. False when the faces do not close.
bool resolve_t_junctions(std::vector<MergedFace>& faces, CellGeometry& geometry,
                         const PlaneTable& planes);

/// Triangles over points, each with the plane of its face.
struct TriangleSet {
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<uint32_t> face;  ///< per triangle
};

/// Per corner of a triangle (3 t + k) the vertex it belongs to, and per vertex its point. Around an
/// edge where more than two triangles meet, each pair that bounds the same wedge of material is
/// joined, found by the exact radial order: solids that touch along an edge are apart, unless they are
/// connected around both ends of it (then they are joined along it, so that no two edges have the same
/// vertices). Vertices are in order of points, then of triangles.
struct VertexFans {
  std::vector<uint32_t> vertex_of_corner;
  std::vector<uint32_t> point_of_vertex;
};

/// False when some directed edge has no reverse.
bool split_fans(const TriangleSet& set, const std::vector<MergedFace>& faces,
                CellGeometry& geometry, const PlaneTable& planes, VertexFans& fans);

}  // namespace csgrun
