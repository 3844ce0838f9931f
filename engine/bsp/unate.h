// Expressions in which each operand only adds, or only takes away (Boolean functions call that
// unate).
#pragma once

#include "engine/bsp/operand.h"

namespace csgrun {

/// Whether what an expression contains only grows, or only shrinks, with each of its operands: then
/// its solid is one cone, and the outside another, around each point in which surfaces of different
/// operands cross in general position. False when it is not seen from each operand's place alone
/// (under a symmetric difference, say, or when it is on both sides of differences). O(nodes).
bool is_unate(const Expression& expression);

}  // namespace csgrun
