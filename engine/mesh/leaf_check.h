// Checks of quantised leaves: self-intersections, exactly.
#pragma once

#include <optional>

#include "engine/bsp/operand.h"

namespace csgrun {

/// The first place (in face order) where two faces of a leaf meet other than in a shared edge or
/// vertex: the faces, and a point near the place in grid steps.
struct SelfIntersection {
  uint32_t face_a = 0, face_b = 0;
  std::array<double, 3> place{};
  uint64_t count = 0;  ///< how many pairs in all
};

/// Exact test of all pairs that are near each other (spatial hashing with exact triangle tests,
/// Campen & Kobbelt 2010, section 6.2). Touching counts: overlapping coplanar faces, an edge that
/// pierces or rests on a face, vertices of one face inside another. Faces that meet only where they
/// share vertices or edges by coordinates do not count. Nothing found: std::nullopt. O(n log n) for
/// meshes of even resolution.
std::optional<SelfIntersection> find_self_intersection(const LeafGeometry& leaf);

}  // namespace csgrun
