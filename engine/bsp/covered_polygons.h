// Polygons that are boundary of nothing, and need not be cut: what is inside of an operand that is
// added to all else, or taken away from it, and what is where the expression has nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/bsp/dead_space.h"
#include "engine/bsp/job.h"

namespace csgrun {

class ContactTable;

/// Polygons that are easily seen to be boundary of nothing. Those of the job come by their numbers.
struct PlainlyCovered {
  /// Whether it is one: it is beside the boxes of what it would be taken away from, or cut with, or
  /// in dead space. Nobody looks at what two of these have in common. Only the rim of one may be on
  /// these boxes, in a side of them: so what goes on beyond it is met there as well. Empty if there
  /// are none.
  std::vector<uint8_t> polygons;
  /// Those of them that are in dead space, of operands that may be open. No point of what meets one
  /// there is boundary of anything, on whichever side of the polygon it is: nobody looks at what
  /// anything has in common with it. Empty if there are none, as with two operands or less.
  std::vector<uint8_t> hidden;
  /// Per operand, whether one of its polygons is hidden, or not in the job for that reason. The
  /// outlines in which it is seen to meet others may have ends, and a part of another surface that
  /// these do not divide may be inside of it here and outside there. What becomes of the part is
  /// the same everywhere.
  std::vector<uint8_t> is_open;
  std::shared_ptr<const DeadSpace> dead = std::make_shared<DeadSpace>();  ///< never null
};

/// O(n) for operands of bounded depth. Parallel.
PlainlyCovered find_plainly_covered(const Job& job, const Expression& expression);

/// Per polygon of the job, whether it touches the surface of a convex remover that is not open from
/// within. The contacts are all, or all that are not of two plainly covered polygons or a hidden
/// one.
std::vector<uint8_t> find_covered(const Job& job, const PlainlyCovered& plainly,
                                  const ContactTable& contacts);

}  // namespace csgrun
