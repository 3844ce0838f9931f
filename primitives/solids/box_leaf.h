// Upright boxes that solids are cut with.
#pragma once

#include <memory>

#include <glm/vec3.hpp>

#include <csgrun/engine/csg_tree.h>

namespace csgrun {

inline NodePtr box_leaf(const glm::dvec3& low, const glm::dvec3& high, const SourceRef& where) {
  auto mesh = std::make_shared<PolygonMesh>();
  for (int i = 0; i < 8; ++i) {
    mesh->points.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y,
                              i & 4 ? high.z : low.z);
  }
  mesh->hull_of_points = true;
  mesh->kind = "half-space";
  return Node::leaf(std::move(mesh), where);
}

}  // namespace csgrun
