// How much of what operands have is dropped within a group of them: what groups save.
#pragma once

#include <span>

#include "engine/bsp/job.h"
#include "engine/bsp/pair_test.h"

namespace csgrun {

/// Which part of the operands' surface (each polygon counting as much as any other) is inside of
/// another one of its group, in a union, or outside of one, in an intersection, when operands are
/// evaluated in groups (operand_groups.h). Estimated from a sample, the same one each time; 0 if
/// there can be no groups, or if operators would stand in them. O(1) rays.
double cover_in_groups(const Job& job, const Expression& expression);

/// The same of what faces have in common: which part of the contacts of two operands is inside
/// (outside) of a third one that is in a group with either. Rods through one place have little
/// surface there, and all that cuts them. Contacts that are not plain do not count.
double contact_cover_in_groups(const Job& job, const Expression& expression,
                               std::span<const Contact> contacts);

/// Which part of the contacts of two operands, of those that are plain, is boundary of nothing
/// whatever these two are there, by all others. Estimated from a sample. O(operands).
double hidden_contacts(const Job& job, const Expression& expression,
                       std::span<const Contact> contacts);

/// How many polygons of other operands have boxes that meet that of a polygon, on average.
/// Estimated from a sample, the same one each time. O(operands).
double meeting_boxes(const Job& job);

}  // namespace csgrun
