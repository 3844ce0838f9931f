#include "tests/unit/primitives/mesh_measures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace csgrun::testing {

glm::dvec3 vector_area2(const PolygonMesh& mesh, const std::vector<std::vector<uint32_t>>& loops) {
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

double volume(const PolygonMesh& mesh) {
  double sum = 0;
  for_each_face(mesh, [&](size_t, const auto& loops) {
    sum += glm::dot(mesh.points[loops[0][0]], vector_area2(mesh, loops)) / 6;
  });
  return sum;
}

double area(const PolygonMesh& mesh) {
  double sum = 0;
  for_each_face(
      mesh, [&](size_t, const auto& loops) { sum += glm::length(vector_area2(mesh, loops)) / 2; });
  return sum;
}

void expect_closed(const PolygonMesh& mesh) {
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

int euler_number(const PolygonMesh& mesh) {
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
