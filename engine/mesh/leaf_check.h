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
  /// How many pairs in all; the search ends with the first face that brings it to this bound.
  uint64_t count = 0;
  static constexpr uint64_t kMaxCount = 1'000'000;
};

/// Exact test of all pairs that are near each other (a tree of boxes, then exact tests;
/// Campen & Kobbelt 2010, section 6.2). Touching counts: overlapping coplanar faces, an edge that
/// pierces or rests on a face, vertices of one face inside another. Faces that meet only where they
/// share vertices or edges by coordinates do not count. Nothing found: std::nullopt. The cost is
/// O(n log n) and that of the pairs whose bounding boxes meet.
std::optional<SelfIntersection> find_self_intersection(const LeafGeometry& leaf);

}  // namespace csgrun
