// The faces of a surface as they are seen from one point.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "engine/bsp/operand.h"
#include "engine/mesh/face_normal.h"

namespace csgrun {

/// The point is relative to a vertex, in halves of steps, and odd: a line through it along an axis
/// misses all vertices. REQUIRES: a compact leaf (leaf_shape.h), and the point within its box.
class CentreView {
 public:
  /// From the middle of the leaf's box.
  CentreView(const LeafGeometry& leaf, const GridBox& box)
      : leaf_(leaf), origin_(leaf.vertices[leaf.corners[0]]) {
    for (size_t k = 0; k < 3; ++k) {
      centre_[k] = odd(static_cast<double>(box.lo[k] + box.hi[k] - 2 * origin_[k]));
    }
  }

  [[nodiscard]] const IVec3& origin() const { return origin_; }
  [[nodiscard]] const IVec3& centre() const { return centre_; }
  /// Puts the centre near here.
  void move_to(const std::array<double, 3>& centre) {
    for (size_t k = 0; k < 3; ++k) centre_[k] = odd(centre[k]);
  }

  /// The way from the centre to a corner, in halves of steps: below 2^32, and odd.
  [[nodiscard]] IVec3 way_to(uint32_t corner) const {
    return way_to_vertex(leaf_.vertices[leaf_.corners[corner]]);
  }
  [[nodiscard]] IVec3 way_to_vertex(const IVec3& p) const {
    IVec3 way;
    for (size_t k = 0; k < 3; ++k) way[k] = 2 * (p[k] - origin_[k]) - centre_[k];
    return way;
  }

  [[nodiscard]] IVec3 normal(size_t face) const {
    return face_normal(leaf_, leaf_.face_starts[face], leaf_.face_starts[face + 1]);
  }

  /// Whether a face has the centre behind it. The sum fits 97 bits.
  [[nodiscard]] bool has_behind(size_t face, const IVec3& normal) const {
    const IVec3 way = way_to(leaf_.face_starts[face]);
    __int128 sum = 0;
    for (size_t k = 0; k < 3; ++k) sum += static_cast<__int128>(normal[k]) * way[k];
    return sum > 0;
  }

  /// Whether the ray from the centre along the first axis crosses a face that has the centre behind
  /// it; through an edge it crosses one of its faces. (It does not cross one that faces the other
  /// way.) A product is below 2^64.
  [[nodiscard]] bool is_crossed(size_t face, const IVec3& normal) const {
    if (normal[0] <= 0) return false;
    const uint32_t begin = leaf_.face_starts[face], end = leaf_.face_starts[face + 1];
    IVec3 from = way_to(end - 1);
    for (uint32_t c = begin; c < end; ++c) {
      const IVec3 to = way_to(c);
      const auto left =
          static_cast<__int128>(from[1]) * to[2] - static_cast<__int128>(from[2]) * to[1];
      // A ray through an edge is moved a little, so that it crosses the one that runs this way.
      if (left < 0 || (left == 0 && (from[1] != to[1] ? from[1] > to[1] : from[2] > to[2]))) {
        return false;
      }
      from = to;
    }
    return true;
  }

 private:
  static int64_t odd(double x) { return 2 * static_cast<int64_t>(std::floor(x / 2)) + 1; }

  const LeafGeometry& leaf_;
  IVec3 origin_;
  IVec3 centre_{};
};

}  // namespace csgrun
