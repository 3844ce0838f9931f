#include "engine/bsp/touch_finder.h"

#include <algorithm>
#include <utility>

#include "engine/base/counting_order.h"
#include "engine/base/parallel.h"
#include "engine/bsp/cut_polygon.h"
#include "engine/bsp/piece_tree.h"
#include "engine/bsp/rounded_box.h"

namespace csgrun {

uint32_t TouchFinder::number(uint32_t point) {
  return may_be_met(point) ? index_.unique(point) : point;
}

void TouchFinder::examine(uint32_t point) {
  if (!may_be_met(point)) return;
  is_examined_.resize(geometry_.point_count(), 0);
  is_examined_[number(point)] = 1;
  has_examined_ = true;
}

/// Those corners of an outline that may be at points to be examined: by points as they are, if not
/// all of them have numbers yet.
void TouchFinder::list_corners(const Outline& outline, std::vector<Corner>& corners) const {
  const std::span<const uint32_t> points = outline.points, planes = outline.planes;
  const size_t count = points.size();
  for (size_t i = 0; i < count; ++i) {
    // Points that are made of three planes by chance have other numbers elsewhere, but nothing
    // that is examined is there, unless it is in the index.
    const bool is_made = geometry_.point(points[i]).vertex == kNone;
    uint32_t at = number_or_none(points[i]);
    if (is_made && at == kNone) at = points[i];
    if (at != kNone && !is_examined_[at]) continue;
    const size_t last = i > 0 ? i - 1 : count - 1, next = i + 1 < count ? i + 1 : 0,
                 edge = outline.flip ? last : i;
    Corner corner{number_or_none(points[last]),
                  at,
                  number_or_none(points[next]),
                  outline.polygon,
                  planes.empty() ? CutLoops::kOwnEdge | static_cast<uint32_t>(edge) : planes[edge],
                  planes.empty()};
    if (corner.before == kNone || at == kNone || corner.after == kNone) {
      corner.before = points[last], corner.at = points[i], corner.after = points[next];
      corner.is_numbered = false;
    }
    if (outline.flip) std::swap(corner.before, corner.after);
    corners.push_back(corner);
  }
}

void TouchFinder::add_corners(std::span<const Corner> corners) {
  corners_.reserve(corners_.size() + corners.size());
  for (Corner c : corners) {
    if (!c.is_numbered) {
      if (geometry_.point(c.at).vertex != kNone) c.at = number(c.at);
      if (!is_examined_[c.at]) continue;
      c.before = number(c.before);
      c.after = number(c.after);
    }
    corners_.push_back(c);
  }
}

bool TouchFinder::add_on_edge(uint32_t polygon, uint32_t point, bool flip) {
  const JobPolygon& p = job_.polygons()[polygon];
  for (uint32_t e = 0; e < p.count; ++e) {
    const auto corners = job_.corners(p);
    const uint32_t a = geometry_.vertex_point(corners[e]),
                   b = geometry_.vertex_point(corners[e + 1 < p.count ? e + 1 : 0]);
    if (geometry_.side(job_.edge_plane(polygon, e), point) != 0) continue;
    const LineAxis way = geometry_.axis_between(a, b);
    if (geometry_.compare_along(point, a, way.axis) * way.sign < 0 ||
        geometry_.compare_along(b, point, way.axis) * way.sign < 0) {
      continue;
    }
    corners_.push_back({number(flip ? b : a), number(point), number(flip ? a : b), polygon,
                        CutLoops::kOwnEdge | e, true});
    examine(point);
    return true;
  }
  return false;
}

/// Whether the edge after a corner starts towards a point that it does not end in. Edges of one
/// line may be broken elsewhere on the other side.
bool TouchFinder::leads_to(const Corner& corner, uint32_t point) {
  job_.ensure_support(corner.polygon);
  if (geometry_.side(job_.polygons()[corner.polygon].support.index(), point) != 0) return false;
  const uint32_t plane = corner.plane & CutLoops::kOwnEdge
                             ? job_.edge_plane(corner.polygon, corner.plane & ~CutLoops::kOwnEdge)
                             : corner.plane;
  if (geometry_.side(plane, point) != 0) return false;
  const LineAxis way = geometry_.axis_between(corner.at, corner.after);
  return geometry_.compare_along(point, corner.at, way.axis) * way.sign > 0;
}

/// `leads_to(corner, point)`: whether one goes on to an edge that ends elsewhere.
template <class LeadsTo>
bool TouchFinder::is_one_round(std::span<const Corner> corners, LeadsTo&& leads_to) {
  constexpr size_t kMost = 64;  // all are compared with all
  if (corners.size() > kMost) return false;
  size_t at = 0;
  for (size_t steps = 1; steps <= corners.size(); ++steps) {
    size_t next = 0;
    while (next < corners.size() && corners[next].before != corners[at].after) ++next;
    for (size_t i = 0; next == corners.size() && i < corners.size(); ++i) {
      if (leads_to(corners[at], corners[i].before)) next = i;
    }
    if (next == corners.size()) return false;
    if (next == 0) return steps == corners.size();
    at = next;
  }
  return false;
}

void TouchFinder::add_edge(uint32_t a, uint32_t b) {
  PieceBox box;
  box.add(geometry_.point(a).rounded);
  box.add(geometry_.point(b).rounded);
  const PolygonBox around = rounded_outwards(box);
  GridBox& added = boxes_.emplace_back();
  for (size_t k = 0; k < 3; ++k) added.lo[k] = around.lo[k], added.hi[k] = around.hi[k];
}

uint32_t TouchFinder::operand_beside_cuts(std::span<const Corner> corners) const {
  uint32_t operand = kNone;
  bool any_cut = false;
  for (const Corner& c : corners) {
    const uint32_t own = job_.polygons()[c.polygon].operand;
    any_cut |= !c.is_whole;
    if (!c.is_whole || own == operand) continue;
    if (operand != kNone) return kNone;
    operand = own;
  }
  return any_cut ? operand : kNone;
}

std::vector<GridBox> TouchFinder::find() {
  beside_cuts_.assign(is_examined_.size(), kNone);
  CountingOrder by_point;
  by_point.sort(corners_.size(), is_examined_.size(), [&](size_t c) { return corners_[c].at; });
  const auto list = [&](size_t point, std::vector<Corner>& here) {
    here.clear();
    for (uint32_t i = by_point.starts[point]; i < by_point.starts[point + 1]; ++i) {
      here.push_back(corners_[by_point.order[i]]);
    }
  };
  // Nearly all are told without a plane, which may have to be made.
  const std::vector<uint32_t> open = list_in_parts<uint32_t>(
      is_examined_.size(), kFewForThreads, [&](size_t begin, size_t end, auto& out) {
        std::vector<Corner> here;
        for (size_t p = begin; p < end; ++p) {
          if (by_point.starts[p] == by_point.starts[p + 1]) continue;
          list(p, here);
          if (is_one_round(here, [](const Corner&, uint32_t) { return false; })) {
            beside_cuts_[p] = operand_beside_cuts(here);
          } else {
            out.push_back(static_cast<uint32_t>(p));
          }
        }
      });
  std::vector<Corner> here;
  for (const uint32_t p : open) {
    list(p, here);
    if (is_one_round(here, [&](const Corner& c, uint32_t point) { return leads_to(c, point); })) {
      beside_cuts_[p] = operand_beside_cuts(here);
      continue;
    }
    for (const Corner& c : here) {
      add_edge(c.before, c.at);
      add_edge(c.at, c.after);
    }
  }
  return std::move(boxes_);
}

}  // namespace csgrun
