// Parts that are one solid in several places, for formats that can say so.
#pragma once

#include <optional>
#include <vector>

#include <csgrun/engine/csg_tree.h>

namespace csgrun {

struct Instance {
  size_t base;       ///< into Instances::bases
  Affine placement;  ///< of the base
};

struct Instances {
  std::vector<NodePtr> bases;                    ///< trees that at least two parts place
  std::vector<std::optional<Instance>> of_part;  ///< none: the part stands alone
};

/// Takes transforms and colours off the roots of the parts; what is left and is the same node with
/// the same colour is one base. O(parts * depth of these roots).
Instances find_instances(const std::vector<NodePtr>& parts);

}  // namespace csgrun
