#include "engine/csg/locate.h"

#include <cmath>

#include "engine/bsp/kernel.h"
#include "engine/exact/fixed_int.h"

namespace csgrun {
namespace {

// Widths of the values below, for points below 2^28.
constexpr int kValueBits =
    (widths::kMaxNormal + 28 > widths::kMaxOffset ? widths::kMaxNormal + 28 : widths::kMaxOffset) +
    2;
static_assert(widths::limbs(kValueBits) <= 3);
static_assert(widths::limbs(kValueBits + widths::kMaxNormal + 1) <= 5);
static_assert(widths::limbs(2 * widths::kMaxNormal + 1) <= 4);

class Locator {
 public:
  Locator(const BoundaryMesh& boundary, const IVec3& p)
      : boundary_(boundary), p_(p), point_(grid_point(p[0], p[1], p[2])) {}

  /// The plane's value at the point.
  [[nodiscard]] Int<3> value(const Plane& plane) const {
    Int<3> sum = Int<3>::from_int128(plane.d);
    for (int i = 0; i < 3; ++i) {
      sum += multiply<3>(Int<2>::from_int128(component(plane, i)), Int<1>(p_[i]));
    }
    return sum;
  }

  /// Sign of a vertex less the point along an axis.
  [[nodiscard]] int compare_vertex(uint32_t vertex, int axis) const {
    // The rounded coordinate is within 2^-26 of the true one, as coordinates are below 2^28.
    const double difference = boundary_.point_rounded[vertex][axis] - static_cast<double>(p_[axis]);
    if (std::fabs(difference) > 0x1p-20) return difference > 0 ? 1 : -1;
    return compare_along(boundary_.exact_point(vertex), point_, axis);
  }

  template <class F>
  void each_edge(const BoundaryMesh::Face& face, F&& f) const {
    for (uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      const uint32_t begin = boundary_.loop_starts[l], end = boundary_.loop_starts[l + 1];
      for (uint32_t c = begin; c < end; ++c) {
        const BoundaryMesh::Corner& corner = boundary_.corners[c];
        f(corner.point, boundary_.corners[c + 1 < end ? c + 1 : begin].point,
          boundary_.planes[corner.edge_plane]);
      }
    }
  }

  /// Whether the point, which is in the face's plane, is on an edge of it.
  [[nodiscard]] bool is_on_edge(const BoundaryMesh::Face& face) const {
    bool on_edge = false;
    each_edge(face, [&](uint32_t a, uint32_t b, const Plane& edge) {
      if (on_edge) return;
      for (int axis = 0; axis < 3; ++axis) {
        if (compare_vertex(a, axis) * compare_vertex(b, axis) > 0) return;
      }
      on_edge = value(edge).is_zero();
    });
    return on_edge;
  }

  /// Whether the point, moved infinitesimally along v and, much more, along u, is within the face
  /// as seen along `axis` (u and v are the axes that follow it). All signs are taken where the line
  /// through the point along `axis` meets the face's plane.
  [[nodiscard]] bool is_within(const BoundaryMesh::Face& face, const Plane& plane, int axis) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Int<2> n_axis = Int<2>::from_int128(component(plane, axis));
    const Int<2> n_u = Int<2>::from_int128(component(plane, u));
    const Int<3> offset = value(plane);
    bool inside = false;
    each_edge(face, [&](uint32_t a, uint32_t b, const Plane& edge) {
      if ((compare_vertex(a, v) > 0) == (compare_vertex(b, v) > 0)) return;
      // The value of the edge's plane there, and how it grows along u within the face's plane, both
      // times n_axis. The crossing lies ahead when the value grows towards zero.
      const Int<2> e_axis = Int<2>::from_int128(component(edge, axis));
      const Int<5> here = multiply<5>(value(edge), n_axis) - multiply<5>(offset, e_axis);
      const Int<4> growth =
          multiply<4>(Int<2>::from_int128(component(edge, u)), n_axis) - multiply<4>(e_axis, n_u);
      // A value of zero: the crossing is at the point, so before the moved one.
      if (here.sign() * growth.sign() < 0) inside = !inside;
    });
    return inside;
  }

  static Int128 component(const Plane& plane, int axis) {
    return axis == 0 ? plane.a : axis == 1 ? plane.b : plane.c;
  }

 private:
  const BoundaryMesh& boundary_;
  IVec3 p_;
  Point point_;
};

}  // namespace

int locate(const BoundaryMesh& boundary, const IVec3& point) {
  const GridBox box = bounding_box(boundary);
  for (int i = 0; i < 3; ++i) {
    if (box.empty() || point[i] < box.lo[i] || point[i] > box.hi[i]) return -1;
  }
  const Locator locator(boundary, point);
  // A ray along +x from the point, which is moved off every edge's shadow as is_within says.
  bool inside = false;
  for (const BoundaryMesh::Face& face : boundary.faces) {
    const Plane& stored = boundary.planes[face.plane.index()];
    const int here = locator.value(stored).sign();
    if (here == 0) {
      int axis = 0;
      while (Locator::component(stored, axis) == 0) ++axis;
      if (locator.is_on_edge(face) || locator.is_within(face, stored, axis)) return 0;
      continue;
    }
    // Ahead when the plane's value goes to zero along +x.
    if (stored.a == 0 || (here > 0) == (stored.a > 0)) continue;
    if (locator.is_within(face, stored, 0)) inside = !inside;
  }
  return inside ? 1 : -1;
}

}  // namespace csgrun
