#include "export/defects.h"

#include <algorithm>

#include "export/shells.h"
#include "export/text.h"

namespace csgrun {

std::vector<glm::dvec3> face_directions(const Solid& solid, const Affine& placement) {
  if (solid.face_normals.size() != solid.faces.size())
    return place_solid(solid, placement).face_normals;
  std::vector<glm::dvec3> directions = solid.face_normals;
  if (placement == Affine{}) return directions;
  // Normals go with the matrix of cofactors, which also knows when the map turns a surface over.
  const auto& m = placement.m;
  double cofactor[3][3], determinant = 0;
  for (size_t i = 0; i < 3; ++i) {
    const size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (size_t j = 0; j < 3; ++j) {
      const size_t j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      cofactor[i][j] = m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
    }
  }
  for (size_t j = 0; j < 3; ++j) determinant += m[0][j] * cofactor[0][j];
  const double sign = determinant < 0 ? -1 : 1;  // the writer reverses the loops of such a surface
  for (glm::dvec3& n : directions) {
    const glm::dvec3 old = n * sign;
    for (int i = 0; i < 3; ++i)
      n[i] = cofactor[i][0] * old.x + cofactor[i][1] * old.y + cofactor[i][2] * old.z;
  }
  return directions;
}

Defects find_bad_triangles(const RoundedMesh& mesh, std::span<const glm::dvec3> directions) {
  const TriangleView view{mesh.positions, mesh.triangles};
  Defects defects;
  for (uint32_t t = 0; t < view.triangles.size(); ++t) {
    if (is_degenerate(view, t)) {
      defects.degenerate.push_back(t);
    } else if (facing(view, t, directions[mesh.triangle_face[t]]) < 0) {
      defects.flipped.push_back(t);
    }
  }
  return defects;
}

Defects find_defects(const RoundedMesh& mesh, std::span<const glm::dvec3> directions,
                     const CleanTriangles& clean, unsigned threads) {
  // Surfaces that were split where they touch do not cross there: equal coordinates are one corner.
  const std::vector<uint32_t> place = number_places(mesh.positions);
  const std::vector<glm::dvec3> points = positions_of_places(mesh.positions, place);
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({place[a], place[b], place[c]});
  const TriangleView view{points, triangles};

  Defects defects = find_bad_triangles(mesh, directions);
  defects.crossings = clean.none()
                          ? find_crossings(view, kMostCrossings, threads)
                          : find_crossings(view, kMostCrossings, clean.others(mesh), threads);
  if (defects.crossings.empty()) defects.inverted = inverted_sheets(view);
  return defects;
}

std::vector<DefectPlace> places_of(const Defects& defects, const RoundedMesh& mesh,
                                   const Solid& solid) {
  std::vector<DefectPlace> places;
  const auto sources = [&](std::span<const uint32_t> triangles) {
    std::vector<std::string> made_by;
    for (const uint32_t t : triangles) {
      std::string source = source_text(solid, solid.faces[mesh.triangle_face[t]].source);
      if (!source.empty()) made_by.push_back(std::move(source));
    }
    return made_by;
  };
  const auto first_of = [](const auto& list) {
    return std::span(list).first(std::min(list.size(), kMostPlaces));
  };
  for (const TriangleCrossing& crossing : first_of(defects.crossings))
    places.push_back({DefectKind::kCrossing, crossing.place, sources(crossing.triangles)});
  const auto add = [&](DefectKind kind, std::span<const uint32_t> triangles) {
    for (const uint32_t t : triangles) {
      const auto& [a, b, c] = mesh.triangles[t];
      const glm::dvec3 middle =
          mesh.positions[a] / 3.0 + mesh.positions[b] / 3.0 + mesh.positions[c] / 3.0;
      places.push_back({kind, middle, sources(std::span(&t, 1))});
    }
  };
  add(DefectKind::kDegenerate, first_of(defects.degenerate));
  add(DefectKind::kFlipped, first_of(defects.flipped));
  add(DefectKind::kInverted, first_of(defects.inverted));
  return places;
}

}  // namespace csgrun
