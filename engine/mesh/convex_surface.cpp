#include "engine/mesh/convex_surface.h"

#include <algorithm>
#include <vector>

#include "engine/base/scratch.h"
#include "engine/base/vec3d.h"
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

uint32_t apex_beside(uint32_t opposite) { return opposite % 3 == 0 ? opposite + 2 : opposite - 1; }

/// Looks at the neighbours of a face exactly; at those beyond edges that come after their opposite
/// ones others looked. A height is a determinant of sides, which fits 95 bits.
void look_beside(const LeafGeometry& leaf, const IVec3& normal, uint32_t face, Look& look) {
  const uint32_t first = 3 * face;
  const auto point = [&](uint32_t corner) -> const IVec3& {
    return leaf.vertices[leaf.corners[corner]];
  };
  for (uint32_t edge = first; edge < first + 3; ++edge) {
    if (leaf.opposite[edge] < edge) continue;
    const IVec3 to_apex = difference(point(apex_beside(leaf.opposite[edge])), point(first));
    __int128 height = 0;
    for (size_t k = 0; k < 3; ++k) height += static_cast<__int128>(normal[k]) * to_apex[k];
    look.has_neighbour_in_front |= height > 0;
    look.has_flat_edges |= height == 0;
  }
}

/// Whether the axis along x through the centre, from which these are ways, may cross a triangle.
/// None of their coordinates is 0.
bool may_be_crossed(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  bool may = true;
  for (size_t k = 1; k < 3; ++k) may = may && (a[k] * b[k] < 0 || a[k] * c[k] < 0);
  return may;
}

/// Doubles decide nearly everything. With the ways from the centre below r and u = 2^-53, sides are
/// exact, a normal is off by 16 u r^2 in each coordinate, none of which is above 8 r^2, and its
/// product with a way by 120 u r^3; so the difference of two is off by less than 2^9 u r^3.
///
/// REQUIRES: triangles; coordinates are less than 2^30 apart.
Look look_at(const LeafGeometry& leaf, const GridBox& box) {
  const CentreView view(leaf, box);
  Scratch scratch;
  const auto ways = scratch.array<Vec3d>(leaf.vertices.size());
  for (size_t v = 0; v < ways.size(); ++v) {
    const IVec3 way = view.way_to_vertex(leaf.vertices[v]);
    for (size_t k = 0; k < 3; ++k) ways[v][k] = static_cast<double>(way[k]);
  }
  double reach = 0;
  for (size_t k = 0; k < 3; ++k) {
    reach = std::max(reach, static_cast<double>(box.hi[k] - box.lo[k] + 1));
  }
  const double slack = 0x1p-44 * reach * reach * reach;
  const auto way_to = [&, corners = leaf.corners.data()](uint32_t corner) -> const Vec3d& {
    return ways[corners[corner]];
  };
  const uint32_t* const opposite = leaf.opposite.data();
  Look look;
  for (uint32_t face = 0; face < leaf.face_count(); ++face) {
    const uint32_t first = 3 * face;
    const Vec3d &a = way_to(first), &b = way_to(first + 1), &c = way_to(first + 2);
    const Vec3d normal = cross(minus(b, a), minus(c, a));
    const double height = dot(normal, a);  // of the face over the centre
    bool are_behind = true;                // the neighbours
    for (uint32_t edge = first; edge < first + 3; ++edge) {
      const uint32_t back = opposite[edge];
      if (back < edge) continue;
      are_behind = are_behind & (dot(normal, way_to(apex_beside(back))) - height < -slack);
    }
    if (!are_behind) {
      look_beside(leaf, view.normal(face), face, look);
      if (look.has_neighbour_in_front) return look;
    }
    if (!look.is_star) continue;
    look.is_star = height > slack || view.has_behind(face, view.normal(face));
    if (look.is_star && may_be_crossed(a, b, c) && view.is_crossed(face, view.normal(face))) {
      ++look.ray_crossings;
    }
  }
  return look;
}

}  // namespace

ConvexSurface find_convex_surface(const LeafGeometry& leaf, const GridBox& box) {
  if (leaf.opposite.empty() || !leaf.consists_of_triangles() || !is_compact(box)) return {};
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
