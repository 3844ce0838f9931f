// Where nothing is boundary, as is easily told: inside of balls and boxes in what is added to all
// else, or taken away from it, alone or among others, outside of balls around what all else is cut
// with, or taken away from, and beside the box of the result.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/inner_boxes.h"
#include "engine/bsp/operand.h"
#include "engine/bsp/operand_balls.h"
#include "engine/bsp/polygon_box.h"
#include "engine/bsp/rounded_box.h"

namespace csgrun {

class DeadSpace {
 public:
  /// Nothing is known: all may be boundary.
  DeadSpace() = default;
  /// `boxes`: around all of each operand. With two operands or less there are no balls and inner
  /// boxes: what is inside of one meets nothing at all. O(n), parallel.
  DeadSpace(const std::vector<Operand>& operands, const Expression& expression,
            std::vector<PolygonBox> boxes);

  /// Whether an operand is a leaf and the expression is the same everywhere inside of it, so that
  /// nothing is boundary there: it is a remover.
  [[nodiscard]] bool is_remover(uint32_t operand) const {
    return !removes_.empty() && removes_[operand] != 0;
  }
  /// Whether an operand is a leaf and the expression is empty everywhere outside of it: it is a
  /// confiner.
  [[nodiscard]] bool is_confiner(uint32_t operand) const {
    return !confines_.empty() && confines_[operand] != 0;
  }
  /// Of leaves; those of removers and confiners hide polygons.
  [[nodiscard]] const OperandBalls& balls() const { return balls_; }
  [[nodiscard]] const PolygonBox& operand_box(size_t operand) const { return boxes_[operand]; }
  /// Per node of the expression, a box that holds what it is.
  [[nodiscard]] std::span<const PolygonBox> node_boxes() const { return node_boxes_; }
  /// Whether a point is beside the result, each coordinate being as wrong as `error` at most.
  [[nodiscard]] bool is_beside_result(const std::array<double, 3>& point, double error) const {
    return !may_hold(result_, point, error);
  }
  /// Of removers.
  [[nodiscard]] const InnerBoxes& inner_boxes() const { return inner_boxes_; }
  /// Whether all of a polygon is in there, in one ball, outside of one or beside the result: at(i)
  /// is corner i of `count`, correctly rounded.
  template <class At>
  [[nodiscard]] bool holds(const PolygonBox& box, uint32_t count, At&& at) const {
    return !result_.meets(box) || balls_.leave_out(box) || balls_.hold(count, at);
  }
  /// Whether an operand with this box may have polygons there.
  [[nodiscard]] bool may_hold_part(const PolygonBox& box) const {
    return balls_.hide_some() || !result_.holds(box);
  }
  /// Whether an operand of so many faces may be open (see PlainlyCovered::is_open): many points are
  /// asked whether they are inside of it then, which must not take a ray through many faces.
  [[nodiscard]] bool may_be_open(uint32_t operand, size_t faces) const {
    constexpr size_t kFew = 64;
    return faces <= kFew || balls_.hides(operand);
  }

 private:
  std::vector<uint8_t> removes_, confines_;  ///< per operand
  std::vector<PolygonBox> boxes_, node_boxes_;
  PolygonBox result_ = PolygonBox::everywhere();
  OperandBalls balls_;
  InnerBoxes inner_boxes_;
};

}  // namespace csgrun
