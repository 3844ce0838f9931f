// Millimetres from grid coordinates: coordinate * numerator / denominator * 2^exponent of a step.
#pragma once

#include <array>
#include <string>

#include <glm/vec3.hpp>

#include <csgrun/engine/evaluate.h>

#include "engine/bsp/operand.h"
#include "engine/exact/point.h"

namespace csgrun {

class ToMillimetres {
 public:
  /// `step` is not automatic.
  explicit ToMillimetres(const GridStep& step);

  /// Each coordinate correctly rounded from the exact value, to double and to float.
  void position(const Point& p, glm::dvec3& mm, std::array<float, 3>& single) const;
  /// The same of a grid point; a few nanoseconds.
  void position(const IVec3& p, glm::dvec3& mm, std::array<float, 3>& single) const;
  /// As fractions in lowest terms, "p/q" or "p".
  [[nodiscard]] std::array<std::string, 3> text(const Point& p) const;

 private:
  void divide(const Point& p, glm::dvec3& mm, std::array<float, 3>& single) const;
  [[nodiscard]] bool quick(int64_t coordinate, double& mm, float& single) const;

  GridStep step_;
  int64_t quick_limit_ = 0;  ///< coordinates below it times the numerator are exact as doubles
  double denominator_ = 1, scale_ = 1;
};

}  // namespace csgrun
