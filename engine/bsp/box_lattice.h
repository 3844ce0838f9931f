// Boxes along the axes on the lattice of all their planes: each cell of it is inside a box or
// outside as a whole, so that the order of coordinates decides everything.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/operand.h"

namespace csgrun {

/// Cell p of an axis is between planes p - 1 and p; cell 0 and the last one reach to infinity.
struct BoxLattice {
  struct Box {
    /// Along each axis it fills the cells from lo + 1 to hi: lo and hi are its planes.
    std::array<uint32_t, 3> lo, hi;
    /// Of its lower and its upper side along each axis: into `labels`.
    std::array<std::array<uint32_t, 2>, 3> label;
  };
  std::array<std::vector<int64_t>, 3> planes;  ///< ascending
  std::vector<Box> boxes;                      ///< per operand
  std::vector<FaceLabel> labels;               ///< ascending, each once

  [[nodiscard]] uint32_t plane_count(int axis) const {
    return static_cast<uint32_t>(planes[static_cast<size_t>(axis)].size());
  }
};

/// The lattice of operands that all are boxes along the axes of the world, each side of one label
/// and no facet that is kept as it is; nothing if they are not, or if the lattice is so fine that
/// its cells are many more than the operands. O(n log n).
std::optional<BoxLattice> make_lattice(const std::vector<Operand>& operands);

}  // namespace csgrun
