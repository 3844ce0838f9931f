#include "engine/bsp/cell_arrangement.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/bsp/corner_trace.h"

namespace csgrun {

bool CellArrangement::build(CellGeometry& geometry, const Job& job, const CellBox& box,
                            const CellWalls& walls, const std::vector<Fragment>& polygons,
                            int32_t corner_winding) {
  geometry_ = &geometry;
  walls_ = walls;
  nodes_.clear();
  covering_.clear();
  path_.clear();
  contacts_.clear();
  parts_.clear();
  leaf_count_ = 0;
  root_ = build_node(polygons);
  leaves_.reset(leaf_count_);
  for (const Node& node : nodes_) split_facet(node);
  return label(leaf_at_corner(job, box.lo), corner_winding);
}

int32_t CellArrangement::build_node(std::vector<Fragment> polygons) {
  if (polygons.empty()) return ~static_cast<int32_t>(leaf_count_++);
  const uint32_t plane = polygons[choose_splitter(*geometry_, polygons)].support.index();
  auto [front, back, on] = part_polygons(*geometry_, polygons, plane);
  const auto first_covering = static_cast<uint32_t>(covering_.size());
  covering_.insert(covering_.end(), on.begin(), on.end());
  polygons = {};
  const auto index = static_cast<int32_t>(nodes_.size());
  nodes_.push_back({plane, 0, 0, first_covering,
                    static_cast<uint32_t>(covering_.size()) - first_covering, facet_of(plane)});
  path_.push_back({plane, true});
  const int32_t in_front = build_node(std::move(front));
  path_.back().front = false;
  const int32_t behind = build_node(std::move(back));
  path_.pop_back();
  nodes_[index].front = in_front;
  nodes_[index].back = behind;
  return index;
}

Fragment CellArrangement::facet_of(uint32_t plane) {
  const auto& n = geometry_->planes().approximate(plane);
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::fabs(n[k]) > std::fabs(n[axis])) axis = k;
  }
  // The four walls along the axis bound the plane, the other two and the nodes above cut it.
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const uint32_t u0 = walls_[2 * i], u1 = walls_[2 * i + 1], v0 = walls_[2 * j],
                 v1 = walls_[2 * j + 1];
  std::vector<uint32_t> points, edges;
  const auto corner = [&](uint32_t u, uint32_t v) {
    points.push_back(geometry_->add_point({plane, u, v}));
  };
  if (n[axis] > 0) {
    corner(u0, v0), corner(u1, v0), corner(u1, v1), corner(u0, v1);
    edges = {v0, u1, v1, u0};
  } else {
    corner(u0, v0), corner(u0, v1), corner(u1, v1), corner(u1, v0);
    edges = {u0, v1, u1, v0};
  }
  Fragment f = geometry_->make_fragment(PlaneId(plane, false), points, edges);
  const auto keep = [&](uint32_t cut, bool front) {
    Fragment a, b;
    if (geometry_->split(f, cut, a, b) == Side::kSplit) f = front ? a : b;
  };
  keep(walls_[2 * axis], true);
  keep(walls_[2 * axis + 1], false);
  for (const PathStep& step : path_) keep(step.plane, step.front);
  return f;
}

void CellArrangement::push(int32_t node, const Fragment& f,
                           std::vector<std::pair<Fragment, uint32_t>>& out) {
  while (node >= 0) {
    Fragment front, back;
    const Side side = geometry_->split(f, nodes_[node].plane, front, back);
    if (side == Side::kSplit) {
      push(nodes_[node].front, front, out);
      push(nodes_[node].back, back, out);
      return;
    }
    assert(side != Side::kOn);  // a plane occurs once on each path
    node = side == Side::kFront ? nodes_[node].front : nodes_[node].back;
  }
  out.emplace_back(f, static_cast<uint32_t>(~node));
}

void CellArrangement::split_facet(const Node& node) {
  front_pieces_.clear();
  push(node.front, node.facet, front_pieces_);
  for (const auto& [piece, front] : front_pieces_) {
    back_pieces_.clear();
    push(node.back, piece, back_pieces_);
    for (const auto& [face, back] : back_pieces_) cover(node, {face, front, back});
  }
}

