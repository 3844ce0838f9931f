#include "primitives/solids/edge_ends.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "primitives/base/text.h"

namespace csgrun {
namespace {

std::string point_text(const glm::dvec3& p) {
  return "{" + number_text(p.x) + ", " + number_text(p.y) + ", " + number_text(p.z) + "}";
}

}  // namespace

bool is_along_axis(const glm::dvec3& unit) {
  return std::fabs(unit.x) + std::fabs(unit.y) + std::fabs(unit.z) == 1;
}

std::string edge_text(const SolidEdge& edge) {
  return "the edge from " + point_text(edge.from) + " to " + point_text(edge.to);
}

EdgeEnds::EdgeEnds(const Solid& solid, const EdgeFrames& frames, double radius)
    : solid_(solid), frames_(frames), is_fillet_(radius > 0) {
  find_corners(radius);
}

void EdgeEnds::find_corners(double radius) {
  corner_of_.assign(solid_.positions.size(), UINT32_MAX);
  std::vector<std::pair<uint32_t, uint32_t>> ends;
  for (uint32_t i = 0; i < frames_.frames().size(); ++i) {
    for (const uint32_t v : edge(frames_.frames()[i]).vertex) ends.emplace_back(v, i);
  }
  std::sort(ends.begin(), ends.end());
  for (size_t first = 0, last; first < ends.size(); first = last) {
    const uint32_t v = ends[first].first;
    std::vector<uint32_t> at_vertex;
    for (last = first; last < ends.size() && ends[last].first == v; ++last)
      at_vertex.push_back(ends[last].second);
    const size_t count = at_vertex.size();
    if (count < 3 || frames_.graph().degree(v) != count || !is_convex(v, at_vertex)) continue;
    if (count > 3) {
      tips_.push_back({v, std::move(at_vertex)});
      continue;
    }
    EdgeCorner corner{v, {at_vertex[0], at_vertex[1], at_vertex[2]}};
    corner.centre = in_front(corner, -radius);
    corner_of_[v] = static_cast<uint32_t>(corners_.size());
    corners_.push_back(corner);
  }
}

/// Convex edges may still turn inwards in one of the sides.
bool EdgeEnds::is_convex(uint32_t vertex, std::span<const uint32_t> frames) const {
  return std::all_of(frames.begin(), frames.end(), [&](uint32_t k) {
    const EdgeFrame& f = frames_.frames()[k];
    const int end = end_at(f, vertex);
    return frames_.kind(f, end, 0) == EdgeEnd::kMitre && frames_.kind(f, end, 1) == EdgeEnd::kMitre;
  });
}

const EdgeCorner* EdgeEnds::corner_at(const EdgeFrame& f, int end) const {
  const uint32_t place = corner_of_[edge(f).vertex[end]];
  return place == UINT32_MAX ? nullptr : &corners_[place];
}

std::array<glm::dvec3, 3> EdgeEnds::normals_at(const EdgeCorner& corner) const {
  const EdgeGraph::Edge& first = edge(frames_.frames()[corner.frames[0]]);
  const EdgeGraph::Edge& second = edge(frames_.frames()[corner.frames[1]]);
  const int other = second.side[0] == first.side[0] || second.side[0] == first.side[1] ? 1 : 0;
  return {first.line.normals[0], first.line.normals[1], second.line.normals[other]};
}

glm::dvec3 EdgeEnds::in_front(const EdgeCorner& corner, double distance) const {
  const auto n = normals_at(corner);
  const double volume = glm::dot(n[0], glm::cross(n[1], n[2]));
  const glm::dvec3 sum = glm::cross(n[1], n[2]) + glm::cross(n[2], n[0]) + glm::cross(n[0], n[1]);
  return solid_.positions[corner.vertex] + distance / volume * sum;
}

EdgeEnds::Lines EdgeEnds::lines(const EdgeFrame& f) {
  const double a = f.setback, out = f.outwards();
  return {a * f.in[0] + out * (f.in[0] - f.in[1]), a * f.in[1] + out * (f.in[1] - f.in[0]),
          -out * (f.in[0] + f.in[1])};
}

std::array<glm::dvec3, 2> EdgeEnds::meeting_points(const EdgeFrame& f, int end) const {
  std::array<glm::dvec3, 2> points;
  for (int side = 0; side < 2; ++side) {
    points[static_cast<size_t>(side)] =
        f.start + f.setback * f.in[side] + frames_.at_next_cut(f, end, side) * f.along;
  }
  return points;
}

Result<EdgeEnds::PrismEnd> EdgeEnds::end_of(const EdgeFrame& f, int end) const {
  const Lines offsets = lines(f);
  PrismEnd result;
  const double outwards = end == 0 ? -1 : 1;
  // So much farther: within what other cuts take, and beyond the solid.
  const double more = outwards * f.reach, beyond = outwards * f.outwards();
  const auto farther = [&](double a, double b) {
    return end == 0 ? std::min(a, b) : std::max(a, b);
  };
  const auto nearer = [&](double a, double b) {
    return end == 0 ? std::max(a, b) : std::min(a, b);
  };
  if (const EdgeCorner* corner = corner_at(f, end); corner != nullptr && is_fillet_) {
    result.at.fill(glm::dot(corner->centre - f.start, f.along) + more);
    return result;
  }
  const double here = EdgeFrames::at_end(f, end);
  if (is_tip(f, end)) {
    // In the plane between the edge and what is left for the tip, wherever the lines are.
    const glm::dvec3& corner = solid_.positions[edge(f).vertex[end]];
    const auto [left, right] = meeting_points(f, end);
    return end_in_plane(f, end, glm::cross(left - corner, right - corner), more);
  }
  std::array<EdgeEnd, 2> kinds;
  for (int side = 0; side < 2; ++side) kinds[side] = frames_.kind(f, end, side);
  if (kinds[0] == EdgeEnd::kInside || kinds[1] == EdgeEnd::kInside) {
    if (frames_.graph().degree(edge(f).vertex[end]) != 3) {
      return invalid_argument(fmt::format(
          "the cuts of the edges that meet at {} cannot be joined: other edges end there, too",
          point_text(solid_.positions[edge(f).vertex[end]])));
    }
    return end_beyond_mitre(f, end);
  }
  std::optional<double> cap, barrier;
  std::array<double, 2> aslant{};
  for (int side = 0; side < 2; ++side) {
    double& at = result.at[side];
    at = here;
    if (kinds[side] == EdgeEnd::kGoesOn) {
      // Ends that were rounded are not in one plane with those of the next cut.
      const bool is_cut = frames_.frame_of(edge(f).next[end][side]) != nullptr;
      if (is_cut && !frames_.goes_straight_on(f, end, side)) at += more;
      continue;
    }
    if (kinds[side] == EdgeEnd::kMitre) {
      at = frames_.strip_end(f, end, side) + more;
      for (const EdgeFrames::Bend& bend : frames_.bends(f, end, side)) {
        const glm::dvec3 along = more * f.along;
        result.bends.push_back(bend.below + along);
        result.bends.push_back(bend.top + along - f.outwards() * f.in[1 - side]);
      }
    } else {
      at = frames_.at_plane(f, end, side, offsets[side]);
      if (kinds[side] == EdgeEnd::kCap) {
        // Outside of the solid the plane may be met earlier than on the side.
        at = farther(at, frames_.at_plane(f, end, side, f.in[side] * f.setback)) + beyond;
      }
    }
    const double outer = frames_.at_plane(f, end, side, offsets[2]);
    if (kinds[side] == EdgeEnd::kWall) {
      barrier = barrier ? nearer(*barrier, outer) : outer;
    } else {
      cap = cap ? farther(*cap, outer) : outer;
    }
    // The plane of a mitre is farther out there by as much as it is farther in on the side.
    aslant[side] = f.outwards() / f.setback * std::fabs(at - here);
  }
  for (int side = 0; side < 2; ++side) {
    // So it is beyond the other side.
    if (kinds[side] == EdgeEnd::kCap && kinds[1 - side] == EdgeEnd::kMitre) {
      result.at[side] += outwards * aslant[1 - side];
    }
  }
  result.at[2] =
      barrier ? *barrier
              : farther(cap.value_or(here), here) + beyond + outwards * (aslant[0] + aslant[1]);
  return result;
}

EdgeEnds::PrismEnd EdgeEnds::end_in_plane(const EdgeFrame& f, int end, const glm::dvec3& normal,
                                          double more) const {
  const Lines offsets = lines(f);
  PrismEnd result;
  for (size_t k = 0; k < 3; ++k) {
    result.at[k] = EdgeFrames::at_end(f, end) -
                   glm::dot(normal, offsets[k]) / glm::dot(normal, f.along) + more;
  }
  return result;
}

EdgeEnds::PrismEnd EdgeEnds::end_beyond_mitre(const EdgeFrame& f, int end) const {
  const int side = frames_.kind(f, end, 0) == EdgeEnd::kInside ? 0 : 1;
  const Mitre mitre = mitre_at(f, end, side);
  const double more = (end == 0 ? -kBeyondMitres : kBeyondMitres) * f.reach;
  PrismEnd result = end_in_plane(f, end, mitre.normal, more);
  result.wall = mitre;
  return result;
}

Mitre EdgeEnds::mitre_at(const EdgeFrame& f, int end, int side) const {
  const uint32_t vertex = edge(f).vertex[end];
  Mitre result;
  result.corner = solid_.positions[vertex];
  const double at = frames_.at_next_cut(f, end, side), here = EdgeFrames::at_end(f, end);
  const glm::dvec3 inwards = (at - here) * f.along + f.setback * f.in[side];
  const EdgeGraph::Edge& third = frames_.graph().edges()[edge(f).next[end][1 - side]];
  result.normal = glm::normalize(glm::cross(inwards, third.line.to - third.line.from));
  if (glm::dot(result.normal, f.along) * (end == 0 ? -1 : 1) < 0) result.normal = -result.normal;
  const glm::dvec3& down = f.in[static_cast<size_t>(1 - side)];
  const double below = frames_.at_plane(f, end, 1 - side, down * f.setback) - here;
  result.reach =
      1.25 * std::max(glm::length(inwards), glm::length(below * f.along + f.setback * down));
  result.gap = f.reach / 4 * std::fabs(glm::dot(result.normal, f.along));
  return result;
}

bool EdgeEnds::can_be_flush(const EdgeFrame& f) const {
  for (const glm::dvec3& n : edge(f).line.normals) {
    if (!is_along_axis(n)) return false;
  }
  for (int end = 0; end < 2; ++end) {
    for (int side = 0; side < 2; ++side) {
      if (frames_.kind(f, end, side) != EdgeEnd::kGoesOn &&
          !is_along_axis(frames_.plane_normal(f, end, side))) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace csgrun
