#include "primitives/solids/edge_frames.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include <csgrun/primitives/trig.h>

namespace csgrun {
namespace {

/// Directions are good to this.
constexpr double kParallel = 1e-9;
/// Three points on a line are rounded, each by sqrt(3) / 2 grid steps at most: the middle one is up
/// to twice that off the line through the others, and two edges have so much of a bend for their
/// lengths together. Where they are so short that this is no small angle it is a corner.
constexpr double kLineSteps = 2, kMostBend = 1e-3;

}  // namespace

EdgeFrames::EdgeFrames(const EdgeGraph& graph, std::span<const uint32_t> chosen)
    : graph_(graph), number_(graph.edges().size(), UINT32_MAX) {
  for (const uint32_t e : chosen) {
    if (number_[e] != UINT32_MAX) continue;
    number_[e] = static_cast<uint32_t>(frames_.size());
    const SolidEdge& line = graph.edges()[e].line;
    EdgeFrame& f = frames_.emplace_back();
    f.edge = e;
    f.start = line.from;
    f.length = glm::length(line.to - line.from);
    f.along = (line.to - line.from) / f.length;
    f.in = {glm::normalize(glm::cross(line.normals[0], f.along)),
            glm::normalize(glm::cross(f.along, line.normals[1]))};
  }
  for (const EdgeFrame& f : frames_) {
    auto& own = around_.emplace_back();
    for (size_t end = 0; end < 2; ++end) {
      for (size_t side = 0; side < 2; ++side)
        own[end][side] = around(f, static_cast<int>(end), static_cast<int>(side));
    }
  }
}

void EdgeFrames::set_size(double size, bool is_radius) {
  for (EdgeFrame& f : frames_) {
    f.setback = is_radius ? size * tan_deg(graph_.edges()[f.edge].line.turn / 2) : size;
  }
  find_turned_over();
}

EdgeFrames::Next EdgeFrames::next(const EdgeFrame& f, int end, int side) const {
  const EdgeGraph::Edge& own = graph_.edges()[f.edge];
  const uint32_t id = own.next[end][side];
  const EdgeGraph::Edge& other = graph_.edges()[id];
  const uint32_t vertex = own.vertex[end];
  glm::dvec3 away = other.line.to - other.line.from;
  if (other.vertex[0] != vertex) away = -away;
  away /= glm::length(away);
  const double towards = end == 0 ? 1 : -1;  // back along the edge
  return {id, glm::dot(away, f.along) * towards, glm::dot(away, f.in[side])};
}

double EdgeFrames::most_bend(const EdgeFrame& f, const Next& n) const {
  if (n.x > 0) return kParallel;  // it runs back
  const SolidEdge& other = graph_.edges()[n.edge].line;
  const double steps = kLineSteps * graph_.grid_step();
  return std::clamp(steps / f.length + steps / glm::length(other.to - other.from), kParallel,
                    kMostBend);
}

EdgeEnd EdgeFrames::kind(const EdgeFrame& f, int end, int side) const {
  const Next n = next(f, end, side);
  if (std::fabs(n.y) <= most_bend(f, n)) return EdgeEnd::kGoesOn;
  if (frame_of(n.edge) != nullptr) return n.y > 0 ? EdgeEnd::kMitre : EdgeEnd::kInside;
  const double outwards = end == 0 ? -1 : 1;
  return glm::dot(plane_normal(f, end, side), f.along) * outwards > 0 ? EdgeEnd::kCap
                                                                      : EdgeEnd::kWall;
}

bool EdgeFrames::goes_straight_on(const EdgeFrame& f, int end, int side) const {
  return std::fabs(next(f, end, side).y) <= kParallel;
}

glm::dvec3 EdgeFrames::plane_normal(const EdgeFrame& f, int end, int side) const {
  const EdgeGraph::Edge& own = graph_.edges()[f.edge];
  const EdgeGraph::Edge& other = graph_.edges()[own.next[end][side]];
  const size_t beyond = other.side[0] == own.side[side] ? 1 : 0;
  const glm::dvec3& normal = other.line.normals[beyond];
  if (graph_.roughness(own.side[side]) == 0 && graph_.roughness(other.side[beyond]) == 0)
    return normal;
  // Through the next edge as this side has it: where planes that turn little were to meet,
  // rounding moves the line far along both.
  const Next n = next(f, end, side);
  const glm::dvec3 away = (end == 0 ? n.x : -n.x) * f.along + n.y * f.in[side];
  return glm::normalize(normal - glm::dot(normal, away) / glm::dot(away, away) * away);
}

double EdgeFrames::at_plane(const EdgeFrame& f, int end, int side, const glm::dvec3& offset) const {
  const glm::dvec3 normal = plane_normal(f, end, side);
  const double slope = glm::dot(normal, f.along);
  if (std::fabs(slope) <= kParallel) return at_end(f, end);
  return at_end(f, end) - glm::dot(normal, offset) / slope;
}

double EdgeFrames::at_next_cut(const EdgeFrame& f, int end, int side) const {
  const Next n = next(f, end, side);
  // At y = setback, and as far from the next edge as its own cut goes.
  const double x = (frame_of(n.edge)->setback + f.setback * n.x) / n.y;
  return end == 0 ? x : f.length - x;
}

}  // namespace csgrun
