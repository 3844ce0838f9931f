// Polygons that are boundary of nothing, and need not be cut: what is inside of a convex operand
// that is added to all else, or taken away from it, and what is where the expression has nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/bsp/job.h"

namespace csgrun {

class ContactTable;

/// Per polygon of the job, whether it is easily seen to be of that kind, so that nobody looks at
/// what two of them have in common: it is beside the boxes of what it would be taken away from, or
/// cut with, or inside a ball in such an operand. Only its rim may be on these boxes, in a side of
/// them: so what goes on beyond it is met there as well. Empty if there are none. O(n) for operands
/// of bounded depth.
std::vector<uint8_t> find_plainly_covered(const Job& job, const Expression& expression);

/// Per polygon of the job, whether it touches the surface of a convex operand of that kind from
/// within. The contacts are all, or all that are not of two plainly covered polygons.
std::vector<uint8_t> find_covered(const Job& job, const Expression& expression,
                                  const ContactTable& contacts);

}  // namespace csgrun
