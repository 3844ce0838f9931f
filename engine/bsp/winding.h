// Winding numbers in front of faces of a closed surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/bsp/operand.h"
#include "engine/bsp/packed_boxes.h"

namespace csgrun {

/// For so many rays, each of which looks at all faces, a tree does not pay.
constexpr size_t kFewRays = 8;

/// How often the surface of a leaf wraps around a point just in front of `face`, near the middle of
/// the face. Exact: a ray to infinity, moved off every edge by infinitesimals. `tree` holds the
/// boxes of the faces, rounded; without one every face is looked at, which takes less time than to
/// make one. REQUIRES: closed, no other face meets the inside of this one.
int winding_in_front(const LeafGeometry& leaf, const PackedBoxes* tree, uint32_t face);

}  // namespace csgrun
