#include "export/thin_triangles.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "export/edge_flips.h"

namespace csgrun {
namespace {

/// Moves one end of each short side to the other one. No vertex has a part in two such moves.
void merge_ends(const RoundedMesh& mesh, std::span<const uint32_t> triangles, double width,
                std::vector<glm::dvec3>& positions, ThinnedOut& result) {
  std::vector<bool> has_part(positions.size(), false);
  for (const uint32_t t : triangles) {
    const Triangle& corners = mesh.triangles[t];
    for (size_t i = 0; i < 3; ++i) {
      const auto [kept, moved] = std::minmax(corners[i], corners[(i + 1) % 3]);
      if (has_part[kept] || has_part[moved]) continue;
      const double length = glm::distance(positions[kept], positions[moved]);
      if (!(length < width)) continue;
      positions[moved] = positions[kept];
      has_part[kept] = has_part[moved] = true;
      result.farthest = std::max(result.farthest, length);
      ++result.merged;
    }
  }
}

}  // namespace

Result<ThinnedOut> take_out_thin(RoundedMesh& mesh, std::span<const uint32_t> triangles,
                                 double width, std::span<const glm::dvec3> directions) {
  ThinnedOut result;
  const Turned turned = turn_caps(mesh, triangles, width, directions);
  result.turned = turned.count;
  std::vector<glm::dvec3> positions = mesh.positions;
  merge_ends(mesh, triangles, width, positions, result);
  result.farthest += turned.farthest;
  if (result.turned + result.merged == 0) return result;
  if (Status status = move_vertices(mesh, std::move(positions)); !status) return status.error();
  return result;
}

}  // namespace csgrun
