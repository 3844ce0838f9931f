// Some faces of operands, for a job that does not need all.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

struct SomeFaces {
  std::vector<uint8_t> is_partial;  ///< per operand: not all faces of it
  /// Of each that is partial those that are needed, ascending.
  std::vector<std::vector<uint32_t>> faces;
};

/// Whether a job may have some faces of an operand only: of leaves on the grid. (Who puts a result
/// together may ask for some of a boundary without named faces, too.) Where facets of
/// several faces are kept, who asks for one looks for all of these.
inline bool can_be_partial(const Operand& operand) {
  const LeafGeometry* const leaf = operand.leaf.get();
  return leaf && operand.frame.is_identity &&
         (!leaf->keeps_facets() || leaf->has_triangles_as_facets());
}

}  // namespace csgrun
