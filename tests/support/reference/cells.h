// Space cut by the planes of all faces into convex cells, for what a section cannot tell: what can
// be reached from infinity. Cells are numbered by their sides of all planes, so neighbours differ
// in one.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tests/support/reference/faults.h"
#include "tests/support/reference/solids.h"

namespace csgrun::reference {

/// What stops a flood from infinity.
enum class Reach : uint8_t {
  kSurface,  ///< any face
  kFronts,   ///< faces that look at it; from behind it passes
  kSolid,    ///< the boundary of the expression
};

/// All that a flood from infinity does not reach, as a sound leaf; nothing when the leaves are not
/// closed.
std::optional<Leaf> hull(const std::vector<Leaf>& leaves, const Tree& tree, Reach reach,
                         Fault fault = Fault::kNone);

}  // namespace csgrun::reference
