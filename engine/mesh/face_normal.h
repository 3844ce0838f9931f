// Normals of faces in whole numbers.
#pragma once

#include <cstdint>

#include "engine/bsp/operand.h"

namespace csgrun {

constexpr IVec3 difference(const IVec3& a, const IVec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
constexpr IVec3 cross(const IVec3& a, const IVec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Twice the vector area of the convex face of the corners from `begin` to `end`. REQUIRES: the
/// leaf is compact (leaf_shape.h): as the area stays within its box, it fits 62 bits.
inline IVec3 face_normal(const LeafGeometry& leaf, uint32_t begin, uint32_t end) {
  const IVec3& origin = leaf.vertices[leaf.corners[begin]];
  IVec3 to_next = difference(leaf.vertices[leaf.corners[begin + 1]], origin), normal{0, 0, 0};
  for (uint32_t c = begin + 2; c < end; ++c) {
    const IVec3 from = to_next;
    to_next = difference(leaf.vertices[leaf.corners[c]], origin);
    const IVec3 part = cross(from, to_next);
    for (size_t k = 0; k < 3; ++k) normal[k] += part[k];
  }
  return normal;
}

}  // namespace csgrun
