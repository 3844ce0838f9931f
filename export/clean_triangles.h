// Triangles of which no two cross, by their coordinates: what was looked at once, and is in the
// next mesh too, need not be held against one another again.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <csgrun/engine/exact_triangles.h>

#include "export/rounding.h"

namespace csgrun {

class CleanTriangles {
 public:
  CleanTriangles() = default;  ///< none
  /// Those of a mesh that are in none of its crossings. REQUIRES: that is all of them. O(n log n).
  CleanTriangles(const RoundedMesh& mesh, std::span<const TriangleCrossing> crossings);

  [[nodiscard]] bool none() const { return keys_.empty(); }
  /// The triangles of a mesh that are not among them, ascending; also those that are there twice,
  /// one upon the other. O(n log n).
  [[nodiscard]] std::vector<uint32_t> others(const RoundedMesh& mesh) const;

 private:
  using Key = std::array<uint64_t, 2>;
  static Key key(const RoundedMesh& mesh, uint32_t triangle);

  std::vector<Key> keys_;  ///< hashes of the corners, from the first by coordinates on; ascending
};

}  // namespace csgrun
