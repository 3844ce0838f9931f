// From a frame to the world, exactly.
#pragma once

#include <array>

#include "engine/bsp/operand.h"
#include "engine/exact/fixed_int.h"
#include "engine/exact/plane.h"
#include "engine/exact/point.h"

namespace csgrun {

/// What a frame makes of its grid points and planes; of the identity, nothing.
class FrameMap {
 public:
  FrameMap() = default;
  explicit FrameMap(const Frame& frame);

  [[nodiscard]] const Frame& frame() const { return frame_; }
  [[nodiscard]] bool is_identity() const { return frame_.is_identity; }
  /// The frame's determinant is negative: what runs counter-clockwise there, runs clockwise here.
  [[nodiscard]] bool is_mirrored() const { return determinant_.negative(); }
  [[nodiscard]] const Int<4>& determinant() const { return determinant_; }
  [[nodiscard]] Point point(const IVec3& q) const;
  /// Not reduced; its positive side is the same.
  [[nodiscard]] Plane plane(const Plane& p) const;

 private:
  Frame frame_;
  std::array<std::array<Int<2>, 3>, 3> adjugate_{};
  Int<4> determinant_{1};
  Int<kPointLimbs> weight_{1};  ///< its magnitude
  int weight_bits_ = 1;
};

}  // namespace csgrun
