// Polygons that lie on a polygon of another operand, in one plane: where that one gives the
// surface, if there is any, they are boundary of nothing. Of bodies in one another that share
// planes each face lies on those of all that are around it.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/bsp/contact_table.h"
#include "engine/bsp/job.h"

namespace csgrun {

/// Whether polygon q, of another operand, covers all of p. They are known to be coplanar. Exact;
/// false where corners are not known to be grid points. O(corners of both, multiplied; of q alone
/// if it does not).
bool covers(const Job& job, uint32_t q, uint32_t p);

/// Marks each polygon of the job that one of an operand to which it yields (label_order.h) covers;
/// those that are marked are not looked at. O(coplanar contacts) mostly. Parallel.
void mark_flat_covered(const Job& job, const Expression& expression, const ContactTable& contacts,
                       std::vector<uint8_t>& is_covered);

}  // namespace csgrun
