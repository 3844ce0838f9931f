#include "engine/mesh/boundary_volume.h"

#include <array>
#include <vector>

#include "engine/mesh/measure.h"

namespace csgrun {

Result<double> boundary_volume(const BoundaryMesh& b, const GridStep& step) {
  std::vector<std::array<uint32_t, 3>> fans;
  fans.reserve(b.corners.size());
  for (size_t l = 0; l + 1 < b.loop_starts.size(); ++l) {
    const uint32_t first = b.loop_starts[l];
    for (uint32_t c = first + 1; c + 1 < b.loop_starts[l + 1]; ++c) {
      fans.push_back({b.corners[first].point, b.corners[c].point, b.corners[c + 1].point});
    }
  }
  auto mass = measure_mesh(
      b.point_planes.size(), [&](uint32_t p) { return b.exact_point(p); }, fans, step);
  if (!mass) return mass.error();
  return mass->volume;
}

}  // namespace csgrun
