// Whether points are inside of convex leaves on the grid, by all their planes in doubles.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "engine/bsp/operand.h"
#include "engine/bsp/ray_label.h"

namespace csgrun {

/// Not for several threads at the same time; copies know what was known.
class ConvexSides {
 public:
  /// kUnknown within two steps of a plane that has all of the leaf behind it, or nearly all: a
  /// point is wrong by less than a step along each axis, and planes by much less. REQUIRES: the
  /// operand is a convex leaf on the grid with faces, and all coordinates are below 2^30. O(faces).
  Inside side(const std::vector<Operand>& operands, uint32_t operand,
              const std::array<double, 3>& point);

 private:
  using UnitPlane = std::array<double, 4>;

  std::unordered_map<uint32_t, std::vector<UnitPlane>> planes_;  ///< of operands asked about
};

}  // namespace csgrun
