#include "engine/mesh/convex_surface.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/mesh/leaf_shape.h"
#include "engine/mesh/spread_vertices.h"

namespace csgrun {
namespace {

/// Whether d is in front of the plane of a, b, c. Coordinates are less than 2^30 apart.
bool is_in_front(const IVec3& a, const IVec3& b, const IVec3& c, const IVec3& d) {
  IVec3 u, v, w;
  for (size_t k = 0; k < 3; ++k) u[k] = b[k] - a[k], v[k] = c[k] - a[k], w[k] = d[k] - a[k];
  __int128 sum = 0;
  for (size_t k = 0; k < 3; ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    sum += static_cast<__int128>(u[i] * v[j] - u[j] * v[i]) * w[k];
  }
  return sum > 0;
}

uint32_t next(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

bool has_neighbour_in_front(const LeafGeometry& leaf) {
  const auto point = [&](uint32_t corner) -> const IVec3& {
    return leaf.vertices[leaf.corners[corner]];
  };
  for (uint32_t edge = 0; edge < leaf.corners.size(); ++edge) {
    const uint32_t back = leaf.opposite[edge];
    if (back < edge) continue;
    const uint32_t end = next(edge);
    if (is_in_front(point(edge), point(end), point(next(end)), point(next(next(back))))) {
      return true;
    }
  }
  return false;
}

bool is_connected(const LeafGeometry& leaf) {
  std::vector<uint8_t> reached(leaf.face_count(), 0);
  std::vector<uint32_t> open{0};
  reached[0] = 1;
  size_t count = 0;
  while (!open.empty()) {
    const uint32_t face = open.back();
    open.pop_back();
    ++count;
    for (uint32_t edge = 3 * face; edge < 3 * face + 3; ++edge) {
      const uint32_t neighbour = leaf.opposite[edge] / 3;
      if (reached[neighbour] != 0) continue;
      reached[neighbour] = 1;
      open.push_back(neighbour);
    }
  }
  return count == leaf.face_count();
}

}  // namespace

bool is_convex_surface(const LeafGeometry& leaf, const GridBox& box) {
  if (leaf.opposite.empty() || !consists_of_triangles(leaf)) return false;
  if (!is_compact(box) || has_neighbour_in_front(leaf)) return false;
  const std::vector<uint8_t> is_spread = find_spread_vertices(leaf);
  return std::all_of(is_spread.begin(), is_spread.end(), [](uint8_t s) { return s != 0; }) &&
         is_connected(leaf);
}

}  // namespace csgrun
