#include "primitives/solids/edge_graph.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include <glm/geometric.hpp>

#include <csgrun/primitives/trig.h>

#include "primitives/base/none.h"

namespace csgrun {
namespace {

/// Edges are short that have this part of the largest coordinate: some steps of the grid, which has
/// 2^24 to 2^27 to that unless it was asked for.
constexpr double kShort = 0x1p-22;

auto as_tuple(const glm::dvec3& p) { return std::tie(p.x, p.y, p.z); }

bool is_short(const SolidEdge& line, double least) {
  return glm::length(line.to - line.from) < least;
}

}  // namespace

EdgeGraph::EdgeGraph(const Solid& solid, double grid_step_mm)
    : solid_(solid), grid_step_(grid_step_mm) {
  for (const glm::dvec3& p : solid.positions) {
    for (int i = 0; i < 3; ++i) scale_ = std::max(scale_, std::fabs(p[i]));
  }
  find_twins();
  sides_ = flat_sides(solid, twin_, grid_step_mm);
  edges_of_.resize(sides_.face.size());
  find_lines();
}

void EdgeGraph::find_twins() {
  const size_t halves = solid_.triangles.size() * 3;
  twin_.assign(halves, kNone);
  std::unordered_map<uint64_t, uint32_t> half_at;
  half_at.reserve(halves);
  for (uint32_t h = 0; h < halves; ++h) {
    const uint64_t a = from(h), b = to(h);
    half_at[a << 32 | b] = h;
    const auto found = half_at.find(b << 32 | a);
    if (found == half_at.end()) continue;
    twin_[h] = found->second;
    twin_[found->second] = h;
  }
}

uint32_t EdgeGraph::following(uint32_t half) const {
  uint32_t h = around(half);
  while (!is_boundary(h)) h = around(twin_[h]);
  return h;
}

glm::dvec3 EdgeGraph::normal_at(uint32_t half) const {
  const auto& rough = sides_.normal[side_at(half)];
  return rough ? *rough : glm::normalize(solid_.face_normals[solid_.triangle_face[half / 3]]);
}

double EdgeGraph::roughness_of(uint32_t half) const {
  const double rounding = 1e-14 * scale_;
  if (!sides_.normal[side_at(half)] && !sides_.normal[side_at(twin_[half])]) return rounding;
  // Two slabs have this in common, the more the less they are turned to one another.
  const double sine = glm::length(glm::cross(normal_at(half), normal_at(twin_[half])));
  return std::max(rounding, 2 * sides_.roughness / std::max(sine, 0.1));
}

bool EdgeGraph::goes_straight_on(uint32_t half, uint32_t next) const {
  if (side_at(twin_[half]) != side_at(twin_[next])) return false;
  if (following(twin_[next]) != twin_[half]) return false;
  const glm::dvec3 &a = solid_.positions[from(half)], &b = solid_.positions[to(half)],
                   &c = solid_.positions[to(next)];
  const glm::dvec3 along = c - a;
  const double length = glm::length(along);
  // Between the ends of what is straight, up to the rounding of the three.
  return glm::dot(b - a, along) > 0 && glm::dot(c - b, along) > 0 &&
         glm::length(glm::cross(b - a, along)) <= roughness_of(half) * length;
}

void EdgeGraph::find_lines() {
  const auto halves = static_cast<uint32_t>(twin_.size());
  edge_of_.assign(halves, kNone);
  std::vector<uint32_t> previous(halves, kNone), line;
  for (uint32_t h = 0; h < halves; ++h) {
    if (is_boundary(h)) previous[following(h)] = h;
  }
  for (uint32_t h = 0; h < halves; ++h) {
    if (previous[h] == kNone || edge_of_[h] != kNone) continue;
    if (goes_straight_on(previous[h], h)) continue;  // a straight loop there is not
    line.assign(1, h);
    for (uint32_t next = following(h); goes_straight_on(line.back(), next); next = following(next))
      line.push_back(next);
    const glm::dvec3 &a = solid_.positions[from(h)], &b = solid_.positions[to(line.back())];
    // Of its two sides one makes it.
    if (as_tuple(b) < as_tuple(a) || (a == b && twin_[line.back()] < h)) continue;
    add_line(h, line);
  }
  for (Edge& e : edges_) {
    for (auto& end : e.next) {
      for (uint32_t& next : end) next = edge_of_[next];
    }
  }
  contract_short_edges();
  sort_edges();
  degree_.assign(solid_.positions.size(), 0);
  for (uint32_t i = 0; i < edges_.size(); ++i) {
    for (const uint32_t side : edges_[i].side) edges_of_[side].push_back(i);
    for (const uint32_t v : edges_[i].vertex) ++degree_[v];
  }
}

uint32_t EdgeGraph::united(uint32_t v) const {
  while (united_with_[v] != v) v = united_with_[v];
  return v;
}

void EdgeGraph::unite(uint32_t v, uint32_t w) {
  v = united(v), w = united(w);
  united_with_[std::max(v, w)] = std::min(v, w);
}

/// Where sides meet in a point by the user's numbers, their planes on the grid miss one another by
/// a step or so, and leave edges that have no direction to go by.
void EdgeGraph::contract_short_edges() {
  united_with_.resize(solid_.positions.size());
  std::iota(united_with_.begin(), united_with_.end(), 0u);
  const double least = kShort * scale_;
  for (uint32_t i = 0; i < edges_.size(); ++i) {
    const Edge& e = edges_[i];
    if (!is_short(e.line, least)) continue;
    for (int side = 0; side < 2; ++side) close_gap(i, side);
    unite(e.vertex[0], e.vertex[1]);
  }
}

/// Has what comes before and after an edge on one of its sides follow each other.
void EdgeGraph::close_gap(uint32_t edge, int side) {
  const Edge& e = edges_[edge];
  const uint32_t before = e.next[0][side], after = e.next[1][side];
  if (before == edge) return;  // the last one of a side that vanishes
  relink(before, edge, e.side[side], after);
  relink(after, edge, e.side[side], before);  // nothing is left of them if both are one
}

/// Where an edge has another one for the next on a side, at one end or both, it gets a third.
void EdgeGraph::relink(uint32_t of, uint32_t edge, uint32_t side, uint32_t to) {
  for (size_t own_end = 0; own_end < 2; ++own_end) {
    for (size_t own_side = 0; own_side < 2; ++own_side) {
      uint32_t& link = edges_[of].next[own_end][own_side];
      if (link == edge && edges_[of].side[own_side] == side) link = to;
    }
  }
}

/// By their ends, without those that are short.
void EdgeGraph::sort_edges() {
  const double least = kShort * scale_;
  std::vector<uint32_t> order, place(edges_.size(), kNone);
  for (uint32_t i = 0; i < edges_.size(); ++i) {
    if (!is_short(edges_[i].line, least)) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](uint32_t i, uint32_t k) {
    const Edge &a = edges_[i], &b = edges_[k];
    return std::tuple(as_tuple(a.line.from), as_tuple(a.line.to), a.vertex) <
           std::tuple(as_tuple(b.line.from), as_tuple(b.line.to), b.vertex);
  });
  std::vector<Edge> sorted;
  for (uint32_t i = 0; i < order.size(); ++i) {
    place[order[i]] = i;
    sorted.push_back(edges_[order[i]]);
  }
  for (Edge& e : sorted) {
    for (uint32_t& v : e.vertex) v = united(v);
    for (auto& end : e.next) {
      for (uint32_t& next : end) next = place[next];
    }
  }
  edges_ = std::move(sorted);
}

