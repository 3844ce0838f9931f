// The measures of a triangle mesh as it stands, exactly.
#pragma once

#include "lua_bindings/measure/part_measures.h"
#include "lua_bindings/measure/triangle_mesh.h"

namespace csgrun {

/// Volume: the exact sum, rounded once. Where several surfaces meet in one edge its triangles are
/// paired by the wedges of solid between them, so that solids which only touch are counted apart;
/// `vertices` counts a vertex once for each fan of triangles around it. Components and genus are 0
/// for a mesh that is not closed.
PartMeasures measure(const TriangleMesh& mesh);

/// Pairs of triangles that meet in anything but corners and edges which both have, found exactly;
/// kMostCrossings (csgrun/export/write.h) if there are at least so many. Triangles without area are
/// left out.
uint64_t count_crossings(const TriangleMesh& mesh);

/// Triangles whose corners lie on one line, or coincide.
uint64_t count_degenerate(const TriangleMesh& mesh);

}  // namespace csgrun
