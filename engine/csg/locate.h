// Is a point inside a result? Exactly, by counting the faces beside it.
#pragma once

#include <memory>
#include <optional>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/operand.h"
#include "engine/bsp/square_bins.h"

namespace csgrun {

class PointLocator {
 public:
  /// Without bins O(1) but for the box, and O(edges) for each point, most of them decided by
  /// doubles. With bins O(edges), and for each point what stands beside it along x.
  PointLocator(std::shared_ptr<const BoundaryMesh> boundary, bool with_bins);

  [[nodiscard]] bool has_bins() const { return bins_.has_value(); }
  [[nodiscard]] const BoundaryMesh* boundary() const { return boundary_.get(); }
  /// +1 when the grid point is inside the solid, 0 on its boundary, -1 outside.
  [[nodiscard]] int locate(const IVec3& point) const;

 private:
  std::shared_ptr<const BoundaryMesh> boundary_;
  GridBox box_;
  std::optional<SquareBins> bins_;  ///< of the faces
};

}  // namespace csgrun
