// The bodies that a leaf consists of, each a solid by itself.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/bsp/operand.h"
#include "engine/csg/quantise.h"
#include "engine/mesh/closed_shells.h"

namespace csgrun {

/// A closed shell and its cavities, or a closed shell that crosses itself.
struct Body {
  Shell faces;            ///< of the leaf, ascending
  PreparedLeaf prepared;  ///< of these faces; good, or tangled with crossings
};

/// The different bodies of a leaf, in the order of the first faces of their outer shells: of those
/// that have the same faces the first is there. `crossings` as resolve_surface has them.
///
/// Nothing where there is but one shell, or shells that face inwards are not told to be cavities of
/// others; nor where of faces that lie upon one another, with different labels, the first in the
/// leaf is not of the first body: it is the label of the place, and bodies would not tell it.
/// O(n log n), and for each cavity a look at the shells nearest to it in the leaf.
std::optional<std::vector<Body>> find_bodies(const LeafGeometry& leaf,
                                             std::span<const std::array<uint32_t, 2>> crossings);

}  // namespace csgrun
