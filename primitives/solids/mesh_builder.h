// Faces with holes, appended to a PolygonMesh.
#pragma once

#include <span>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// The most points that a primitive may have: beyond it the numbers asked for are a mistake, and
/// the arrays would take gigabytes.
constexpr double kMostPoints = 1 << 24;

/// Facets that turn by less than this are shaded as one curved surface; a hexagonal nut is not.
constexpr double kSmoothTurnDegrees = 40;

/// Appends one face: its outer loop, then its holes.
void add_face_with_holes(PolygonMesh& mesh, std::span<const std::vector<uint32_t>> loops,
                         uint32_t surface_id = 0);

/// An error that says "sphere: 100000 fragments make 5e+09 points, the limit is 16777216".
Error too_many_points(const std::string& function, double fragments, double points);

}  // namespace csgrun
