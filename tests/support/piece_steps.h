// Steps of chains of results in pieces, for tests.
#pragma once

#include <cstdint>

#include "engine/bsp/operand.h"
#include "engine/bsp/result_pieces.h"

namespace csgrun::test {

/// The expression with one more node: the root before, and operands that are new, or these first.
Expression continued(Expression e, BooleanOp op, uint32_t first, uint32_t count,
                     bool root_last = false);

/// One node over a version, operand 0, and others; or over these first.
Expression step_of(BooleanOp op, uint32_t others, bool version_last);

/// Pieces that a job may take have corners that it can name, and planes where these are not made
/// of a face of a leaf.
void check_names(const ResultPieces& pieces);

}  // namespace csgrun::test
