#include "engine/mesh/triangle_boxes.h"

#include <algorithm>
#include <cmath>

#include "engine/mesh/triangle_shape.h"

namespace csgrun {
namespace {

std::array<Vec3d, 3> vectors(const TriangleCorners& corners) {
  std::array<Vec3d, 3> result{};
  for (size_t i = 0; i < 3; ++i) result[i] = {corners[i].x, corners[i].y, corners[i].z};
  return result;
}

}  // namespace

std::vector<std::array<Vec3d, 3>> sample_of(const TriangleView& mesh,
                                            std::span<const uint32_t> triangles) {
  std::vector<std::array<Vec3d, 3>> sample;
  for (size_t i = 0, step = triangles.size() / kFrameSample + 1; i < triangles.size(); i += step) {
    sample.push_back(vectors(corners_of(mesh, triangles[i])));
  }
  return sample;
}

TriangleBoxes::TriangleBoxes(const TriangleView& mesh, std::span<const std::array<Vec3d, 3>> sample)
    : frame_(find_box_frame(sample)) {
  for (const glm::dvec3& p : mesh.points) {
    reach_ = std::max({reach_, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
}

Box TriangleBoxes::of(const TriangleView& mesh, uint32_t triangle) const {
  const TriangleCorners corners = corners_of(mesh, triangle);
  return frame_ ? box_along(*frame_, vectors(corners), reach_) : box_of(corners);
}

}  // namespace csgrun
