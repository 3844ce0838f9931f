#include "engine/csg/fine_triangles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/csg/grid.h"
#include "engine/csg/leaf_faces.h"
#include "engine/csg/quantise.h"

namespace csgrun {

std::vector<std::vector<std::array<uint32_t, 3>>> fine_triangles(const PolygonMesh& mesh) {
  const std::vector<uint8_t> is_used = find_used_points(mesh);
  double reach = 0;
  for (size_t p = 0; p < mesh.points.size(); ++p) {
    if (!is_used[p]) continue;
    for (int i = 0; i < 3; ++i) reach = std::max(reach, std::fabs(mesh.points[p][i]));
  }
  // Decimals that outlines lie on are points of this grid, too.
  const auto points = round_points(mesh, LeafRounding{}, Quantiser(choose_step(0, reach)));
  std::vector<std::vector<std::array<uint32_t, 3>>> triangles(mesh.face_count());
  if (!points) return triangles;
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    const uint32_t first = mesh.face_starts[f], last = mesh.face_starts[f + 1];
    if (last - first == 1 && mesh.loop_starts[last] - mesh.loop_starts[first] <= 3) continue;
    LoopFace face;
    for (uint32_t l = first; l < last; ++l) {
      face.loops.emplace_back(mesh.corners.begin() + mesh.loop_starts[l],
                              mesh.corners.begin() + mesh.loop_starts[l + 1]);
    }
    triangles[f] = triangulate(*points, face);
  }
  return triangles;
}

}  // namespace csgrun
