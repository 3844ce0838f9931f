#include "engine/mesh/convex_surface.h"

#include <algorithm>
#include <vector>

#include "engine/mesh/centre_view.h"
#include "engine/mesh/face_normal.h"
#include "engine/mesh/leaf_shape.h"
#include "engine/mesh/spread_vertices.h"
#include "engine/mesh/surface_parts.h"

namespace csgrun {
namespace {

/// What the edges of a surface say, and how it is seen from the middle of its box.
struct Look {
  bool has_neighbour_in_front = false;  ///< then no more was looked at
  bool has_flat_edges = false;
  bool is_star = true;       ///< all faces have the middle behind them
  size_t ray_crossings = 0;  ///< of a ray from there, if so
};

/// REQUIRES: triangles; coordinates are less than 2^30 apart.
Look look_at(const LeafGeometry& leaf, const GridBox& box) {
  const auto point = [&](uint32_t corner) -> const IVec3& {
    return leaf.vertices[leaf.corners[corner]];
  };
  const CentreView view(leaf, box);
  Look look;
  for (uint32_t face = 0; face < leaf.face_count(); ++face) {
    const uint32_t first = 3 * face;
    const IVec3& origin = point(first);
    const IVec3 normal = view.normal(face);
    for (uint32_t edge = first; edge < first + 3; ++edge) {
      const uint32_t back = leaf.opposite[edge];
      if (back < edge) continue;
      const uint32_t apex = back % 3 == 0 ? back + 2 : back - 1;
      const IVec3 to_apex = difference(point(apex), origin);
      __int128 height = 0;
      for (size_t k = 0; k < 3; ++k) height += static_cast<__int128>(normal[k]) * to_apex[k];
      if (height > 0) {
        look.has_neighbour_in_front = true;
        return look;
      }
      look.has_flat_edges |= height == 0;
    }
    look.is_star = look.is_star && view.has_behind(face, normal);
    look.ray_crossings += look.is_star && view.is_crossed(face, normal) ? 1 : 0;
  }
  return look;
}

}  // namespace

ConvexSurface find_convex_surface(const LeafGeometry& leaf, const GridBox& box) {
  if (leaf.opposite.empty() || !consists_of_triangles(leaf) || !is_compact(box)) return {};
  const Look look = look_at(leaf, box);
  if (look.has_neighbour_in_front) return {};
  // One crossing: the surface is a sphere that does not meet itself (star_surface.h).
  if (look.is_star) return {look.ray_crossings == 1, look.has_flat_edges};
  const std::vector<uint8_t> is_spread = find_spread_vertices(leaf);
  const bool all_spread =
      std::all_of(is_spread.begin(), is_spread.end(), [](uint8_t s) { return s != 0; });
  return {all_spread && one_face_of_each_part(leaf).size() == 1, look.has_flat_edges};
}

}  // namespace csgrun
