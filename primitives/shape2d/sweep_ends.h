// Ends of sweeps as planes: the last piece goes on, and a box takes off what is beyond the end.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// The rings of an open sweep: corners are numbers of points, the same of each ring in its order.
struct SweepRings {
  std::span<const glm::dvec3> points;
  std::span<const std::vector<uint32_t>> rings;
};

/// One end of it, the first ring or the last.
struct SweepEnd {
  bool is_last;
  glm::dvec3 at;        ///< of the path
  glm::dvec3 outwards;  ///< along the path; of length 1
  bool has_flat_walls;  ///< of the last piece: walls over straight edges are flat
};

struct CutEnd {
  double beyond;  ///< by how much of their length the last piece's walls go on
  /// What takes off what is beyond the end, and nothing else, when `map` put it there. Its side in
  /// the plane of the end is turned as a plane, and `map` depends on place and direction only.
  PolygonMesh tool;
  Affine map;
};

/// How an end becomes a plane; nothing where it is one, across an axis, or where other parts of the
/// sweep leave no room for that. O(n).
std::optional<CutEnd> cut_end(const SweepRings& sweep, const SweepEnd& end);

/// A corner of the end's ring when its wall goes on beyond it. `before`: of the ring before.
inline glm::dvec3 beyond_end(const glm::dvec3& corner, const glm::dvec3& before, double beyond) {
  return corner + (corner - before) * beyond;
}

}  // namespace csgrun
