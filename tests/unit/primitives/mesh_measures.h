// Measures of meshes, written for the tests alone: volume, area, closedness, Euler number.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

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
inline glm::dvec3 vector_area2(const PolygonMesh& mesh,
                               const std::vector<std::vector<uint32_t>>& loops) {
  glm::dvec3 sum(0);
  const glm::dvec3 origin = mesh.points[loops[0][0]];
  for (const auto& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      sum += glm::cross(mesh.points[loop[i]] - origin,
                        mesh.points[loop[(i + 1) % loop.size()]] - origin);
    }
  }
  return sum;
}

inline double volume(const PolygonMesh& mesh) {
  double sum = 0;
  for_each_face(mesh, [&](size_t, const auto& loops) {
    sum += glm::dot(mesh.points[loops[0][0]], vector_area2(mesh, loops)) / 6;
  });
  return sum;
}

inline double area(const PolygonMesh& mesh) {
  double sum = 0;
  for_each_face(
      mesh, [&](size_t, const auto& loops) { sum += glm::length(vector_area2(mesh, loops)) / 2; });
  return sum;
}

/// Every directed edge is met by as many opposite ones, every face has three corners or more, no
/// corner repeats its neighbour, every point is used, and per-face arrays have the right length.
inline void expect_closed(const PolygonMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> balance;
  std::set<uint32_t> used;
  for_each_face(mesh, [&](size_t f, const auto& loops) {
    for (const auto& loop : loops) {
      EXPECT_GE(loop.size(), 3u) << "face " << f;
      for (size_t i = 0; i < loop.size(); ++i) {
        const uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
        ASSERT_LT(a, mesh.points.size());
        EXPECT_NE(a, b) << "face " << f;
        used.insert(a);
        if (a < b) ++balance[{a, b}];
        if (b < a) --balance[{b, a}];
      }
    }
  });
  for (const auto& [edge, count] : balance) {
    EXPECT_EQ(count, 0) << "edge " << edge.first << ' ' << edge.second;
  }
  EXPECT_EQ(used.size(), mesh.points.size());
  EXPECT_EQ(mesh.surface.size(), mesh.face_count());
}

/// Vertices - edges + faces, a face with holes counted with its holes as bridges.
inline int euler_number(const PolygonMesh& mesh) {
  std::set<std::pair<uint32_t, uint32_t>> edges;
  int faces = 0;
  for_each_face(mesh, [&](size_t, const auto& loops) {
    faces += 2 - static_cast<int>(loops.size());
    for (const auto& loop : loops) {
      for (size_t i = 0; i < loop.size(); ++i) {
        const uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
        edges.insert({std::min(a, b), std::max(a, b)});
      }
    }
  });
  return static_cast<int>(mesh.points.size()) - static_cast<int>(edges.size()) + faces;
}

}  // namespace csgrun::testing
