#include "engine/mesh/boundary_volume.h"

#include <array>
#include <vector>

#include "engine/exact/grid_meeting.h"
#include "engine/mesh/measure.h"

namespace csgrun {
namespace {

/// The area is that of the signed triangles, and no measure.
Result<MassProperties> measure(const BoundaryMesh& b, const GridStep& step, Wanted wanted) {
  std::vector<std::array<uint32_t, 3>> fans;
  fans.reserve(b.corners.size());
  for (size_t l = 0; l + 1 < b.loop_starts.size(); ++l) {
    const uint32_t first = b.loop_starts[l];
    for (uint32_t c = first + 1; c + 1 < b.loop_starts[l + 1]; ++c) {
      fans.push_back({b.corners[first].point, b.corners[c].point, b.corners[c + 1].point});
    }
  }
  const auto explicit_points = static_cast<uint32_t>(b.point_planes.size());
  struct Vertex {
    const UntouchedPart* part;
    uint32_t number;
  };
  std::vector<Vertex> more;
  for (const UntouchedPart& part : b.parts) {
    const auto first = static_cast<uint32_t>(explicit_points + more.size());
    for (uint32_t v = 0; v < part.leaf->vertices.size(); ++v) more.push_back({&part, v});
    for (const uint32_t f : part.faces) {
      const auto t = part.triangle(f);
      fans.push_back({first + t[0], first + t[1], first + t[2]});
    }
  }
  const auto point = [&](uint32_t p) {
    if (p < explicit_points) {
      const auto& [i, j, k] = b.point_planes[p];
      const auto& at = b.point_rounded[p];
      return meet_on_grid(b.planes[i], b.planes[j], b.planes[k], at)
                 ? grid_point(static_cast<int64_t>(at[0]), static_cast<int64_t>(at[1]),
                              static_cast<int64_t>(at[2]))
                 : b.exact_point(p);
    }
    const Vertex& v = more[p - explicit_points];
    return v.part->point(v.number);
  };
  return measure_mesh(explicit_points + more.size(), point, fans, step, wanted);
}

}  // namespace

Result<double> boundary_volume(const BoundaryMesh& boundary, const GridStep& step) {
  auto mass = measure(boundary, step, Wanted::kVolume);
  if (!mass) return mass.error();
  return mass->volume;
}

Result<glm::dvec3> boundary_centroid(const BoundaryMesh& boundary, const GridStep& step) {
  auto mass = measure(boundary, step, Wanted::kAll);
  if (!mass) return mass.error();
  return mass->centroid;
}

}  // namespace csgrun
