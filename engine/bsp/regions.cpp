#include "engine/bsp/regions.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/base/counting_order.h"
#include "engine/base/number_map.h"
#include "engine/base/sort_few.h"

namespace csgrun {
namespace {

/// The direction of an edge as a multiple of n x t, n the outward normal of the support and t the
/// normal of the edge's plane: its sign.
template <class Geometry>
int direction_sign(Geometry& geometry, const PlaneTable& planes, PlaneId support,
                   const DirectedEdge& e) {
  const LineAxis line = line_axis(planes.oriented(support), planes.plane(e.plane));
  return geometry.compare_along(e.to, e.from, line.axis) * line.sign;
}

/// The sign of det(n, p, q) of the normals; 0 where doubles do not tell.
int turn_by_doubles(const PlaneTable& planes, PlaneId support, uint32_t p_plane, uint32_t q_plane) {
  const auto &n = planes.approximate(support.index()), &p = planes.approximate(p_plane),
             &q = planes.approximate(q_plane);
  double determinant = 0, size = 0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double u = n[k] * (p[i] * q[j]), v = n[k] * (p[j] * q[i]);
    determinant += u - v;
    size += std::fabs(u) + std::fabs(v);
  }
  // Less than ten roundings of no more than the sum of the sizes.
  if (std::fabs(determinant) <= 0x1p-48 * size) return 0;
  return (determinant > 0) != support.flipped() ? 1 : -1;
}

/// The turn between the directions sign_a n x t_a and sign_b n x t_b: the sign of det(n, t_a, t_b).
int turn(const PlaneTable& planes, PlaneId support, uint32_t plane_a, int sign_a, uint32_t plane_b,
         int sign_b) {
  if (const int quick = turn_by_doubles(planes, support, plane_a, plane_b)) {
    return quick * sign_a * sign_b;
  }
  const Plane n = planes.oriented(support);
  const Plane &p = planes.plane(plane_a), &q = planes.plane(plane_b);
  using N = Int<2>;
  const auto minor = [](Int128 u, Int128 v, Int128 x, Int128 y) {
    return multiply<4>(N::from_int128(u), N::from_int128(y)) -
           multiply<4>(N::from_int128(v), N::from_int128(x));
  };
  static_assert(widths::point_w(widths::kMaxNormal) < 64 * 6);
  const auto determinant = multiply<6>(minor(p.b, p.c, q.b, q.c), N::from_int128(n.a)) +
                           multiply<6>(minor(p.c, p.a, q.c, q.a), N::from_int128(n.b)) +
                           multiply<6>(minor(p.a, p.b, q.a, q.b), N::from_int128(n.c));
  return determinant.sign() * sign_a * sign_b;
}

}  // namespace

template <class Points>
int turn_between(Points& points, const PlaneTable& planes, PlaneId support, const DirectedEdge& a,
                 const DirectedEdge& b) {
  return turn(planes, support, a.plane, direction_sign(points, planes, support, a), b.plane,
              direction_sign(points, planes, support, b));
}
template int turn_between(CellGeometry&, const PlaneTable&, PlaneId, const DirectedEdge&,
                          const DirectedEdge&);
template int turn_between(PointView&, const PlaneTable&, PlaneId, const DirectedEdge&,
                          const DirectedEdge&);

