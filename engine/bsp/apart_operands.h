// Operands of a job that are near no other one: what becomes of them is known before it is run.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// A job in parts whose boxes do not meet: the result is those of all of them, side by side.
struct ApartOperands {
  /// Materialised operands that stand alone and are in the result as they are.
  std::vector<Operand> kept;
  /// Several operands, and the same ones elsewhere.
  struct Repeated {
    std::vector<Operand> operands;
    Expression expression;
    GridBox box;
    struct Place {
      IVec3 moved;            ///< from where they are
      uint32_t more_sources;  ///< than theirs
    };
    std::vector<Place> places;  ///< the first of them is their own
  };
  std::vector<Repeated> repeated;
  /// The operands of what is left of the job, and the expression over them, if there are any.
  std::vector<Operand> others;
  Expression expression;
};

/// Parts of a job that need not be run, or once for several places: outside of an operand's box it
/// is empty, so that a part whose box meets no other's is in the result as if it was alone. Nothing
/// if there are none. O(points, and pairs of boxes that meet along one axis).
std::optional<ApartOperands> find_apart(const std::vector<Operand>& operands,
                                        const Expression& expression);

}  // namespace csgrun
