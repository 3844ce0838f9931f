// The extent of the vertices of a leaf, and the form of its faces.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// Whether coordinates are less than 2^30 apart: normals of three points fit 62 bits.
inline bool is_compact(const GridBox& box) {
  bool all = true;
  for (size_t k = 0; k < 3; ++k) all = all && box.hi[k] - box.lo[k] < int64_t{1} << 30;
  return all;
}

/// Calls `visit(face_of)` with a function from an edge, by the corner that it leaves, to its face.
template <class Visit>
auto with_face_of(const LeafGeometry& leaf, Visit visit) {
  if (leaf.consists_of_triangles()) return visit([](uint32_t edge) { return edge / 3; });
  std::vector<uint32_t> face(leaf.corners.size());
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    std::fill(face.begin() + leaf.face_starts[f], face.begin() + leaf.face_starts[f + 1], f);
  }
  return visit([&](uint32_t edge) { return face[edge]; });
}

}  // namespace csgrun