bool RegionBuilder::build(PlaneId support, const std::vector<DirectedEdge>& edges,
                          RegionLoops& loops) {
  loops.clear();
  // Most cuts meet their counterpart end to end: cancel these first.
  by_ends_.clear();
  for (const DirectedEdge& e : edges) {
    by_ends_.emplace_back(ends_together(e.from, e.to), together(e.from, e.plane));
  }
  std::sort(by_ends_.begin(), by_ends_.end());
  open_.clear();
  for (size_t i = 0; i < by_ends_.size();) {
    const uint64_t ends = by_ends_[i].first;
    const auto lower = static_cast<uint32_t>(ends >> 32), higher = static_cast<uint32_t>(ends);
    // Those that leave the lower end come first.
    size_t j = i, forward = 0;
    while (j < by_ends_.size() && by_ends_[j].first == ends) {
      forward += by_ends_[j++].second >> 32 == lower;
    }
    const size_t backward = j - i - forward;
    const auto plane = [&](size_t k) { return static_cast<uint32_t>(by_ends_[k].second); };
    for (size_t k = backward; k < forward; ++k) open_.push_back({lower, higher, plane(i)});
    for (size_t k = forward; k < backward; ++k) open_.push_back({higher, lower, plane(j - 1)});
    i = j;
  }
  boundary_.clear();
  return cancel_on_lines(support) && trace(support, loops);
}

bool RegionBuilder::build_single(PlaneId support, const std::vector<DirectedEdge>& edges,
                                 RegionLoops& loops) {
  loops.clear();
  boundary_ = edges;
  return trace(support, loops);
}

