#include "engine/csg/grid_solid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <unordered_map>

#include <glm/geometric.hpp>

#include "engine/bsp/union_find.h"
#include "engine/csg/grid.h"
#include "engine/csg/wide_cross.h"
#include "engine/mesh/to_millimetres.h"

namespace csgrun {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

/// Joins the triangles of a face to convex polygons, by leaving out edges between them where that
/// makes no corner that turns right (Hertel & Mehlhorn 1983): at most four times as many as needed.
class ConvexPatches {
 public:
  ConvexPatches(const Solid& solid, const std::vector<IVec3>& points)
      : solid_(solid), points_(points) {}

  void make(GridSolid& result) {
    const size_t edges = solid_.triangles.size() * 3;
    next_.resize(edges);
    previous_.resize(edges);
    is_gone_.assign(edges, 0);
    polygon_.reset(solid_.triangles.size());
    for (uint32_t e = 0; e < edges; ++e) {
      next_[e] = e % 3 == 2 ? e - 2 : e + 1;
      previous_[e] = e % 3 == 0 ? e + 2 : e - 1;
    }
    find_twins();
    for (uint32_t e = 0; e < edges; ++e) {
      if (e < twin_[e] && face(e) == face(twin_[e])) drop(e, twin_[e]);
    }
    patch_of_.assign(edges, kNone);
    for (uint32_t e = 0; e < edges; ++e) {
      if (is_gone_[e] != 0 || patch_of_[e] != kNone) continue;
      const auto patch = static_cast<uint32_t>(result.patches.size());
      GridSolid::Patch& made = result.patches.emplace_back();
      made.face = face(e);
      made.normal = glm::normalize(solid_.face_normals[face(e)]);
      for (uint32_t at = e; patch_of_[at] == kNone; at = next_[at]) {
        patch_of_[at] = patch;
        made.corners.push_back(from(at));
        made.is_exact = made.is_exact && solid_.on_grid[from(at)] != 0;
      }
    }
    for (uint32_t e = 0; e < edges; ++e) {
      const uint32_t twin = twin_[e];
      if (e > twin || face(e) == face(twin)) continue;
      const int side = side_of_apex(e, twin);
      if (side == 0) continue;
      result.rims.push_back({from(e), from(twin), patch_of_[e], patch_of_[twin], side < 0});
    }
  }

 private:
  [[nodiscard]] uint32_t from(uint32_t edge) const { return solid_.triangles[edge / 3][edge % 3]; }
  [[nodiscard]] uint32_t face(uint32_t edge) const { return solid_.triangle_face[edge / 3]; }

  /// On which side of the triangle of an edge the third corner of its neighbour is: +1 in front.
  [[nodiscard]] int side_of_apex(uint32_t edge, uint32_t twin) const {
    const uint32_t third = twin - twin % 3 + (twin % 3 + 2) % 3;
    const auto& t = solid_.triangles[edge / 3];
    return side(points_[t[0]], points_[t[1]], points_[t[2]], points_[from(third)]);
  }

  /// The same edge as its other triangle runs it: a solid is closed, so all have one.
  void find_twins() {
    twin_.assign(next_.size(), kNone);
    std::unordered_map<uint64_t, uint32_t> edge_at;
    edge_at.reserve(next_.size());
    for (uint32_t e = 0; e < next_.size(); ++e) {
      const uint64_t a = from(e), b = from(next_[e]);
      edge_at[a << 32 | b] = e;
      const auto found = edge_at.find(b << 32 | a);
      if (found == edge_at.end()) continue;
      twin_[e] = found->second;
      twin_[found->second] = e;
    }
    assert(std::find(twin_.begin(), twin_.end(), kNone) == twin_.end());
  }

  /// Whether the way a, b, c does not turn right, seen from outside of a face: along the axis that
  /// its normal is nearest to.
  [[nodiscard]] bool turns_left(uint32_t face, uint32_t a, uint32_t b, uint32_t c) const {
    const glm::dvec3& normal = solid_.face_normals[face];
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
      if (std::fabs(normal[i]) > std::fabs(normal[axis])) axis = i;
    }
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    const IVec3 &p = points_[a], &q = points_[b], &r = points_[c];
    const Int128 area = static_cast<Int128>(q[x] - p[x]) * (r[y] - p[y]) -
                        static_cast<Int128>(q[y] - p[y]) * (r[x] - p[x]);
    return normal[axis] > 0 ? area >= 0 : area <= 0;
  }

  void drop(uint32_t edge, uint32_t twin) {
    const uint32_t face = solid_.triangle_face[edge / 3];
    if (polygon_.find(edge / 3) == polygon_.find(twin / 3)) return;
    const uint32_t a = from(edge), b = from(twin);
    if (!turns_left(face, from(previous_[edge]), a, from(next_[next_[twin]])) ||
        !turns_left(face, from(previous_[twin]), b, from(next_[next_[edge]]))) {
      return;
    }
    polygon_.join(edge / 3, twin / 3);
    is_gone_[edge] = is_gone_[twin] = 1;
    link(previous_[edge], next_[twin]);
    link(previous_[twin], next_[edge]);
  }
  void link(uint32_t a, uint32_t b) {
    next_[a] = b;
    previous_[b] = a;
  }

  const Solid& solid_;
  const std::vector<IVec3>& points_;
  std::vector<uint32_t> next_, previous_, twin_, patch_of_;
  std::vector<uint8_t> is_gone_;
  UnionFind polygon_;
};

}  // namespace

std::vector<glm::dvec3> to_millimetres(const std::vector<IVec3>& points, const GridStep& step) {
  const ToMillimetres convert(step);
  std::vector<glm::dvec3> result(points.size());
  std::array<float, 3> unused;
  for (size_t i = 0; i < points.size(); ++i) convert.position(points[i], result[i], unused);
  return result;
}

Result<GridSolid> grid_solid(const Solid& solid, const GridStep& step, bool with_patches) {
  GridSolid result;
  const Quantiser quantiser(step);
  result.points.reserve(solid.positions.size());
  for (const glm::dvec3& p : solid.positions) {
    IVec3& q = result.points.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const auto rounded = quantiser(p[i]);
      if (!rounded || *rounded > kFarLimit || *rounded < -kFarLimit) {
        return Error{ErrorCode::kOutOfRange, "reaches too far from the origin for the grid", {}};
      }
      q[i] = *rounded;
    }
  }
  result.rounded = static_cast<size_t>(std::count(solid.on_grid.begin(), solid.on_grid.end(), 0));
  if (!with_patches) return result;

  UnionFind surface(result.points.size());
  for (const auto& t : solid.triangles) {
    surface.join(t[0], t[1]);
    surface.join(t[0], t[2]);
  }
  for (uint32_t v = 0; v < result.points.size(); ++v) {
    if (surface.find(v) == v) result.anchors.push_back(v);
  }
  ConvexPatches(solid, result.points).make(result);
  return result;
}

std::string rounding_note(size_t corners, const GridStep& step) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6g", step.millimetres());
  return std::to_string(corners) + (corners == 1 ? " corner" : " corners") +
         " of its operands lie off the grid and were rounded to it, by up to half a step of " +
         text + " mm";
}

}  // namespace csgrun
