// Where an operand may have points: in its box, and in a ball around that box's middle. Of round
// tools the ball leaves out the half of the box that is in its corners.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "engine/bsp/piece_tree.h"

namespace csgrun {

class OperandReach {
 public:
  /// Of an operand with these vertices, correctly rounded.
  explicit OperandReach(std::span<const std::array<double, 3>> vertices) {
    for (const auto& v : vertices) box_.add(v);
    if (vertices.empty()) return;
    for (size_t k = 0; k < 3; ++k) middle_[k] = box_.lo[k] / 2 + box_.hi[k] / 2;
    double most = 0;
    for (const auto& v : vertices) {
      most = std::max(most, sum_of_squares([&](size_t k) { return v[k] - middle_[k]; }));
    }
    // Coordinates are rounded, and so is all this, by far less than a step beside 2^-40 of it.
    constexpr double kMargin = 1 + 0x1p-40;
    const double radius = std::sqrt(most) * kMargin + 1;
    radius_squared_ = radius * radius;
  }

  [[nodiscard]] const PieceBox& box() const { return box_; }

  /// Whether the operand may have a point in a box: one of correctly rounded coordinates.
  [[nodiscard]] bool may_meet(const PieceBox& box) const {
    return box_.meets(box) &&
           sum_of_squares([&](size_t k) {
             return std::max({box.lo[k] - middle_[k], middle_[k] - box.hi[k], 0.0});
           }) <= radius_squared_;
  }

 private:
  template <class Of>
  static double sum_of_squares(Of&& of) {
    double sum = 0;
    for (size_t k = 0; k < 3; ++k) {
      const double x = of(k);
      sum += x * x;
    }
    return sum;
  }

  PieceBox box_;
  std::array<double, 3> middle_{};
  double radius_squared_ = 0;
};

}  // namespace csgrun
