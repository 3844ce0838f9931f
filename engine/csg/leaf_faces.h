// The faces of a leaf on integer points: what collapses is dropped, what is not planar and convex
// is triangulated, so that the surface stays closed and every face has one exact plane.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/bsp/operand.h"
#include "engine/mesh/loop_faces.h"

namespace csgrun {

/// Turns faces over integer vertices (distinct, |coordinate| <= 2^40) into planar convex polygons.
/// Directed edges stay balanced: a face that collapses to a segment goes by splitting the edges
/// of its neighbours at its inner vertices. Diagonals lie inside faces. `prefer_convex` chooses the
/// diagonal of a bent quadrilateral that bulges outwards; `merged` says that points became one
/// vertex, so that faces may lie on each other's back. False when the loops of a face cross in
/// every projection: it became fans, which keep the surface closed but may lie far outside the
/// face.
bool make_convex_faces(const std::vector<IVec3>& vertices, bool prefer_convex, bool merged,
                       std::vector<LoopFace>& faces);

/// Triangles over the corners of a face, with its loops as their boundary; none when the loops
/// cross in every projection along an axis.
std::vector<std::array<uint32_t, 3>> triangulate(const std::vector<IVec3>& vertices,
                                                 const LoopFace& face);

using BulgingTriangles = std::array<std::array<uint32_t, 3>, 2>;
/// What make_convex_faces makes of a quadrilateral that is not planar and should bulge outwards, if
/// that is told by one look along the axis which it faces most.
std::optional<BulgingTriangles> split_bent_quad(const std::vector<IVec3>& vertices,
                                                std::span<const uint32_t> quad);

/// Whether a loop lies in a plane, turns left or goes straight everywhere as seen from its front,
/// and goes around once.
bool is_convex_polygon(const std::vector<IVec3>& vertices, std::span<const uint32_t> loop);

/// The normal (b - a) x (c - a) of the first three corners that are not collinear, and the corners;
/// false when there are none. |component| < 2^83.
struct CornerPlane {
  std::array<__int128, 3> normal{};
  IVec3 point{};
  /// Sign of a point against the plane: +1 in front.
  [[nodiscard]] int side(const IVec3& p) const;
};
bool corner_plane(const std::vector<IVec3>& vertices, const uint32_t* corners, size_t count,
                  CornerPlane& plane);

}  // namespace csgrun
