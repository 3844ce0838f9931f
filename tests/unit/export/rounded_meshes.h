// Rounded meshes made by hand, for tests of what repair does to them.
#pragma once

#include <vector>

#include <gtest/gtest.h>

#include "export/half_edges.h"
#include "export/rounding.h"

namespace csgrun::testing {

/// A mesh, and the outward direction of each face.
struct MadeMesh {
  RoundedMesh mesh;
  std::vector<glm::dvec3> directions;

  void face(const glm::dvec3& direction, const std::vector<Triangle>& triangles) {
    for (const Triangle& t : triangles) {
      mesh.triangles.push_back(t);
      mesh.triangle_face.push_back(static_cast<uint32_t>(directions.size()));
    }
    directions.push_back(direction);
    mesh.face_normals.push_back(direction);
    mesh.outlines.emplace_back();
  }
};

inline void pair_up(RoundedMesh& mesh) {
  auto twins = manifold_twins(mesh.triangles, mesh.positions.size());
  ASSERT_TRUE(twins) << twins.error().message;
  mesh.twins = *std::move(twins);
}

inline void expect_manifold(const RoundedMesh& mesh) {
  const auto twins = manifold_twins(mesh.triangles, mesh.positions.size());
  ASSERT_TRUE(twins) << twins.error().message;
  EXPECT_EQ(*twins, mesh.twins);
}

}  // namespace csgrun::testing