void EdgeGraph::add_line(uint32_t first, std::span<const uint32_t> halves) {
  const uint32_t last = halves.back();
  Edge e;
  e.vertex = {from(first), to(last)};
  e.line.from = solid_.positions[e.vertex[0]];
  e.line.to = solid_.positions[e.vertex[1]];
  e.side = {side_at(first), side_at(twin_[first])};
  const std::array<uint32_t, 2> face{solid_.triangle_face[first / 3],
                                     solid_.triangle_face[twin_[first] / 3]};
  e.line.normals = {normal_at(first), normal_at(twin_[first])};
  const glm::dvec3 across = glm::cross(e.line.normals[0], e.line.normals[1]);
  e.line.turn = atan2_deg(glm::length(across), glm::dot(e.line.normals[0], e.line.normals[1]));
  e.line.is_convex = glm::dot(across, e.line.to - e.line.from) > 0;
  const Solid::Face &f = solid_.faces[face[0]], &g = solid_.faces[face[1]];
  const auto is_of = [&](const char* kind) {
    return solid_.sources[f.source].kind == kind && solid_.sources[g.source].kind == kind;
  };
  // The facets at the poles of a round sphere are flat, but no faces of their own.
  const bool is_of_ball = f.source == g.source && (f.surface != 0 || g.surface != 0) &&
                          (is_of("sphere") || is_of("ellipsoid"));
  e.line.is_smooth = (f.surface != 0 && f.surface == g.surface) || is_of_ball || is_of("fillet");
  // What the sides have before and after it, as half-edges for now. The right side runs it back.
  const auto before = [&](uint32_t half) {
    // The one that comes to the start of `half`: round that corner, against its triangles' order.
    uint32_t h = around(around(half));
    while (!is_boundary(h)) h = around(around(twin_[h]));
    return h;
  };
  e.next[1] = {following(last), before(twin_[last])};
  e.next[0] = {before(first), following(twin_[first])};
  const auto id = static_cast<uint32_t>(edges_.size());
  for (const uint32_t h : halves) edge_of_[h] = edge_of_[twin_[h]] = id;
  edges_.push_back(e);
}

std::vector<SolidEdge> edges_of_solid(const Solid& solid, double grid_step_mm) {
  const EdgeGraph graph(solid, grid_step_mm);
  std::vector<SolidEdge> result;
  for (const EdgeGraph::Edge& e : graph.edges()) result.push_back(e.line);
  return result;
}

}  // namespace csgrun
