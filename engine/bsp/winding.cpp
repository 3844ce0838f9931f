#include "engine/bsp/winding.h"

#include <cmath>
#include <limits>

#include "engine/exact/fixed_int.h"

namespace csgrun {
namespace {

using Vector = std::array<Int128, 3>;

int sign_of(Int128 x) { return (x > 0) - (x < 0); }

struct SpannedPlane {
  std::array<uint32_t, 3> corners{};  ///< three vertices that are not collinear, counter-clockwise
  Vector normal{};
};

SpannedPlane plane_of(const LeafGeometry& leaf, std::span<const uint32_t> loop) {
  SpannedPlane plane;
  const IVec3& a = leaf.vertices[loop[0]];
  for (size_t i = 1; i + 1 < loop.size(); ++i) {
    const IVec3 &b = leaf.vertices[loop[i]], &c = leaf.vertices[loop[i + 1]];
    for (int k = 0; k < 3; ++k) {
      const int u = (k + 1) % 3, v = (k + 2) % 3;
      plane.normal[k] = static_cast<Int128>(b[u] - a[u]) * (c[v] - a[v]) -
                        static_cast<Int128>(b[v] - a[v]) * (c[u] - a[u]);
    }
    if (plane.normal == Vector{}) continue;
    plane.corners = {loop[0], loop[i], loop[i + 1]};
    return plane;
  }
  return plane;
}

}  // namespace

int winding_in_front(const LeafGeometry& leaf, const PackedBoxes* tree, uint32_t face) {
  const auto loop_of = [&](uint32_t f) {
    return std::span(leaf.corners)
        .subspan(leaf.face_starts[f], leaf.face_starts[f + 1] - leaf.face_starts[f]);
  };
  const SpannedPlane own = plane_of(leaf, loop_of(face));
  int axis = 0;
  const auto size = [&](int k) { return own.normal[k] < 0 ? -own.normal[k] : own.normal[k]; };
  for (int k = 1; k < 3; ++k) {
    if (size(k) > size(axis)) axis = k;
  }
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  // Three times the middle of a triangle within the face, and the ray from there along the axis. It
  // is moved by e along u and by e^2 along v: off all vertices and edges.
  IVec3 middle{0, 0, 0};
  for (const uint32_t corner : own.corners) {
    for (int k = 0; k < 3; ++k) middle[k] += leaf.vertices[corner][k];
  }
  int ahead = 0;  // the winding number on the side of the face that the ray leaves to
  const auto pass = [&](uint32_t f) {
    if (f == face) return;
    const std::span<const uint32_t> loop = loop_of(f);
    int turns = 0;  // of the loop around the ray, seen from where the ray goes
    for (size_t i = 0; i < loop.size(); ++i) {
      const IVec3& a = leaf.vertices[loop[i]];
      const IVec3& b = leaf.vertices[loop[i + 1 < loop.size() ? i + 1 : 0]];
      const bool a_above = 3 * a[v] > middle[v], b_above = 3 * b[v] > middle[v];
      if (a_above == b_above) continue;
      int left = sign_of(static_cast<Int128>(b[u] - a[u]) * (middle[v] - 3 * a[v]) -
                         static_cast<Int128>(b[v] - a[v]) * (middle[u] - 3 * a[u]));
      if (left == 0) left = b_above ? -1 : 1;
      if (b_above && left > 0) ++turns;
      if (a_above && left < 0) --turns;
    }
    if (turns == 0) return;
    const SpannedPlane plane = plane_of(leaf, loop);
    const IVec3& origin = leaf.vertices[loop[0]];
    Int<3> value;
    for (int k = 0; k < 3; ++k) {
      value += multiply<3>(Int<2>::from_int128(plane.normal[k]), Int<1>(middle[k] - 3 * origin[k]));
    }
    // Faces that face the way of the ray are left through their fronts: they count when the ray
    // starts behind them.
    if (value.sign() * turns < 0) ahead += turns;
  };
  if (tree != nullptr) {
    FloatBox ray;
    for (int k = 0; k < 3; ++k) {
      ray.lo[k] = static_cast<float>(std::floor(static_cast<double>(middle[k]) / 3) - 1);
      ray.hi[k] = static_cast<float>(std::ceil(static_cast<double>(middle[k]) / 3) + 1);
    }
    ray.hi[axis] = std::numeric_limits<float>::max();
    tree->visit_all(ray, [&](uint32_t place) { pass(tree->order()[place]); });
  } else {
    for (uint32_t f = 0; f < leaf.face_count(); ++f) pass(f);
  }
  return own.normal[axis] > 0 ? ahead : ahead - 1;
}

}  // namespace csgrun
