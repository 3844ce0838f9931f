// Connectivity of a result: twins, and one vertex for each fan of triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/raw_vector.h"
#include "engine/mesh/merge_faces.h"
#include "engine/mesh/whole_order.h"

namespace csgrun {

/// Triangles over points, each with the plane of its face.
struct TriangleSet {
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<uint32_t> face;  ///< per triangle
};

/// Per corner of a triangle (3 t + k) the vertex it belongs to, and per vertex its point. Vertices
/// are in order of points, then of triangles.
struct VertexFans {
  RawVector<uint32_t> vertex_of_corner;
  std::vector<uint32_t> point_of_vertex;
  bool were_parted = false;  ///< edges exchanged neighbours: see split_fans and part_faces.h
};

/// What becomes of an edge where more than two faces meet, found by their exact radial order.
enum class ContactRule : uint8_t {
  kSeparate,  ///< faces that bound the same wedge of material are neighbours
  kJoin,      ///< faces that bound the same wedge between the solids are neighbours
};

/// Makes one vertex of each closed fan of triangles. Two edges with the same two vertices are none:
/// their ends, the lower first, are put into `doubled`, if that is given, and the fans are not
/// made. Without it such edges exchange neighbours, which parts their vertices: so solids kept
/// apart are joined along an edge when they are connected around both of its ends, and the reverse.
/// Points that untouched triangles have too are one vertex. False when some directed edge has no
/// reverse, neither in the set nor on the rim.
bool split_fans(const TriangleSet& set, const std::vector<MergedFace>& faces,
                CellGeometry& geometry, const PlaneTable& planes, const WholeOrder& whole,
                ContactRule contacts, VertexFans& fans,
                std::vector<std::array<uint32_t, 2>>* doubled = nullptr);

}  // namespace csgrun
