#include "export/edge_flips.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

#include <csgrun/engine/exact_triangles.h>

#include "export/edge_turn.h"
#include "export/half_edges.h"

namespace csgrun {
namespace {

class EdgeTurner {
 public:
  EdgeTurner(RoundedMesh& mesh, std::span<const glm::dvec3> directions)
      : mesh_(mesh), directions_(directions) {}

  bool turn_longest_edge(uint32_t triangle) { return turn(longest_edge(triangle)); }

  /// How high the triangle is, if it is a cap less than `width` high.
  [[nodiscard]] std::optional<double> cap_height(uint32_t triangle, double width) const {
    const uint32_t h = longest_edge(triangle);
    const glm::dvec3 &a = at(h), &b = at(next_in_triangle(h)), &c = at(previous_in_triangle(h));
    const double height = glm::length(glm::cross(b - a, c - a)) / glm::distance(a, b);
    const bool is_cap =
        height < width && glm::distance(a, c) >= width && glm::distance(b, c) >= width;
    return is_cap ? std::optional(height) : std::nullopt;
  }

  /// A cap, and before it those beyond its longest edge.
  void turn_caps(uint32_t triangle, double width, Turned& turned) {
    tried_.resize(mesh_.triangles.size());
    path_.assign(1, triangle);
    tried_[triangle] = true;
    double moved = 0;
    while (!path_.empty()) {
      const uint32_t t = path_.back(), beyond = mesh_.twins[longest_edge(t)] / 3;
      if (!tried_[beyond] && cap_height(beyond, width)) {
        tried_[beyond] = true;
        path_.push_back(beyond);
        continue;
      }
      path_.pop_back();
      // What was turned beyond it may have been its own edge.
      const std::optional<double> height = cap_height(t, width);
      if (!height || !turn_longest_edge(t)) continue;
      ++turned.count;
      // The surface near a fan's first corners moves with each cap that is turned.
      moved += *height;
      turned.farthest = std::max(turned.farthest, moved);
    }
  }
  [[nodiscard]] bool is_tried(uint32_t triangle) const {
    return triangle < tried_.size() && tried_[triangle];
  }

 private:
  [[nodiscard]] uint32_t longest_edge(uint32_t triangle) const {
    uint32_t longest = 3 * triangle;
    for (uint32_t h = longest + 1; h < 3 * triangle + 3; ++h) {
      if (squared_length(h) > squared_length(longest)) longest = h;
    }
    return longest;
  }

  [[nodiscard]] uint32_t from(uint32_t h) const { return mesh_.triangles[h / 3][h % 3]; }

  /// The corner that a half-edge starts at.
  [[nodiscard]] const glm::dvec3& at(uint32_t h) const { return mesh_.positions[from(h)]; }

  [[nodiscard]] double squared_length(uint32_t h) const {
    const glm::dvec3 d = at(next_in_triangle(h)) - at(h);
    return d.x * d.x + d.y * d.y + d.z * d.z;
  }

  /// Whether the triangle would have area and look to the side that its face does.
  [[nodiscard]] bool is_good(const Triangle& triangle, uint32_t face) const {
    const TriangleView view{mesh_.positions, std::span(&triangle, 1)};
    return facing(view, 0, directions_[face]) > 0;
  }

  bool turn(uint32_t h) {
    const std::optional<EdgeTurn> to = edge_turn(mesh_, h);
    if (!to) return false;
    const uint32_t face = mesh_.triangle_face[to->u];
    if (!is_good(to->first, face) || !is_good(to->second, face)) return false;
    mesh_.triangles[to->t] = to->first;
    mesh_.triangles[to->u] = to->second;
    mesh_.triangle_face[to->t] = face;
    to->glue_all([&](uint32_t g, uint32_t k) {
      mesh_.twins[g] = k;
      mesh_.twins[k] = g;
    });
    return true;
  }

  RoundedMesh& mesh_;
  std::span<const glm::dvec3> directions_;
  std::vector<uint32_t> path_;  ///< of caps, each beyond the longest edge of the one before
  std::vector<bool> tried_;     ///< per triangle
};

}  // namespace

uint64_t turn_longest_edges(RoundedMesh& mesh, std::span<const uint32_t> triangles,
                            std::span<const glm::dvec3> directions) {
  EdgeTurner turner(mesh, directions);
  uint64_t turned = 0;
  for (const uint32_t t : triangles) {
    // An earlier turn may have mended it.
    const TriangleView view{mesh.positions, mesh.triangles};
    if (facing(view, t, directions[mesh.triangle_face[t]]) > 0) continue;
    if (turner.turn_longest_edge(t)) ++turned;
  }
  return turned;
}

Turned turn_caps(RoundedMesh& mesh, std::span<const uint32_t> triangles, double width,
                 std::span<const glm::dvec3> directions) {
  EdgeTurner turner(mesh, directions);
  Turned turned;
  for (const uint32_t t : triangles) {
    if (!turner.is_tried(t) && turner.cap_height(t, width)) turner.turn_caps(t, width, turned);
  }
  return turned;
}

}  // namespace csgrun
