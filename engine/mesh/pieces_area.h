// Area of a result in pieces: what two versions share is summed once.
#pragma once

#include <optional>

#include <csgrun/engine/evaluate.h>

#include "engine/bsp/result_pieces.h"

namespace csgrun {

/// The area in mm^2 that the presented solid has, to the last bit; nothing when the sums leave more
/// than one double (once in some ten thousand results), or a point is out of range. Nodes of the
/// tree keep their sums: the time is that for the pieces below nodes that nobody has asked before.
std::optional<double> pieces_area(const ResultPieces& pieces, const GridStep& step);

}  // namespace csgrun
