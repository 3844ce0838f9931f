#include "engine/csg/locate.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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

/// How a point lies to the planes and edges of a boundary.
class FaceLook {
 public:
  FaceLook(const BoundaryMesh& boundary, const IVec3& p)
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

namespace {

/// Along x, in which rays go, boxes do not tell: all are as long as any.
SquareBins bins_of_faces(const BoundaryMesh& boundary) {
  std::vector<SquareBins::Box> boxes;
  boxes.reserve(boundary.faces.size());
  for (const BoundaryMesh::Face& face : boundary.faces) {
    SquareBins::Box& box = boxes.emplace_back();
    box.lo = {-1, HUGE_VAL, HUGE_VAL};
    box.hi = {1, -HUGE_VAL, -HUGE_VAL};
    const uint32_t begin = boundary.loop_starts[face.first_loop],
                   end = boundary.loop_starts[face.first_loop + face.loop_count];
    for (uint32_t c = begin; c < end; ++c) {
      const std::array<double, 3>& at = boundary.point_rounded[boundary.corners[c].point];
      for (size_t k = 1; k < 3; ++k) {
        box.lo[k] = std::min(box.lo[k], at[k] - 1);  // a step more than what rounding may take
        box.hi[k] = std::max(box.hi[k], at[k] + 1);
      }
    }
  }
  constexpr uint32_t kMost = 512 * 512;
  return {boxes, kMost};
}

}  // namespace

PointLocator::PointLocator(std::shared_ptr<const BoundaryMesh> boundary, bool with_bins)
    : boundary_(std::move(boundary)), box_(bounding_box(*boundary_)) {
  if (with_bins && !boundary_->faces.empty()) bins_ = bins_of_faces(*boundary_);
}

int PointLocator::locate(const IVec3& point) const {
  const BoundaryMesh& boundary = *boundary_;
  for (int i = 0; i < 3; ++i) {
    if (box_.empty() || point[i] < box_.lo[i] || point[i] > box_.hi[i]) return -1;
  }
  const FaceLook look(boundary, point);
  // A ray along +x from the point, which is moved off every edge's shadow as is_within says.
  bool inside = false;
  const auto is_on = [&](const BoundaryMesh::Face& face) {
    const Plane& stored = boundary.planes[face.plane.index()];
    const int here = look.value(stored).sign();
    if (here == 0) {
      int axis = 0;
      while (FaceLook::component(stored, axis) == 0) ++axis;
      return look.is_on_edge(face) || look.is_within(face, stored, axis);
    }
    // Ahead when the plane's value goes to zero along +x.
    if (stored.a == 0 || (here > 0) == (stored.a > 0)) return false;
    if (look.is_within(face, stored, 0)) inside = !inside;
    return false;
  };
  if (!bins_) {
    if (std::any_of(boundary.faces.begin(), boundary.faces.end(), is_on)) return 0;
  } else {
    const auto near = bins_->at({0, static_cast<double>(point[1]), static_cast<double>(point[2])});
    if (std::any_of(near.begin(), near.end(),
                    [&](uint32_t f) { return is_on(boundary.faces[f]); })) {
      return 0;
    }
  }
  return inside ? 1 : -1;
}

}  // namespace csgrun
