// The faces that a job of many operands needs: those that are not in dead space. Nothing is left of
// the others, and nobody looks at what meets them (see PlainlyCovered::hidden).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/bsp/dead_space.h"
#include "engine/bsp/operand.h"
#include "engine/bsp/some_faces.h"

namespace csgrun {

struct LiveFaces : SomeFaces {
  std::vector<uint8_t> is_looked_at;  ///< per operand, whether its faces were
  std::shared_ptr<const DeadSpace> dead;
};

/// Of leaves on the grid; of others all faces are needed. Nothing when it is not worth the while.
/// O(n), parallel.
std::optional<LiveFaces> find_live_faces(const std::vector<Operand>& operands,
                                         const Expression& expression);

}  // namespace csgrun
