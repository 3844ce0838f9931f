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
  /// Per operand, whether it may be open, and polygons of it may meet others inside of a remover,
  /// as inner boxes tell (see DeadSpace): nobody looks at what those of two such operands have in
  /// common there. Empty if there are no such boxes.
  std::vector<uint8_t> meets_within;
  /// Per operand, whether one of its polygons is hidden, or not in the job for that reason, or may
  /// meet others within. The outlines in which it is seen to meet others may have ends, and a part
  /// of another surface that these do not divide may be inside of it here and outside there. What
  /// becomes of the part is the same everywhere.
  std::vector<uint8_t> is_open;
  std::shared_ptr<const DeadSpace> dead = std::make_shared<DeadSpace>();  ///< never null

  /// Whether nobody looks at what two polygons of the job have in common, for that reason.
  [[nodiscard]] bool meet_within(const Job& job, uint32_t p, uint32_t q) const {
    return !meets_within.empty() && meets_within[job.polygons()[p].operand] != 0 &&
           meets_within[job.polygons()[q].operand] != 0 &&
           dead->inner_boxes().hold_common(job.boxes()[p], job.boxes()[q]);
  }
};

/// O(n) for operands of bounded depth. Parallel.
PlainlyCovered find_plainly_covered(const Job& job, const Expression& expression);

/// Per polygon of the job, whether it touches the surface of a convex remover that is not open from
/// within. The contacts are all, or all that are not of two plainly covered polygons, a hidden one,
/// or two that meet within a remover.
std::vector<uint8_t> find_covered(const Job& job, const PlainlyCovered& plainly,
                                  const ContactTable& contacts);

}  // namespace csgrun
