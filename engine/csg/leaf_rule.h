// What is inside a leaf whose surface crosses itself, and what the user is told of it.
#pragma once

#include <string>

#include "engine/bsp/self_resolution.h"
#include "engine/csg/leaf_store.h"

namespace csgrun {

/// The rule by which a leaf's surface is resolved: what its hull asks for, else its fill rule.
InsideRule rule_of(const NormalNode& leaf);

/// "the fill rule nonzero", "its outer hull" ...
std::string rule_text(InsideRule rule);

/// What is wrong with the surface of a leaf: how many pairs of faces cross, and where the first is,
/// in mm and in the user's coordinates.
std::string describe_tangle(const QuantisedLeaf& leaf, const LeafRounding& rounding,
                            const GridStep& step);

}  // namespace csgrun
