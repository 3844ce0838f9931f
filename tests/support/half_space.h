// Planes that come closer to each other than doubles tell, although they are planes through grid
// points of few bits.
#pragma once

#include <cstdint>

#include "engine/bsp/operand.h"

namespace csgrun::test {

/// What is below the plane z = height + (x + y - 1) / q near the z axis, or above the plane
/// z = height - (x + y + 1) / q. Two such planes with q and q + 1 are about 1 / q^2 apart there.
/// REQUIRES: 0 < q <= 2^23.
Operand half_space(int64_t q, int64_t height, bool is_below);

}  // namespace csgrun::test
