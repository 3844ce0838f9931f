// Small boxes around what two polygons have in common, by doubles.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/bsp/job.h"

namespace csgrun {

/// Appends boxes that together hold all points of two polygons of a job: around where each of them
/// is near the plane of the other one, within the overlap of their boxes, in so many slices across
/// its longest side. Slivers aslant have large boxes, and in common a strip along a diagonal of
/// these. O(corners^2 slices).
void add_common_boxes(const Job& job, uint32_t p, uint32_t q, uint32_t slices,
                      std::vector<GridBox>& boxes);

}  // namespace csgrun
