// Half-edges of a triangle mesh: which edge is glued to which.
//
// Half-edge 3t+i runs from corner i of triangle t to corner i+1 and also names corner i. `twin` is
// the half-edge on the other side of the edge. Going from a half-edge to the twin of the one before
// it in its triangle turns counter-clockwise around its first vertex; the corners met on one such
// turn are a fan. A mesh is a manifold by index when every directed edge occurs once, its reverse
// occurs once, and every vertex has one fan.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <csgrun/engine/error.h>

namespace csgrun {

using Triangle = std::array<uint32_t, 3>;

constexpr uint32_t next_in_triangle(uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
constexpr uint32_t previous_in_triangle(uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

/// The twin of every half-edge of a manifold by index, or an Error kInternal that names the first
/// place where the mesh is not one. `vertex_count` bounds the indices; vertices without triangles
/// are allowed. O(n log d) for vertices of degree d.
Result<std::vector<uint32_t>> manifold_twins(std::span<const Triangle> triangles,
                                             size_t vertex_count);

/// The connected surface that each triangle belongs to, numbered in the order of their first ones.
std::vector<uint32_t> shells_of(std::span<const uint32_t> twins);

}  // namespace csgrun
