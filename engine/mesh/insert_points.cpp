#include "engine/mesh/insert_points.h"

namespace csgrun {

bool insert_points(std::span<const uint32_t> points, const PlanarOracle& oracle,
                   std::vector<std::array<uint32_t, 3>>& triangles) {
  for (const uint32_t p : points) {
    bool placed = false;
    for (size_t t = 0, count = triangles.size(); t < count; ++t) {
      const std::array<uint32_t, 3> old = triangles[t];
      std::array<int, 3> side{};
      for (size_t k = 0; k < 3; ++k) side[k] = oracle.orient(old[k], old[(k + 1) % 3], p);
      if (side[0] < 0 || side[1] < 0 || side[2] < 0) continue;
      // On an edge: each of its two triangles is split here, into what has area.
      bool first = true;
      for (size_t k = 0; k < 3; ++k) {
        if (side[k] == 0) continue;
        const std::array<uint32_t, 3> part{old[k], old[(k + 1) % 3], p};
        if (first) {
          triangles[t] = part;
        } else {
          triangles.push_back(part);
        }
        first = false;
      }
      placed = true;
    }
    if (!placed) return false;
  }
  return true;
}

}  // namespace csgrun
