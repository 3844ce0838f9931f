// Long triangles over doubles, eight by eight: nearly all whose boxes overlap are told apart at
// once. Boxes of needles that are aslant hold much of the mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <csgrun/engine/exact_triangles.h>

#include "engine/mesh/eight_slabs.h"

namespace csgrun {

class LongTriangles {
 public:
  /// Of a mesh, those that `order` names, by their places in it. O(n).
  LongTriangles(const TriangleView& mesh, std::span<const uint32_t> order);

  /// Of the triangles at places 8 group .. 8 group + 7, as bits, those of `which` that certainly
  /// have no point in common with the one at `place`.
  [[nodiscard]] uint32_t apart(uint32_t place, uint32_t group, uint32_t which) const {
    return slabs_.empty() ? 0 : slabs_[group].apart(slabs_[place / 8], place % 8, which);
  }

 private:
  std::vector<EightSlabs> slabs_;  ///< none where floats do not reach
};

}  // namespace csgrun
