// Measures of meshes, written for the tests alone: volume, area, closedness, Euler number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <csgrun/engine/polygon_mesh.h>

namespace csgrun::testing {

template <class F>
void for_each_face(const PolygonMesh& mesh, F visit) {
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<std::vector<uint32_t>> loops;
    for (uint32_t l = mesh.face_starts[f]; l < mesh.face_starts[f + 1]; ++l) {
      loops.emplace_back(mesh.corners.begin() + mesh.loop_starts[l],
                         mesh.corners.begin() + mesh.loop_starts[l + 1]);
    }
    visit(f, loops);
  }
}

/// Twice the vector area of a face.
glm::dvec3 vector_area2(const PolygonMesh& mesh, const std::vector<std::vector<uint32_t>>& loops);

double volume(const PolygonMesh& mesh);

double area(const PolygonMesh& mesh);

/// Every directed edge is met by as many opposite ones, every face has three corners or more, no
/// corner repeats its neighbour, every point is used, and per-face arrays have the right length.
void expect_closed(const PolygonMesh& mesh);

/// Vertices - edges + faces, a face with holes counted with its holes as bridges.
int euler_number(const PolygonMesh& mesh);

}  // namespace csgrun::testing
