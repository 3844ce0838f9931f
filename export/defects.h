// What is wrong with a rounded mesh, exactly.
//
// A crossing is a pair of triangles that have a point in common beyond the corners and edges which
// both have by coordinates. A triangle is degenerate when its corners lie on one line, and flipped
// when its normal makes more than 90 degrees with that of the exact face that it belongs to. Where
// nothing crosses, a surface is inverted when the winding number in front of it is not 0 (see
// shells.h). A mesh without these is the boundary of a solid, at the coordinates that are in the
// file.
#pragma once

#include <vector>

#include <csgrun/engine/exact_triangles.h>
#include <csgrun/export/write.h>

#include "export/clean_triangles.h"
#include "export/rounding.h"

namespace csgrun {

struct Defects {
  std::vector<TriangleCrossing> crossings;
  std::vector<uint32_t> degenerate, flipped;  ///< triangles, ascending
  /// One triangle of each inverted surface, ascending; not looked for where something crosses.
  std::vector<uint32_t> inverted;

  [[nodiscard]] size_t count() const {
    return crossings.size() + degenerate.size() + flipped.size() + inverted.size();
  }
  [[nodiscard]] bool none() const { return count() == 0; }
  [[nodiscard]] MeshDefects counts() const {
    return {crossings.size(), degenerate.size(), flipped.size(), inverted.size()};
  }
  /// Whether a mesh with these is better than one with `before`, or may be: where counting ended
  /// both times, nobody knows.
  [[nodiscard]] bool fewer_than(const Defects& before) const {
    return count() < before.count() ||
           (crossings.size() >= kMostCrossings && before.crossings.size() >= kMostCrossings);
  }
};

/// So many places of each kind of defect are told.
constexpr size_t kMostPlaces = 8;

/// Directions of the exact faces of a solid under an affine map, outwards as the map leaves them:
/// from their exact planes where the solid has them, else from their corners.
std::vector<glm::dvec3> face_directions(const Solid& solid, const Affine& placement);

/// Of all those only the degenerate and flipped triangles. O(n).
Defects find_bad_triangles(const RoundedMesh& mesh, std::span<const glm::dvec3> directions);

/// The defects of a mesh rounded from a solid with these face directions. O(n log n); of `clean`
/// triangles no two are held against each other. `threads`: as WriteOptions has them.
Defects find_defects(const RoundedMesh& mesh, std::span<const glm::dvec3> directions,
                     const CleanTriangles& clean = {}, unsigned threads = 0);

/// Where the first few defects of each kind are, and what made the triangles.
std::vector<DefectPlace> places_of(const Defects& defects, const RoundedMesh& mesh,
                                   const Solid& solid);

}  // namespace csgrun
