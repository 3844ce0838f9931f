// Parts of Minkowski sums in tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <variant>
#include <vector>

#include "engine/csg/convex_hull.h"
#include "engine/csg/minkowski.h"
#include "engine/csg/sum_surface.h"
#include "test_meshes.h"

namespace csgrun::testing {

/// Six times the volume that a surface of convex faces wraps; small coordinates.
inline int64_t six_volumes(const std::vector<IVec3>& points, const std::vector<uint32_t>& corners,
                           const std::vector<uint32_t>& face_starts) {
  int64_t sum = 0;
  for (size_t f = 0; f + 1 < face_starts.size(); ++f) {
    for (uint32_t c = face_starts[f] + 2; c < face_starts[f + 1]; ++c) {
      const IVec3 &p = points[corners[face_starts[f]]], &q = points[corners[c - 1]],
                  &r = points[corners[c]];
      sum += p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
             p[2] * (q[0] * r[1] - q[1] * r[0]);
    }
  }
  return sum;
}
inline int64_t six_volumes(const LeafGeometry& leaf) {
  return six_volumes(leaf.vertices, leaf.corners, leaf.face_starts);
}
inline int64_t six_volumes(const SumSurface& surface) {
  return six_volumes(surface.points, surface.corners, surface.face_starts);
}

inline bool is_balanced(const SumSurface& surface) {
  std::map<std::pair<uint32_t, uint32_t>, int> runs;
  for (size_t f = 0; f + 1 < surface.face_starts.size(); ++f) {
    const uint32_t begin = surface.face_starts[f], end = surface.face_starts[f + 1];
    for (uint32_t c = begin; c < end; ++c) {
      const uint32_t from = surface.corners[c], to = surface.corners[c + 1 < end ? c + 1 : begin];
      ++runs[{std::min(from, to), std::max(from, to)}] += from < to ? 0 : -2;
    }
  }
  return std::all_of(runs.begin(), runs.end(), [](const auto& run) { return run.second == 0; });
}

inline LeafGeometry random_hull(std::mt19937& random, int points, int size) {
  std::vector<IVec3> all;
  for (int i = 0; i < points; ++i) {
    IVec3& p = all.emplace_back();
    for (int64_t& x : p)
      x = static_cast<int64_t>(random() % static_cast<uint32_t>(size)) - size / 2;
  }
  return convex_hull(all);
}

inline std::vector<IVec3> on_grid(const PolygonMesh& mesh) {
  std::vector<IVec3> result;
  for (const glm::dvec3& p : mesh.points) {
    result.push_back({std::lround(p.x), std::lround(p.y), std::lround(p.z)});
  }
  return result;
}

inline Summand as_summand(const PolygonMesh& mesh) {
  return solid_summand(mesh, on_grid(mesh), Node::leaf(std::make_shared<PolygonMesh>(mesh)));
}

inline SolidPtr solid_of_parts(const std::vector<SumPart>& parts, const GridStep& step) {
  std::vector<NodePtr> nodes;
  for (const SumPart& part : parts) {
    if (const auto* node = std::get_if<NodePtr>(&part)) {
      nodes.push_back(*node);
      continue;
    }
    PolygonMesh mesh;
    const auto* hull = std::get_if<std::vector<IVec3>>(&part);
    const auto* surface = std::get_if<SumSurface>(&part);
    for (const IVec3& p : hull != nullptr ? *hull : surface->points) {
      mesh.points.emplace_back(p[0], p[1], p[2]);
    }
    mesh.hull_of_points = hull != nullptr;
    for (size_t f = 0; surface != nullptr && f + 1 < surface->face_starts.size(); ++f) {
      mesh.add_face(std::vector<uint32_t>(surface->corners.begin() + surface->face_starts[f],
                                          surface->corners.begin() + surface->face_starts[f + 1]));
    }
    nodes.push_back(Node::leaf(std::make_shared<PolygonMesh>(std::move(mesh))));
  }
  EvaluateOptions options;
  options.grid = step;
  return solid_of(unite(nodes), options);
}

}  // namespace csgrun::testing
