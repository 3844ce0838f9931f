// Operands that know that they are convex.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/bsp/operand.h"
#include "tests/support/random_solids.h"

namespace csgrun::test {

Operand convex_operand(const std::vector<Loop>& loops);

Operand octahedron(const IVec3& middle, int64_t radius);

}  // namespace csgrun::test
