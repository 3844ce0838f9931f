// Whose faces give the surface where those of two operands lie on one another: the order in which
// an expression asks its operands.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

class LabelOrder {
 public:
  /// O(nodes).
  LabelOrder(const Expression& expression, size_t operands);

  /// Whether no point that is on the surface of both operands has the first one's label: an
  /// operator that names the first of its children with surface there, so no symmetric difference,
  /// has the other operand before what the first one is in. False when in doubt, as of what stands
  /// in several places.
  [[nodiscard]] bool yields(uint32_t operand, uint32_t other) const {
    const uint32_t own = places_[operand].place;
    return places_[other].place < own && own < places_[other].end;
  }

 private:
  /// Operands are counted from left to right.
  struct Place {
    uint32_t place = ~0u;  ///< unknown
    uint32_t end = 0;      ///< of those that yield
  };
  std::vector<Place> places_;  ///< per operand
};

}  // namespace csgrun
