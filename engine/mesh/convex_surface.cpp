#include "engine/mesh/convex_surface.h"

#include <algorithm>
#include <vector>

#include "engine/mesh/face_normal.h"
#include "engine/mesh/leaf_shape.h"
#include "engine/mesh/spread_vertices.h"

namespace csgrun {
namespace {

enum class Bend : uint8_t { kBack, kFlat, kFront };

/// The neighbour that bends forward most as seen from any face: kFront, if one is in front. (Then
/// no more are looked at.) REQUIRES: triangles; coordinates are less than 2^30 apart.
Bend foremost_neighbour(const LeafGeometry& leaf) {
  const auto point = [&](uint32_t corner) -> const IVec3& {
    return leaf.vertices[leaf.corners[corner]];
  };
  Bend most = Bend::kBack;
  for (uint32_t first = 0; first < leaf.corners.size(); first += 3) {
    const IVec3& origin = point(first);
    const IVec3 normal =
        cross(difference(point(first + 1), origin), difference(point(first + 2), origin));
    for (uint32_t edge = first; edge < first + 3; ++edge) {
      const uint32_t back = leaf.opposite[edge];
      if (back < edge) continue;
      const uint32_t apex = back % 3 == 0 ? back + 2 : back - 1;
      const IVec3 to_apex = difference(point(apex), origin);
      __int128 height = 0;
      for (size_t k = 0; k < 3; ++k) height += static_cast<__int128>(normal[k]) * to_apex[k];
      if (height > 0) return Bend::kFront;
      if (height == 0) most = Bend::kFlat;
    }
  }
  return most;
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

ConvexSurface find_convex_surface(const LeafGeometry& leaf, const GridBox& box) {
  if (leaf.opposite.empty() || !consists_of_triangles(leaf) || !is_compact(box)) return {};
  const Bend most = foremost_neighbour(leaf);
  if (most == Bend::kFront) return {};
  const std::vector<uint8_t> is_spread = find_spread_vertices(leaf);
  const bool all_spread =
      std::all_of(is_spread.begin(), is_spread.end(), [](uint8_t s) { return s != 0; });
  return {all_spread && is_connected(leaf), most == Bend::kFlat};
}

}  // namespace csgrun
