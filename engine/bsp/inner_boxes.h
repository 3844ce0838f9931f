// Boxes inside of the largest operands: what two polygons have in common is often plainly in one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/bsp/operand.h"
#include "engine/bsp/polygon_box.h"

namespace csgrun {

class InnerBoxes {
 public:
  /// None.
  InnerBoxes() = default;
  /// A box strictly inside of each of the few largest of the operands that are `wanted`, if it
  /// takes up a good part of `whole`. `boxes`: of the operands. O(n). REQUIRES: those wanted have a
  /// ball (OperandBalls), so are leaves with their middle behind all faces.
  InnerBoxes(const std::vector<Operand>& operands, const std::vector<PolygonBox>& boxes,
             const std::vector<uint8_t>& wanted, const PolygonBox& whole);

  [[nodiscard]] bool empty() const { return all_.empty(); }
  /// Whether all that is in both of two boxes is in one inside of an operand.
  [[nodiscard]] bool hold_common(const PolygonBox& a, const PolygonBox& b) const {
    PolygonBox common = a;
    common.clip(b);
    return std::any_of(all_.begin(), all_.end(),
                       [&](const Inner& inner) { return inner.box.holds(common); });
  }
  /// Whether a point is in one, each coordinate being as wrong as `error` at most.
  [[nodiscard]] bool hold(const std::array<double, 3>& point, double error) const;
  /// Whether an operand in this box may meet others in one that is inside of another one.
  [[nodiscard]] bool may_hold_part(uint32_t operand, const PolygonBox& box) const {
    return std::any_of(all_.begin(), all_.end(), [&](const Inner& inner) {
      return inner.operand != operand && inner.box.meets(box);
    });
  }

 private:
  struct Inner {
    PolygonBox box;
    uint32_t operand;
  };
  std::vector<Inner> all_;
};

}  // namespace csgrun
