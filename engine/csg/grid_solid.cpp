#include "engine/csg/grid_solid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <unordered_map>

#include "engine/base/none.h"
#include "engine/bsp/union_find.h"
#include "engine/csg/grid.h"
#include "engine/mesh/to_millimetres.h"

namespace csgrun {
namespace {

/// Joins the triangles of a face to convex polygons, by leaving out edges between them where that
/// makes no corner that turns right (Hertel & Mehlhorn 1983): at most four times as many as needed.
/// Triangles with a corner that was rounded stay alone: with others they need not be flat.
class ConvexPatches {
 public:
  ConvexPatches(const Solid& solid, const std::vector<IVec3>& points)
      : solid_(solid), points_(points) {}

  /// Adds the polygons to `mesh`, whose points are the solid's vertices.
  void make(PolygonMesh& mesh) {
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
    std::vector<uint32_t> loop;
    for (uint32_t e = 0; e < edges; ++e) {
      if (is_gone_[e] != 0) continue;
      loop.clear();
      for (uint32_t at = e; is_gone_[at] == 0; at = next_[at]) {
        is_gone_[at] = 1;
        loop.push_back(from(at));
      }
      mesh.add_face(loop, solid_.faces[face(e)].surface);
      mesh.appearance_of.push_back(solid_.faces[face(e)].appearance);
    }
  }

 private:
  [[nodiscard]] uint32_t from(uint32_t edge) const { return solid_.triangles[edge / 3][edge % 3]; }
  [[nodiscard]] uint32_t face(uint32_t edge) const { return solid_.triangle_face[edge / 3]; }

  [[nodiscard]] bool is_exact(uint32_t triangle) const {
    const auto& t = solid_.triangles[triangle];
    return solid_.on_grid[t[0]] != 0 && solid_.on_grid[t[1]] != 0 && solid_.on_grid[t[2]] != 0;
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
    if (!is_exact(edge / 3) || !is_exact(twin / 3)) return;
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
  std::vector<uint32_t> next_, previous_, twin_;
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

Result<GridSolid> grid_solid(const Solid& solid, const GridStep& step) {
  GridSolid result;
  const Quantiser quantiser(step);
  result.points.reserve(solid.positions.size());
  for (const glm::dvec3& p : solid.positions) {
    IVec3& q = result.points.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const auto rounded = quantiser(p[i]);
      if (!rounded || *rounded >= kFarLimit || *rounded <= -kFarLimit) {
        return Error{ErrorCode::kOutOfRange, "reaches too far from the origin for the grid", {}};
      }
      q[i] = *rounded;
    }
  }
  result.rounded = static_cast<size_t>(std::count(solid.on_grid.begin(), solid.on_grid.end(), 0));
  return result;
}

PolygonMesh patch_mesh(const Solid& solid, const GridSolid& on_grid, const GridStep& step) {
  PolygonMesh mesh;
  mesh.points = to_millimetres(on_grid.points, step);
  mesh.appearances = solid.appearances;
  ConvexPatches(solid, on_grid.points).make(mesh);
  return mesh;
}

std::string rounding_note(size_t corners, const GridStep& step) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6g", step.millimetres());
  const bool is_one = corners == 1;
  return std::to_string(corners) + (is_one ? " corner" : " corners") + " of its operands " +
         (is_one ? "lies off the grid and was" : "lie off the grid and were") +
         " rounded to it, by up to half a step of " + text + " mm";
}

}  // namespace csgrun
