// How much of what operands have is dropped within a group of them: what groups save.
#pragma once

#include "engine/bsp/job.h"

namespace csgrun {

/// Which part of the operands' surface (each polygon counting as much as any other) is inside of
/// another one of its group, in a union, or outside of one, in an intersection, when operands are
/// evaluated in groups (operand_groups.h). Estimated from a sample, the same one each time; 0 if
/// there can be no groups, or if operators would stand in them. O(1) rays.
double cover_in_groups(const Job& job, const Expression& expression);

}  // namespace csgrun
