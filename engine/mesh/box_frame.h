// Directions along which the faces of a leaf have small boxes.
//
// The long triangles of a flat side lie side by side, but their boxes do not where the side is
// aslant: a part that was turned before it was written has many times as many boxes that overlap.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/bsp/operand.h"
#include "engine/mesh/packed_boxes.h"

namespace csgrun {

/// Three perpendicular directions of length 1, up to rounding.
using BoxFrame = std::array<std::array<double, 3>, 3>;

/// The normal of much of the surface and the direction of long edges there, if boxes along them are
/// much smaller than along the axes.
/// Looks at a sample of the faces: O(1).
std::optional<BoxFrame> find_box_frame(const LeafGeometry& leaf);

/// A box for each face, or each of some, along the axes or those of the frame, so that the boxes of
/// faces that have a point in common overlap. O(n).
std::vector<FloatBox> face_boxes(const LeafGeometry& leaf, const std::optional<BoxFrame>& frame);
std::vector<FloatBox> face_boxes(const LeafGeometry& leaf, std::span<const uint32_t> faces,
                                 const std::optional<BoxFrame>& frame);

}  // namespace csgrun
