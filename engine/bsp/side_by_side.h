// The union of boundaries that are apart from one another.
#pragma once

#include <memory>
#include <vector>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/operand.h"

namespace csgrun {

/// The boundary of the union of materialised operands whose boxes do not meet: what a job of them
/// would make. Named faces stay named. REQUIRES: they are in the world's frame, and only moved if
/// their named faces are; and painted over only if their faces have one appearance. O(n log n).
std::shared_ptr<const BoundaryMesh> side_by_side(const std::vector<Operand>& operands);

}  // namespace csgrun
