#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <csgrun/primitives/reshape.h>

#include "primitives/solids/finish_solid.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

using Triangle = std::array<uint32_t, 3>;

Triangle triangle(const PolygonMesh& mesh, size_t face) {
  const uint32_t* corners = mesh.corners.data() + mesh.loop_starts[mesh.face_starts[face]];
  return {corners[0], corners[1], corners[2]};
}

/// A mesh like `mesh`, but for its points and faces.
PolygonMesh emptied(const PolygonMesh& mesh) {
  PolygonMesh result;
  result.appearances = mesh.appearances;
  result.keep_facets = mesh.keep_facets;
  result.fill = mesh.fill;
  result.kind = mesh.kind;
  return result;
}

/// Appends a triangle that is a part of face `parent` of `mesh`.
void add_part(PolygonMesh& result, const PolygonMesh& mesh, size_t parent,
              const Triangle& corners) {
  result.add_face(corners, mesh.surface[parent]);
  result.appearance_of.push_back(mesh.appearance_of[parent]);
}

using Midpoints = std::map<std::array<uint32_t, 2>, uint32_t>;

/// The parts of a triangle with the given middles of its edges (edge k begins in corner k).
void cut_triangle(PolygonMesh& result, const PolygonMesh& mesh, size_t face, const Triangle& t,
                  const std::array<const uint32_t*, 3>& middle) {
  const auto count = std::count_if(middle.begin(), middle.end(), [](auto m) { return m; });
  if (count == 0) return add_part(result, mesh, face, t);
  if (count == 3) {
    const uint32_t a = *middle[0], b = *middle[1], c = *middle[2];
    add_part(result, mesh, face, {t[0], a, c});
    add_part(result, mesh, face, {a, t[1], b});
    add_part(result, mesh, face, {c, b, t[2]});
    add_part(result, mesh, face, {a, b, c});
    return;
  }
  // Turned so that the first edge is cut, and with two cuts the second one too.
  size_t k = 0;
  while (!middle[k] || (count == 2 && !middle[(k + 1) % 3])) ++k;
  const uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], m = *middle[k];
  if (count == 1) {
    add_part(result, mesh, face, {a, m, c});
    add_part(result, mesh, face, {m, b, c});
    return;
  }
  const uint32_t n = *middle[(k + 1) % 3];
  const auto length = [&](uint32_t i, uint32_t j) {
    return glm::distance(result.points[i], result.points[j]);
  };
  add_part(result, mesh, face, {m, b, n});
  if (length(m, c) < length(a, n)) {
    add_part(result, mesh, face, {a, m, c});
    add_part(result, mesh, face, {m, n, c});
  } else {
    add_part(result, mesh, face, {a, m, n});
    add_part(result, mesh, face, {a, n, c});
  }
}

}  // namespace

PolygonMesh triangle_mesh(const Solid& solid) {
  PolygonMesh mesh;
  mesh.points = solid.positions;
  mesh.appearances = solid.appearances;
  for (size_t i = 0; i < solid.triangles.size(); ++i) {
    const Solid::Face& face = solid.faces[solid.triangle_face[i]];
    mesh.add_face(solid.triangles[i], face.surface);
    mesh.appearance_of.push_back(face.appearance);
  }
  return mesh;
}

MeshResult refine_edges(PolygonMesh mesh, double length, const std::string& name) {
  while (true) {
    Midpoints middles;
    const auto is_long = [&](uint32_t a, uint32_t b) {
      return glm::distance(mesh.points[std::min(a, b)], mesh.points[std::max(a, b)]) > length;
    };
    PolygonMesh result = emptied(mesh);
    result.points = mesh.points;
    for (size_t f = 0; f < mesh.face_count(); ++f) {
      const Triangle t = triangle(mesh, f);
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = std::min(t[k], t[(k + 1) % 3]), b = std::max(t[k], t[(k + 1) % 3]);
        if (!is_long(a, b)) continue;
        const auto [at, is_new] =
            middles.try_emplace({a, b}, static_cast<uint32_t>(result.points.size()));
        if (is_new) result.points.push_back((mesh.points[a] + mesh.points[b]) * 0.5);
      }
    }
    if (middles.empty()) return mesh;
    if (static_cast<double>(result.points.size()) > kMostPoints) {
      return Error{ErrorCode::kLimit,
                   name +
                       ": edges no longer than this make more than 16777216 "
                       "points",
                   {}};
    }
    for (size_t f = 0; f < mesh.face_count(); ++f) {
      const Triangle t = triangle(mesh, f);
      std::array<const uint32_t*, 3> middle{};
      for (size_t k = 0; k < 3; ++k) {
        const auto at =
            middles.find({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
        if (at != middles.end()) middle[k] = &at->second;
      }
      cut_triangle(result, mesh, f, t, middle);
    }
    mesh = std::move(result);
  }
}

MeshResult warp_mesh(PolygonMesh mesh, const std::function<glm::dvec3(const glm::dvec3&)>& map,
                     std::string* note) {
  for (glm::dvec3& p : mesh.points) p = map(p);
  mesh.kind = "warp";
  return finish_solid(std::move(mesh), "warp", note);
}

}  // namespace csgrun
