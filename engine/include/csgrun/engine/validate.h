// Checks of meshes that come from outside: is it closed, oriented, free of degenerate faces?
#pragma once

#include <string>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// What is wrong with a mesh: counts, and the coordinates of the first places of each kind.
struct MeshReport {
  uint64_t open_edges = 0;         ///< directed edges without a reverse
  uint64_t misoriented_edges = 0;  ///< edges whose faces run in the same direction
  uint64_t degenerate_faces = 0;   ///< fewer than three distinct points, or no area
  uint64_t bad_indices = 0;
  uint64_t non_finite_points = 0;
  std::vector<std::string> first_places;  ///< "open edge (0, 0, 0) - (1, 0, 0)", at most 5 a kind

  [[nodiscard]] bool ok() const {
    return !open_edges && !misoriented_edges && !degenerate_faces && !bad_indices &&
           !non_finite_points;
  }
  /// One line for a message: "3 open edges (first: (0,0,0)-(1,0,0)), 1 degenerate face ...".
  [[nodiscard]] std::string text() const;
};

/// Examines a mesh as it stands (points are compared by index). O(n log n).
[[nodiscard]] MeshReport check_mesh(const PolygonMesh& mesh);

/// Merges points of equal coordinates and drops points that no face uses. O(n).
void weld_points(PolygonMesh& mesh);

/// The signed volume in mm^3, in doubles: for telling whether a closed mesh is inside out.
/// REQUIRES: no bad indices (MeshReport::bad_indices).
[[nodiscard]] double signed_volume(const PolygonMesh& mesh);

/// Turns every face over.
void reverse_faces(PolygonMesh& mesh);

}  // namespace csgrun
