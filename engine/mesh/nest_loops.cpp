#include "engine/mesh/nest_loops.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace csgrun {
namespace {

using Loop = std::vector<DirectedEdge>;

class Nester {
 public:
  Nester(PlaneId support, CellGeometry& geometry, const PlaneTable& planes)
      : support_(support), geometry_(geometry), planes_(planes) {
    const Plane& n = planes.plane(support.index());
    const auto size = [](Int128 v) { return v < 0 ? -v : v; };
    const int normal =
        size(n.a) >= size(n.b) && size(n.a) >= size(n.c) ? 0 : size(n.b) >= size(n.c) ? 1 : 2;
    u_ = (normal + 1) % 3;
    v_ = (normal + 2) % 3;
  }

  /// Seen from outside: an outer loop turns left at its lowest corner, a hole right. A loop that touches
  /// itself there passes it several times: a hole turns left between two of its lobes, but not each
  /// time.
  [[nodiscard]] bool is_outer(const Loop& loop) const {
    uint32_t low = loop[0].from;
    for (const DirectedEdge& e : loop) {
      if (before(e.from, low)) low = e.from;
    }
    for (size_t i = 0; i < loop.size(); ++i) {
      const DirectedEdge& in = loop[(i + loop.size() - 1) % loop.size()];
      if (loop[i].from == low && turn_between(geometry_, planes_, support_, in, loop[i]) < 0) {
        return false;
      }
    }
    return true;
  }

  /// Whether `hole` lies inside `outer`. Loops of one region do not cross.
  bool contains(const Loop& outer, const Loop& hole) {
    for (const DirectedEdge& e : hole) {
      const int where = locate(outer, e.from);
      if (where != 0) return where > 0;
    }
    return false;
  }

  /// Order by the sweep of `v`, then `u`; doubles decide unless equal.
  [[nodiscard]] bool before(uint32_t p, uint32_t q) const {
    const int by_v = geometry_.compare_along(p, q, v_);
    return by_v ? by_v < 0 : geometry_.compare_along(p, q, u_) < 0;
  }

  struct Box {
    double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
    [[nodiscard]] bool holds(const Box& o) const {
      return lo[0] <= o.lo[0] && lo[1] <= o.lo[1] && hi[0] >= o.hi[0] && hi[1] >= o.hi[1];
    }
  };
  [[nodiscard]] Box box(const Loop& loop) const {
    Box b;
    for (const DirectedEdge& e : loop) {
      const auto& p = geometry_.point(e.from).rounded;
      b.lo[0] = std::min(b.lo[0], p[u_]), b.hi[0] = std::max(b.hi[0], p[u_]);
      b.lo[1] = std::min(b.lo[1], p[v_]), b.hi[1] = std::max(b.hi[1], p[v_]);
    }
    return b;
  }

 private:
  /// +1 inside, 0 on, -1 outside: parity of the edges that a ray towards -u meets.
  int locate(const Loop& loop, uint32_t p) {
    bool inside = false;
    for (const DirectedEdge& e : loop) {
      if (e.from == p || e.to == p) return 0;
      const bool from_above = geometry_.compare_along(e.from, p, v_) > 0;
      const bool to_above = geometry_.compare_along(e.to, p, v_) > 0;
      if (from_above == to_above) continue;
      // Both ends on one side of p along u: no arithmetic needed.
      const int from_u = geometry_.compare_along(e.from, p, u_);
      const int to_u = geometry_.compare_along(e.to, p, u_);
      if (from_u < 0 && to_u < 0) {
        inside = !inside;
      } else if (from_u <= 0 || to_u <= 0) {
        const int side = side_towards_u(e, p);
        if (side == 0) return 0;
        if (side > 0) inside = !inside;
      }
    }
    return inside ? 1 : -1;
  }

  /// +1 when p lies on the +u side of the edge (a ray from p towards -u meets it), 0 on it. In (u, v)
  /// the line is du * u + dv * v + c, got from the edge's plane by eliminating the third axis with
  /// the support: its value at p is the plane's value, and du is a minor of the two normals.
  int side_towards_u(const DirectedEdge& e, uint32_t p) {
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
    return geometry_.side(e.plane, p) * along_u;
  }

  PlaneId support_;
  CellGeometry& geometry_;
  const PlaneTable& planes_;
  int u_, v_;
};

}  // namespace

std::vector<std::vector<Loop>> nest_loops(PlaneId support, const RegionLoops& loops,
                                          CellGeometry& geometry, const PlaneTable& planes) {
  std::vector<std::vector<Loop>> faces;
  std::vector<Loop> holes;
  Nester nester(support, geometry, planes);
  for (size_t l = 0; l < loops.loop_count(); ++l) {
    Loop loop(loops.edges.begin() + loops.starts[l], loops.edges.begin() + loops.starts[l + 1]);
    if (loops.loop_count() == 1 || nester.is_outer(loop)) {
      faces.push_back({std::move(loop)});
    } else {
      holes.push_back(std::move(loop));
    }
  }
  if (holes.empty()) return faces;
  const auto lowest = [&](const Loop& loop) {
    return std::min_element(loop.begin(), loop.end(), [&](const auto& a, const auto& b) {
             return nester.before(a.from, b.from);
           })->from;
  };
  std::vector<Nester::Box> boxes;
  for (const auto& face : faces) boxes.push_back(nester.box(face[0]));
  for (Loop& hole : holes) {
    const Nester::Box box = nester.box(hole);
    // Of several outer loops around a hole the innermost has the highest lowest corner.
    size_t best = faces.size();
    for (size_t f = 0; f < faces.size(); ++f) {
      if (!boxes[f].holds(box) || (faces.size() > 1 && !nester.contains(faces[f][0], hole))) continue;
      if (best == faces.size() || nester.before(lowest(faces[best][0]), lowest(faces[f][0]))) best = f;
    }
    assert(best < faces.size());
    faces[best].push_back(std::move(hole));
  }
  return faces;
}

}  // namespace csgrun
