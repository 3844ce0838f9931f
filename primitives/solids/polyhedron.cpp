// A solid from points and faces, as OpenSCAD's polyhedron: faces are clockwise from outside.
#include <algorithm>
#include <cmath>
#include <utility>

#include <csgrun/primitives/solids.h>

#include "primitives/base/text.h"
#include "primitives/solids/finish_solid.h"

namespace csgrun {
namespace {

Error invalid_mesh(std::string message) {
  return Error{ErrorCode::kInvalidMesh, std::move(message), {}};
}

/// How many of the face's points differ by value.
size_t distinct_points(const std::vector<glm::dvec3>& points, const std::vector<uint32_t>& face) {
  std::vector<std::array<double, 3>> seen;
  for (const uint32_t i : face) {
    seen.push_back({points[i].x + 0.0, points[i].y + 0.0, points[i].z + 0.0});
  }
  std::sort(seen.begin(), seen.end());
  return static_cast<size_t>(std::unique(seen.begin(), seen.end()) - seen.begin());
}

}  // namespace

MeshResult make_polyhedron(const std::vector<glm::dvec3>& points,
                           const std::vector<std::vector<uint32_t>>& faces, std::string* note,
                           FillRule fill, PolygonMesh* uncut) {
  if (faces.empty()) return invalid_argument("polyhedron: has no faces");
  for (size_t i = 0; i < points.size(); ++i) {
    for (const double c : {points[i].x, points[i].y, points[i].z}) {
      if (!std::isfinite(c)) {
        return invalid_argument("polyhedron: point " + std::to_string(i) + " must be finite, got " +
                                number_text(c));
      }
    }
  }
  PolygonMesh mesh;
  mesh.kind = "polyhedron";
  mesh.fill = fill;
  mesh.points = points;
  for (size_t f = 0; f < faces.size(); ++f) {
    const std::vector<uint32_t>& face = faces[f];
    for (const uint32_t i : face) {
      if (i >= points.size()) {
        return invalid_mesh("polyhedron: face " + std::to_string(f) + ": index " +
                            std::to_string(i) + " is out of range, there are " +
                            std::to_string(points.size()) + " points; indices count from 0");
      }
    }
    if (const size_t count = distinct_points(points, face); count < 3) {
      return invalid_mesh("polyhedron: face " + std::to_string(f) + " is degenerate: it has " +
                          std::to_string(count) + " distinct points");
    }
    mesh.add_face(std::vector<uint32_t>(face.rbegin(), face.rend()));
  }
  return finish_solid(std::move(mesh), "polyhedron", note, false, uncut);
}

}  // namespace csgrun