bool RegionBuilder::cancel_on_lines(PlaneId support) {
  constexpr size_t kFew = 16;
  if (open_.size() <= kFew) return cancel_few(support);
  // Most lines are of one plane that all their edges have: these are named once.
  NumberMap line_of_plane;
  lines_.clear();
  line_of_edge_.clear();
  for (const DirectedEdge& e : open_) {
    const auto next = static_cast<uint32_t>(lines_.size());
    const auto [line, is_new] = line_of_plane.find_or_add(e.plane, next);
    if (is_new) lines_.push_back({support.index(), e.plane});
    line_of_edge_.push_back(line);
  }
  namer_.keys(lines_, keys_);
  struct Keyed {
    LineKey key;
    uint32_t line;
  };
  std::vector<Keyed> keyed;
  keyed.reserve(keys_.size());
  for (uint32_t i = 0; i < keys_.size(); ++i) keyed.push_back({keys_[i], i});
  std::sort(keyed.begin(), keyed.end(),
            [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
  std::vector<uint32_t> place(keyed.size());  // per line: equal ones have one
  uint32_t places = 0;
  for (size_t i = 0; i < keyed.size(); ++i) {
    if (i > 0 && keyed[i].key != keyed[i - 1].key) ++places;
    place[keyed[i].line] = places;
  }
  CountingOrder by_place;
  by_place.sort(open_.size(), places + size_t{1},
                [&](size_t e) { return place[line_of_edge_[e]]; });
  for (uint32_t p = 0; p <= places; ++p) {
    line_.clear();
    for (uint32_t i = by_place.starts[p]; i < by_place.starts[p + 1]; ++i) {
      line_.push_back(open_[by_place.order[i]]);
    }
    if (!cancel_line(support.index())) return false;
  }
  return true;
}

/// Lines of a few edges are told apart by looking at pairs: mostly one end decides.
bool RegionBuilder::cancel_few(PlaneId support) {
  while (!open_.empty()) {
    line_.clear();
    const DirectedEdge first = open_[0];
    size_t kept = 0;
    for (const DirectedEdge& e : open_) {
      const bool on_line = e.plane == first.plane || (geometry_.side(first.plane, e.from) == 0 &&
                                                      geometry_.side(first.plane, e.to) == 0);
      if (on_line) {
        line_.push_back(e);
      } else {
        open_[kept++] = e;
      }
    }
    open_.resize(kept);
    if (!cancel_line(support.index())) return false;
  }
  return true;
}

bool RegionBuilder::cancel_line(uint32_t support) {
  if (line_.size() > 1) return sweep_line(support);
  boundary_.push_back(line_[0]);
  return true;
}

bool RegionBuilder::sweep_line(uint32_t support) {
  const uint32_t plane = line_[0].plane;
  const LineAxis axis = line_axis(planes_.plane(support), planes_.plane(plane));
  std::vector<uint32_t>& points = on_line_;
  points.clear();
  for (const DirectedEdge& e : line_) {
    points.push_back(e.from);
    points.push_back(e.to);
    // The key is a hash: confirm that this edge lies on the first one's line.
    if (e.plane != plane && (geometry_.side(plane, e.from) || geometry_.side(plane, e.to))) {
      return false;
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::sort(points.begin(), points.end(),
            [&](uint32_t p, uint32_t q) { return geometry_.compare_along(p, q, axis.axis) < 0; });
  place_.clear();
  for (uint32_t i = 0; i < points.size(); ++i) place_.emplace_back(points[i], i);
  std::sort(place_.begin(), place_.end(), pair_less);
  const auto place = [&](uint32_t p) {
    return std::lower_bound(place_.begin(), place_.end(), std::pair(p, 0u))->second;
  };
  change_.assign(points.size() + 1, 0);
  for (const DirectedEdge& e : line_) {
    ++change_[place(e.from)];
    --change_[place(e.to)];
  }
  int net = 0;
  for (size_t i = 0; i + 1 < points.size(); ++i) {
    net += change_[i];
    if (net > 1 || net < -1) return false;
    if (net == 1) boundary_.push_back({points[i], points[i + 1], plane});
    if (net == -1) boundary_.push_back({points[i + 1], points[i], plane});
  }
  return net + change_[points.size() - 1] == 0;
}

bool RegionBuilder::straight(const DirectedEdge& in, const DirectedEdge& out) {
  return in.plane == out.plane || geometry_.side(in.plane, out.to) == 0;
}

/// The edge `out` follows `in` at a point that no others pass.
void RegionBuilder::link(uint32_t in, uint32_t out) {
  next_[in] = out;
  corner_[out] = !straight(boundary_[in], boundary_[out]);
}

/// For a few edges that stand as they follow each other round one loop, which passes no point
/// twice: what one piece has by itself. False for all others.
bool RegionBuilder::link_in_order() {
  constexpr size_t kFew = 12;
  const auto count = static_cast<uint32_t>(boundary_.size());
  if (count > kFew) return false;
  for (uint32_t i = 0; i < count; ++i) {
    const DirectedEdge& e = boundary_[i];
    if (e.to != boundary_[i + 1 < count ? i + 1 : 0].from) return false;
    for (uint32_t k = 0; k < i; ++k) {
      if (boundary_[k].from == e.from) return false;
    }
  }
  for (uint32_t i = 0; i < count; ++i) link(i, i + 1 < count ? i + 1 : 0);
  return true;
}

/// The general case. False when as many edges do not arrive at a point as leave it.
bool RegionBuilder::link_at_points(PlaneId support) {
  // Incident edges by point: edge 2 i leaves boundary edge i's start, 2 i + 1 arrives at its end.
  std::vector<uint64_t>& ends = ends_;
  ends.clear();
  for (uint32_t i = 0; i < boundary_.size(); ++i) {
    ends.push_back(together(boundary_[i].from, 2 * i));
    ends.push_back(together(boundary_[i].to, 2 * i + 1));
  }
  std::sort(ends.begin(), ends.end());
  const auto point = [&](size_t i) { return ends[i] >> 32; };
  const auto edge = [&](size_t i) { return static_cast<uint32_t>(ends[i]); };
  for (size_t i = 0, j = i; i < ends.size(); i = j) {
    while (j < ends.size() && point(j) == point(i)) ++j;
    if (j - i == 2) {
      const uint32_t a = edge(i), b = edge(i + 1);
      if ((a & 1) == (b & 1)) return false;
      a & 1 ? link(a / 2, b / 2) : link(b / 2, a / 2);
      continue;
    }
    incident_.clear();
    size_t arriving = 0;
    for (size_t k = i; k < j; ++k) {
      incident_.push_back(edge(k));
      arriving += edge(k) & 1;
    }
    if (2 * arriving != j - i) return false;
    // Where wedges touch, one of them may be a straight angle: no corner of its loop.
    pair_wedges(support, incident_);
    for (const uint32_t end : incident_) {
      const uint32_t in = end / 2;
      if ((end & 1) && next_[in] != kNone) link(in, next_[in]);
    }
  }
  return true;
}

bool RegionBuilder::trace(PlaneId support, RegionLoops& loops) {
  next_.assign(boundary_.size(), kNone);
  corner_.assign(boundary_.size(), 1);
  if (!link_in_order() && !link_at_points(support)) return false;
  std::vector<uint8_t>& done = done_;
  done.assign(boundary_.size(), 0);
  for (uint32_t i = 0; i < boundary_.size(); ++i) {
    if (done[i] || !corner_[i]) continue;
    for (uint32_t e = i; !done[e];) {
      DirectedEdge edge = boundary_[e];
      done[e] = 1;
      e = next_[e];
      while (e != kNone && !corner_[e] && !done[e]) {
        edge.to = boundary_[e].to;
        done[e] = 1;
        e = next_[e];
      }
      if (e == kNone) return false;
      loops.edges.push_back(edge);
    }
    loops.starts.push_back(static_cast<uint32_t>(loops.edges.size()));
  }
  return std::all_of(done.begin(), done.end(), [](uint8_t d) { return d; });
}

void RegionBuilder::pair_wedges(PlaneId support, std::vector<uint32_t>& incident) {
  // Directions away from the point, as multiples of n x t; sorted counter-clockwise from the first.
  struct Spoke {
    uint32_t end;
    const DirectedEdge* edge;
    int sign;
    int half;  ///< 0: turned by less than 180 degrees from the first spoke, or equal; 1: the rest
  };
  std::vector<Spoke> spokes;
  for (const uint32_t end : incident) {
    const DirectedEdge& e = boundary_[end / 2];
    const int along = direction_sign(geometry_, planes_, support, e);
    spokes.push_back({end, &e, end & 1 ? -along : along, 0});
  }
  const Spoke first = spokes[0];
  const auto away = [](const Spoke& s) { return s.end & 1 ? s.edge->from : s.edge->to; };
  const LineAxis line = line_axis(planes_.plane(support.index()), planes_.plane(first.edge->plane));
  const uint32_t center = first.end & 1 ? first.edge->to : first.edge->from;
  const int along_first = geometry_.compare_along(away(first), center, line.axis);
  for (Spoke& s : spokes) {
    const int t = turn(planes_, support, first.edge->plane, first.sign, s.edge->plane, s.sign);
    // Collinear with the first: the same direction, or the opposite.
    const bool same = t == 0 && geometry_.compare_along(away(s), center, line.axis) == along_first;
    s.half = t > 0 || same ? 0 : 1;
  }
  // Both sides of a slit point the same way: the interior is clockwise of the one that arrives and
  // counter-clockwise of the one that leaves, so the one that arrives comes first.
  std::sort(spokes.begin(), spokes.end(), [&](const Spoke& a, const Spoke& b) {
    if (a.half != b.half) return a.half < b.half;
    if (a.end == b.end) return false;
    const int t = turn(planes_, support, a.edge->plane, a.sign, b.edge->plane, b.sign);
    return t > 0 || (t == 0 && (a.end & 1) > (b.end & 1));
  });
  // Interior lies just counter-clockwise of an outgoing edge and just clockwise of an incoming one:
  // an incoming edge goes on with the outgoing one next to it clockwise.
  for (size_t i = 0; i < spokes.size(); ++i) {
    if (!(spokes[i].end & 1)) continue;
    const Spoke& before = spokes[(i + spokes.size() - 1) % spokes.size()];
    if (!(before.end & 1)) next_[spokes[i].end / 2] = before.end / 2;
  }
}

}  // namespace csgrun
