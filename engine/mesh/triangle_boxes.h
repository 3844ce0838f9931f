// Boxes of the triangles of a mesh over doubles: those of triangles that meet overlap.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <csgrun/engine/exact_triangles.h>

#include "engine/base/vec3d.h"
#include "engine/mesh/box_frame.h"
#include "engine/mesh/box_tree.h"

namespace csgrun {

/// Enough of the triangles to tell what they are like.
std::vector<std::array<Vec3d, 3>> sample_of(const TriangleView& mesh,
                                            std::span<const uint32_t> triangles);

/// Along the axes, or along a frame that suits a mesh better.
class TriangleBoxes {
 public:
  TriangleBoxes(const TriangleView& mesh, std::span<const std::array<Vec3d, 3>> sample);
  [[nodiscard]] Box of(const TriangleView& mesh, uint32_t triangle) const;

 private:
  std::optional<BoxFrame> frame_;
  double reach_ = 0;  ///< no coordinate is larger
};

}  // namespace csgrun
