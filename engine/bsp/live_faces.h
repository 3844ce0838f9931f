// The faces that a job of many operands needs: those that are not in dead space. Nothing is left of
// the others, and nobody looks at what meets them (see PlainlyCovered::hidden).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/bsp/dead_space.h"
#include "engine/bsp/operand.h"

namespace csgrun {

struct LiveFaces {
  /// Per operand, whether its faces were looked at, and whether some of them are in dead space.
  std::vector<uint8_t> is_looked_at, is_partial;
  /// Of each that is: the others, ascending.
  std::vector<std::vector<uint32_t>> faces;
  std::shared_ptr<const DeadSpace> dead;
};

/// Of leaves on the grid; of others all faces are needed. Nothing when it is not worth the while.
/// O(n), parallel.
std::optional<LiveFaces> find_live_faces(const std::vector<Operand>& operands,
                                         const Expression& expression);

}  // namespace csgrun
