// The closed surfaces of a mesh as it was given, each with a box: some of them are a mesh, too.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <csgrun/engine/polygon_mesh.h>

#include "engine/csg/point_box.h"

namespace csgrun {

class MeshShells {
 public:
  /// One shell are faces that have points in common, by index. A mesh that is not closed by index
  /// counts as one: its shells might not be closed by themselves. O(n log n).
  explicit MeshShells(std::shared_ptr<const PolygonMesh> mesh);

  [[nodiscard]] const std::vector<PointBox>& boxes() const { return boxes_; }
  [[nodiscard]] size_t face_count(uint32_t shell) const { return faces_[shell].size(); }
  /// Some shells with their faces and points in the order in which the mesh has them. There are no
  /// notes about how they cross: there were of the whole.
  [[nodiscard]] std::shared_ptr<const PolygonMesh> mesh_of(std::span<const uint32_t> shells) const;

 private:
  std::shared_ptr<const PolygonMesh> mesh_;
  std::vector<PointBox> boxes_;
  std::vector<std::vector<uint32_t>> faces_;  ///< of each shell, ascending
};

}  // namespace csgrun