void CellArrangement::cover(const Node& node, const Face& face) {
  pieces_.clear();
  pieces_.push_back({face.fragment});
  for (uint32_t c = node.first_covering; c < node.first_covering + node.covering; ++c) {
    const Fragment& polygon = covering_[c];
    next_pieces_.clear();
    for (const Covered& piece : pieces_) {
      Covered inside = piece;
      bool is_left = true;  // of `inside`
      for (uint32_t e = 0; e < polygon.count && is_left; ++e) {
        const uint32_t edge = geometry_->edges(polygon)[e];
        int inner = 0;  // the side of the edge on which the polygon's other corners are
        for (uint32_t k = 2; k < polygon.count && inner == 0; ++k) {
          inner = geometry_->side(edge, geometry_->corners(polygon)[(e + k) % polygon.count]);
        }
        Fragment front, back;
        const Side side = geometry_->split(inside.fragment, edge, front, back);
        if (side == Side::kSplit) {
          Covered outside = inside;
          outside.fragment = inner > 0 ? back : front;
          next_pieces_.push_back(outside);
          inside.fragment = inner > 0 ? front : back;
        } else if ((side == Side::kFront) != (inner > 0)) {
          next_pieces_.push_back(inside);
          is_left = false;
        }
      }
      if (!is_left) continue;
      const bool up = !polygon.support.flipped();
      inside.winding_step += up ? 1 : -1;
      inside.has_up |= up;
      inside.has_down |= !up;
      inside.fragment.polygon = std::min(inside.fragment.polygon, polygon.polygon);
      next_pieces_.push_back(inside);
    }
    std::swap(pieces_, next_pieces_);
  }
  for (const Covered& piece : pieces_) {
    contacts_.push_back({face.front, face.back, piece.winding_step});
    if (piece.has_up || piece.has_down) {
      parts_.push_back({piece.fragment, face.front, face.back, piece.has_up, piece.has_down});
    } else {
      leaves_.join(face.front, face.back);
    }
  }
}

bool CellArrangement::label(uint32_t corner_leaf, int32_t corner_winding) {
  volume_of_leaf_.assign(leaf_count_, 0);
  uint32_t volumes = 0;
  for (uint32_t leaf = 0; leaf < leaf_count_; ++leaf) {
    const uint32_t root = leaves_.find(leaf);  // not above the leaf
    volume_of_leaf_[leaf] = root == leaf ? volumes++ : volume_of_leaf_[root];
  }
  for (Part& part : parts_) {
    part.front = volume_of_leaf_[part.front];
    part.back = volume_of_leaf_[part.back];
  }
  for (Contact& c : contacts_) {
    c.front = volume_of_leaf_[c.front];
    c.back = volume_of_leaf_[c.back];
  }
  constexpr int32_t kUnset = std::numeric_limits<int32_t>::min();
  windings_.assign(volumes, kUnset);
  windings_[volume_of_leaf_[corner_leaf]] = corner_winding;
  // Few volumes, few rounds: the cell is convex, so contacts join all of them.
  for (bool changed = true; changed;) {
    changed = false;
    for (const Contact& c : contacts_) {
      int32_t &front = windings_[c.front], &back = windings_[c.back];
      if ((front == kUnset) == (back == kUnset)) continue;
      if (back == kUnset) {
        back = front + c.winding_step;
      } else {
        front = back - c.winding_step;
      }
      changed = true;
    }
  }
  for (const Contact& c : contacts_) {
    if (windings_[c.back] != windings_[c.front] + c.winding_step) return false;
  }
  return true;
}

uint32_t CellArrangement::leaf_at_corner(const Job& job, const IVec3& corner) const {
  int32_t node = root_;
  while (node >= 0) {
    const Node& n = nodes_[node];
    const Plane plane = geometry_->planes().plane(n.plane);
    node = side_of_corner(plane, corner, job.prime()) > 0 ? n.front : n.back;
  }
  return static_cast<uint32_t>(~node);
}

uint32_t CellArrangement::volume_below(CellGeometry& geometry, uint32_t point) const {
  int32_t node = root_;
  while (node >= 0) {
    const Node& n = nodes_[node];
    // The first component of a stored plane that is not zero is positive: moved down, a point of
    // the plane is behind it.
    node = geometry.side(n.plane, point) > 0 ? n.front : n.back;
  }
  return volume_of_leaf_[~node];
}

}  // namespace csgrun
