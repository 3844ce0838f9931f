#include "lua_bindings/measure/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace csgrun {
namespace {

/// The axis along which the polygon is seen largest, and whether it runs clockwise from there.
struct View {
  int axis = 2;
  bool clockwise = false;
};

View view_of(const std::vector<glm::dvec3>& points, const std::vector<uint32_t>& loop) {
  glm::dvec3 normal(0, 0, 0);
  const glm::dvec3& origin = points[loop[0]];
  for (size_t i = 1; i + 1 < loop.size(); ++i) {
    const glm::dvec3 a = points[loop[i]] - origin, b = points[loop[i + 1]] - origin;
    normal += glm::dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
  }
  View view;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(normal[axis]) > std::abs(normal[view.axis])) view.axis = axis;
  }
  view.clockwise = normal[view.axis] < 0;
  return view;
}

/// Cuts ears off until a triangle is left. A loop that crosses itself has no more ears at some
/// point; the rest becomes a fan, whose crossings are then found as such.
void cut_ears(const std::vector<glm::dvec3>& points, std::vector<uint32_t> loop,
              std::vector<std::array<uint32_t, 3>>& triangles) {
  const View view = view_of(points, loop);
  const auto turn = [&](uint32_t a, uint32_t b, uint32_t c) {
    const int sign = orient_along(view.axis, points[a], points[b], points[c]);
    return view.clockwise ? -sign : sign;
  };
  const auto is_ear = [&](size_t i) {
    const size_t n = loop.size();
    const uint32_t a = loop[(i + n - 1) % n], b = loop[i], c = loop[(i + 1) % n];
    if (turn(a, b, c) <= 0) return false;
    return std::none_of(loop.begin(), loop.end(), [&](uint32_t p) {
      return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
             turn(c, a, p) >= 0;
    });
  };
  size_t at = 0, tried = 0;
  while (loop.size() > 3 && tried < loop.size()) {
    const size_t n = loop.size();
    if (!is_ear(at)) {
      at = (at + 1) % n;
      ++tried;
      continue;
    }
    triangles.push_back({loop[(at + n - 1) % n], loop[at], loop[(at + 1) % n]});
    loop.erase(loop.begin() + static_cast<ptrdiff_t>(at));
    at = at == 0 ? loop.size() - 1 : at - 1;
    tried = 0;
  }
  for (size_t i = 1; i + 1 < loop.size(); ++i) triangles.push_back({loop[0], loop[i], loop[i + 1]});
}

}  // namespace

void weld(TriangleMesh& mesh) {
  const auto less = [&](uint32_t a, uint32_t b) {
    const glm::dvec3 &p = mesh.points[a], &q = mesh.points[b];
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
  };
  std::vector<uint32_t> order(mesh.points.size()), name(mesh.points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), less);
  std::vector<glm::dvec3> distinct;
  for (size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || less(order[i - 1], order[i])) distinct.push_back(mesh.points[order[i]]);
    name[order[i]] = static_cast<uint32_t>(distinct.size() - 1);
  }
  mesh.points = std::move(distinct);
  for (auto& triangle : mesh.triangles) {
    for (uint32_t& corner : triangle) corner = name[corner];
  }
}

TriangleMesh triangulated(const PolygonMesh& mesh, bool weld_points_too) {
  TriangleMesh result;
  for (const glm::dvec3& p : mesh.points)
    result.points.emplace_back(p.x + 0.0, p.y + 0.0, p.z + 0.0);
  for (size_t loop = 0; loop < mesh.loop_count(); ++loop) {
    const auto first = mesh.corners.begin() + mesh.loop_starts[loop];
    const std::vector<uint32_t> corners(first, mesh.corners.begin() + mesh.loop_starts[loop + 1]);
    if (corners.size() == 3) {
      result.triangles.push_back({corners[0], corners[1], corners[2]});
    } else if (corners.size() > 3) {
      cut_ears(result.points, corners, result.triangles);
    }
  }
  if (weld_points_too) weld(result);
  return result;
}

}  // namespace csgrun
