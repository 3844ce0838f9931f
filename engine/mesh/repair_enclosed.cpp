// Whether a closed surface encloses anything, or is a sheet with a back of its own.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "engine/mesh/edge_uses.h"
#include "engine/mesh/flat_points.h"
#include "engine/mesh/repair_steps.h"

namespace csgrun {
namespace {

/// Edges of more uses are taken for balanced, so that they cost no square of their number.
constexpr size_t kMostUses = 64;

uint32_t apex(const LoopFace& triangle, const EdgeUse& use) {
  for (const uint32_t v : triangle.loops[0]) {
    if (v != use.low && v != use.high) return v;
  }
  return use.low;
}

/// Whether two points lie in one plane with an edge: up to 2^-40 of their distances, since what is
/// flat in exact numbers is not so in doubles, and nothing that thin is left on the grid.
bool is_coplanar(const std::vector<glm::dvec3>& points, const EdgeUse& edge, uint32_t a,
                 uint32_t b) {
  const glm::dvec3 u = points[edge.high] - points[edge.low], v = points[a] - points[edge.low],
                   w = points[b] - points[edge.low];
  const double volume =
      u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) + u.z * (v.x * w.y - v.y * w.x);
  const auto length = [](const glm::dvec3& x) {
    return std::sqrt(x.x * x.x + x.y * x.y + x.z * x.z);
  };
  return std::fabs(volume) <= 0x1p-40 * length(u) * length(v) * length(w);
}

}  // namespace

bool encloses_nothing(const RepairMesh& mesh) {
  std::vector<LoopFace> triangles;
  for (const LoopFace& face : mesh.faces) {
    for (const auto& loop : face.loops) {
      for (size_t i = 1; i + 1 < loop.size(); ++i) {
        const std::array<uint32_t, 3> corners{loop[0], loop[i], loop[i + 1]};
        if (is_flat(mesh.points, corners)) continue;
        triangles.push_back({{{corners.begin(), corners.end()}}, 0, 0, 0});
      }
    }
  }
  // What faces of one plane cover cancels just if their edges do.
  bool nothing = true;
  std::vector<std::pair<uint32_t, int64_t>> planes;  // by an apex: uses forward less uses back
  EdgeUses(triangles, mesh.points.size()).for_each_edge([&](std::span<const EdgeUse> uses) {
    if (!nothing || uses.size() > kMostUses) return;
    planes.clear();
    for (const EdgeUse& use : uses) {
      const uint32_t at = apex(triangles[use.face], use);
      const auto plane = std::find_if(planes.begin(), planes.end(), [&](const auto& known) {
        return is_coplanar(mesh.points, use, known.first, at);
      });
      const int64_t sign = use.forward ? 1 : -1;
      if (plane == planes.end()) {
        planes.emplace_back(at, sign);
      } else {
        plane->second += sign;
      }
    }
    for (const auto& [at, sum] : planes) nothing &= sum == 0;
  });
  return nothing;
}

}  // namespace csgrun
