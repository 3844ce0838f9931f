// A mesh file as triangles over distinct points, for measuring it as it stands.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/exact_triangles.h>
#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

struct TriangleMesh {
  std::string name;
  std::vector<glm::dvec3> points;
  std::vector<std::array<uint32_t, 3>> triangles;  ///< counter-clockwise from outside
  std::vector<uint32_t> appearance_of;             ///< per triangle; empty: no colours were read
  std::vector<Appearance> appearances;

  [[nodiscard]] TriangleView view() const { return {points, triangles}; }
};

/// Cuts polygons into triangles along their plane (ears, exactly). Points with equal coordinates
/// become one when `weld`; -0 is 0.
TriangleMesh triangulated(const PolygonMesh& mesh, bool weld);

/// Merges points with equal coordinates.
void weld(TriangleMesh& mesh);

}  // namespace csgrun
