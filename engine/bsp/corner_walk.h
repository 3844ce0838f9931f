// Walks around faces and vertices of a leaf.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// REQUIRES: the leaf outlives it.
class CornerWalk {
 public:
  explicit CornerWalk(const LeafGeometry& leaf) : CornerWalk(leaf, leaf.opposite) {}
  /// With opposite edges other than the leaf's, which outlive it, too.
  CornerWalk(const LeafGeometry& leaf, std::span<const uint32_t> opposite)
      : leaf_(leaf), opposite_(opposite) {
    if (leaf.consists_of_triangles()) return;
    face_of_.resize(leaf.corners.size());
    for (uint32_t f = 0; f < leaf.face_count(); ++f) {
      std::fill(face_of_.begin() + leaf.face_starts[f], face_of_.begin() + leaf.face_starts[f + 1],
                f);
    }
  }

  /// The corner before a corner in its face.
  [[nodiscard]] uint32_t before(uint32_t corner) const {
    if (face_of_.empty()) return corner % 3 == 0 ? corner + 2 : corner - 1;
    const uint32_t f = face_of_[corner];
    return (corner == leaf_.face_starts[f] ? leaf_.face_starts[f + 1] : corner) - 1;
  }
  [[nodiscard]] uint32_t face(uint32_t corner) const {
    return face_of_.empty() ? corner / 3 : face_of_[corner];
  }
  /// Calls `visit(corner)` for the corners of the faces in the fan around the vertex of a corner,
  /// and returns how many these are. REQUIRES: the opposites of all edges there are known.
  template <class Visit>
  uint32_t each_in_fan(uint32_t corner, Visit&& visit) const {
    uint32_t count = 0;
    for (uint32_t c = corner; count == 0 || c != corner; ++count) {
      c = opposite_[before(c)];
      visit(c);
    }
    return count;
  }
  /// How many there are.
  [[nodiscard]] uint32_t fan(uint32_t corner) const {
    return each_in_fan(corner, [](uint32_t) {});
  }

 private:
  const LeafGeometry& leaf_;
  const std::span<const uint32_t> opposite_;
  std::vector<uint32_t> face_of_;  ///< per corner, unless all faces are triangles
};

/// The vertices whose faces are more than one fan, of those that are not `skipped`. REQUIRES: as
/// CornerWalk::fan. O(n).
inline std::vector<uint32_t> find_vertices_of_fans(const LeafGeometry& leaf,
                                                   std::span<const uint32_t> opposite,
                                                   std::span<const uint8_t> skipped) {
  const CornerWalk walk(leaf, opposite);
  std::vector<uint32_t> some_corner(leaf.vertices.size(), 0), faces(leaf.vertices.size(), 0);
  for (uint32_t c = 0; c < leaf.corners.size(); ++c) {
    if (!skipped.empty() && skipped[leaf.corners[c]] != 0) continue;
    some_corner[leaf.corners[c]] = c;
    ++faces[leaf.corners[c]];
  }
  std::vector<uint32_t> found;
  for (uint32_t v = 0; v < faces.size(); ++v) {
    if (faces[v] == 0) continue;
    if (walk.fan(some_corner[v]) != faces[v]) found.push_back(v);
  }
  return found;
}
/// The same for all vertices, by the leaf's own opposite edges.
inline std::vector<uint32_t> find_vertices_of_fans(const LeafGeometry& leaf) {
  return find_vertices_of_fans(leaf, leaf.opposite, {});
}

}  // namespace csgrun
