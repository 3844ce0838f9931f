// Changing colours and materials where they are: face by face, below Booleans.
#pragma once

#include <functional>

#include <csgrun/engine/csg_tree.h>

namespace csgrun {

/// The tree with every appearance that shows changed by `change`: what nothing was painted yet
/// starts as the default. Shared subtrees stay shared. O(nodes above the outermost colours); the
/// stack stays flat however deep the tree is.
NodePtr repaint(const NodePtr& root, const std::function<Appearance(const Appearance&)>& change);

/// The appearance of the first leaf of a tree, as it shows: what one would call the colour of a
/// body. The default where nothing is painted.
Appearance first_appearance(const NodePtr& root);

}  // namespace csgrun
