// Volume and bounding box of a result in pieces: what two versions share is summed once.
#pragma once

#include <array>
#include <optional>

#include <glm/vec3.hpp>

#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>

#include "engine/bsp/result_pieces.h"

namespace csgrun {

/// The exact volume in mm^3, rounded once, as boundary_volume gives it. Nodes of the tree keep
/// their sums: the time is that for the pieces whose sums nobody has asked for before, and O(n)
/// only when the sums leave more than one double. Errors: kInternal.
Result<double> pieces_volume(const ResultPieces& pieces, const GridStep& step);

/// The least and the greatest coordinates in mm, as the corners of the presented solid have them
/// when it is moved by whole steps; nothing of an empty one. Nodes of the tree keep the points
/// there.
std::optional<std::array<glm::dvec3, 2>> pieces_box(const ResultPieces& pieces,
                                                    const GridStep& step,
                                                    const IVec3& moved = {0, 0, 0});

}  // namespace csgrun
