#include "engine/mesh/face_location.h"

#include <cassert>

namespace csgrun {

FaceLocator::FaceLocator(PlaneId support, PointView& points, const PlaneTable& planes)
    : support_(support), points_(points), planes_(planes) {
  const Plane& n = planes.plane(support.index());
  const auto size = [](Int128 v) { return v < 0 ? -v : v; };
  const int normal = size(n.a) >= size(n.b) && size(n.a) >= size(n.c) ? 0
                     : size(n.b) >= size(n.c)                         ? 1
                                                                      : 2;
  u_ = (normal + 1) % 3;
  v_ = (normal + 2) % 3;
}

bool FaceLocator::before(uint32_t p, uint32_t q) const {
  const int by_v = points_.compare_along(p, q, v_);
  return by_v ? by_v < 0 : points_.compare_along(p, q, u_) < 0;
}

FaceLocator::Met FaceLocator::meet(const DirectedEdge& e, uint32_t p) {
  if (e.from == p || e.to == p) return Met::kOn;
  const int from_v = points_.compare_along(e.from, p, v_);
  const int to_v = points_.compare_along(e.to, p, v_);
  const bool is_along = from_v == 0 && to_v == 0;
  if (!is_along && (from_v > 0) == (to_v > 0)) return Met::kMissed;
  const int from_u = points_.compare_along(e.from, p, u_);
  const int to_u = points_.compare_along(e.to, p, u_);
  // The ray does not meet an edge along it, but p may lie on one.
  if (is_along) return from_u * to_u < 0 ? Met::kOn : Met::kMissed;
  // Both ends on one side of p along u: no arithmetic needed.
  if (from_u < 0 && to_u < 0) return Met::kCrossed;
  if (from_u > 0 && to_u > 0) return Met::kMissed;
  const int side = side_towards_u(e, p);
  return side == 0 ? Met::kOn : side > 0 ? Met::kCrossed : Met::kMissed;
}

/// +1 when p lies on the +u side of the edge (a ray from p towards -u meets it), 0 on it. In (u, v)
/// the line is du * u + dv * v + c, got from the edge's plane by eliminating the third axis with
/// the support: its value at p is the plane's value, and du is a minor of the two normals.
int FaceLocator::side_towards_u(const DirectedEdge& e, uint32_t p) {
  const Plane &s = planes_.plane(support_.index()), &t = planes_.plane(e.plane);
  const auto component = [](const Plane& q, int axis) {
    return Int<2>::from_int128(axis == 0 ? q.a : axis == 1 ? q.b : q.c);
  };
  const int w = 3 - u_ - v_;
  // On the support, moving by (du = 1, dw = -s_u / s_w) changes t by t_u - t_w s_u / s_w.
  const auto slope = multiply<4>(component(t, u_), component(s, w)) -
                     multiply<4>(component(t, w), component(s, u_));
  const int along_u = slope.sign() * component(s, w).sign();
  assert(along_u != 0);  // the edge is not parallel to u: its ends differ along v
  return points_.side(e.plane, p) * along_u;
}

bool FaceLocator::is_in_wedge(const DirectedEdge& arriving, const DirectedEdge& leaving,
                              const DirectedEdge& line) {
  // The wedge of the interior runs counter-clockwise from the edge that leaves to the one that
  // arrives (seen from the point).
  const int from_leaving = turn_between(points_, planes_, support_, leaving, line);
  const int to_arriving = turn_between(points_, planes_, support_, arriving, line);
  const int corner = turn_between(points_, planes_, support_, arriving, leaving);
  // Left of both at a convex corner, left of one of them at a reflex one.
  return corner > 0 ? from_leaving > 0 && to_arriving > 0 : from_leaving > 0 || to_arriving > 0;
}

}  // namespace csgrun
