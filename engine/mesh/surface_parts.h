// The parts of a surface that hang together by edges.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// The lowest face of each part that is connected by edges of two faces, ascending. Within a part
/// the winding numbers in front of faces, and those behind, are the same. O(n).
std::vector<uint32_t> one_face_of_each_part(const LeafGeometry& leaf);

}  // namespace csgrun
