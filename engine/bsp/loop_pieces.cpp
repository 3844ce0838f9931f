#include "engine/bsp/loop_pieces.h"

#include <algorithm>
#include <cmath>

#include "engine/bsp/regions.h"

namespace csgrun {

LoopPieces::LoopPieces(CellGeometry& geometry, const PlaneTable& planes, PlaneId support)
    : geometry_(geometry), planes_(planes), support_(support) {
  const auto& n = planes.approximate(support.index());
  const double x = std::fabs(n[0]), y = std::fabs(n[1]), z = std::fabs(n[2]);
  const int normal_axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  axes_ = {(normal_axis + 1) % 3, (normal_axis + 2) % 3};
  positive_ = (n[normal_axis] > 0) != support.flipped();
}

int LoopPieces::turn(const BoundaryEdge& arriving, const BoundaryEdge& leaving) {
  const auto &p = geometry_.point(arriving.from).rounded, &q = geometry_.point(arriving.to).rounded,
             &r = geometry_.point(leaving.to).rounded;
  const auto [i, j] = axes_;
  const double ui = q[i] - p[i], uj = q[j] - p[j], vi = r[i] - q[i], vj = r[j] - q[j];
  const double product = ui * vj, other = uj * vi, determinant = product - other;
  // Differences are off by four roundings of the largest coordinate; all is taken twice.
  double largest = 0;
  for (const int k : axes_) {
    largest = std::max({largest, std::fabs(p[k]), std::fabs(q[k]), std::fabs(r[k])});
  }
  const double e = 0x1p-50 * largest;
  const double bound = e * (std::fabs(ui) + std::fabs(uj) + std::fabs(vi) + std::fabs(vj) + 2 * e) +
                       0x1p-51 * (std::fabs(product) + std::fabs(other));
  if (std::fabs(determinant) > bound) return (determinant > 0) == positive_ ? 1 : -1;
  return turn_between(geometry_, planes_, support_, {arriving.from, arriving.to, arriving.plane},
                      {leaving.from, leaving.to, leaving.plane});
}

bool LoopPieces::add(std::span<const BoundaryEdge> loop, std::vector<Fragment>& pieces) {
  if (passes_twice(loop) || !find_turns(loop) || !is_outline()) return false;
  const size_t before = pieces.size();
  starts_.assign(1, 0);
  while (!starts_.empty()) {
    const size_t start = starts_.back();
    const auto reflex = std::find_if(corners_.begin() + static_cast<std::ptrdiff_t>(start),
                                     corners_.end(), [](const Corner& c) { return c.turn < 0; });
    if (reflex == corners_.end()) {
      take(start, pieces);
      continue;
    }
    const auto at = static_cast<size_t>(reflex - corners_.begin());
    Hit hit{};
    if (!find_hit(start, at, hit)) {
      pieces.resize(before);
      return false;
    }
    divide(start, at, hit);
  }
  return true;
}

BoundaryEdge LoopPieces::edge(std::span<const Corner> loop, size_t i) const {
  return {loop[i].point, loop[i + 1 < loop.size() ? i + 1 : 0].point, loop[i].plane};
}

bool LoopPieces::passes_twice(std::span<const BoundaryEdge> loop) {
  points_.clear();
  points_.reserve(loop.size());
  for (const BoundaryEdge& e : loop) points_.push_back(e.from);
  std::sort(points_.begin(), points_.end());
  return std::adjacent_find(points_.begin(), points_.end()) != points_.end();
}

/// Lists the corners; false when one turns back.
bool LoopPieces::find_turns(std::span<const BoundaryEdge> loop) {
  corners_.clear();
  corners_.reserve(2 * loop.size());
  for (size_t i = 0; i < loop.size(); ++i) {
    const BoundaryEdge& arriving = loop[i > 0 ? i - 1 : loop.size() - 1];
    const int t = turn(arriving, loop[i]);
    if (t == 0 && goes_back(arriving, loop[i])) return false;
    corners_.push_back({loop[i].from, loop[i].plane, t});
  }
  return true;
}

/// Of edges in one line.
bool LoopPieces::goes_back(const BoundaryEdge& arriving, const BoundaryEdge& leaving) {
  const LineAxis along = geometry_.axis_between(arriving.from, arriving.to);
  return geometry_.compare_along(leaving.to, leaving.from, along.axis) != along.sign;
}

/// Whether the corners run counter-clockwise: so it is where they turn at the one that is the
/// lowest along one axis, and of these along the other.
bool LoopPieces::is_outline() {
  size_t lowest = 0;
  for (size_t i = 1; i < corners_.size(); ++i) {
    const uint32_t p = corners_[i].point, q = corners_[lowest].point;
    const int order = geometry_.compare_along(p, q, axes_[0]);
    if (order < 0 || (order == 0 && geometry_.compare_along(p, q, axes_[1]) < 0)) lowest = i;
  }
  return corners_[lowest].turn > 0;
}

/// Where the last loop is first met beyond a corner of it by the edge that arrives there.
bool LoopPieces::find_hit(size_t start, size_t reflex, Hit& hit) {
  const std::span<const Corner> loop(corners_.data() + start, corners_.size() - start);
  const size_t n = loop.size(), own = reflex - start, before = own > 0 ? own - 1 : n - 1;
  const uint32_t from = loop[own].point, plane = loop[before].plane;
  sides_.resize(n);
  for (size_t i = 0; i < n; ++i) {
    sides_[i] = static_cast<int8_t>(geometry_.side(plane, loop[i].point));
  }
  const LineAxis along = geometry_.axis_between(loop[before].point, from);
  const auto is_beyond = [&](uint32_t point, uint32_t other) {
    return geometry_.compare_along(point, other, along.axis) == along.sign;
  };
  bool any = false;
  const auto look_at = [&](const Hit& found) {
    if (is_beyond(found.point, from) && (!any || is_beyond(hit.point, found.point))) {
      hit = found;
      any = true;
    }
  };
  for (size_t i = 0; i < n; ++i) {
    const size_t next = i + 1 < n ? i + 1 : 0;
    if (sides_[i] == 0) look_at({i, loop[i].point, false});
    if (sides_[i] * sides_[next] >= 0) continue;
    // An edge that is not beyond the corner at either end is not met there.
    if (!is_beyond(loop[i].point, from) && !is_beyond(loop[next].point, from)) continue;
    look_at({i, geometry_.add_point({support_.index(), loop[i].plane, plane}), true});
  }
  return any;
}

/// Makes two loops of the last one, along the edge that was drawn on.
void LoopPieces::divide(size_t start, size_t reflex, const Hit& hit) {
  const size_t n = corners_.size() - start, own = reflex - start;
  const size_t before = own > 0 ? own - 1 : n - 1;
  const Corner* loop = corners_.data() + start;
  const uint32_t plane = loop[before].plane;
  const auto next = [n](size_t i) { return i + 1 < n ? i + 1 : 0; };
  // From the corner along the loop to the hit, and back: the corner is one to the left now.
  part_.clear();
  part_.reserve(n + 3);
  part_.push_back({loop[own].point, loop[own].plane, 1});
  for (size_t i = own; i != hit.corner; i = next(i)) part_.push_back(loop[next(i)]);
  if (hit.on_edge) part_.push_back({hit.point, plane, 1});
  part_.back().plane = plane;
  const size_t first_end = part_.size();
  // From the hit along the loop to the edge that is drawn on, which ends in the hit.
  part_.push_back({hit.point, loop[hit.corner].plane, 1});
  for (size_t i = next(hit.corner); i != own; i = next(i)) part_.push_back(loop[i]);
  if (!hit.on_edge) {
    // A corner of both, now.
    const std::span<const Corner> first(part_.data(), first_end),
        second(part_.data() + first_end, part_.size() - first_end);
    part_[first_end - 1].turn = turn(edge(first, first.size() - 2), edge(first, first.size() - 1));
    part_[first_end].turn = turn(edge(second, second.size() - 1), edge(second, 0));
  }
  corners_.resize(start);
  corners_.insert(corners_.end(), part_.begin(), part_.end());
  starts_.push_back(start + first_end);
}

/// The last loop, which turns left or goes straight on everywhere, is a piece.
void LoopPieces::take(size_t start, std::vector<Fragment>& pieces) {
  points_.clear();
  edges_.clear();
  edges_.reserve(corners_.size() - start);
  for (size_t i = start; i < corners_.size(); ++i) {
    const Corner& c = corners_[i];
    const Corner& before = i > start ? corners_[i - 1] : corners_.back();
    if (before.plane == c.plane) continue;  // straight on
    points_.push_back(c.point);
    edges_.push_back(c.plane);
  }
  pieces.push_back(geometry_.make_fragment(support_, points_, edges_));
  corners_.resize(start);
  starts_.pop_back();
}

}  // namespace csgrun
