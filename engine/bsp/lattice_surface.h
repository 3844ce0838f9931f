// What is boundary on a lattice: its squares, each with the side that is outside and a label, and
// the faces that they form.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/bsp/box_lattice.h"

namespace csgrun {

class LatticeSurface {
 public:
  explicit LatticeSurface(const BoxLattice& lattice);

  /// The square between a cell and the next one along an axis. `upper`: the outside is there.
  void add(int axis, const std::array<uint32_t, 3>& cell, uint32_t label, bool upper) {
    const auto a = static_cast<size_t>(axis);
    has_squares_[a][cell[a]] = 1;
    squares_[a][index(a, cell)] = 1 + 2 * label + (upper ? 1 : 0);
  }

  /// The canonical boundary that the squares make up. O(cells), and O(n log n) for n corners.
  [[nodiscard]] BoundaryMesh boundary() const;

 private:
  friend class LatticeTracer;
  /// By planes of the axis, then by the cells of the next axis, then by those of the one after.
  [[nodiscard]] size_t index(size_t axis, const std::array<uint32_t, 3>& cell) const {
    const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    return (cell[axis] * cells_[u] + cell[u]) * cells_[v] + cell[v];
  }

  const BoxLattice& lattice_;
  std::array<size_t, 3> cells_;  ///< along each axis
  /// Per axis and square: 0, or one more than twice its label and whether the outside is above.
  std::array<std::vector<uint32_t>, 3> squares_;
  std::array<std::vector<uint8_t>, 3> has_squares_;  ///< per plane
};

}  // namespace csgrun
