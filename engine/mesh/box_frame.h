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

#include "engine/base/vec3d.h"
#include "engine/bsp/operand.h"
#include "engine/bsp/packed_boxes.h"
#include "engine/mesh/box_tree.h"

namespace csgrun {

/// Three perpendicular directions of length 1, up to rounding.
using BoxFrame = std::array<std::array<double, 3>, 3>;

/// The normal of much of the surface and the direction of long edges there, if boxes along them are
/// much smaller than along the axes. Looks at a sample of the faces, each given by three corners,
/// for which so many are enough: O(n).
std::optional<BoxFrame> find_box_frame(std::span<const std::array<Vec3d, 3>> sample);
constexpr size_t kFrameSample = 512;
/// The same for a leaf: O(1).
std::optional<BoxFrame> find_box_frame(const LeafGeometry& leaf);

/// The box along a frame that holds points whose coordinates are at most `reach`, and what rounding
/// to doubles may have moved them.
Box box_along(const BoxFrame& frame, std::span<const Vec3d> points, double reach);

/// A box for each face, or each of some, along the axes or those of the frame, so that the boxes of
/// faces that have a point in common overlap. O(n).
std::vector<FloatBox> face_boxes(const LeafGeometry& leaf, const std::optional<BoxFrame>& frame);
std::vector<FloatBox> face_boxes(const LeafGeometry& leaf, std::span<const uint32_t> faces,
                                 const std::optional<BoxFrame>& frame);

/// Whether many of the faces are long triangles: many times as long as they are high over their
/// longest side. Looks at a sample of the triangles, or of the leaf: O(1).
bool has_long_triangles(std::span<const std::array<Vec3d, 3>> sample);
bool has_long_triangles(const LeafGeometry& leaf);

/// For each face what it takes up along the diagonals x + y, y + z, z + x, and x - y, y - z, z - x:
/// long triangles side by side, aslant to the axes, are apart along one of them mostly. O(n).
/// REQUIRES: coordinates are below 2^62 in magnitude.
std::array<std::vector<FloatBox>, 2> face_diagonals(const LeafGeometry& leaf);

}  // namespace csgrun
