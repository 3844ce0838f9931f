// Winding numbers of a mesh over doubles: rays from the middles of triangles, moved off every edge
// by infinitesimals. The middle of three doubles is none, but determinants are linear in each
// point: the sum over the three corners has the sign at the middle.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <csgrun/engine/exact_triangles.h>

#include "engine/mesh/box_tree.h"
#include "engine/mesh/exact_determinant.h"
#include "engine/mesh/triangle_shape.h"

namespace csgrun {
namespace {

using Corners = TriangleCorners;

/// The sign of a linear function at the middle of three points from those at the points, when they
/// do not contradict one another.
std::optional<int> agreed(const std::array<int, 3>& signs) {
  const auto [least, most] = std::minmax_element(signs.begin(), signs.end());
  if (*least * *most < 0) return {};
  return *least + *most < 0 ? -1 : *least + *most > 0 ? 1 : 0;
}

/// The sign of coordinate `k` of p, less that of the middle of m.
int beyond_middle(const glm::dvec3& p, const Corners& m, int k) {
  std::array<int, 3> signs{};
  for (size_t i = 0; i < 3; ++i) signs[i] = (p[k] > m[i][k]) - (p[k] < m[i][k]);
  if (const auto sign = agreed(signs)) return *sign;
  ExactSum sum;
  sum.add(p[k], 3, 1);
  for (const glm::dvec3& corner : m) sum.add(corner[k], 1, 1, true);
  return sum.sign();
}

/// The sign of the area of a, b and the middle of m, seen along `axis`.
int area_with_middle(int axis, const glm::dvec3& a, const glm::dvec3& b, const Corners& m) {
  std::array<int, 3> signs{};
  for (size_t i = 0; i < 3; ++i) signs[i] = orient_along(axis, a, b, m[i]);
  if (const auto sign = agreed(signs)) return *sign;
  ExactSum sum;
  for (const glm::dvec3& corner : m) add_area(sum, (axis + 1) % 3, (axis + 2) % 3, a, b, corner);
  return sum.sign();
}

/// On which side of t the middle of m lies: positive in front.
int side_of_middle(const Corners& t, const Corners& m) {
  std::array<int, 3> signs{};
  for (size_t i = 0; i < 3; ++i) signs[i] = orient(t[0], t[1], t[2], m[i]);
  if (const auto sign = agreed(signs)) return *sign;
  ExactSum sum;
  for (const glm::dvec3& corner : m) add_determinant(sum, t[0], t[1], t[2], corner, false);
  return sum.sign();
}

class Windings {
 public:
  explicit Windings(const TriangleView& mesh)
      : mesh_(mesh), boxes_(boxes_of(mesh)), tree_(boxes_) {}

  [[nodiscard]] int in_front(uint32_t triangle) const {
    const Corners own = corners_of(mesh_, triangle);
    const TriangleAspect view = aspect_of(own);
    const int axis = view.axis, v = (axis + 2) % 3;
    int ahead = 0;  // the winding number on the side that the ray leaves to
    tree_.visit_all(ray_box(own, axis), [&](uint32_t other) {
      if (other == triangle) return;
      const Corners t = corners_of(mesh_, other);
      int turns = 0;  // of the triangle around the ray, seen from where the ray goes
      for (size_t i = 0; i < 3; ++i) {
        const glm::dvec3 &a = t[i], &b = t[(i + 1) % 3];
        // The ray is moved by e along u and by e^2 along v, for an infinitesimal e.
        const bool a_above = beyond_middle(a, own, v) > 0, b_above = beyond_middle(b, own, v) > 0;
        if (a_above == b_above) continue;
        int left = area_with_middle(axis, a, b, own);
        if (left == 0) left = b_above ? -1 : 1;
        if (b_above && left > 0) ++turns;
        if (a_above && left < 0) --turns;
      }
      // What faces the way of the ray is left through its front: it counts when the ray starts
      // behind it.
      if (turns != 0 && side_of_middle(t, own) * turns < 0) ahead += turns;
    });
    return view.sign > 0 ? ahead : ahead - 1;
  }

 private:
  static std::vector<Box> boxes_of(const TriangleView& mesh) {
    std::vector<Box> boxes;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
      boxes.push_back(box_of(corners_of(mesh, t)));
    return boxes;
  }

  /// A box that holds the ray, whatever the rounding of the middle.
  static Box ray_box(const Corners& t, int axis) {
    Box box{};
    for (int k = 0; k < 3; ++k) {
      const double middle = t[0][k] / 3 + t[1][k] / 3 + t[2][k] / 3;
      const double size = std::max({std::abs(t[0][k]), std::abs(t[1][k]), std::abs(t[2][k])});
      const double margin = size * 0x1p-49 + std::numeric_limits<double>::min();
      box.lo[static_cast<size_t>(k)] = middle - margin;
      box.hi[static_cast<size_t>(k)] = middle + margin;
    }
    box.hi[static_cast<size_t>(axis)] = std::numeric_limits<double>::infinity();
    return box;
  }

  const TriangleView& mesh_;
  std::vector<Box> boxes_;
  BoxTree tree_;
};

}  // namespace

std::vector<int> windings_in_front(const TriangleView& mesh, std::span<const uint32_t> triangles) {
  std::vector<int> result;
  if (triangles.empty()) return result;
  const Windings windings(mesh);
  for (const uint32_t triangle : triangles) result.push_back(windings.in_front(triangle));
  return result;
}

}  // namespace csgrun
